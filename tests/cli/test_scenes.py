"""Scene files and mesh files from the command line: built, captured, interrupted, refused."""

import json
import math
import random
import signal
import struct
import time

import numpy as np
import pytest

import stacks

LITTLE = {"samples": 1, "bounces": 0}
SLAB = {"slab": {"viewPoints": [2, 2], "longerSide": 32}}
BOX = [{"shape": "box"}]


def write_scene(folder, name="scene.json", **fields):
    scene = {"illumScene": 1, "meshes": BOX, "views": [SLAB], "lights": {"fibonacci": 9}, **LITTLE,
             **fields}
    file = folder / name
    file.write_text(json.dumps(scene))
    return file


def info_of(illum, file):
    return json.loads(illum("info", file, "--json").stdout)


TURNED = [math.cos(0.7), 0, math.sin(0.7), 0, 1, 0, -math.sin(0.7), 0, math.cos(0.7)]
POSE = {"rotation": TURNED, "translation": [4 * math.sin(0.7), 0, 4 * math.cos(0.7)]}
VIEWS = {
    "slab": ([SLAB], 4),
    "slabs": ([SLAB, {"slab": {"name": "side", "toward": [1, 0, 0.2], "viewPoints": [1, 2],
                               "longerSide": 24}}], 6),
    "turn": ([{"turn": {"slabs": 3, "viewPoints": [2, 1], "longerSide": 24}}], 6),
    "camera": ([{"camera": {"eye": [3, 2, 4], "size": [32, 24]}}], 1),
    "poses": ([{"camera": {"name": "a", "frame": POSE, "focal": [40, 40], "size": [32, 32]}},
               {"camera": {"name": "b", "eye": [0, 0, 5], "size": [32, 32]}}], 2),
    "equirectangular": ([{"panorama": {"eye": [0, 0, 3], "size": [64, 32]}}], 1),
    "cylindrical": ([{"panorama": {"projection": "cylindrical", "eye": [0, 0, 3],
                                   "heights": [-0.5, 0.5], "size": [64, 16]}}], 1),
    "photograph": ([{"photograph": {"size": [32, 24]}}], 1),
    "mixed": ([SLAB, {"camera": {"eye": [3, 2, 4], "size": [32, 24]}},
               {"panorama": {"eye": [0, 0, 3], "size": [64, 32]}}], 6),
}
GEOMETRIES = {"slabs": "slab", "turn": "slab", "poses": "camera", "equirectangular": "panorama",
              "cylindrical": "panorama"}


@pytest.mark.parametrize("kind", VIEWS)
def test_every_kind_of_view(illum, tmp_path, kind):
    views, count = VIEWS[kind]
    scene = write_scene(tmp_path, views=views, lights={"fibonacci": 9, "region": "sphere"})
    illum("build", scene, "-o", tmp_path / "o.illum")
    illum("verify", tmp_path / "o.illum")
    info = info_of(illum, tmp_path / "o.illum")
    assert info["views"] == count and info["depth"] and info["mask"]
    assert info["geometry"] == GEOMETRIES.get(kind, kind)
    assert sum(info["viewsOfKind"].values()) == count
    assert info["bases"] == {"slabs": 2, "turn": 3}.get(kind, 1)
    illum("relight", tmp_path / "o.illum", "--light", "0.3,0.5,0.8", "-o", tmp_path / "o.png")
    assert stacks.read_picture(tmp_path / "o.png").max() > 100, "the box is lit"


LIGHTS = {
    "polar": ({"polar": [4, 4]}, 16, "hemisphere"),
    "polar_wide": ({"polar": [3, 6], "region": "sphere"}, 18, "sphere"),
    "fibonacci": ({"fibonacci": 12}, 12, "hemisphere"),
    "fibonacci_sphere": ({"fibonacci": 12, "region": "sphere"}, 12, "sphere"),
    "directions": ({"directions": [[0, 0, 2], [1, 0, 1], [0, 1, 1], [-1, -1, 1]]}, 4, "hemisphere"),
    "file": ({"file": "lamps.lp"}, 3, "hemisphere"),
    "sharp": ({"fibonacci": 12, "radiusDegrees": 0}, 12, "hemisphere"),
}


@pytest.mark.parametrize("grid", LIGHTS)
def test_every_grid_of_lights(illum, tmp_path, grid):
    lights, count, domain = LIGHTS[grid]
    (tmp_path / "lamps.lp").write_text("3\na 0 0 1\nb 0.6 0 0.8\nc 0 0.6 0.8\n")
    illum("build", write_scene(tmp_path, lights=lights), "-o", tmp_path / "o.illum")
    info = info_of(illum, tmp_path / "o.illum")
    assert info["lights"] == count and info["domain"] == domain


