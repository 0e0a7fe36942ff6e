"""Captures, lists of cameras and set-ups of lights that are wrong: one sentence, exit 1, nothing left."""

import json
import os
import shutil

import numpy as np
import pytest
from PIL import Image

import balls
import posed

DEEP = "[" * 200_000
NOT_JSON = {
    "empty": b"", "blank": b" \n\n", "zeros": bytes(4000), "noise": b"\xff\xfe\x80" * 400,
    "deep": DEEP.encode(), "deep objects": b'{"a":' * 200_000, "words": b"once upon a time",
    "a number": b"7", "a list": b"[]", "an empty object": b"{}", "null": b"null",
    "a comment": b"// nothing\n{}", "two roots": b"{}{}", "a mark of byte order": b"\xef\xbb\xbf{",
}


@pytest.fixture(scope="module")
def two_views(tmp_path_factory):
    """A capture.json of two cameras; read only."""
    cameras = [(name, balls.Camera.looking((x, 0, 3), width=16, height=12))
               for name, x in (("left", -0.5), ("right", 0.5))]
    return balls.write_capture(tmp_path_factory.mktemp("two") / "capture", cameras=cameras)


@pytest.fixture
def capture(two_views, tmp_path):
    shutil.copytree(two_views, tmp_path / "capture")
    return tmp_path / "capture"


def test_the_unspoilt_capture_is_taken(illum, two_views, tmp_path):
    illum("build", two_views, "-o", tmp_path / "o.illum")


def refuses_build(illum, folder, tmp_path, words):
    return illum.refuses("build", folder, "-o", tmp_path / "o.illum", mentions=words,
                         leaves=tmp_path, timeout=60)


@pytest.mark.parametrize("name", ["capture.json", "transforms.json"])
@pytest.mark.parametrize("content", NOT_JSON)
def test_files_that_are_none(illum, tmp_path, name, content):
    (tmp_path / "folder").mkdir()
    (tmp_path / "folder" / name).write_bytes(NOT_JSON[content])
    refuses_build(illum, tmp_path / "folder", tmp_path, name)


