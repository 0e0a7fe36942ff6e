"""Objects built of scenes, held to what is known of them: sums of lights, frames, threads."""

import json
import math

import numpy as np
import pytest

import stacks
from conftest import Illum
from test_judging import captured
from test_light import read_exr, read_exrs
from test_scenes import write_scene

BOX_AND_BALL = [{"shape": "box", "scale": 0.6}, {"shape": "sphere", "scale": 0.3,
                                                 "translate": [0.2, 0.1, 0.9]}]
DIRECTIONS = [[0, 0, 1], [0.7, 0.2, 0.6], [-0.5, 0.6, 0.6], [0.1, -0.8, 0.5], [-0.7, -0.4, 0.5]]


def text_of(direction):
    return ",".join(f"{c:.9f}" for c in direction)


def relit(illum, built, out, *directions, view="slab_u00_v00"):
    lights = [word for d in directions for word in ("--light", text_of(d))]
    illum("relight", built, "--view", view, *lights, "-o", out)
    return read_exr(out)


def truth_of(folder, view, lights):
    """What `illum capture` wrote of a view, over black, under each of so many lights."""
    views = json.loads((folder / "capture.json").read_text())["views"]
    return captured(folder, next(v for v in views if v["name"] == view), lights)


@pytest.fixture(scope="module")
def two_bounces(tmp_path_factory, binary):
    """A glossy scene with shadows and interreflections; its capture, its object of the samples."""
    folder, illum = tmp_path_factory.mktemp("sum"), Illum(tmp_path_factory.mktemp("output"))
    scene = write_scene(folder, bounces=2, samples=2, lights={"directions": DIRECTIONS},
                        meshes=[{**m, "material": "m"} for m in BOX_AND_BALL],
                        materials={"m": {"baseColour": [0.9, 0.6, 0.3], "roughness": 0.4}})
    illum("capture", scene, "-o", folder / "truth")
    illum("build", scene, "-o", folder / "o.illum", "--basis", "exact")
    return folder


@pytest.mark.parametrize("a, b", [(0, 1), (2, 4), (3, 3)])
@pytest.mark.parametrize("view", ["slab_u00_v00", "slab_u01_v01"])
def test_two_lights_show_the_sum_of_both(illum, two_bounces, tmp_path, view, a, b):
    built, truth = two_bounces / "o.illum", truth_of(two_bounces / "truth", view, 5)
    both = relit(illum, built, tmp_path / "o.exr", DIRECTIONS[a], DIRECTIONS[b], view=view)
    each = [relit(illum, built, tmp_path / "o.exr", DIRECTIONS[i], view=view) for i in (a, b)]
    traced = truth[a] + truth[b]
    assert both.max() > 0.5
    # The object keeps each sample as a half, of eleven bits.
    np.testing.assert_allclose(both, each[0] + each[1], rtol=2**-10, atol=1e-6)
    np.testing.assert_allclose(both, traced, rtol=2**-10, atol=1e-6)


ANGLES = np.radians([20, -35, 50])
SHIFT = np.array([0.7, -0.4, 1.1])


def rotation():
    """About x, then y, then z."""
    (cx, cy, cz), (sx, sy, sz) = np.cos(ANGLES), np.sin(ANGLES)
    x = np.array([[1, 0, 0], [0, cx, -sx], [0, sx, cx]])
    y = np.array([[cy, 0, sy], [0, 1, 0], [-sy, 0, cy]])
    z = np.array([[cz, -sz, 0], [sz, cz, 0], [0, 0, 1]])
    return z @ y @ x


def moved(mesh):
    place = rotation() @ np.array(mesh.get("translate", [0, 0, 0])) + SHIFT
    return {**mesh, "rotateDegrees": list(np.degrees(ANGLES)), "translate": list(place)}


def slab(turn, shift):
    return {"slab": {"frame": {"rotation": list(turn.reshape(-1)), "translation": list(shift)},
                     "viewPoints": [2, 2], "longerSide": 48, "distance": 4, "spreadDegrees": [20, 20],
                     "window": [-1, -1, 1, 1]}}