def test_lights_behind_the_window_are_kept(illum, tmp_path):
    """Light from behind the picture's plane reaches only what it should: the upper side of a roof."""
    meshes = [{"shape": "rectangle", "rotateDegrees": [-90, 0, 0]}]
    scene = write_scene(tmp_path, meshes=meshes, lights={"polar": [8, 8], "region": "sphere"},
                        views=[{"slab": {"viewPoints": [1, 1], "toward": [0, 1, 1],
                                         "longerSide": 24}}])
    illum("build", scene, "-o", tmp_path / "o.illum", "--coding", "png")
    shown = {}
    for name, light in {"behind": "0,1,-0.6", "below": "0,-1,-0.6"}.items():
        illum("relight", tmp_path / "o.illum", "--light", light, "-o", tmp_path / f"{name}.png")
        shown[name] = np.median(stacks.read_picture(tmp_path / f"{name}.png")[..., :3])
    assert shown["behind"] > 120 and shown["below"] < 30, shown


def test_the_extension_below_the_horizon(illum, tmp_path):
    """The paper's step across the equator is offered for rendered hemispheres too."""
    scene = write_scene(tmp_path, lights={"polar": [5, 8]})
    for word in ("--extension", "--no-extension"):
        illum("build", scene, "-o", tmp_path / f"o{word}.illum", "--basis", "sh",
              "--coefficients", 9, word)
    assert (tmp_path / "o--extension.illum").read_bytes() != \
        (tmp_path / "o--no-extension.illum").read_bytes()


TETRAHEDRON = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
FACES = [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)]


def obj_text(points=TETRAHEDRON, faces=FACES):
    lines = ["v " + " ".join(map(str, p)) for p in points]
    return "\n".join(lines + ["f " + " ".join(str(i + 1) for i in f) for f in faces]) + "\n"


def ply_text(points=TETRAHEDRON, faces=FACES):
    head = (f"ply\nformat ascii 1.0\nelement vertex {len(points)}\nproperty float x\n"
            f"property float y\nproperty float z\nelement face {len(faces)}\n"
            "property list uchar int vertex_indices\nend_header\n")
    return head + "".join(" ".join(map(str, p)) + "\n" for p in points) + \
        "".join("3 " + " ".join(map(str, f)) + "\n" for f in faces)


def glb_bytes(**extra):
    points = b"".join(struct.pack("<3f", *p) for p in TETRAHEDRON)
    indices = b"".join(struct.pack("<3H", *f) for f in FACES)
    tree = {
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "buffers": [{"byteLength": len(points + indices)}],
        "bufferViews": [{"buffer": 0, "byteLength": len(points)},
                        {"buffer": 0, "byteOffset": len(points), "byteLength": len(indices)}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3",
                       "min": [0, 0, 0], "max": [1, 1, 1]},
                      {"bufferView": 1, "componentType": 5123, "count": 12, "type": "SCALAR"}],
        **extra}
    text = json.dumps(tree).encode()
    text += b" " * (-len(text) % 4)
    chunks = struct.pack("<I4s", len(text), b"JSON") + text
    data = points + indices
    chunks += struct.pack("<I4s", len(data), b"BIN\0") + data
    return struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks


@pytest.mark.parametrize("name, contents", [("a.obj", obj_text().encode()),
                                            ("a.ply", ply_text().encode()),
                                            ("a.glb", glb_bytes())])
def test_a_mesh_file_alone(illum, tmp_path, name, contents):
    (tmp_path / name).write_bytes(contents)
    illum("build", tmp_path / name, "-o", tmp_path / "o.illum", "--size", 24, "--uv", "2x2",
          "--light-count", 9)
    info = info_of(illum, tmp_path / "o.illum")
    assert info["geometry"] == "slab" and info["views"] == 4
    illum("relight", tmp_path / "o.illum", "--light", "1,1,1", "-o", tmp_path / "o.png")
    picture = stacks.read_picture(tmp_path / "o.png")
    covered = picture[..., 3] > 0
    assert 0.2 < covered.mean() < 0.8, "the mesh fills its window"
    assert covered[:, 0].mean() < 0.2 and covered[:, -1].mean() < 0.2, "and lies within it"


