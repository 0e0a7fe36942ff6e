"""`--basis exact`: the photographs themselves, to the last bit."""

import json
import subprocess
import sys

import numpy as np
import pytest
from PIL import Image

import stacks
from conftest import ROOT
from half_exr import write_half_exr
from test_light import read_exr

SIZE = (40, 30)


def text_of(light):
    return ",".join(f"{c:.7f}" for c in light)


def relit(illum, built, out, light, *more):
    illum("relight", built, "--light", text_of(light), *more, "-o", out)
    return read_exr(out) if out.suffix == ".exr" else stacks.read_picture(out)


def info_of(illum, built):
    return json.loads(illum("info", built, "--json").stdout)


@pytest.fixture(scope="module")
def halves(tmp_path_factory):
    """Photographs whose samples are any finite halves: minus zero, subnormal, the largest."""
    folder = tmp_path_factory.mktemp("halves")
    lights = list(stacks.directions(7))
    names = [f"photo {k}.exr" for k in range(7)]
    random = np.random.default_rng(1)
    pictures = []
    for name in names:
        bits = random.integers(0, 0x7c00, SIZE[::-1] + (3,), dtype=np.uint16)
        bits |= random.integers(0, 2, bits.shape, dtype=np.uint16) << 15
        bits[0, :4, :] = np.array([0x8000, 0x0001, 0x7bff, 0x83ff])[:, None]
        pictures.append(bits.view(np.float16))
        write_half_exr(folder / name, pictures[-1])
    stacks.write_light_file(folder, names, lights)
    return folder, lights, pictures


@pytest.fixture(scope="module")
def exact_halves(halves, tmp_path_factory, binary):
    from conftest import Illum
    out = tmp_path_factory.mktemp("exact") / "o.illum"
    Illum(tmp_path_factory.mktemp("output"))("build", halves[0], "-o", out, "--basis", "exact",
                                             "--tile", 64)
    return out


def test_halves_come_back_to_the_last_bit(illum, halves, exact_halves, tmp_path):
    _, lights, pictures = halves
    for light, picture in zip(lights, pictures):
        found = relit(illum, exact_halves, tmp_path / "o.exr", light).astype(np.float32)
        assert np.array_equal(found.view(np.uint32), picture.astype(np.float32).view(np.uint32))


def test_between_lights_is_between_pictures(illum, halves, exact_halves, tmp_path):
    _, lights, pictures = halves
    middle = (lights[0] + lights[1]) / 2
    found = relit(illum, exact_halves, tmp_path / "o.exr", middle)
    mean = (pictures[0].astype(float) + pictures[1].astype(float)) / 2
    # The light file and the command line have seven decimals.
    assert np.abs(found - mean).max() < 1e-5 * np.abs(mean).max()


def test_what_an_object_of_halves_is(illum, exact_halves):
    info = info_of(illum, exact_halves)
    assert (info["basis"], info["coefficients"], info["planes"]) == ("exact", 7, 21)
    assert (info["coding"], info["bits"], info["curve"]) == ("png", 16, "half")
    assert info["format"] == "1.1" and info["response"] == "linear"
    illum("verify", exact_halves)


@pytest.fixture(scope="module")
def exact(stack, tmp_path_factory, binary):
    from conftest import Illum
    out = tmp_path_factory.mktemp("exact") / "o.illum"
    Illum(tmp_path_factory.mktemp("output"))("build", stack, "-o", out, "--basis", "exact")
    return out


def test_bytes_come_back(illum, stack, exact, tmp_path):
    for k, light in enumerate(stacks.directions(28)):
        found = relit(illum, exact, tmp_path / "o.png", light)
        assert np.array_equal(found, stacks.read_picture(stack / f"photo {k:02d}.png")), k
    info = info_of(illum, exact)
    assert (info["bits"], info["curve"], info["response"]) == (8, "linear", "display")