def test_truncated_captures(illum, capture, tmp_path):
    text = (capture / "capture.json").read_text()
    for length in range(1, len(text), len(text) // 12):
        (capture / "capture.json").write_text(text[:length])
        refuses_build(illum, capture, tmp_path, "capture.json")


def put(value, *path):
    """Sets a field of the JSON; a value that is a function is given the old one."""
    def edit(tree):
        for key in path[:-1]:
            tree = tree[key]
        tree[path[-1]] = value(tree[path[-1]]) if callable(value) else value
    return edit


def drop(*path):
    def edit(tree):
        for key in path[:-1]:
            tree = tree[key]
        del tree[path[-1]]
    return edit


CAMERA = ("views", 0, "geometry", "camera")
POSE = (*CAMERA, "objectFromCamera")
CAPTURE_FIELDS = {
    "no format": (drop("format"), "format"),
    "another format": (put("illum-object", "format"), "format"),
    "a future version": (put([2, 0], "version"), "version"),
    "a version of words": (put("1.0", "version"), "version"),
    "no lights": (put([], "lights"), "lights"),
    "lights missing": (drop("lights"), "lights"),
    "lights of another type": (put({"a": 1}, "lights"), "lights"),
    "a light without direction": (drop("lights", 3, "direction"), "lights[3]"),
    "a zero direction": (put([0, 0, 0], "lights", 3, "direction"), "lights[3]"),
    "a direction of two": (put([0, 1], "lights", 3, "direction"), "lights[3]"),
    "a direction of words": (put(["a", "b", "c"], "lights", 3, "direction"), "lights[3]"),
    "a direction that is none": (put([0, float("nan"), 1], "lights", 3, "direction"), ""),
    "an infinite direction": (put([0, float("inf"), 1], "lights", 3, "direction"), ""),
    "an overflowing direction": (put([0, 1e300, 1], "lights", 3, "direction"), "lights[3]"),
    "a negative intensity": (put([1, -1, 1], "lights", 3, "intensity"), "lights[3]"),
    "a light without intensity": (put([0, 0, 0], "lights", 3, "intensity"), "lights[3]"),
    "two lights of one name": (put("2", "lights", 3, "name"), "{light}"),
    "no views": (put([], "views"), "views"),
    "a view twice": (put("right", "views", 0, "name"), "right"),
    "a view that is a number": (put(7, "views", 0), "views[0]"),
    "an unknown kind": (put("fisheye", "views", 0, "geometry", "kind"), "fisheye"),
    "a slab that is not there": (put({"kind": "slab", "slab": 0, "u": 0, "v": 0}, "views", 0,
                                     "geometry"), "slab"),
    "a view without size": (drop(*CAMERA, "size"), "size"),
    "a huge size": (put({"width": 1 << 30, "height": 1 << 30}, *CAMERA, "size"), "size"),
    "a negative size": (put({"width": -16, "height": 12}, *CAMERA, "size"), "size"),
    "a size of words": (put({"width": "16", "height": 12}, *CAMERA, "size"), "size"),
    "half a pixel": (put({"width": 16.5, "height": 12}, *CAMERA, "size"), "size"),
    "another size": (put({"width": 12, "height": 16}, *CAMERA, "size"), "16x12"),
    "no focal length": (put(0, *CAMERA, "focalX"), "focalX"),
    "a focal length that is none": (put(float("nan"), *CAMERA, "focalX"), ""),
    "a mirrored pose": (put([1, 0, 0, 0, 1, 0, 0, 0, -1], *POSE, "rotation"), "rotation"),
    "a scaled pose": (put([2, 0, 0, 0, 2, 0, 0, 0, 2], *POSE, "rotation"), "rotation"),
    "a short pose": (put([1, 0, 0, 0], *POSE, "rotation"), "rotation"),
    "a place out of the world": (put([0, 0, 1e308], *POSE, "translation"), "translation"),
    "no pictures": (drop("views", 1, "photographs"), "photographs"),
    "one name for all": (put("0/0.png", "views", 1, "photographs"), "0/0.png"),
    "pictures of the root": (put("/etc/{light}", "views", 1, "photographs"), "/etc/{light}"),
    "pictures above": (put("../{light}.png", "views", 1, "photographs"), "../{light}.png"),
    "a light that leads above": (put("../../etc/passwd", "lights", 3, "name"), "../etc/passwd"),
    "a mask above": (put("../mask.png", "views", 1, "mask"), "../mask.png"),
    "a mask that is missing": (put("none.png", "views", 1, "mask"), "none.png"),
    "a mask of one view": (drop("views", 1, "mask"), "mask"),
    "depth of one view": (put("0/mask.png", "views", 1, "depth"), "depth"),
    "depth in colours": (lambda tree: [view.update(depth="0/0.png") for view in tree["views"]],
                         "0/0.png"),
    "a mesh above": (put("../mesh.obj", "proxy"), "../mesh.obj"),
    "a mesh that is missing": (put("mesh.obj", "proxy"), "mesh.obj"),
    "a mesh that is a picture": (put("0/0.png", "proxy"), "0/0.png"),
}


@pytest.mark.parametrize("case", CAPTURE_FIELDS)
def test_capture_fields(illum, capture, tmp_path, case):
    edit, word = CAPTURE_FIELDS[case]
    tree = json.loads((capture / "capture.json").read_text())
    tree.setdefault("proxy", "")
    edit(tree)
    (capture / "capture.json").write_text(json.dumps(tree))
    sentence = refuses_build(illum, capture, tmp_path, word)
    assert str(capture) in sentence


VICTIM = "1/4.png"


def removed(file):
    file.unlink()


def emptied(file):
    file.write_bytes(b"")


def cut(file):
    file.write_bytes(file.read_bytes()[:60])


def text_instead(file):
    file.write_text("not a photograph\n" * 30)


def shrunk(file):
    Image.open(file).resize((8, 6)).save(file)


def linked_to_itself(file):
    file.unlink()
    file.symlink_to(file.name)


def made_a_folder(file):
    file.unlink()
    file.mkdir()


def made_a_pipe(file):
    file.unlink()
    os.mkfifo(file)


SPOILT_PICTURES = [
    removed, emptied, cut, text_instead, shrunk, linked_to_itself, made_a_folder, made_a_pipe,
]


@pytest.mark.parametrize("victim", [VICTIM, "1/mask.png"])
@pytest.mark.parametrize("spoil", SPOILT_PICTURES, ids=lambda spoil: spoil.__name__)
def test_pictures_of_a_capture(illum, capture, tmp_path, spoil, victim):
    spoil(capture / victim)
    refuses_build(illum, capture, tmp_path, victim)


def test_depth_that_is_no_picture_of_depth(illum, capture, tmp_path):
    (capture / "depth.exr").write_bytes(b"v/1\x01" + bytes(300))
    tree = json.loads((capture / "capture.json").read_text())
    for view in tree["views"]:
        view["depth"] = "depth.exr"
    (capture / "capture.json").write_text(json.dumps(tree))
    refuses_build(illum, capture, tmp_path, "depth.exr")


MESHES = {
    "empty": b"", "no face": b"v 0 0 0\n", "nan": b"v nan 0 0\nf 1 1 1\n",
    "infinite": b"v inf 0 0\nf 1 1 1\n", "a corner too many": b"v 0 0 0\nf 1 1 2\n",
    "corner zero": b"v 0 0 0\nf 1 1 0\n", "an overflow": b"v 1e999 0 0\nf 1 1 1\n",
    "noise": bytes(range(256)) * 30, "two corners": b"v 0 0 0\nv 1 1 1\nf 1 2\n",
}


@pytest.mark.parametrize("case", MESHES)
def test_meshes_in_place_of_depth(illum, capture, tmp_path, case):
    (capture / "mesh.obj").write_bytes(MESHES[case])
    tree = json.loads((capture / "capture.json").read_text())
    (capture / "capture.json").write_text(json.dumps({**tree, "proxy": "mesh.obj"}))
    refuses_build(illum, capture, tmp_path, "mesh.obj")


@pytest.fixture
def transforms(tmp_path):
    """Two pictures and their transforms.json."""
    return write_pictures(tmp_path / "posed", posed.write_transforms,
                          lambda name, k: (name, posed.camera(k), {}))


@pytest.fixture
def colmap(tmp_path):
    return write_pictures(tmp_path / "posed", posed.write_colmap,
                          lambda name, k: (name, posed.camera(k)))


def write_pictures(folder, write, frame):
    folder.mkdir()
    for k in range(2):
        shade = np.full((posed.HEIGHT, posed.WIDTH, 3), 0.1 * (k + 1))
        posed.save(shade, folder / f"{k}.png")
    write(folder, [frame(f"{k}.png", k) for k in range(2)])
    return folder


def test_the_unspoilt_lists_are_taken(illum, transforms, tmp_path):
    illum("build", transforms, "-o", tmp_path / "o.illum")
    (transforms / "transforms.json").unlink()
    posed.write_colmap(transforms, [(f"{k}.png", posed.camera(k)) for k in range(2)])
    illum("build", transforms, "-o", tmp_path / "p.illum")


FRAME = ("frames", 1)
MATRIX = (*FRAME, "transform_matrix")
IDENTITY = np.eye(4).tolist()
LAMP = [1, 2, 3]
TRANSFORMS_FIELDS = {
    "no frames": (put([], "frames"), "frames"),
    "frames missing": (drop("frames"), "frames"),
    "frames of another type": (put({"0": {}}, "frames"), "frames"),
    "a frame that is none": (put(None, *FRAME), "frames[1]"),
    "a frame without a picture": (drop(*FRAME, "file_path"), "frames[1]"),
    "a picture that is a number": (put(7, *FRAME, "file_path"), "file_path"),
    "a picture above": (put("../1.png", *FRAME, "file_path"), "../1.png"),
    "a picture of the root": (put("/etc/passwd.png", *FRAME, "file_path"), "/etc/passwd.png"),
    "a picture below and above": (put("a/../../1.png", *FRAME, "file_path"), "a/../../1.png"),
    "a picture that is missing": (put("none.png", *FRAME, "file_path"), "none.png"),
    "one picture twice": (put("0.png", *FRAME, "file_path"), "0.png"),
    "no pose": (drop(*MATRIX), "transform_matrix"),
    "a pose of words": (put("front", *MATRIX), "transform_matrix"),
    "two rows": (put(IDENTITY[:2], *MATRIX), "transform_matrix"),
    "short rows": (put([row[:3] for row in IDENTITY], *MATRIX), "transform_matrix"),
    "a mirror": (put(np.diag([1, 1, -1, 1]).tolist(), *MATRIX), "transform_matrix"),
    "a scale": (put(np.diag([2, 2, 2, 1]).tolist(), *MATRIX), "transform_matrix"),
    "zeros": (put(np.zeros((4, 4)).tolist(), *MATRIX), "transform_matrix"),
    "not a number": (put(float("nan"), *MATRIX, 0, 3), ""),
    "infinitely far": (put(float("inf"), *MATRIX, 0, 3), ""),
    "too far": (put(1e300, *MATRIX, 0, 3), "transform_matrix"),
    "no focal length": (lambda tree: (tree.pop("fl_x"), tree.pop("fl_y")), "fl_x"),
    "a focal length of 0": (put(0, "fl_x"), "focal"),
    "an angle of 0": (lambda tree: (tree.pop("fl_x"), tree.pop("fl_y"),
                                    tree.update(camera_angle_x=0)), "focal"),
    "an angle of half a turn": (lambda tree: (tree.pop("fl_x"), tree.pop("fl_y"),
                                              tree.update(camera_angle_x=4)), "focal"),
    "a width of words": (put("80", "w"), "'frames[0].w'"),
    "a huge width": (put(1e12, "w"), "'frames[0].w'"),
    "another width": (put(60, "w"), "60"),
    "distortion": (put(0.1, "k1"), "k1"),
    "a fisheye": (put("OPENCV_FISHEYE", "camera_model"), "OPENCV_FISHEYE"),
    "a camera that is a list": (put([], "camera_model"), "camera_model"),
    "a mask above": (put("../m.png", *FRAME, "mask_path"), "../m.png"),
    "a mask of one": (put("0.png", *FRAME, "mask_path"), "mask"),
    "a lamp of one": (put(LAMP, *FRAME, "pl_pos"), "lights"),
    "a lamp in the origin": (put([0, 0, 0], *FRAME, "pl_pos"), "pl_pos"),
    "a lamp of words": (put("left", *FRAME, "light_position"), "light_position"),
    "a view that lacks a lamp": (lambda tree: [frame.update(pl_pos=[1, 0, k]) for k, frame in
                                               enumerate(tree["frames"])], "lights"),
    "two pictures of one lamp": (lambda tree: [frame.update(pl_pos=LAMP, transform_matrix=IDENTITY)
                                               for frame in tree["frames"]], ".png"),
}


@pytest.mark.parametrize("case", TRANSFORMS_FIELDS)
def test_transforms_fields(illum, transforms, tmp_path, case):
    edit, word = TRANSFORMS_FIELDS[case]
    tree = json.loads((transforms / "transforms.json").read_text())
    tree["frames"][1].setdefault("mask_path", None)
    edit(tree)
    (transforms / "transforms.json").write_text(json.dumps(tree))
    sentence = refuses_build(illum, transforms, tmp_path, word)
    assert str(transforms) in sentence


POSE_LINE = "1 1 0 0 0 0 0 3 1 0.png\n\n"
COLMAP_FILES = {
    "cameras.txt": {
        "empty": "", "a comment": "# nothing\n", "short": "1 PINHOLE 80 60 100 100 40\n",
        "words": "1 PINHOLE 80 60 long long 40 30\n", "nan": "1 PINHOLE 80 60 nan 100 40 30\n",
        "infinite": "1 PINHOLE 80 60 inf 100 40 30\n", "an overflow": "1 PINHOLE 80 60 1e999 1 1 1\n",
        "no size": "1 PINHOLE 0 60 100 100 40 30\n", "huge": "1 PINHOLE 1e9 1e9 100 100 40 30\n",
        "half a pixel": "1 PINHOLE 80.5 60 100 100 40 30\n",
        "negative": "1 PINHOLE 80 60 -100 100 40 30\n",
        "distorted": "1 OPENCV 80 60 100 100 40 30 0.1 0 0 0\n",
        "unknown": "1 HOLE 80 60 100 100 40 30\n",
        "twice": "1 PINHOLE 80 60 100 100 40 30\n" * 2,
        "binary": bytes(range(256)).decode("latin-1") * 20,
    },
    "images.txt": {
        "empty": "", "a comment": "# nothing\n", "short": "1 1 0 0 0 0 0 3 1\n",
        "words": "1 one 0 0 0 0 0 3 1 0.png\n", "nan": "1 nan 0 0 0 0 0 3 1 0.png\n",
        "infinite": "1 1 0 0 0 inf 0 3 1 0.png\n", "far": "1 1 0 0 0 1e300 0 3 1 0.png\n",
        "no rotation": "1 0 0 0 0 0 0 3 1 0.png\n", "another camera": "1 1 0 0 0 0 0 3 7 0.png\n",
        "twice": POSE_LINE * 2, "above": "1 1 0 0 0 0 0 3 1 ../0.png\n",
        "the root": "1 1 0 0 0 0 0 3 1 /etc/passwd\n",
        "no points": "1 1 0 0 0 0 0 3 1 0.png\n2 1 0 0 0 0 1 3 1 1.png\n3 1 0 0 0 0 2 3\n",
        "binary": bytes(range(256)).decode("latin-1") * 20,
    },
}
COLMAP_CASES = [(file, case) for file, cases in COLMAP_FILES.items() for case in cases]


@pytest.mark.parametrize("file, case", COLMAP_CASES, ids=str)
def test_colmap_files(illum, colmap, tmp_path, file, case):
    (colmap / file).write_text(COLMAP_FILES[file][case], encoding="latin-1")
    sentence = refuses_build(illum, colmap, tmp_path, file if case != "empty" else ".txt")
    assert str(colmap) in sentence


def test_colmap_pictures_that_are_missing_or_of_another_size(illum, colmap, tmp_path):
    shrunk(colmap / "1.png")
    refuses_build(illum, colmap, tmp_path, ["1.png", "8x6", "80x60"])
    (colmap / "1.png").unlink()
    refuses_build(illum, colmap, tmp_path, "1.png")


def lit(**light):
    return json.dumps({"lighting": 1, "lights": [light]})


UP = [0, 1, 0]
SETUPS = {
    **{name: (text.decode("latin-1"), "") for name, text in NOT_JSON.items()},
    "zero lights": ('{"lighting": 1, "lights": []}', "lights"),
    "too many lights": (json.dumps({"lighting": 1, "lights": [
        {"kind": "directional", "direction": UP}] * 10_001}), "lights"),
    "lights missing": ('{"lighting": 1}', "lights"),
    "a future version": ('{"lighting": 2, "lights": []}', "lighting"),
    "a version of words": ('{"lighting": "1", "lights": []}', "lighting"),
    "an unknown field": ('{"lighting": 1, "lamps": [], "lights": [{}]}', ""),
    "a light that is none": ('{"lighting": 1, "lights": [7]}', "lights[0]"),
    "a light without a kind": (lit(direction=UP), "kind"),
    "an unknown kind": (lit(kind="laser", direction=UP), "laser"),
    "a set-up in a set-up": (lit(kind="lighting", file="setup.json"), "lighting"),
    "a kind of a list": (lit(kind=[[]], direction=UP), "kind"),
    "an unknown field of a light": (lit(kind="point", position=UP, radius=1), "radius"),
    "no direction": (lit(kind="directional"), "direction"),
    "a zero direction": (lit(kind="directional", direction=[0, 0, 0]), "direction"),
    "a direction that is none": (lit(kind="directional", direction=[0, float("nan"), 1]), ""),
    "an infinite direction": (lit(kind="directional", direction=[0, float("inf"), 1]), ""),
    "an overflowing place": (lit(kind="point", position=[0, 1e300, 1]), "position"),
    "a place of words": (lit(kind="point", position="above"), "position"),
    "a place of two": (lit(kind="point", position=[0, 1]), "position"),
    "a negative intensity": (lit(kind="point", position=UP, intensity=-1), "intensity"),
    "an endless intensity": (lit(kind="point", position=UP, intensity=1e300), "intensity"),
    "a colour beyond white": (lit(kind="point", position=UP, colour=[2, 0, 0]), "colour"),
    "an unknown falloff": (lit(kind="point", position=UP, falloff="cubic"), "cubic"),
    "a spot on itself": (lit(kind="spot", position=UP, target=UP), "target"),
    "a spot of no width": (lit(kind="spot", position=UP, target=[0, 0, 0], coneDegrees=0), "cone"),
    "a rectangle of no width": (lit(kind="rectangle", centre=UP, halfWidth=[0, 0, 0]), "halfWidth"),
    "a skew rectangle": (lit(kind="rectangle", centre=UP, halfWidth=[1, 0, 0],
                             halfHeight=[1, 1, 0]), "halfHeight"),
    "a rectangle of a million points": (lit(kind="rectangle", centre=UP, across=1000, down=1000),
                                        "across"),
    "half a point": (lit(kind="rectangle", centre=UP, across=1.5), "across"),
    "a sphere of no size": (lit(kind="sphere", centre=UP, radius=0), "radius"),
    "a sphere of a million points": (lit(kind="sphere", centre=UP, radius=1, samples=1_000_000),
                                     "samples"),
    "no environment": (lit(kind="environment"), "picture"),
    "an environment of no name": (lit(kind="environment", picture=""), "picture"),
    "an environment that is missing": (lit(kind="environment", picture="none.exr"), "none.exr"),
    "an environment that is this file": (lit(kind="environment", picture="setup.json"),
                                         "setup.json"),
    "an environment that is a folder": (lit(kind="environment", picture="."), "."),
    "an environment of stops": (lit(kind="environment", picture="sky.png", exposureStops=1000),
                                "exposureStops"),
    "an empty environment": (lit(kind="environment", picture="empty.exr"), "empty.exr"),
    "a broken environment": (lit(kind="environment", picture="short.png"), "short.png"),
    "an unknown sky": (lit(kind="sky", model="martian"), "martian"),
    "a sun below": (lit(kind="sky", model="clear", sun=[0, -1, 0]), "sun"),
    "a sky of no turbidity": (lit(kind="sky", model="preetham", turbidity=0), "turbidity"),
}


@pytest.mark.parametrize("case", SETUPS)
def test_setups_of_lights(illum, built, tmp_path, case):
    text, word = SETUPS[case]
    setup = tmp_path / "setup.json"
    setup.write_text(text, encoding="latin-1")
    Image.new("RGB", (32, 16), "grey").save(tmp_path / "sky.png")
    (tmp_path / "short.png").write_bytes((tmp_path / "sky.png").read_bytes()[:50])
    (tmp_path / "empty.exr").write_bytes(b"")
    sentence = illum.refuses("relight", built, "--lighting", setup, "-o", tmp_path / "o.png",
                             mentions=word, leaves=tmp_path, timeout=60)
    assert "setup.json" in sentence or "environment" in case


def test_truncated_setups(illum, built, tmp_path):
    text = lit(kind="sphere", centre=UP, radius=0.5, colour=[1, 0.5, 0.2])
    for length in range(0, len(text), 9):
        (tmp_path / "setup.json").write_text(text[:length])
        illum.refuses("relight", built, "--lighting", tmp_path / "setup.json", "-o",
                      tmp_path / "o.png", mentions="setup.json", leaves=tmp_path)


@pytest.mark.parametrize("make", ["missing", "a folder", "a pipe", "huge"])
def test_setups_that_are_no_files(illum, built, tmp_path, make):
    setup = tmp_path / "setup.json"
    if make == "a folder":
        setup.mkdir()
    if make == "a pipe":
        os.mkfifo(setup)
    if make == "huge":
        with open(setup, "wb") as file:
            file.truncate(1 << 40)
    outcome = illum("relight", built, "--lighting", setup, "-o", tmp_path / "o.png", expect=None,
                    timeout=5 if make == "a pipe" else 60)
    assert not (tmp_path / "o.png").exists()
    if make != "a pipe":  # which may be written to yet: it is waited for
        assert outcome.code == 1 and "setup.json" in outcome.stderr, outcome
        assert outcome.peak_bytes < 1 << 30
