"""Normals and heights that an object's own light shows, against scenes whose shape is known."""

import math
import subprocess

import numpy as np
import pytest
from PIL import Image

import stacks
from test_light import read_exr


def true_shape():
    """Normals and heights of the ball in its plane, and where both are beyond doubt."""
    x, y = stacks.grid(stacks.WIDTH, stacks.HEIGHT)
    r = np.hypot(x, y)
    on_ball = r < stacks.BALL_RADIUS
    z = np.where(on_ball, np.sqrt(np.maximum(stacks.BALL_RADIUS**2 - r * r, 0)), 0)
    ball = np.stack([x, y, z], axis=2) / stacks.BALL_RADIUS
    flat = np.array([0, 0, 1.0])
    return np.where(on_ball[..., None], ball, flat), z, r


def degrees_between(a, b):
    return np.degrees(np.arccos(np.clip((a * b).sum(axis=2), -1, 1)))


def read_grey_exr(file):
    plane = file.with_suffix(".tif")
    subprocess.run(["oiiotool", file, "-d", "float", "-o", plane], check=True, capture_output=True)
    return np.asarray(Image.open(plane), float)


@pytest.fixture(scope="module")
def shape(built, tmp_path_factory):
    from conftest import Illum
    folder = tmp_path_factory.mktemp("shape")
    run = Illum(tmp_path_factory.mktemp("output"))
    outcome = run("normals", built, "-o", folder / "n.exr", "--height", folder / "z.exr")
    return outcome, read_exr(folder / "n.exr"), read_grey_exr(folder / "z.exr")


def test_normals_of_a_known_scene(shape):
    _, normals, _ = shape
    truth, _, r = true_shape()
    error = degrees_between(normals, truth)
    assert error[r < 0.75 * stacks.BALL_RADIUS].mean() < 4
    assert error[r > 1.6 * stacks.BALL_RADIUS].mean() < 2


def test_robust_is_better_than_plain_least_squares(illum, shape, built, tmp_path):
    illum("normals", built, "-o", tmp_path / "n.exr", "--method", "plain")
    truth, _, r = true_shape()
    judged = (r < 0.8 * stacks.BALL_RADIUS) | (r > 1.1 * stacks.BALL_RADIUS)
    robust, plain = (degrees_between(n, truth)[judged].mean()
                     for n in (shape[1], read_exr(tmp_path / "n.exr")))
    assert robust < 0.75 * plain, (robust, plain)


def test_heights_of_a_known_scene(shape):
    outcome, _, heights = shape
    _, z, r = true_shape()
    rise = heights[r < 0.1].mean() - heights[(r > 0.3) & (r < 0.32)].mean()
    truth = z[r < 0.1].mean() - z[(r > 0.3) & (r < 0.32)].mean()
    assert rise == pytest.approx(truth, rel=0.15)
    assert abs(heights.mean()) < 1e-4
    assert outcome.stdout.startswith("heights from -")


def test_the_usual_encoding(illum, built, tmp_path):
    illum("normals", built, "-o", tmp_path / "n.png", "--height", tmp_path / "z.png")
    encoded = np.asarray(Image.open(tmp_path / "n.png").convert("RGBA"), float)
    _, _, r = true_shape()
    x, y = stacks.grid(stacks.WIDTH, stacks.HEIGHT)
    ring = (r > 0.2) & (r < 0.32)
    assert encoded[ring & (x > 0.15)][:, 0].mean() > 170, "what faces right is red"
    assert encoded[ring & (x < -0.15)][:, 0].mean() < 85
    assert encoded[ring & (y > 0.15)][:, 1].mean() > 170, "what faces up is green"
    assert encoded[ring & (y < -0.15)][:, 1].mean() < 85
    assert encoded[..., 2].mean() > 200 and (encoded[..., 3] == 255).all()
    heights = Image.open(tmp_path / "z.png")
    assert heights.mode.startswith("I") and np.asarray(heights).max() == 65535


def test_the_mask_is_transparent(illum, tmp_path, stack):
    mask = np.zeros((stacks.HEIGHT, stacks.WIDTH), np.uint8)
    mask[:, 20:] = 255
    Image.fromarray(mask).save(tmp_path / "mask.png")
    illum("build", stack, "--mask", tmp_path / "mask.png", "-o", tmp_path / "o.illum")
    illum("normals", tmp_path / "o.illum", "-o", tmp_path / "n.png")
    alpha = np.asarray(Image.open(tmp_path / "n.png").convert("RGBA"))[..., 3]
    assert (alpha[:, :20] == 0).all() and (alpha[:, 20:] == 255).all()


def test_a_candle_stands_above_the_surface(illum, built, shape, tmp_path):
    """Close to the ball, light falls on its side: with heights the ball's near flank is brighter
    than a plane's would be."""
    lamp = ("--point", "0.8,0,0.25,0.3,0.3,0.3")
    pictures = {}
    for name, more in (("plane", ()), ("auto", ("--height", "auto"))):
        illum("relight", built, *lamp, *more, "-o", tmp_path / f"{name}.exr")
        pictures[name] = read_exr(tmp_path / f"{name}.exr").mean(axis=2)
    illum("normals", built, "-o", tmp_path / "n.png", "--height", tmp_path / "z.exr")
    illum("relight", built, *lamp, "--height", tmp_path / "z.exr", "-o", tmp_path / "file.exr")
    np.testing.assert_array_equal(read_exr(tmp_path / "file.exr").mean(axis=2), pictures["auto"])

    # The truth: every point of the scene seen by the directional light of its own direction.
    truth, z, r = true_shape()
    z = z - z.mean()
    x, y = stacks.grid(stacks.WIDTH, stacks.HEIGHT)
    toward = np.stack([0.8 - x, 0 - y, 0.25 - z], axis=2)
    d = np.linalg.norm(toward, axis=2)
    cosine = np.clip((toward / d[..., None] * truth).sum(axis=2), 0, None)
    expected = 0.3 * cosine / d**2
    flank = (r < 0.8 * stacks.BALL_RADIUS) & (x > 0.1)

    def correlation(picture):
        return np.corrcoef(picture[flank], expected[flank])[0, 1]

    assert correlation(pictures["auto"]) > correlation(pictures["plane"])


@pytest.mark.parametrize("arguments, code, word", [
    (("-o", "n.jpg"), 2, ".exr"),
    (("-o", "n.png", "--height", "z.jpg"), 2, ".exr"),
    (("-o", "n.png", "--method", "magic"), 2, "robust"),
    (("-o", "n.png", "--view", "nobody"), 2, "nobody"),
])
def test_wrong_usage(illum, built, tmp_path, arguments, code, word):
    illum.refuses("normals", built, *arguments, code=code, mentions=word, leaves=tmp_path,
                  cwd=tmp_path)


def test_three_lights_are_too_few(illum, tmp_path):
    folder = tmp_path / "few"
    folder.mkdir()
    lights = [np.array([math.sin(a), 0.2, 0.8]) for a in (-0.6, 0, 0.6)]
    names = []
    for k, light in enumerate(lights):
        names.append(f"{k}.png")
        Image.fromarray(stacks.display_bytes(stacks.render(light))).save(folder / names[-1])
    stacks.write_light_file(folder, names, lights)
    illum("build", folder, "-o", tmp_path / "o.illum")
    illum.refuses("normals", tmp_path / "o.illum", "-o", tmp_path / "n.png", mentions="4 lights")
