"""`illum build` and `illum relight`, the whole way on a scene whose every picture is known."""

import json

import numpy as np
import pytest
from PIL import Image

import stacks
from conftest import listing


def relit(illum, built, tmp_path, light, *more):
    out = tmp_path / "relit.png"
    illum("relight", built, "--light", ",".join(f"{c:.7f}" for c in light), *more, "-o", out)
    return stacks.read_picture(out)


def mean_psnr(illum, built, tmp_path, lights):
    return np.mean([stacks.psnr(relit(illum, built, tmp_path, l),
                                stacks.display_bytes(stacks.render(l))) for l in lights])


# Decibels over the lights that the photographs were taken under; measured less about 1 dB.
@pytest.mark.parametrize("options, at_least", [
    ([], 30),
    (["--basis", "learned", "--planes", 12], 27),
    (["--basis", "sh", "--coefficients", 16], 27),
    (["--basis", "hsh", "--coefficients", 9], 25),
    (["--basis", "dct", "--coefficients", 16], 25),
    (["--basis", "sh", "--coefficients", 9, "--projection"], 18),
    (["--coding", "png"], 31),
    (["--coding", "jpeg", "--quality", 90], 29),
    (["--coding", "avif", "--quality", 90], 30),
    (["--coding", "png", "--bits", 16], 31),
    (["--coding", "png", "--bits", 8, "--curve", "signedSqrt"], 27),
    (["--response", "linear"], 24),
    (["--tile", 64], 29),
    (["--basis", "sh", "--no-weights", "--no-extension", "--regularizer", "0.001"], 24),
    (["--basis", "sh", "--weights", "--extension"], 24),
], ids=lambda value: " ".join(map(str, value)) or "default" if isinstance(value, list) else None)
def test_photographed_lights_come_back(illum, stack, tmp_path, options, at_least):
    out = tmp_path / "ball.illum"
    illum("build", stack, "-o", out, *options)
    assert listing(tmp_path) == [("ball.illum", out.stat().st_size)], "nothing else is left behind"
    lights = list(stacks.directions(28))[::9]
    assert mean_psnr(illum, out, tmp_path, lights) > at_least


def test_unseen_lights_are_interpolated(illum, built, tmp_path):
    lights = [(0.3, 0.2, 0.9), (-0.5, 0.4, 0.7), (0.1, -0.6, 0.75)]
    assert mean_psnr(illum, built, tmp_path, lights) > 27


def test_more_quality_takes_more_bytes_and_errs_less(illum, stack, tmp_path):
    lights = list(stacks.directions(28))[::9]
    figures = []
    for quality in (20, 60, 95):
        out = tmp_path / f"{quality}.illum"
        illum("build", stack, "-o", out, "--planes", 12, "--quality", quality, "--coding", "jpeg")
        figures.append((out.stat().st_size, mean_psnr(illum, out, tmp_path, lights)))
    assert figures == sorted(figures) and figures[0][1] < figures[2][1], figures


def test_zip_and_folder_relight_alike(illum, stack, tmp_path):
    illum("build", stack, "-o", tmp_path / "ball.illum")
    illum("build", stack, "-o", f"{tmp_path / 'ball'}/")
    assert (tmp_path / "ball" / "object.json").is_file()
    pictures = [relit(illum, tmp_path / name, tmp_path, (0.4, 0.3, 0.8)) for name in
                ("ball.illum", "ball")]
    assert np.array_equal(*pictures)


def test_same_bytes_whatever_the_threads_and_the_place(illum, own_stack, stack, tmp_path):
    for name, source, threads in (("a", stack, 1), ("b", stack, 2), ("c", own_stack, 2)):
        illum("build", source, "-o", tmp_path / f"{name}.illum", "--threads", threads, "--tile", 64)
    a, b, c = ((tmp_path / f"{n}.illum").read_bytes() for n in "abc")
    assert a == b, "one thread and two"
    assert a == c, "another folder with the same photographs"


def test_crop_and_shrink(illum, stack, tmp_path):
    illum("build", stack, "-o", tmp_path / "o.illum", "--crop", "8,4,48,40", "--shrink", 2,
          "--coding", "png")
    light = next(stacks.directions(28))
    picture = relit(illum, tmp_path / "o.illum", tmp_path, light)
    truth = stacks.render(light)[4:44, 8:56].reshape(20, 2, 24, 2, 3).mean(axis=(1, 3))
    assert picture.shape == truth.shape
    assert stacks.psnr(picture, stacks.display_bytes(truth)) > 28


