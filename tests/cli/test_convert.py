"""`illum convert`: other grids of view points, other codings; what it refuses, leaves and takes."""

import json
import re
import time

import numpy as np
import pytest

import balls
import stacks
from conftest import Illum, interrupt, listing

LIGHT = (0.4, 0.3, 0.85)
MEBI = 1 << 20


def build(tmp_path_factory, name, *options, **capture):
    folder = tmp_path_factory.mktemp(name)
    balls.write_capture(folder / "capture", **capture)
    Illum(folder)("build", folder / "capture", "-o", folder / "o.illum", *options)
    return folder / "o.illum"


@pytest.fixture(scope="module")
def slab(tmp_path_factory, binary):
    return build(tmp_path_factory, "slab", slabs=[balls.Slab()], depth=True)


@pytest.fixture(scope="module")
def two_slabs(tmp_path_factory, binary):
    return build(tmp_path_factory, "two", slabs=SLABS, depth=True)


SLABS = [balls.Slab(), balls.Slab("side", count=2, width=40, turn_degrees=50)]


def info_of(illum, built):
    return json.loads(illum("info", built, "--json").stdout)


def see(illum, built, tmp_path, view):
    light = ",".join(map(str, LIGHT))
    illum("relight", built, "--light", light, "--view", view, "-o", tmp_path / "seen.png")
    return stacks.read_picture(tmp_path / "seen.png")


def test_a_finer_grid_shows_what_would_be_seen(illum, slab, tmp_path):
    finer = tmp_path / "finer.illum"
    illum("convert", slab, finer, "--uv", "5x3")
    illum("verify", finer)
    info = info_of(illum, finer)
    assert info["views"] == 15 and info["depth"] and info["mask"]
    for u, v in ((0.25, 0), (0.75, 0.5), (0.25, 1)):
        assert balls.likeness(see(illum, finer, tmp_path, f"{u},{v}"), balls.Slab().camera(u, v),
                              LIGHT) > 26
    for view in ("0,0", "0.5,1"):
        assert np.array_equal(*(see(illum, built, tmp_path, view) for built in (finer, slab)))


def test_without_depth_new_views_are_blurred(illum, slab, tmp_path):
    truth = balls.Slab().camera(0.25, 0.25)
    seen = []
    for name, options in (("by depth", ()), ("flat", ("--no-depth",))):
        illum("convert", slab, tmp_path / name, "--uv", "5x5", *options)
        seen.append(balls.likeness(see(illum, tmp_path / name, tmp_path, "0.25,0.25"), truth, LIGHT))
    assert seen[0] > seen[1] + 2


def test_a_coarser_grid_keeps_corners(illum, slab, tmp_path):
    coarser = tmp_path / "coarser.illum"
    illum("convert", slab, coarser, "--uv", "2x2")
    illum("verify", coarser)
    assert info_of(illum, coarser)["views"] == 4
    assert coarser.stat().st_size < slab.stat().st_size
    for view in ("0,0", "1,0", "0,1", "1,1"):
        assert np.array_equal(*(see(illum, built, tmp_path, view) for built in (coarser, slab)))


def test_every_slab_has_the_grid(illum, two_slabs, tmp_path):
    illum("convert", two_slabs, tmp_path / "o.illum", "--uv", "3x2")
    illum("verify", tmp_path / "o.illum")
    info = info_of(illum, tmp_path / "o.illum")
    assert info["views"] == 12 and info["bases"] == 2
    for slab, new in zip(SLABS, ((0, 1), (0.5, 0))):
        picture = see(illum, tmp_path / "o.illum", tmp_path, f"{slab.name}:{new[0]},{new[1]}")
        assert balls.likeness(picture, slab.camera(*new), LIGHT) > 26, slab.name


@pytest.mark.parametrize("coding, at_least", [("png", 36), ("jpeg", 30), ("avif", 30)])
def test_codings(illum, slab, tmp_path, coding, at_least):
    eight = tmp_path / "eight.illum"
    illum("build", slab.parent / "capture", "-o", eight, "--bits", 8, "--quality", 95)
    illum("convert", eight, tmp_path / "o.illum", "--coding", coding, "--quality", 90)
    illum("verify", tmp_path / "o.illum")
    assert info_of(illum, tmp_path / "o.illum")["coding"] == coding
    before, after = (balls.over_black(see(illum, built, tmp_path, "0.5,0.5"))
                     for built in (eight, tmp_path / "o.illum"))
    assert stacks.psnr(after, before) > at_least


def test_quality_is_bytes_against_error(illum, slab, tmp_path):
    figures = []
    for quality in (90, 50, 10):
        illum("convert", slab, tmp_path / "o.illum", "--quality", quality, "--force")
        seen = see(illum, tmp_path / "o.illum", tmp_path, "0.5,0.5")
        figures.append(((tmp_path / "o.illum").stat().st_size,
                        balls.likeness(seen, balls.Slab().camera(0.5, 0.5), LIGHT)))
    assert figures == sorted(figures, reverse=True), figures


