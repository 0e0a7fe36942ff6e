"""The manual's examples are run, in order, beside photographs/ and an object medal.illum.

An example is a ```sh block, or an indented line that begins with `illum`.
"""

import os
import re
import shutil
import subprocess

import pytest

from conftest import BINARY, ROOT

PAGES = sorted([*ROOT.glob("docs/guide/*.md"), ROOT / "README.md"])


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_examples(stack, built, tmp_path, page):
    found = re.findall(r"^```sh\n(.*?)^```$|^    (illum [^|\n]+)", page.read_text(),
                       re.MULTILINE | re.DOTALL)
    blocks = [block or line for block, line in found]
    assert blocks, "a page without an example"
    shutil.copytree(stack, tmp_path / "photographs")
    shutil.copy(built, tmp_path / "medal.illum")
    (tmp_path / "bin").mkdir()
    (tmp_path / "bin" / "illum").symlink_to(BINARY)
    environment = {**os.environ, "PATH": f"{tmp_path / 'bin'}:/usr/bin:{os.environ['PATH']}"}
    for block in blocks:
        run = subprocess.run(["bash", "-euo", "pipefail", "-c", block], cwd=tmp_path,
                             env=environment, capture_output=True, text=True, timeout=300)
        assert run.returncode == 0, f"{block}\n{run.stdout}\n{run.stderr}"


def links_of(page):
    text = re.sub(r"^```.*?^```$", "", page.read_text(), flags=re.MULTILINE | re.DOTALL)
    return re.findall(r"\]\(([^)#\s]+)", text)


@pytest.mark.parametrize("page", sorted([*ROOT.glob("*.md"), *ROOT.glob("docs/**/*.md")]),
                         ids=lambda page: page.name)
def test_links_lead_somewhere(page):
    for link in links_of(page):
        if "://" not in link:
            assert (page.parent / link).exists(), link


def test_every_option_is_in_the_manual(binary):
    """What `--help` offers is explained on some page."""
    manual = "".join(page.read_text() for page in PAGES)
    for command in ("build", "capture", "convert", "evaluate", "info", "normals", "relight", "verify"):
        text = subprocess.run([binary, command, "--help"], capture_output=True, text=True).stdout
        for option in set(re.findall(r"--[a-z][a-z-]+", text)) - {"--help", "--output"}:
            assert option in manual, f"illum {command} {option}"


def test_the_architecture_names_files_that_are_there():
    text = (ROOT / "docs/architecture.md").read_text()
    modules = {folder.name for folder in (ROOT / "src").iterdir() if folder.is_dir()}
    named = [name for name in re.findall(r"`([a-z_]+/[a-z_]+)`", text)
             if name.split("/")[0] in modules]
    assert len(named) > 20
    for name in named:
        assert list((ROOT / "src").glob(f"{name}*")), name
