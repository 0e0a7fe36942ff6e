"""Scenes, meshes, textures and hair that somebody spoilt: one sentence, and nothing is left."""

import base64
import io
import json
import math
import struct
import time
import zlib

import numpy as np
import pytest
from PIL import Image

from test_scenes import FACES, TETRAHEDRON, glb_bytes, obj_text, write_scene

SMALL = ("--size", 12, "--uv", "1x1", "--light-count", 4)


def png(width, height, data, colour_type=2, depth=8):
    def chunk(kind, body):
        return struct.pack(">I", len(body)) + kind + body + \
            struct.pack(">I", zlib.crc32(kind + body))

    header = struct.pack(">IIBBBBB", width, height, depth, colour_type, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", data) + chunk(b"IEND", b"")


def picture(kind, **options):
    noise = np.random.default_rng(0).integers(0, 256, (40, 40, 3), dtype=np.uint8)
    file = io.BytesIO()
    Image.fromarray(noise).save(file, kind, **options)
    return file.getvalue()


def patched(data, at, replacement):
    return data[:at] + replacement + data[at + len(replacement):]


ROWS = zlib.compress(b"".join(b"\0" + bytes(24) for _ in range(8)))
PNG, JPEG, GIF = png(8, 8, ROWS), picture("JPEG"), picture("GIF")
JPEG_SIZE = JPEG.index(b"\xff\xc0") + 5
TEXTURES = {
    "empty.png": b"", "text.png": b"once upon a time\n", "signature.png": PNG[:8],
    "half.png": PNG[:len(PNG) // 2], "end.png": PNG[:-14], "noise.png": png(8, 8, b"noise" * 9),
    "rows.png": png(64, 64, ROWS), "none.png": png(0, 0, ROWS),
    "huge.png": png(2**31 - 1, 2**31 - 1, ROWS), "wide.png": png(65535, 65535, ROWS),
    "large.png": png(16384, 16384, ROWS, 6, 16),
    "half.jpg": JPEG[:len(JPEG) // 2], "head.jpg": JPEG[:20],
    "large.jpg": patched(JPEG, JPEG_SIZE, struct.pack(">HH", 16000, 16000)),
    "huge.jpg": patched(JPEG, JPEG_SIZE, struct.pack(">HH", 65535, 65535)),
    "half.gif": GIF[:len(GIF) // 2], "large.gif": patched(GIF, 6, struct.pack("<HH", 16000, 16000)),
    "half.tif": picture("TIFF")[:3000], "head.tif": picture("TIFF")[:8],
    "half.webp": picture("WEBP")[:500], "half.bmp": picture("BMP")[:3000],
    "large.bmp": patched(picture("BMP"), 18, struct.pack("<ii", 16000, 16000)),
    "half.tga": picture("TGA")[:3000], "text.tga": b"once upon a time\n" * 9,
    "large.tga": patched(picture("TGA"), 12, struct.pack("<HH", 16000, 16000)),
    "large.hdr": b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 16000 +X 16000\n" + b"\1\1\1\1" * 4,
    "head.exr": b"\x76\x2f\x31\x01", "noise.exr": b"\x76\x2f\x31\x01" + bytes(200),
}
USES = ("baseColourTexture", "metallicRoughnessTexture", "normalTexture")


@pytest.mark.parametrize("name", TEXTURES)
def test_spoilt_textures(illum, tmp_path, name):
    (tmp_path / name).write_bytes(TEXTURES[name])
    for use in USES if name == "half.png" else USES[:1]:
        scene = write_scene(tmp_path, meshes=[{"shape": "box", "material": "m"}],
                            materials={"m": {use: name}})
        begun = time.monotonic()
        outcome = illum("build", scene, "-o", tmp_path / "o.illum", expect=None)
        assert outcome.peak_bytes < 1.5e9, "memory is not asked for on a header's word"
        assert time.monotonic() - begun < 30
        illum.refuses("build", scene, "-o", tmp_path / "o.illum", mentions=name, leaves=tmp_path)


@pytest.mark.parametrize("name", ["half.png", "text.png", "half.jpg"])
def test_spoilt_textures_of_mesh_files(illum, tmp_path, name):
    (tmp_path / name).write_bytes(TEXTURES[name])
    (tmp_path / "m.mtl").write_text(f"newmtl m\nmap_Kd {name}\n")
    (tmp_path / "a.obj").write_text("mtllib m.mtl\nusemtl m\n" + obj_text())
    illum.refuses("build", tmp_path / "a.obj", "-o", tmp_path / "o.illum", mentions=name,
                  leaves=tmp_path)
    held = base64.b64encode(TEXTURES[name]).decode()
    for uri in (name, f"data:image/png;base64,{held}"):
        write_gltf(tmp_path, **textured(uri))
        illum.refuses("build", tmp_path / "a.gltf", "-o", tmp_path / "o.illum",
                      mentions=name if uri == name else "a.gltf", leaves=tmp_path)


POINTS = b"".join(struct.pack("<3f", *p) for p in TETRAHEDRON)
INDICES = b"".join(struct.pack("<3H", *f) for f in FACES)


def data_uri(data):
    return "data:application/octet-stream;base64," + base64.b64encode(data).decode()


TREE = json.loads(glb_bytes()[20:][:struct.unpack_from("<I", glb_bytes(), 12)[0]])
BUFFER = {"byteLength": len(POINTS + INDICES), "uri": data_uri(POINTS + INDICES)}


def write_gltf(folder, **fields):
    (folder / "a.gltf").write_text(json.dumps({**TREE, "buffers": [BUFFER], **fields}))


def buffer(uri, **more):
    return {"buffers": [{**BUFFER, "uri": uri, **more}]}


def changed(name, number, **fields):
    entries = [dict(entry) for entry in TREE[name]]
    entries[number].update(fields)
    return {name: entries}


def primitive(**fields):
    return {"meshes": [{"primitives": [{**TREE["meshes"][0]["primitives"][0], **fields}]}]}


def textured(uri):
    return {"materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}],
            "textures": [{"source": 0}], "images": [{"uri": uri}], **primitive(material=0)}


def sparse(count=1, index_view=1, kind=5123):
    return changed("accessors", 0, sparse={
        "count": count, "indices": {"bufferView": index_view, "componentType": kind},
        "values": {"bufferView": 0}})


def attribute(name, target=False, **form):
    """Another attribute, or one of a morph target, read from the points' bytes."""
    at = len(TREE["accessors"])
    accessor = {"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3", **form}
    attributes = TREE["meshes"][0]["primitives"][0]["attributes"]
    use = {"targets": [{name: at}]} if target else {"attributes": {**attributes, name: at}}
    return {"accessors": [*TREE["accessors"], accessor], **primitive(**use)}


def material(**fields):
    return {"materials": [fields], **primitive(material=0)}


def metallic_roughness(**fields):
    return material(pbrMetallicRoughness=fields)


def extension(name, **fields):
    return {"extensionsUsed": [name], **material(extensions={name: fields})}


NAN = struct.pack("<f", math.nan)
BAD_GLTF = {
    "a buffer that is missing": (buffer("none.bin"), "none.bin"),
    "a buffer that is too short": (buffer("short.bin"), "a.gltf"),
    "a buffer that is a folder": (buffer("."), "buffers[0].uri"),
    "a buffer without a name": (buffer(""), "buffers[0].uri"),
    "a buffer named by a number": (buffer(5), "buffers[0].uri"),
    "a buffer with a zero in its name": (buffer("mesh.bin\0.png"), "buffers[0].uri"),
    "a buffer outside": (buffer("../outside.bin"), "../outside.bin"),
    "a buffer outside, by a detour": (buffer("a/../../outside.bin"), "buffers[0].uri"),
    "a buffer outside, escaped": (buffer("%2e%2e/outside.bin"), "buffers[0].uri"),
    "a buffer outside, backslash": (buffer("..\\outside.bin"), "buffers[0].uri"),
    "an absolute buffer": (buffer("/dev/zero"), "/dev/zero"),
    "a buffer by its address": (buffer("file:///dev/zero"), "buffers[0].uri"),
    "a buffer of the net": (buffer("http://localhost/mesh.bin"), "buffers[0].uri"),
    "no buffer at all": ({"buffers": [{"byteLength": 72}]}, "buffers[0]"),
    "data that is no base64": (buffer("data:application/octet-stream;base64,@@!!"), "expected"),
    "data that is cut off": (buffer(BUFFER["uri"][:-3]), "base64"),
    "data that is too short": (buffer(data_uri(POINTS)), "a.gltf"),
    "no data": (buffer("data:,"), "a.gltf"),
    "data without a comma": (buffer("data:application/octet-stream;base64"), "a.gltf"),
    "a negative length": (buffer("mesh.bin", byteLength=-1), "buffers[0].byteLength"),
    "an absurd length": (buffer("mesh.bin", byteLength=2**60), "buffers[0].byteLength"),
    "coordinates that are no numbers": (buffer(data_uri(NAN + (POINTS + INDICES)[4:])), "nan"),
    "an index out of range": (buffer(data_uri(POINTS + b"\xff\x7f" + INDICES[2:])), "triangles"),
    "more points than there are": (changed("accessors", 0, count=5), "accessors[0]"),
    "absurdly many points": (changed("accessors", 0, count=2**31), "accessors[0]"),
    "a negative count": (changed("accessors", 0, count=-4), "accessors[0].count"),
    "a fraction of a point": (changed("accessors", 0, count=3.5), "accessors[0].count"),
    "no points": (changed("accessors", 0, count=0), "accessors[0].count"),
    "an offset too far": (changed("accessors", 0, byteOffset=40), "accessors[0]"),
    "a negative offset": (changed("accessors", 0, byteOffset=-4), "accessors[0].byteOffset"),
    "a view that is not there": (changed("accessors", 0, bufferView=9), "accessors[0].bufferView"),
    "an unknown type": (changed("accessors", 0, type="VEC9"), "accessors[0].type"),
    "an unknown component": (changed("accessors", 0, componentType=1), "accessors[0].componentType"),
    "points of one number": (changed("accessors", 0, type="SCALAR"), "attributes.POSITION"),
    "points of whole numbers": (changed("accessors", 0, componentType=5123), "attributes.POSITION"),
    "indices of floats": (changed("accessors", 1, componentType=5126, count=3),
                          "primitives[0].indices"),
    "indices of three numbers": (changed("accessors", 1, type="VEC3", count=2),
                                 "primitives[0].indices"),
    "normals of two numbers": (attribute("NORMAL", type="VEC2"), "attributes.NORMAL"),
    "fewer normals than points": (attribute("NORMAL", count=3), "attributes."),
    "coordinates of bytes": (attribute("TEXCOORD_0", type="VEC2", componentType=5121),
                             "attributes.TEXCOORD_0"),
    "coordinates that are not said to be normalised": (
        attribute("TEXCOORD_0", type="VEC2", componentType=5123, normalized="yes"),
        "accessors[2].normalized"),
    "coordinates beyond a short file": (
        {**buffer("short.bin"), **attribute("TEXCOORD_0", type="VEC2", componentType=5121,
                                            normalized=True)}, "buffers[0]"),
    "sparse coordinates of points that are not there": (
        attribute("TEXCOORD_0", type="VEC2", componentType=5121, normalized=True, sparse={
            "count": 4, "indices": {"bufferView": 0, "byteOffset": 14, "componentType": 5121},
            "values": {"bufferView": 0}}), "accessors[2].sparse"),
    "fewer coordinates than points": (attribute("TEXCOORD_0", type="VEC2", count=2), "attributes."),
    "colours of one number": (attribute("COLOR_0", type="SCALAR"), "attributes.COLOR_0"),
    "fewer colours than points": (attribute("COLOR_0", count=1), "attributes."),
    "morphed points that are fewer": (attribute("POSITION", target=True, count=2),
                                      "targets[0].POSITION"),
    "indices of four bytes": (changed("accessors", 1, componentType=5125), "accessors[1]"),
    "a view beyond its buffer": (changed("bufferViews", 1, byteLength=25), "bufferViews[1]"),
    "a view before its buffer": (changed("bufferViews", 1, byteOffset=-24), "bufferViews[1]"),
    "a view around the number circle": (changed("bufferViews", 0, byteOffset=2**64 - 8),
                                        "bufferViews[0]"),
    "a view of no buffer": (changed("bufferViews", 0, buffer=3), "bufferViews[0].buffer"),
    "a stride of one": (changed("bufferViews", 0, byteStride=1), "bufferViews[0].byteStride"),
    "an absurd stride": (changed("bufferViews", 0, byteStride=2**31), "bufferViews[0].byteStride"),
    "sparse beyond all points": (sparse(count=2**30), "sparse.count"),
    "sparse beyond its view": (sparse(count=4, kind=5125, index_view=9), "indices.bufferView"),
    "sparse points out of range": (sparse(count=2, kind=5125), "a.gltf"),
    "zeros without end": ({"accessors": [{"componentType": 5126, "count": 2**31, "type": "VEC3"},
                                         TREE["accessors"][1]]}, "accessors[0].count"),
    "points that are not there": (primitive(attributes={"POSITION": 9}), "attributes.POSITION"),
    "indices that are not there": (primitive(indices=9), "primitives[0].indices"),
    "a material that is not there": (primitive(material=9), "primitives[0].material"),
    "an unknown mode": (primitive(mode=77), "primitives[0].mode"),
    "points alone": (primitive(mode=0), "a.gltf"),
    "a strip of one corner": ({**primitive(mode=5), **changed("accessors", 1, count=1)}, "corners"),
    "a node in itself": ({"nodes": [{"mesh": 0, "children": [0]}]}, "nodes"),
    "nodes in a circle": ({"nodes": [{"children": [1]}, {"mesh": 0, "children": [2]},
                                     {"children": [0]}]}, "nodes"),
    "a circle below": ({"nodes": [{"children": [1]}, {"mesh": 0, "children": [2]},
                                  {"children": [1]}]}, "nodes[2].children"),
    "a node with two parents": ({"nodes": [*({"children": [i + 1] * 9} for i in range(9)),
                                           {"mesh": 0}]}, "nodes[0].children"),
    "a very deep tree": ({"nodes": [*({"children": [i + 1]} for i in range(50000)), {"mesh": 0}]},
                         "1000 levels"),
    "a child that is not there": ({"nodes": [{"mesh": 0, "children": [9]}]}, "nodes[0].children"),
    "a negative child": ({"nodes": [{"mesh": 0, "children": [-1]}]}, "nodes[0].children"),
    "a mesh that is not there": ({"nodes": [{"mesh": 9}]}, "nodes[0].mesh"),
    "a short matrix": ({"nodes": [{"mesh": 0, "matrix": [1, 2]}]}, "nodes[0].matrix"),
    "a matrix of words": ({"nodes": [{"mesh": 0, "matrix": ["a"] * 16}]}, "nodes[0].matrix"),
    "a translation that is no number": ({"nodes": [{"mesh": 0, "translation": [math.nan, 0, 0]}]},
                                        "JSON"),
    "an infinite scale": ({"nodes": [{"mesh": 0, "scale": [1e38, 1e38, 1e38]}]}, "coordinates"),
    "a scale of zero": ({"nodes": [{"mesh": 0, "scale": [0, 0, 0]}]}, "triangles"),
    "a scene that is not there": ({"scene": 9}, "scene"),
    "a scene of nodes that are not there": ({"scenes": [{"nodes": [9]}]}, "scenes[0].nodes"),
    "a scene with a node twice": ({"scenes": [{"nodes": [0, 0]}]}, "scenes[0].nodes"),
    "a scene of nothing": ({"scenes": [{}]}, "triangles"),
    "nodes that are no list": ({"nodes": {}}, "nodes"),
    "nodes that are numbers": ({"nodes": [1, 2]}, "nodes[0]"),
    "meshes that are nothing": ({"meshes": None}, "meshes"),
    "a colour of three numbers": (metallic_roughness(baseColorFactor=[1, 1, 1]), "baseColorFactor"),
    "a colour above 1": (metallic_roughness(baseColorFactor=[1, 1, 2, 1]), "baseColorFactor"),
    "a colour below 0": (metallic_roughness(baseColorFactor=[1, -1, 1, 1]), "baseColorFactor"),
    "a colour of words": (metallic_roughness(baseColorFactor=["1"] * 4), "baseColorFactor"),
    "a colour that is one number": (metallic_roughness(baseColorFactor=1), "baseColorFactor"),
    "a huge roughness": (metallic_roughness(roughnessFactor=1e300), "roughnessFactor"),
    "a negative roughness": (metallic_roughness(roughnessFactor=-0.5), "roughnessFactor"),
    "a roughness in words": (metallic_roughness(roughnessFactor="dull"), "roughnessFactor"),
    "a metallic factor above 1": (metallic_roughness(metallicFactor=1.5), "metallicFactor"),
    "a metallic factor that is a list": (metallic_roughness(metallicFactor=[1]), "metallicFactor"),
    "factors that are a list": (material(pbrMetallicRoughness=[]), "pbrMetallicRoughness"),
    "an emission of words": (material(emissiveFactor="bright"), "emissiveFactor"),
    "a negative cutoff": (material(alphaMode="MASK", alphaCutoff=-1), "alphaCutoff"),
    "an unknown alpha mode": (material(alphaMode="DITHER"), "alphaMode"),
    "a texture that is not there": (metallic_roughness(baseColorTexture={"index": 3}),
                                    "baseColorTexture.index"),
    "a texture that is a number": (material(normalTexture=3), "normalTexture"),
    "an image that is not there": ({**textured("a.png"), "textures": [{"source": 4}]},
                                   "textures[0].source"),
    "a sampler that is not there": ({**textured("a.png"), "textures": [{"source": 0, "sampler": 2}]},
                                    "textures[0].sampler"),
    "a texture wrapped in an unknown way": ({"samplers": [{"wrapS": 7}]}, "samplers[0].wrapS"),
    "an image in a view that is not there": ({**textured("a.png"), "images": [{"bufferView": 7}]},
                                             "images[0].bufferView"),
    "an image named by a number": (textured(4), "images[0].uri"),
    "a transmission above 1": (extension("KHR_materials_transmission", transmissionFactor=2),
                               "transmissionFactor"),
    "a negative refraction": (extension("KHR_materials_ior", ior=-1.5), "KHR_materials_ior.ior"),
    "a diffuse factor of words": (extension("KHR_materials_pbrSpecularGlossiness",
                                            diffuseFactor="red"), "diffuseFactor"),
    "an image of base64 that is none": (textured("data:image/png;base64,@@"), "base64"),
}


@pytest.mark.parametrize("fault", BAD_GLTF)
def test_spoilt_gltf(illum, tmp_path, fault):
    (tmp_path / "outside.bin").write_bytes(POINTS + INDICES)
    folder = tmp_path / "scene"
    folder.mkdir()
    (folder / "mesh.bin").write_bytes(POINTS + INDICES)
    (folder / "short.bin").write_bytes(POINTS)
    (folder / "a").mkdir()
    fields, mention = BAD_GLTF[fault]
    write_gltf(folder, **fields)
    begun = time.monotonic()
    illum.refuses("build", folder / "a.gltf", "-o", tmp_path / "o.illum", *SMALL,
                  mentions=["a.gltf", mention], leaves=tmp_path)
    assert time.monotonic() - begun < 30


GOOD_GLTF = {
    "data": {},
    "a file": buffer("mesh.bin"),
    "a file in a folder": buffer("./parts/../mesh.bin"),
    "a file with a blank": buffer("my%20mesh.bin"),
    "a mesh that no node shows": {"meshes": [TREE["meshes"][0]] * 2},
    "a scene of several": {"scene": 1, "scenes": [{"nodes": []}, {"nodes": [0]}]},
    "a mesh shown twice": {"nodes": [{"mesh": 0}, {"mesh": 0, "translation": [2, 0, 0]}],
                           "scenes": [{"nodes": [0, 1]}]},
    "a strip": primitive(mode=5),
    "a fan": primitive(mode=6),
    "no indices": {"meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}]},
    "a deep tree": {"nodes": [*({"children": [i + 1]} for i in range(900)), {"mesh": 0}]},
    "normals": attribute("NORMAL"),
    "colours of bytes": attribute("COLOR_0", type="VEC4", componentType=5121, normalized=True),
    "coordinates of bytes": attribute("TEXCOORD_0", type="VEC2", componentType=5121,
                                      normalized=True),
    "an attribute of its own": attribute("_SCAN", type="SCALAR"),
    "all factors": metallic_roughness(baseColorFactor=[1, 0, 0.5, 1], metallicFactor=1,
                                      roughnessFactor=1.0000001),
    "a sampler": {"samplers": [{"wrapS": 10497}]},
}


@pytest.mark.parametrize("kind", GOOD_GLTF)
def test_what_gltf_allows_is_taken(illum, tmp_path, kind):
    for name in ("mesh.bin", "my mesh.bin"):
        (tmp_path / name).write_bytes(POINTS + INDICES)
    (tmp_path / "parts").mkdir()
    write_gltf(tmp_path, **GOOD_GLTF[kind])
    outcome = illum("build", tmp_path / "a.gltf", "-o", tmp_path / "o.illum", *SMALL)
    assert "a.gltf" not in outcome.stderr.replace("a.gltf: mesh", ""), outcome


def test_a_texture_that_is_missing_is_remarked(illum, tmp_path):
    write_gltf(tmp_path, **textured("none.png"))
    outcome = illum("build", tmp_path / "a.gltf", "-o", tmp_path / "o.illum", *SMALL)
    assert "'none.png', which is not there" in outcome.stderr


@pytest.mark.parametrize("length, offset", [(2**40, 0), (80, 0), (72, 2)])
def test_binary_gltf_whose_chunk_is_too_short(illum, tmp_path, length, offset):
    (tmp_path / "a.glb").write_bytes(glb_bytes(
        buffers=[{"byteLength": length}], **changed("bufferViews", 1, byteOffset=48 + offset)))
    illum.refuses("build", tmp_path / "a.glb", "-o", tmp_path / "o.illum",
                  mentions=["a.glb", "buffer"], leaves=tmp_path)


FBX = "; FBX 7.3.0 project file\nFBXHeaderExtension:  {\n\tFBXVersion: 7300\n}\n"


def fbx_text(models, links):
    return "".join([FBX, "Objects:  {\n",
                    *(f'\tModel: {i}, "Model::m{i}", "Null" {{\n\t}}\n' for i in range(1, models + 1)),
                    "}\nConnections:  {\n", *(f'\tC: "OO",{a},{b}\n' for a, b in links), "}\n"])


def fbx_record(at, name, properties=b"", count=0, records=()):
    """A record of binary FBX that begins at `at`; `records`: functions of their own places."""
    head = 13 + len(name) + len(properties)
    within = b""
    for record in records:
        within += record(at + head + len(within))
    within += bytes(13) if records else b""
    return struct.pack("<3IB", at + head + len(within), count, len(properties), len(name)) + \
        name + properties + within


def binary_fbx(*records):
    data = b"Kaydara FBX Binary  \0\x1a\0" + struct.pack("<I", 7300)
    for record in records:
        data += record(len(data))
    return data + bytes(13)


def nested_fbx(levels):
    end = 27 + 27 * levels
    heads = (struct.pack("<3IBc", end - 13 * i, 0, 0, 1, b"A") for i in range(levels))
    return binary_fbx(lambda at: b"".join(heads) + bytes(13) * levels)


def chained_fbx(models):
    def number(value):
        return b"L" + struct.pack("<q", value)

    def model(i):
        return lambda at: fbx_record(at, b"Model", number(i) + b"S\0\0\0\0" * 2, 3)

    def link(i):
        return lambda at: fbx_record(at, b"C", b"S\2\0\0\0OO" + number(i) + number(i - 1), 3)

    return binary_fbx(
        lambda at: fbx_record(at, b"Objects", records=[model(i) for i in range(1, models + 1)]),
        lambda at: fbx_record(at, b"Connections", records=[link(i) for i in range(1, models + 1)]))


MANY = 100_000
BAD_FBX = {
    "records within each other": (FBX + "A:  {\n" * MANY + "}\n" * MANY, "100 others"),
    "records that never end": (FBX + "A:  {\n" * MANY, "100 others"),
    "binary records within each other": (nested_fbx(MANY), "100 others"),
    "a chain of models": (fbx_text(MANY, [(i, i - 1) for i in range(1, MANY + 1)]), "1000 models"),
    "a chain upwards": (fbx_text(MANY, [(i, i - 1) for i in range(MANY, 0, -1)]), "1000 models"),
    "a binary chain of models": (chained_fbx(MANY), "1000 models"),
    "a model in itself": (fbx_text(1, [(1, 1)]), "itself"),
    "models in a circle": (fbx_text(3, [(1, 2), (2, 3), (3, 1)]), "itself"),
    "a circle below": (fbx_text(3, [(1, 0), (2, 1), (3, 2), (2, 3)]), "2 belonging to two"),
    "a model twice in another": (fbx_text(2, [(1, 0), (2, 1), (2, 1)]), "2 belonging to two"),
    "a deep tree of nothing": (fbx_text(900, [(i, i - 1) for i in range(1, 901)]), "triangles"),
    "a comment and a string of braces": (FBX + "; " + "{" * 200 + '\nA: "' + "{" * 200 + '"\n',
                                         "FBX-Parser"),
}


@pytest.mark.parametrize("fault", BAD_FBX)
def test_spoilt_fbx(illum, tmp_path, fault):
    data, mention = BAD_FBX[fault]
    (tmp_path / "a.fbx").write_bytes(data if isinstance(data, bytes) else data.encode())
    illum.refuses("build", tmp_path / "a.fbx", "-o", tmp_path / "o.illum", *SMALL,
                  mentions=["a.fbx", mention], leaves=tmp_path)


HAIR = {
    "empty": "", "blank": "\n\n\n", "letters": "a b c\n", "one point": "0 0 0\n",
    "one point among others": "0 0 0\n0 1 0\n\n0 0 0\n", "no number": "0 0 0\nnan 0 0\n",
    "infinite": "0 0 0\ninf 0 0\n", "far away": "0 0 0\n1e300 0 0\n", "too far": "1e999 0 0\n0 1 0\n",
    "two numbers": "0 0\n1 1\n", "four numbers": "0 0 0 1\n0 1 0 1\n", "bytes": "\0\1\2\xff" * 99,
    "a comment": "# nothing\n",
}


@pytest.mark.parametrize("fault", HAIR)
def test_spoilt_hair(illum, tmp_path, fault):
    (tmp_path / "hair.txt").write_text(HAIR[fault], encoding="latin1")
    scene = write_scene(tmp_path, hair=[{"file": "hair.txt"}])
    illum.refuses("build", scene, "-o", tmp_path / "o.illum", mentions="hair.txt",
                  leaves=tmp_path)


TEXCOORD = "vt 0 0\nvn 0 0 1\n"
BAD_OBJ = {
    "beyond the last": ("f 1 2 99\n", "a.obj:9: "), "zero": ("f 0 1 2\n", "a.obj:9: "),
    "before the first": ("f -5 -1 -2\n", "a.obj:9: "),
    "beyond all numbers": ("f 1 2 99999999999999999999\n", "a.obj:9: "),
    "continued": ("f 1 2 \\\n99\n", "a.obj:10: "),
    "texture coordinates": (TEXCOORD + "f 1/1 2/1 3/2\n", "texture coordinates"),
    "no texture coordinates": ("f 1/1 2/1 3/1\n", "texture coordinates"),
    "normals": (TEXCOORD + "f 1//1 2//1 3//2\n", "normals"),
    "words": ("f a b c\n", "a.obj"), "two corners": ("f 1 2\n", "a.obj"),
    "no number": ("v nan 0 0\nf 1 2 5\n", "nan"), "infinite": ("v 1e99 0 0\nf 1 2 5\n", "inf"),
}


@pytest.mark.parametrize("fault", BAD_OBJ)
def test_spoilt_obj(illum, tmp_path, fault):
    more, mention = BAD_OBJ[fault]
    (tmp_path / "a.obj").write_text(obj_text() + more)
    illum.refuses("build", tmp_path / "a.obj", "-o", tmp_path / "o.illum",
                  mentions=["a.obj", mention], leaves=tmp_path)


@pytest.mark.parametrize("ending", ["\n", "\r\n", "\r"])
def test_what_obj_allows_is_taken(illum, tmp_path, ending):
    text = "f 1 2 3\n" + obj_text() + TEXCOORD + "f -1/-1/-1 -2/1/1 \\\n -3/1/1\n"
    if ending == "\r":
        text = text.replace("\\\n", "")
    (tmp_path / "a.obj").write_text(text.replace("\n", ending), newline="")
    illum("build", tmp_path / "a.obj", "-o", tmp_path / "o.illum", *SMALL)


MATERIALS = {"missing": ("none.mtl", True), "a folder": ("folder", True),
             "bytes": ("bytes.mtl", False), "empty": ("empty.mtl", False)}


@pytest.mark.parametrize("fault", MATERIALS)
def test_materials_of_obj_are_remarked_at_most(illum, tmp_path, fault):
    name, remarked = MATERIALS[fault]
    (tmp_path / "folder").mkdir()
    (tmp_path / "bytes.mtl").write_bytes(bytes(range(256)) * 9)
    (tmp_path / "empty.mtl").write_bytes(b"")
    (tmp_path / "a.obj").write_text(f"mtllib {name}\nusemtl m\n" + obj_text())
    outcome = illum("build", tmp_path / "a.obj", "-o", tmp_path / "o.illum", *SMALL)
    assert (f"'{name}', which are not there" in outcome.stderr) == remarked, outcome


@pytest.mark.parametrize("line", ["Kd nan -5 1e99", "Ks 0 nan 0", "Ns nan", "Ni nan", "d nan"])
def test_a_material_of_obj_that_is_no_number_is_refused(illum, tmp_path, line):
    (tmp_path / "a.mtl").write_text(f"newmtl m\n{line}\n")
    (tmp_path / "a.obj").write_text("mtllib a.mtl\nusemtl m\n" + obj_text())
    illum.refuses("build", tmp_path / "a.obj", "-o", tmp_path / "o.illum", *SMALL,
                  mentions=["a.obj: material 'm': expected a number as its", "found nan"],
                  leaves=tmp_path)
