"""--max-memory is kept, whatever the number, size and kind of the photographs."""

import os
import re
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


@pytest.mark.parametrize("budget", [512, 768])
def test_resident_memory(illum, megapixels, tmp_path, budget):
    outcome = illum("build", megapixels, "-o", tmp_path / "o.illum", "--max-memory", f"{budget}M",
                    "--planes", 9, "--basis", "learned", timeout=600)
    assert outcome.peak_bytes <= budget * MEBI, f"{outcome.peak_bytes / MEBI:.0f} of {budget} MiB"
    shutil.rmtree(tmp_path / "o.illum", ignore_errors=True)


def told_bytes(sentence):
    """The least budget that a refusal names, rounded up as it was rounded for reading."""
    number, unit = re.search(r"at least ([\d.]+) (KiB|MiB|GiB)", sentence).groups()
    return int((float(number) + 0.1) * {"KiB": 1024, "MiB": MEBI, "GiB": 1024 * MEBI}[unit])


def test_the_least_budget_is_told_and_is_enough(illum, megapixels, tmp_path):
    """Whoever follows the number arrives, at the latest after a second thing turns out too large."""
    budget = MEBI
    for _ in range(3):
        outcome = illum("build", megapixels, "-o", tmp_path / "o.illum", "--planes", 9,
                        "--max-memory", budget, expect=None, timeout=600)
        if outcome.code == 0:
            return
        assert not (tmp_path / "o.illum").exists(), outcome
        assert told_bytes(outcome.stderr) > budget, outcome
        budget = told_bytes(outcome.stderr)
    raise AssertionError(f"still refused: {outcome}")