def test_new_views_in_another_coding(illum, slab, tmp_path):
    illum("convert", slab, tmp_path / "o.illum", "--uv", "4x3", "--coding", "png")
    illum("verify", tmp_path / "o.illum")
    picture = see(illum, tmp_path / "o.illum", tmp_path, "0.333333333333,0.5")
    assert balls.likeness(picture, balls.Slab().camera(1 / 3, 0.5), LIGHT) > 24


def test_the_same_bytes_whatever_the_threads(illum, two_slabs, tmp_path):
    for threads in (1, 2):
        illum("convert", two_slabs, tmp_path / str(threads), "--uv", "3x3", "--threads", threads)
    assert (tmp_path / "1").read_bytes() == (tmp_path / "2").read_bytes()


def test_what_is_there_is_not_replaced_unasked(illum, slab, built, tmp_path):
    out = tmp_path / "o.illum"
    out.write_bytes(built.read_bytes())
    illum.refuses("convert", slab, out, "--uv", "2x2", mentions="--force", leaves=tmp_path)
    assert out.read_bytes() == built.read_bytes()
    illum("convert", slab, out, "--uv", "2x2", "--force")
    assert info_of(illum, out)["views"] == 4
    (tmp_path / "mine").mkdir()
    (tmp_path / "mine" / "letter.txt").write_text("precious")
    illum.refuses("convert", slab, f"{tmp_path}/mine/", "--force", leaves=tmp_path)


def test_an_object_may_become_itself(illum, slab, tmp_path):
    out = tmp_path / "o.illum"
    out.write_bytes(slab.read_bytes())
    illum("convert", out, out, "--force")
    assert out.read_bytes() == slab.read_bytes()
    illum("convert", out, out, "--force", "--uv", "2x2")
    illum("verify", out)
    assert listing(tmp_path) == [("o.illum", out.stat().st_size)]


@pytest.mark.parametrize("options, code, word", [
    (("--uv", "3"), 2, "--uv"), (("--uv", "axb"), 2, "--uv"), (("--uv", "2000x2"), 2, "--uv"),
    (("--quality", "101"), 2, "--quality"), (("--speed", "11"), 2, "--speed"),
    (("--coding", "bmp"), None, "bmp"), (("--uv", "4x4", "--max-memory", "1M"), 3, "at least"),
], ids=lambda o: " ".join(o) if isinstance(o, tuple) else "")
def test_options_that_mean_nothing(illum, slab, tmp_path, options, code, word):
    illum.refuses("convert", slab, tmp_path / "o.illum", *options, code=code, mentions=word,
                  leaves=tmp_path)


@pytest.mark.parametrize("spoil", ["missing", "not an object", "cut"])
def test_objects_that_are_none(illum, slab, tmp_path, spoil):
    file = tmp_path / "in.illum"
    if spoil == "not an object":
        file.write_text("once upon a time\n" * 99)
    if spoil == "cut":
        file.write_bytes(slab.read_bytes()[:-600])
    illum.refuses("convert", file, tmp_path / "o.illum", "--uv", "2x2", mentions="in.illum",
                  leaves=tmp_path)


@pytest.fixture(scope="module")
def many_planes(tmp_path_factory, binary):
    """2 x 1 views of 192 planes, 50 MiB each as floats."""
    folder = tmp_path_factory.mktemp("planes")
    scene = {"illumScene": 1, "samples": 1, "bounces": 0, "meshes": [{"shape": "box"}],
             "views": [{"slab": {"viewPoints": [2, 1], "size": [256, 256]}}],
             "lights": {"fibonacci": 70}}
    (folder / "scene.json").write_text(json.dumps(scene))
    Illum(folder)("build", folder / "scene.json", "-o", folder / "o.illum", "--basis", "sh",
                  "--coefficients", 64, "--coding", "png", "--bits", 8, "--tile", 64)
    return folder / "o.illum"


def test_memory_is_kept(illum, many_planes, tmp_path):
    """In parts, if need be; with the same result."""
    outcome = illum("convert", many_planes, tmp_path / "o.illum", "--uv", "3x1", "--max-memory",
                    "8M", expect=3)
    told = float(re.search(r"at least ([\d.]+) MiB", outcome.stderr).group(1)) + 0.1
    assert told < 400, "one view of all planes and the program"
    for budget in (told, 2000):
        outcome = illum("convert", many_planes, tmp_path / f"{budget}", "--uv", "3x1",
                        "--max-memory", f"{int(budget * MEBI)}", timeout=600)
        assert outcome.peak_bytes < budget * MEBI, outcome.peak_bytes / MEBI
    assert (tmp_path / f"{told}").read_bytes() == (tmp_path / "2000").read_bytes()


@pytest.mark.parametrize("target", ["new", "existing"])
def test_an_interrupted_conversion_leaves_nothing(illum, many_planes, built, tmp_path, target):
    out = tmp_path / "o.illum"
    if target == "existing":
        out.write_bytes(built.read_bytes())
    before = listing(tmp_path)
    process = illum.start("convert", many_planes, out, "--uv", "9x1", "--force")
    deadline = time.monotonic() + 60
    while not any(tmp_path.rglob("planes/**/*")) and time.monotonic() < deadline:
        time.sleep(0.02)
    interrupt(process)
    assert process.wait(60) == 130
    assert listing(tmp_path) == before
    if target == "existing":
        assert out.read_bytes() == built.read_bytes()