def test_mask_becomes_alpha(illum, stack, tmp_path):
    x, y = stacks.grid(stacks.WIDTH, stacks.HEIGHT)
    inside = x * x + y * y < stacks.BALL_RADIUS**2
    Image.fromarray((inside * 255).astype(np.uint8)).save(tmp_path / "mask.png")
    illum("build", stack, "-o", tmp_path / "o.illum", "--mask", tmp_path / "mask.png")
    picture = relit(illum, tmp_path / "o.illum", tmp_path, (0.3, 0.3, 0.9))
    assert picture.shape[2] == 4
    assert np.array_equal(picture[..., 3] > 127, inside)
    truth = stacks.display_bytes(stacks.render((0.3, 0.3, 0.9)))
    assert stacks.psnr(picture[inside][:, :3], truth[inside]) > 24


@pytest.mark.parametrize("suffix, options", [
    (".jpg", {"quality": 97}), (".jpg", {"quality": 97, "progressive": True}), (".tif", {}),
    (".webp", {"lossless": True}), (".bmp", {}), (".JPG", {"quality": 97}),
], ids=str)
def test_picture_formats(illum, tmp_path, suffix, options):
    lights = stacks.write_stack(tmp_path / "p", count=16, suffix=suffix, **options)
    out = tmp_path / "o.illum"
    illum("build", tmp_path / "p", "-o", out)
    assert mean_psnr(illum, out, tmp_path, lights[::5]) > 27


def test_linear_and_display_files_look_alike(illum, own_stack, tmp_path):
    """The same scene as linear values, told so, shows the same picture."""
    for k, light in enumerate(stacks.directions(28)):
        linear = np.round(np.clip(stacks.render(light), 0, 1) * 255).astype(np.uint8)
        Image.fromarray(linear).save(own_stack / f"photo {k:02d}.png")
    out = tmp_path / "o.illum"
    illum("build", own_stack, "-o", out, "--transfer", "linear")
    assert json.loads(illum("info", out, "--json").stdout)["response"] == "linear"
    light = (0.2, 0.3, 0.9)
    assert stacks.psnr(relit(illum, out, tmp_path, light),
                       stacks.display_bytes(stacks.render(light))) > 22


def test_grey_photographs(illum, own_stack, tmp_path):
    for file in own_stack.glob("*.png"):
        Image.open(file).convert("L").save(file)
    illum("build", own_stack, "-o", tmp_path / "o.illum")
    picture = relit(illum, tmp_path / "o.illum", tmp_path, (0.2, 0.3, 0.9)).astype(int)
    assert np.ptp(picture[..., :3], axis=2).max() <= 3


def test_warns_of_too_many_coefficients(illum, stack, tmp_path):
    outcome = illum("build", stack, "-o", tmp_path / "o.illum", "--basis", "sh",
                    "--coefficients", 64)
    assert "illum: " in outcome.stderr and "64" in outcome.stderr, outcome


def test_overwriting_needs_force(illum, stack, tmp_path):
    out = tmp_path / "o.illum"
    out.write_bytes(b"something precious")
    illum.refuses("build", stack, "-o", out, mentions="--force", leaves=tmp_path)
    assert out.read_bytes() == b"something precious"
    illum("build", stack, "-o", out, "--force")
    illum("verify", out)


def test_a_failed_build_leaves_the_old_object(illum, own_stack, built, tmp_path):
    out = tmp_path / "o.illum"
    out.write_bytes(built.read_bytes())
    (own_stack / "photo 05.png").write_bytes(b"")
    illum.refuses("build", own_stack, "-o", out, "--force", leaves=tmp_path)
    assert out.read_bytes() == built.read_bytes()


@pytest.mark.parametrize("side, warned", [(2, False), (14, True)])
def test_highlights_that_the_pilot_did_not_see(illum, tmp_path, side, warned):
    """Planes are scaled by a part of the pixels. What is brighter elsewhere is clipped: a few
    samples are told, more than one in 10 000 are warned of."""
    width = height = 640  # so large that every other row of blocks of 16 is looked at
    lights = list(stacks.directions(6))
    noise = np.random.default_rng(1).integers(20, 30, (height, width, 3))
    names = [f"photo {k}.png" for k in range(len(lights))]
    for k, name in enumerate(names):
        picture = (noise + 3 * k).astype(np.uint8)
        picture[17:17 + side, 17:17 + side] = 255 if k % 2 else 0
        Image.fromarray(picture).save(tmp_path / name)
    stacks.write_light_file(tmp_path, names, lights)
    outcome = illum("build", tmp_path, "-o", tmp_path / "o.illum", "--tile", 64)
    said = "plane samples lay outside the quantiser's range and took its nearest end"
    notes = [line for line in outcome.stderr.splitlines() if line.startswith("illum: note: ")]
    assert any(said in line for line in notes) == warned, outcome
    assert (said in outcome.stdout) != warned, outcome
