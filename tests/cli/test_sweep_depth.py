"""`--sweep-depth`: photographs from several places tell how far away things are."""

import json

import numpy as np
import pytest
from PIL import Image

import balls
import stacks
from conftest import Illum

WALL, PANEL, HALF = -1.0, 0.8, 0.45
STEP, WIDTH, HEIGHT, DEGREES = 0.24, 120, 96, 40


def camera(x, y):
    """All look the same way."""
    return balls.Camera.looking((x, y, 4), (x, y, 0), DEGREES, WIDTH, HEIGHT)


def pattern(x, y, waves):
    return np.stack([0.5 + 0.4 * np.sin(waves * x) * np.cos(0.7 * waves * y),
                     0.5 + 0.4 * np.cos(0.8 * waves * (x + y)),
                     0.4 + 0.3 * np.sin(1.3 * waves * (x - 0.5 * y))], axis=-1)


def shot(pose, side=3):
    """A patterned panel before a patterned wall: linear colours, and depth along the axis."""
    rays = pose.rays(side)
    at = [pose.eye + (pose.eye[2] - z) * rays for z in (PANEL, WALL)]
    front = (np.abs(at[0][..., :2]) < HALF).all(axis=-1)
    colours = np.where(front[..., None], pattern(at[0][..., 0], at[0][..., 1], 17),
                       pattern(at[1][..., 0], at[1][..., 1], 9))
    return colours.mean(axis=2), np.where(front.mean(axis=2) > 0.5, 4 - PANEL, 4 - WALL)


def write(folder, poses, masked=False):
    folder.mkdir(parents=True)
    views = []
    for k, pose in enumerate(poses):
        Image.fromarray(stacks.display_bytes(shot(pose)[0])).save(folder / f"{k}.png")
        views.append({"name": str(k), "geometry": {"kind": "camera", "camera": pose.record()},
                      "photographs": f"{k}.png"})
        if masked:
            front = shot(pose)[1] == 4 - PANEL
            Image.fromarray(np.uint8(255 * front)).save(folder / f"mask {k}.png")
            views[-1]["mask"] = f"mask {k}.png"
    (folder / "capture.json").write_text(json.dumps(
        {"format": "illum-capture", "version": [1, 0], "views": views,
         "lights": [{"name": "all", "direction": [0, 0, 1]}]}))
    return folder


@pytest.fixture(scope="module")
def folder(tmp_path_factory, binary):
    folder = tmp_path_factory.mktemp("swept")
    write(folder / "capture", [camera(STEP * u, STEP * v) for v in (-1, 0, 1) for u in (-1, 0, 1)])
    for name, options in (("plain", ()), ("swept", ("--sweep-depth",))):
        Illum(folder)("build", folder / "capture", "-o", folder / f"{name}.illum", *options)
    return folder


def test_views_between_are_sharp_near_and_far(illum, folder, tmp_path):
    x, y = 0.5 * STEP, -0.5 * STEP
    truth = stacks.display_bytes(shot(camera(x, y))[0])
    quality = {}
    for name in ("plain", "swept"):
        illum("relight", folder / f"{name}.illum", "--light", "0,0,1", "--camera",
              f"{x},{y},4,{x},{y},0,{DEGREES}", "--size", f"{WIDTH}x{HEIGHT}", "-o",
              tmp_path / f"{name}.png")
        seen = stacks.read_picture(tmp_path / f"{name}.png")
        assert (seen[..., 3] > 250).mean() > 0.99, name
        quality[name] = stacks.psnr(balls.over_black(seen), np.float64(truth))
    assert quality["swept"] > 27 and quality["swept"] > quality["plain"] + 5, quality


def test_what_a_mask_leaves_out_has_no_depth(illum, tmp_path):
    poses = [camera(STEP * u, 0) for u in (-1, 0, 1)]
    write(tmp_path / "in", poses, masked=True)
    illum("build", tmp_path / "in", "-o", f"{tmp_path / 'o'}/", "--sweep-depth")
    for k, pose in enumerate(poses):
        codes = np.asarray(Image.open(tmp_path / f"o/depth/{k}/0/0_0.png"), int)
        nothing = codes == 255 if codes.ndim == 2 else 256 * codes[..., 0] + codes[..., 1] == 65535
        front = shot(pose)[1] == 4 - PANEL
        assert np.array_equal(nothing[:HEIGHT, :WIDTH], ~front), k


def test_the_object_says_that_it_has_depth(illum, folder):
    info = {name: json.loads(illum("info", folder / f"{name}.illum", "--json").stdout)
            for name in ("plain", "swept")}
    assert not info["plain"]["depth"] and info["swept"]["depth"]
    illum("verify", folder / "swept.illum")


def test_the_same_on_any_number_of_threads_and_in_little_memory(illum, folder, tmp_path):
    illum("build", folder / "capture", "-o", tmp_path / "o.illum", "--sweep-depth", "--threads", 1,
          "--max-memory", "700M")
    assert (tmp_path / "o.illum").read_bytes() == (folder / "swept.illum").read_bytes()


def test_the_memory_that_it_needs_is_said(illum, folder, tmp_path):
    illum.refuses("build", folder / "capture", "-o", tmp_path / "o.illum", "--sweep-depth",
                  "--max-memory", "5M", code=3, mentions="at least", leaves=tmp_path)


def test_one_place_tells_nothing(illum, tmp_path):
    write(tmp_path / "in", [camera(0, 0), camera(0, 0)])
    illum.refuses("build", tmp_path / "in", "-o", tmp_path / "o.illum", "--sweep-depth", code=2,
                  mentions="two places", leaves=tmp_path)


def test_what_has_depth_already_is_not_swept(illum, folder, own_stack, tmp_path):
    illum.refuses("build", "builtin:box", "-o", tmp_path / "o.illum", "--sweep-depth", code=2,
                  mentions="depth", leaves=tmp_path)
    illum.refuses("build", own_stack, "-o", tmp_path / "o.illum", "--sweep-depth", code=2,
                  mentions="photograph", leaves=tmp_path)