def test_photographs_of_sixteen_bits_come_back_to_eight(illum, tmp_path):
    folder = tmp_path / "deep"
    folder.mkdir()
    lights = list(stacks.directions(5))
    names = [f"photo {k}.png" for k in range(5)]
    for name, light in zip(names, lights):
        words = np.round(stacks.encoded(stacks.render(light)) * 65535).astype(np.uint16)
        grey = words[:, :, 1]
        Image.fromarray(grey).save(folder / name)
    stacks.write_light_file(folder, names, lights)
    illum("build", folder, "-o", tmp_path / "o.illum", "--basis", "exact")
    assert info_of(illum, tmp_path / "o.illum")["curve"] == "half"
    for name, light in zip(names, lights):
        found = relit(illum, tmp_path / "o.illum", tmp_path / "o.png", light)[:, :, 1].astype(float)
        words = np.asarray(Image.open(folder / name), float)
        # Halves err by 2^-12, sixteen bits by less.
        assert np.abs(found - words / 257).max() <= 0.5 + 255 / 4096


def test_linear_photographs_of_eight_bits_come_back(illum, stack, tmp_path):
    illum("build", stack, "-o", tmp_path / "o.illum", "--basis", "exact", "--response", "linear")
    for k, light in list(enumerate(stacks.directions(28)))[::9]:
        found = relit(illum, tmp_path / "o.illum", tmp_path / "o.png", light)
        assert np.array_equal(found, stacks.read_picture(stack / f"photo {k:02d}.png")), k


def test_evaluate_says_identical(illum, stack, exact):
    figures = json.loads(illum("evaluate", exact, "--against", stack, "--json").stdout)
    assert figures["used"]["psnr"] == pytest.approx(99, abs=1e-9), figures


def test_held_out_lights_are_interpolated(illum, stack, tmp_path):
    illum("build", stack, "-o", tmp_path / "o.illum", "--basis", "exact", "--holdout", 4)
    assert info_of(illum, tmp_path / "o.illum")["planes"] == 3 * 21
    figures = json.loads(
        illum("evaluate", tmp_path / "o.illum", "--against", stack, "--json").stdout)
    assert figures["used"]["psnr"] == pytest.approx(99, abs=1e-9), figures
    assert 18 < figures["heldOut"]["psnr"] < 60, figures


def test_the_format_s_reader_reads_it(illum, exact_halves, halves):
    _, lights, pictures = halves
    out = subprocess.run([sys.executable, ROOT / "docs/examples/read_illum.py", exact_halves,
                          text_of(lights[2]), "5,7"], check=True, capture_output=True, text=True)
    found = [float(v) for v in out.stdout.split(":")[1].split()]
    assert np.allclose(found, pictures[2][7, 5].astype(float), rtol=1e-6, atol=1e-6)


def test_one_thread_gives_the_same_bytes(illum, stack, exact, tmp_path):
    illum("build", stack, "-o", tmp_path / "o.illum", "--basis", "exact", "--threads", 1)
    assert (tmp_path / "o.illum").read_bytes() == exact.read_bytes()


@pytest.mark.parametrize("option", [["--coding", "avif"], ["--coding", "jpeg"], ["--bits", 8],
                                    ["--curve", "linear"], ["--planes", 9],
                                    ["--coefficients", 4]], ids=lambda o: o[0] + " " + str(o[1]))
def test_options_that_would_lose_something_are_refused(illum, stack, tmp_path, option):
    illum.refuses("build", stack, "-o", tmp_path / "o.illum", "--basis", "exact", *option, code=2,
                  mentions="exact", leaves=tmp_path)


def test_lights_from_one_direction_are_told(illum, own_stack, tmp_path):
    text = (own_stack / "lights.lp").read_text().splitlines()
    text[3] = text[3].rsplit(" ", 3)[0] + " " + " ".join(text[1].split()[-3:])
    (own_stack / "lights.lp").write_text("\n".join(text) + "\n")
    outcome = illum("build", own_stack, "-o", tmp_path / "o.illum", "--basis", "exact")
    assert "lights 1 and 3 of those used come from the same direction" in outcome.stderr
    assert info_of(illum, tmp_path / "o.illum")["coefficients"] == 27
