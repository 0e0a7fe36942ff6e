"""Objects of several slabs round a thing: one goes round without seams, holes or changes of colour."""

import json

import numpy as np
import pytest

import balls
import stacks
from conftest import Illum

LIGHT = ("--light", "0.5,0.8,0.6")
SLABS = 4
SCENE = {
    "illumScene": 1, "samples": 4, "bounces": 1,
    "meshes": [{"shape": "teapot", "material": "clay"},
               {"shape": "box", "material": "blue", "scale": 0.25, "translate": [0.9, -0.3, 0.5],
                "rotateDegrees": [0, 30, 0]}],
    "materials": {"clay": {"baseColour": [0.8, 0.4, 0.25], "roughness": 0.5},
                  "blue": {"baseColour": [0.1, 0.2, 0.8]}},
    "views": [{"turn": {"slabs": SLABS, "viewPoints": [4, 2], "longerSide": 96}}],
    "lights": {"fibonacci": 80, "region": "sphere"}}


@pytest.fixture(scope="module")
def turn(tmp_path_factory, binary):
    folder = tmp_path_factory.mktemp("turn")
    (folder / "scene.json").write_text(json.dumps(SCENE))
    for name, options in (("learned", ()), ("exact", ("--basis", "exact"))):
        Illum(folder)("build", folder / "scene.json", "-o", folder / f"{name}.illum", *options)
    return folder


def orbit(illum, built, tmp_path, frames):
    illum("relight", built, *LIGHT, "--path", "orbit", "--frames", frames, "--size", "96x72", "-o",
          tmp_path / "film")
    return [stacks.read_picture(tmp_path / f"film/frame_{k:05}.png") for k in range(frames)]


def holes_in(coverage):
    """Pixels that show little amid such as show all; what one sees through is larger."""
    round_them = [np.roll(coverage, (y, x), (0, 1)) for y in (-1, 0, 1) for x in (-1, 0, 1) if y or x]
    return np.argwhere((coverage < 64) & (np.min(round_them, axis=0) > 190))


def test_an_orbit_has_neither_seams_nor_holes(illum, turn, tmp_path):
    pictures = orbit(illum, turn / "learned.illum", tmp_path, 36)
    shown = [balls.over_black(picture) for picture in pictures]
    steps = np.array([np.sqrt(np.mean((shown[k] - shown[k - 1]) ** 2)) for k in range(len(shown))])
    assert steps.min() > 1, "it moves"
    assert steps.max() < 2.5 * np.median(steps), steps
    for k, step in enumerate(steps):
        before, after = steps[k - 1], steps[(k + 1) % len(steps)]
        assert step < 1.6 * max(before, after), f"a jump into frame {k}: {steps}"
    for k, picture in enumerate(pictures):
        coverage = picture[..., 3]
        assert 0.1 < (coverage > 127).mean() < 0.7, k
        assert len(holes_in(coverage)) == 0, f"{k}: {holes_in(coverage)}"


def test_every_slab_of_a_turn_is_fitted_as_well(illum, turn, tmp_path):
    """Also that which the light hardly reaches. A few pixels to choose planes by are too few."""
    for slab in range(SLABS):
        learned, exact = (np.float64(picture) for picture in (
            see(illum, turn / f"{name}.illum", tmp_path, f"turn_{slab}:0.333333333,0")
            for name in ("learned", "exact")))
        assert stacks.psnr(balls.over_black(learned), balls.over_black(exact)) > 28, slab


def see(illum, built, tmp_path, view):
    illum("relight", built, *LIGHT, "--view", view, "-o", tmp_path / "seen.png")
    return stacks.read_picture(tmp_path / "seen.png")