@pytest.mark.parametrize("basis, step", [("exact", 2**-10), ("sh", 0.01)])
@pytest.mark.parametrize("bounces", [0, 2])
def test_a_slab_that_is_moved_with_everything_shows_the_same(illum, tmp_path, basis, step, bounces):
    """Scene, window and lights turned and moved together: nothing changes in the window."""
    lights = {"directions": [[math.sin(t) * math.cos(p), math.sin(t) * math.sin(p), math.cos(t)]
                             for t in (0.2, 0.7, 1.2) for p in np.arange(6) + t],
              "radiusDegrees": 0}
    turned = {**lights, "directions": [list(rotation() @ d) for d in lights["directions"]]}
    common = {"bounces": bounces, "samples": 4 if bounces == 0 else 24}
    where = {"still": (BOX_AND_BALL, slab(np.eye(3), np.zeros(3)), lights),
             "moved": ([moved(m) for m in BOX_AND_BALL], slab(rotation(), SHIFT), turned)}
    coefficients = ["--coefficients", 9] if basis == "sh" else []
    seen = {}
    for name, (meshes, view, grid) in where.items():
        scene = write_scene(tmp_path, f"{name}.json", meshes=meshes, views=[view], lights=grid,
                            **common)
        built = tmp_path / f"{name}.illum"
        illum("build", scene, "-o", built, "--basis", basis, *coefficients, "--coding", "png")
        seen[name] = [relit(illum, built, tmp_path / "o.exr", grid["directions"][i],
                            view="slab_u01_v00") for i in (1, 8)]
    assert np.abs(seen["still"][0] - seen["still"][1]).max() > 0.3, "lights differ in what they show"
    for still, there in zip(seen["still"], seen["moved"]):
        assert 0.2 < (still > 0).mean() < 0.95 and still.max() > 0.3
        apart = np.abs(still - there).max(axis=2)
        if bounces == 0:
            # The same rays but for rounding, which tips some that pass an edge or a shadow's.
            assert (apart > step * np.maximum(1, still.max(axis=2))).mean() < 0.01
        else:
            # Paths go on in frames of their own, so that each pixel has its own noise.
            assert np.abs(still.mean(axis=(0, 1)) - there.mean(axis=(0, 1))).max() < 0.002
            assert np.median(apart) < 0.02


@pytest.fixture(scope="module")
def turn(tmp_path_factory, binary):
    folder, illum = tmp_path_factory.mktemp("turn"), Illum(tmp_path_factory.mktemp("output"))
    scene = write_scene(folder, meshes=[{"shape": "teapot"}], bounces=1, samples=4,
                        views=[{"turn": {"slabs": 8, "viewPoints": [2, 1], "longerSide": 40}}],
                        lights={"fibonacci": 40, "region": "sphere"})
    illum("capture", scene, "-o", folder / "truth")
    for threads in (1, 2):
        illum("build", scene, "-o", folder / f"{threads}.illum", "--threads", threads)
    return folder


def test_a_turn_is_the_same_on_any_number_of_threads(turn):
    assert (turn / "1.illum").read_bytes() == (turn / "2.illum").read_bytes()


@pytest.mark.parametrize("view", ["turn_0_u00_v00", "turn_3_u01_v00", "turn_6_u00_v00"])
def test_a_view_of_a_turn_shows_what_was_captured_from_there(illum, turn, tmp_path, view):
    figures = json.loads(illum("evaluate", turn / "1.illum", "--against", turn / "truth",
                               "--json").stdout)
    [judged] = [v for v in figures["views"] if v["name"] == view]
    lights = [light["direction"] for light in figures["lights"]]
    stacks.write_light_file(tmp_path, [str(k) for k in range(len(lights))], lights)
    illum("relight", turn / "1.illum", "--view", view, "--lights", tmp_path / "lights.lp",
          "--format", "exr", "-o", tmp_path / "relit")
    relit = read_exrs([tmp_path / f"relit/{k}.exr" for k in range(len(lights))])
    truth = truth_of(turn / "truth", view, len(lights))
    rms = [np.sqrt(np.mean((a - b) ** 2)) for a, b in zip(relit, truth)]
    assert rms == pytest.approx([l["linear"]["rms"] for l in judged["lights"]], rel=0.02)
    elsewhere = [np.sqrt(np.mean((a - b) ** 2)) for a, b in zip(relit, truth[1:] + truth[:1])]
    assert np.mean(rms) < min(0.03, np.mean(elsewhere) / 3)
