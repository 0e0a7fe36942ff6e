"""That light comes from where it is said to come, and that lights add up."""

import math
import subprocess

import numpy as np
import pytest
from PIL import Image

import stacks


def parts_of_the_ball():
    x, y = stacks.grid(stacks.WIDTH, stacks.HEIGHT)
    on_ball = x * x + y * y < (0.8 * stacks.BALL_RADIUS) ** 2
    return x, y, on_ball


def relight(illum, built, out, *lights, more=()):
    arguments = [part for light in lights for part in ("--light", ",".join(map(str, light)))]
    illum("relight", built, *arguments, *more, "-o", out)
    return out


def read_exrs(files, names="RGB"):
    """Linear values of these channels of each file, read by OpenImageIO's tool rather than by our
    code, all in one call: it takes long to begin."""
    planes = [[file.with_suffix(f".{name}.tif") for name in names] for file in files]
    words = [word for file, of in zip(files, planes) for name, plane in zip(names, of)
             for word in (file, "--ch", name, "-d", "float", "-o", plane, "--pop")]
    subprocess.run(["oiiotool", *words], check=True, capture_output=True)
    return [np.stack([np.asarray(Image.open(plane), float) for plane in of], axis=2)
            for of in planes]


def read_exr(file):
    return read_exrs([file])[0]


@pytest.mark.parametrize("light, side", [
    ((0.8, 0, 0.6), lambda x, y: x > 0.1), ((-0.8, 0, 0.6), lambda x, y: x < -0.1),
    ((0, 0.8, 0.6), lambda x, y: y > 0.1), ((0, -0.8, 0.6), lambda x, y: y < -0.1),
], ids=["from the right", "from the left", "from above", "from below"])
def test_the_side_that_faces_the_light_is_bright(illum, built, tmp_path, light, side):
    picture = stacks.read_picture(relight(illum, built, tmp_path / "o.png", light)).mean(axis=2)
    x, y, on_ball = parts_of_the_ball()
    toward, away = on_ball & side(x, y), on_ball & side(-x, -y)
    assert picture[toward].mean() > 1.5 * picture[away].mean()


@pytest.mark.parametrize("degrees", range(0, 360, 45))
def test_the_shadow_falls_away_from_the_light(illum, built, tmp_path, degrees):
    a = math.radians(degrees)
    light = (0.85 * math.cos(a), 0.85 * math.sin(a), 0.52)
    picture = stacks.read_picture(relight(illum, built, tmp_path / "o.png", light)).mean(axis=2)
    x, y, _ = parts_of_the_ball()

    def ground_at(distance):
        return np.hypot(x - distance * math.cos(a), y - distance * math.sin(a)) < 0.08

    shadow, lit = picture[ground_at(-0.58)].mean(), picture[ground_at(0.58)].mean()
    assert shadow < 0.6 * lit, (shadow, lit)


@pytest.fixture(scope="module", params=["display", "linear"])
def responding(request, stack, tmp_path_factory, binary):
    from conftest import Illum
    out = tmp_path_factory.mktemp(request.param) / "o.illum"
    Illum(tmp_path_factory.mktemp("output"))("build", stack, "-o", out, "--response", request.param)
    return out


def test_lights_add_up_in_linear_light(illum, responding, tmp_path):
    red = (0.7, 0.2, 0.6, 1.5, 0.2, 0.1)
    blue = (-0.6, 0.3, 0.7, 0.1, 0.3, 0.8)
    one, other, both = (read_exr(relight(illum, responding, tmp_path / f"{name}.exr", *lights))
                        for name, lights in (("a", [red]), ("b", [blue]), ("ab", [red, blue])))
    assert np.abs(one).max() > 0.1
    np.testing.assert_allclose(both, one + other, atol=2e-6, rtol=1e-5)


def test_intensity_scales(illum, responding, tmp_path):
    once = read_exr(relight(illum, responding, tmp_path / "a.exr", (0.3, 0.3, 0.9)))
    scaled = read_exr(relight(illum, responding, tmp_path / "b.exr", (0.3, 0.3, 0.9, 3, 0.5, 0)))
    np.testing.assert_allclose(scaled, once * [3, 0.5, 0], atol=2e-6, rtol=1e-5)


