"""Photographs as cameras and telephones write them: raw files, HEIF."""

import shutil
import subprocess

import numpy as np
import pytest
from PIL import Image

import stacks
from conftest import listing
from dng import write_dng


def relit(illum, built, tmp_path, light):
    out = tmp_path / "relit.png"
    illum("relight", built, "--light", ",".join(f"{c:.7f}" for c in light), "-o", out)
    return stacks.read_picture(out)


def photographed(illum, folder, tmp_path, lights, names):
    """PSNR of the lights that were photographed, of an object without loss."""
    stacks.write_light_file(folder, names, lights)
    illum("build", folder, "-o", tmp_path / "o.illum", "--coding", "png")
    return [stacks.psnr(relit(illum, tmp_path / "o.illum", tmp_path, light),
                        stacks.display_bytes(stacks.render(light))) for light in lights[::4]]


def test_camera_raw(illum, tmp_path):
    folder = tmp_path / "raw"
    folder.mkdir()
    lights = list(stacks.directions(14))
    names = [f"shot {k:02d}.dng" for k in range(14)]
    for name, light in zip(names, lights):
        write_dng(folder / name, stacks.render(light))
    # A mosaic of 72x56 pixels keeps a third of the samples: edges suffer, exposure must not.
    figures = photographed(illum, folder, tmp_path, lights, names)
    assert min(figures) > 22, figures
    truth = np.mean([stacks.linear_from_bytes(stacks.display_bytes(stacks.render(l)))
                     for l in lights[:1]])
    found = np.mean(stacks.linear_from_bytes(relit(illum, tmp_path / "o.illum", tmp_path, lights[0])))
    assert abs(found / truth - 1) < 0.03, (found, truth)


def test_raw_files_that_end_early(illum, tmp_path):
    folder = tmp_path / "raw"
    folder.mkdir()
    lights = list(stacks.directions(5))
    names = [f"shot {k}.dng" for k in range(5)]
    for name, light in zip(names, lights):
        write_dng(folder / name, stacks.render(light))
    stacks.write_light_file(folder, names, lights)
    whole = (folder / names[3]).read_bytes()
    for size in (0, 7, 300, len(whole) - 2000):
        (folder / names[3]).write_bytes(whole[:size])
        before = listing(tmp_path)
        outcome = illum("build", folder, "-o", tmp_path / "o.illum", expect=1)
        # The library that reads raw files may have said a word of its own before.
        last = outcome.stderr.splitlines()[-1]
        assert last.startswith("illum: ") and "shot 3.dng: expected" in last, outcome
        assert listing(tmp_path) == before


@pytest.mark.parametrize("suffix", [".heic", ".avif"])
def test_heif(illum, tmp_path, suffix):
    if shutil.which("oiiotool") is None:
        pytest.skip("writing HEIF needs oiiotool")
    folder = tmp_path / "heif"
    folder.mkdir()
    lights = list(stacks.directions(14))
    names = [f"photo {k:02d}{suffix}" for k in range(14)]
    for name, light in zip(names, lights):
        plain = tmp_path / "plain.png"
        Image.fromarray(stacks.display_bytes(stacks.render(light))).save(plain)
        done = subprocess.run(["oiiotool", plain, "--quality", "95", "-o", folder / name],
                              capture_output=True, text=True, check=False)
        if done.returncode != 0:
            pytest.skip(f"oiiotool writes no {suffix}: {done.stdout}")
    figures = photographed(illum, folder, tmp_path, lights, names)
    assert min(figures) > 27, figures
