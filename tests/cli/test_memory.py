"""--max-memory is kept, whatever the number, size and kind of the photographs."""

import os
import shutil

import pytest
from PIL import Image

import stacks

MEBI = 1 << 20


@pytest.fixture(scope="module", params=["baseline", "progressive"])
def megapixels(request, tmp_path_factory):
    """48 photographs of 3 megapixels (432 MB decoded), eight different ones under many names."""
    folder = tmp_path_factory.mktemp(request.param) / "photographs"
    folder.mkdir()
    lights = list(stacks.directions(48))
    names = [f"photo {k:02d}.jpg" for k in range(48)]
    for k, name in enumerate(names):
        if k < 8:
            small = Image.fromarray(stacks.display_bytes(stacks.render(lights[k], 400, 300)))
            small.resize((2000, 1500), Image.BICUBIC).save(
                folder / name, quality=90, progressive=request.param == "progressive")
        else:
            os.link(folder / names[k % 8], folder / name)
    stacks.write_light_file(folder, names, lights)
    return folder


@pytest.mark.parametrize("budget", [192, 320])
def test_resident_memory(illum, megapixels, tmp_path, budget):
    outcome = illum("build", megapixels, "-o", tmp_path / "o.illum", "--max-memory", f"{budget}M",
                    "--planes", 9, "--basis", "learned", timeout=600)
    assert outcome.peak_bytes <= budget * MEBI, f"{outcome.peak_bytes / MEBI:.0f} of {budget} MiB"
    shutil.rmtree(tmp_path / "o.illum", ignore_errors=True)


def test_the_least_budget_is_told_and_is_enough(illum, megapixels, tmp_path):
    """Below it: one sentence with a number, and that number works."""
    sentence = illum.refuses("build", megapixels, "-o", tmp_path / "o.illum", "--max-memory", "1M",
                             leaves=tmp_path)
    words = sentence.replace(",", "").split()
    at = max(i for i, word in enumerate(words) if word.strip(".;)") in ("KiB", "MiB", "GiB"))
    number, unit = float(words[at - 1]), words[at].strip(".;)")
    scale = {"KiB": 1024, "MiB": MEBI, "GiB": 1024 * MEBI}[unit]
    told = number * scale * 1.01 + 1
    outcome = illum("build", megapixels, "-o", tmp_path / "o.illum", "--planes", 9,
                    "--max-memory", int(told), timeout=600)
    assert outcome.code == 0
