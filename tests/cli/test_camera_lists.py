"""Captures as other programs pose them: transforms.json and COLMAP's text, from pictures to pictures.

The blocks of posed.py are photographed from five places. Objects are seen again from the place of a
photograph that they hold, and from that of one which they were not given: a wrong axis, sign or order
puts the blocks elsewhere.
"""

import json

import numpy as np
import pytest
from PIL import Image

import posed
import stacks
from conftest import Illum

LEFT_OUT = 2
KEPT = [k for k in range(len(posed.EYES)) if k != LEFT_OUT]


@pytest.fixture(scope="module")
def rendered(tmp_path_factory, binary):
    folder = tmp_path_factory.mktemp("rendered")
    return posed.render(Illum(folder), folder / "blocks")


def seen(illum, built, tmp_path, pose, light, *options):
    """RGBA through --camera, which knows nothing of stored views."""
    out = tmp_path / "seen.png"
    size = f"{posed.WIDTH}x{posed.HEIGHT}"
    illum("relight", built, "--light", ",".join(map(str, light)), "--camera", posed.look(pose),
          "--size", size, *options, "-o", out)
    return np.asarray(Image.open(out).convert("RGBA"))


def likeness(picture, truth, where=True):
    """Over what is covered."""
    where = (picture[..., 3] == 255) & where
    return stacks.psnr(picture[where][:, :3], stacks.display_bytes(truth)[where])


def info_of(illum, built):
    return json.loads(illum("info", built, "--json").stdout)


@pytest.fixture(scope="module", params=["transforms", "colmap"])
def one_light(request, rendered, tmp_path_factory):
    """Four photographs under one light and a mesh of what they show."""
    folder = tmp_path_factory.mktemp(request.param)
    for k in KEPT:
        posed.save(rendered[k][0], folder / f"images/picture {k}.png")
    posed.write_proxy(folder)
    if request.param == "transforms":
        posed.write_transforms(folder, [(f"./images/picture {k}", posed.camera(k), {})
                                        for k in KEPT])
    else:
        posed.write_colmap(folder / "sparse/0", [(f"picture {k}.png", posed.camera(k))
                                                 for k in KEPT])
    Illum(folder)("build", folder, "-o", folder / "o.illum", "--basis", "exact")
    return folder / "o.illum"


@pytest.mark.parametrize("pose", KEPT)
def test_photographs_come_back(illum, one_light, rendered, tmp_path, pose):
    picture = seen(illum, one_light, tmp_path, pose, posed.LIGHTS[0])
    assert picture[..., 3].min() == 255
    assert likeness(picture, rendered[pose][0]) > 50


def test_the_mesh_shows_what_was_not_photographed(illum, one_light, rendered, tmp_path):
    """Away from the few pixels that no photograph shows."""
    assert info_of(illum, one_light)["depth"]
    truth = rendered[LEFT_OUT][0]
    by_depth, flat = (seen(illum, one_light, tmp_path, LEFT_OUT, posed.LIGHTS[0], *options)
                      for options in ((), ("--no-depth",)))
    covered = by_depth[..., 3] == 255
    assert covered.mean() > 0.97
    assert likeness(by_depth, truth) > 27
    nearest = covered & (truth[..., 2] > 2 * truth[..., 0])
    assert likeness(by_depth, truth, nearest) > likeness(flat, truth, nearest) + 2.5


def write_lit(folder, rendered, brightness, lamps):
    """Frames of every pose under every lamp, in an order that helps nobody."""
    frames = []
    for light, lamp in reversed(list(enumerate(lamps))):
        for k in KEPT:
            name = f"lamp {light}/picture {k}.png"
            posed.save(brightness / float(np.dot(lamp, lamp)) * rendered[k][light], folder / name)
            frames.append((name, posed.camera(k), {"pl_pos": list(lamp),
                                                   "mask_path": f"mask {k}.png"}))
    mask = np.full((posed.HEIGHT, posed.WIDTH), 255, np.uint8)
    mask[:10] = 0
    for k in KEPT:
        Image.fromarray(mask).save(folder / f"mask {k}.png")
    posed.write_transforms(folder, frames)


def test_positions_of_lights_are_directions_and_brightness(illum, rendered, tmp_path):
    """Lamps at several distances: nearer ones photographed brighter, which is not the object's."""
    lamps = [distance * np.array(light) / np.linalg.norm(light)
             for light, distance in zip(posed.LIGHTS, (4, 5, 6, 4.5))]
    mean_square = np.mean([np.dot(lamp, lamp) for lamp in lamps])
    folder = tmp_path / "capture"
    write_lit(folder, rendered, 0.6 * mean_square, lamps)
    illum("build", folder, "-o", tmp_path / "o.illum", "--basis", "exact")
    info = info_of(illum, tmp_path / "o.illum")
    assert (info["views"], info["lights"], info["mask"]) == (len(KEPT), len(lamps), True)
    for light in range(len(lamps)):
        picture = seen(illum, tmp_path / "o.illum", tmp_path, KEPT[1], posed.LIGHTS[light])
        assert likeness(picture, 0.6 * rendered[KEPT[1]][light]) > 46
        assert (picture[:10, :, 3] == 0).all() and (picture[10:, :, 3] == 255).all()