@pytest.mark.parametrize("half", [False, True])
def test_a_capture_is_built_to_the_same_bytes(illum, tmp_path, half):
    views = [SLAB, {"slab": {"name": "side", "toward": [1, 0, 0], "viewPoints": [2, 1],
                             "longerSide": 24}}]
    scene = write_scene(tmp_path, views=views)
    illum("build", scene, "-o", tmp_path / "direct.illum", "--threads", 1)
    illum("capture", scene, "-o", tmp_path / "folder", *(["--half"] if half else []))
    illum("build", tmp_path / "folder", "-o", tmp_path / "after.illum", "--threads", 2)
    same = (tmp_path / "direct.illum").read_bytes() == (tmp_path / "after.illum").read_bytes()
    assert same != half, "halves are rounded, floats are not"


@pytest.fixture(scope="module")
def ci_case(tmp_path_factory, binary):
    """3 x 3 views of 128 x 128 under 64 lights, undisturbed, on one thread."""
    from conftest import Illum
    folder = tmp_path_factory.mktemp("ci")
    scene = write_scene(folder, lights={"fibonacci": 64}, samples=2, bounces=1,
                        meshes=[{"shape": "teapot"}],
                        views=[{"slab": {"viewPoints": [3, 3], "longerSide": 128}}])
    begun = time.monotonic()
    Illum(folder)("build", scene, "-o", folder / "o.illum", "--threads", 1)
    return scene, (folder / "o.illum").read_bytes(), time.monotonic() - begun


@pytest.mark.parametrize("seed", range(3))
def test_killed_renderings_go_on_to_the_same_bytes(illum, ci_case, tmp_path, seed):
    scene, whole, seconds = ci_case
    moments, out = random.Random(seed), tmp_path / "o.illum"
    for attempt in range(2):
        process = illum.start("build", scene, "-o", out, "--threads", 2,
                              *(["--resume"] if attempt else []))
        time.sleep(moments.uniform(0.1, 0.7) * seconds)
        process.send_signal(signal.SIGKILL)
        process.wait(60)
        if out.exists():
            break
    if not out.exists():
        illum("build", scene, "-o", out, "--threads", 2, "--resume")
        assert [p.name for p in tmp_path.iterdir()] == ["o.illum"]
    # Killed between the object's renaming and the last tidying up, its folder may still be there.
    assert out.read_bytes() == whole


BAD_FIELDS = {
    "no meshes": ({"meshes": []}, "meshes"),
    "a misspelt field": ({"sampels": 3}, "samples"),
    "another version": ({"illumScene": 2}, "illumScene"),
    "no direction": ({"lights": {"directions": [[0, 0, 0]]}}, "zero vector"),
    "no lights": ({"lights": {"directions": []}}, "lights.directions"),
    "zero lights": ({"lights": {"fibonacci": 0}}, "lights.fibonacci"),
    "two kinds of lights": ({"lights": {"fibonacci": 9, "polar": [2, 2]}}, "several"),
    "a missing light file": ({"lights": {"file": "none.lp"}}, "none.lp"),
    "a missing mesh": ({"meshes": [{"file": "none.obj"}]}, "none.obj"),
    "a missing texture": ({"meshes": [{"shape": "box", "material": "m"}],
                           "materials": {"m": {"baseColourTexture": "none.png"}}}, "none.png"),
    "an unknown material": ({"meshes": [{"shape": "box", "material": "gold"}],
                             "materials": {"golden": {}}}, "golden"),
    "an unknown shape": ({"meshes": [{"shape": "cube"}]}, "box"),
    "a flat scale": ({"meshes": [{"shape": "box", "scale": [1, 0, 1]}]}, "scale"),
    "a mirror image of a frame": ({"views": [{"slab": {"frame": {
        "rotation": [1, 0, 0, 0, 1, 0, 0, 0, -1]}}}]}, "frame"),
    "view points inside": ({"views": [{"slab": {"distance": 0.1}}]}, "distance"),
    "a photograph beside others": ({"views": [SLAB, {"photograph": {"size": [32, 24]}}]},
                                   "scene.json: expected a photograph to be the only view"),
    "two kinds of view": ({"views": [{"slab": {}, "turn": {}}]}, "views[0]"),
    "an empty window": ({"views": [{"slab": {"window": [1, 0, 1, 1]}}]}, "window"),
    "absurdly many pixels": ({"views": [{"slab": {"viewPoints": [1024, 1024],
                                                  "longerSide": 65536}}]}, "shadow rays"),
    "absurdly many samples": ({"samples": 65536, "bounces": 64, "lights": {"fibonacci": 100000},
                               "views": [{"slab": {"longerSide": 4096}}]}, "years"),
    "a hair file of words": ({"hair": [{"file": "hair.txt"}]}, "hair.txt"),
    "negative samples": ({"samples": -1}, "samples"),
    "text for a number": ({"bounces": "many"}, "bounces"),
}