def test_the_length_of_a_light_vector_does_not_matter(illum, built, tmp_path):
    a = relight(illum, built, tmp_path / "a.png", (0.3, 0.2, 0.9)).read_bytes()
    b = relight(illum, built, tmp_path / "b.png", (30, 20, 90)).read_bytes()
    assert a == b


def test_exposure_is_in_stops(illum, built, tmp_path):
    light = (0.3, 0.2, 0.9)
    plain = read_exr(relight(illum, built, tmp_path / "a.exr", light))
    stops = read_exr(relight(illum, built, tmp_path / "b.exr", light, more=["--exposure", "1.5"]))
    np.testing.assert_allclose(stops, plain * 2**1.5, atol=2e-6, rtol=1e-5)
    shown = stacks.read_picture(relight(illum, built, tmp_path / "c.png", light))
    assert np.abs(shown.astype(int) - stacks.display_bytes(plain)).max() <= 1


def test_below_the_horizon_is_continuous(illum, built, tmp_path):
    above = read_exr(relight(illum, built, tmp_path / "a.exr", (0.9, 0.1, 0.002)))
    below = read_exr(relight(illum, built, tmp_path / "b.exr", (0.9, 0.1, -0.002)))
    assert np.abs(above - below).max() < 0.02
    assert np.isfinite(read_exr(relight(illum, built, tmp_path / "c.exr", (0, 0, -1)))).all()


@pytest.mark.parametrize("suffix, at_least", [("png", 99), ("jpg", 30)])
def test_picture_formats_show_the_same(illum, built, tmp_path, suffix, at_least):
    light = (0.1, 0.5, 0.8)
    reference = stacks.display_bytes(read_exr(relight(illum, built, tmp_path / "o.exr", light)))
    picture = stacks.read_picture(relight(illum, built, tmp_path / f"o.{suffix}", light))
    error = np.abs(picture.astype(int) - reference).max()
    assert error <= 1 if at_least == 99 else stacks.psnr(picture, reference) > at_least


def test_a_light_file_writes_a_picture_a_line(illum, stack, built, tmp_path):
    illum("relight", built, "--lights", stack / "lights.lp", "-o", tmp_path / "all")
    names = sorted(p.name for p in (tmp_path / "all").iterdir())
    assert names == [f"photo {k:02d}.png" for k in range(28)]
    light = list(stacks.directions(28))[7]
    single = relight(illum, built, tmp_path / "one.png", tuple(light))
    one, batch = (stacks.read_picture(p) for p in (single, tmp_path / "all" / "photo 07.png"))
    assert np.abs(one.astype(int) - batch).max() <= 1
    illum("relight", built, "--lights", stack / "lights.lp", "--format", "jpg", "-o",
          tmp_path / "jpegs")
    assert {p.suffix for p in (tmp_path / "jpegs").iterdir()} == {".jpg"}


def test_a_folder_with_something_in_it_needs_force(illum, stack, built, tmp_path):
    (tmp_path / "all").mkdir()
    (tmp_path / "all" / "mine.txt").write_text("mine")
    command = ["relight", built, "--lights", stack / "lights.lp", "-o", tmp_path / "all"]
    illum.refuses(*command, mentions="--force", leaves=tmp_path)
    illum(*command, "--force")
    assert (tmp_path / "all" / "mine.txt").read_text() == "mine"


def test_a_picture_is_replaced(illum, built, tmp_path):
    out = tmp_path / "o.png"
    out.write_bytes(b"old")
    relight(illum, built, out, (0, 0, 1))
    assert stacks.read_picture(out).shape == (stacks.HEIGHT, stacks.WIDTH, 3)


def test_coarser_level(illum, stack, tmp_path):
    illum("build", stack, "-o", tmp_path / "o.illum", "--tile", 64, "--coding", "png")
    light = next(stacks.directions(28))
    out = relight(illum, tmp_path / "o.illum", tmp_path / "l1.png", tuple(light),
                  more=["--level", "1"])
    truth = stacks.render(light).reshape(28, 2, 36, 2, 3).mean(axis=(1, 3))
    picture = stacks.read_picture(out)
    assert picture.shape == truth.shape
    assert stacks.psnr(picture, stacks.display_bytes(truth)) > 24