@pytest.mark.parametrize("fault", BAD_FIELDS)
@pytest.mark.parametrize("command", ["build", "capture"])
def test_bad_scenes_are_refused_in_one_sentence(illum, tmp_path, fault, command):
    fields, mention = BAD_FIELDS[fault]
    (tmp_path / "hair.txt").write_text("once upon a time\n")
    scene = write_scene(tmp_path, **fields)
    out = tmp_path / ("o.illum" if command == "build" else "folder")
    illum.refuses(command, scene, "-o", out, mentions=mention, leaves=tmp_path)


NAN = [("nan", 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
FLAT = [(0, 0, 0), (0, 0, 0), (0, 0, 0), (0, 0, 0)]
BAD_MESHES = {
    "empty.obj": b"", "words.obj": b"once upon a time\n", "empty.ply": b"", "empty.glb": b"",
    "nan.ply": ply_text(NAN).encode(), "flat.obj": obj_text(FLAT).encode(),
    "flat.ply": ply_text(FLAT).encode(), "far.ply": ply_text(faces=[(0, 1, 999)]).encode(),
    "short.ply": ply_text().encode()[:-30], "short.glb": glb_bytes()[:300],
    "header.glb": glb_bytes()[:12], "noise.fbx": bytes(range(256)) * 8,
    "kaydara.fbx": b"Kaydara FBX Binary  \0\x1a\0" + b"\xff" * 64,
    "required.glb": glb_bytes(extensionsUsed=["EXT_x"], extensionsRequired=["EXT_x"]),
    "version.glb": glb_bytes(asset={"version": "9.0"}),
}


@pytest.mark.parametrize("name", BAD_MESHES)
def test_bad_mesh_files_are_refused_in_one_sentence(illum, tmp_path, name):
    (tmp_path / name).write_bytes(BAD_MESHES[name])
    illum.refuses("build", tmp_path / name, "-o", tmp_path / "o.illum", mentions=name,
                  leaves=tmp_path)


def test_degenerate_triangles_among_others_are_remarked(illum, tmp_path):
    (tmp_path / "a.ply").write_text(ply_text(faces=[*FACES, (1, 1, 2)]))
    outcome = illum("build", tmp_path / "a.ply", "-o", tmp_path / "o.illum", "--size", 16, "--uv",
                    "1x1", "--light-count", 4)
    assert "illum: note: " in outcome.stderr and "a.ply" in outcome.stderr, outcome


def test_unknown_builtins_and_wrong_usage(illum, tmp_path):
    sentence = illum.refuses("build", "builtin:teapt", "-o", tmp_path / "o.illum", leaves=tmp_path,
                             code=None)
    assert "teapot" in sentence
    scene = write_scene(tmp_path)
    illum.refuses("build", scene, code=2)
    illum.refuses("build", scene, "-o", tmp_path / "o.illum", "--uv", "3", code=2, leaves=tmp_path)


def test_info_tells_of_views_and_depth(illum, tmp_path):
    views = [{"turn": {"slabs": 3, "viewPoints": [2, 1], "longerSide": 24}}]
    illum("build", write_scene(tmp_path, views=views), "-o", tmp_path / "o.illum")
    text = illum("info", tmp_path / "o.illum").stdout
    for word in ("6: 3 slabs 'turn_0' to 'turn_2' of 2 x 1 each", "3 bases", "depth"):
        assert word in text, text
    info = info_of(illum, tmp_path / "o.illum")
    assert [slab["name"] for slab in info["slabs"]] == ["turn_0", "turn_1", "turn_2"]
    assert info["depthBytes"] > 0 and info["maskBytes"] > 0


def test_info_tells_mixed_views_apart(illum, tmp_path):
    illum("build", write_scene(tmp_path, views=VIEWS["mixed"][0]), "-o", tmp_path / "o.illum")
    info = info_of(illum, tmp_path / "o.illum")
    assert info["viewsOfKind"] == {"slab": 4, "camera": 1, "panorama": 1} and not info["oneSize"]
    text = illum("info", tmp_path / "o.illum").stdout
    for word in ("mixed (4 slab, 1 camera, 1 panorama)", "sizes differ", "6: slab 'slab' of 2 x 2"):
        assert word in text, text
