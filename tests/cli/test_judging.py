"""`illum evaluate` against judge.py, which shares no code with it."""

import html.parser
import json
import subprocess
import sys

import numpy as np
import pytest
from PIL import Image

import stacks
from conftest import ROOT

JUDGE = ROOT / "tests/cli/judge.py"


def judged(relit, photographs, *options):
    run = subprocess.run([sys.executable, JUDGE, relit, photographs, "--json", "--ssim", *options],
                         capture_output=True, text=True, check=True)
    return json.loads(run.stdout)


def assert_agrees(illum, built, photographs, tmp_path, holdout=0, *options):
    illum("relight", built, "--lights", photographs / "lights.lp", "-o", tmp_path / "relit")
    theirs = judged(tmp_path / "relit", photographs, "--holdout", str(holdout), *options)
    ours = json.loads(illum("evaluate", built, "--against", photographs, "--json").stdout)
    assert [l["name"] for l in ours["lights"]] == [l["name"] for l in theirs["lights"]]
    for mine, yours in zip(ours["lights"], theirs["lights"]):
        assert mine["heldOut"] == yours["heldOut"], mine["name"]
        assert mine["psnr"] == pytest.approx(yours["psnr"], abs=0.01), mine["name"]
        assert mine["ssim"] == pytest.approx(yours["ssim"], abs=1e-3), mine["name"]
    for part in ("used", "heldOut"):
        assert ours[part]["lights"] == theirs[part]["lights"]
        if ours[part]["lights"]:
            assert ours[part]["psnr"] == pytest.approx(theirs[part]["psnr"], abs=0.01)
    return ours


@pytest.mark.parametrize("holdout", [0, 5])
def test_agrees_with_an_independent_program(illum, stack, tmp_path, holdout):
    illum("build", stack, "-o", tmp_path / "o.illum", "--holdout", holdout)
    ours = assert_agrees(illum, tmp_path / "o.illum", stack, tmp_path, holdout)
    assert ours["bytes"] == (tmp_path / "o.illum").stat().st_size
    assert ours["used"]["psnr"] > 28


def test_agrees_with_a_mask(illum, own_stack, tmp_path):
    x, y = stacks.grid(stacks.WIDTH, stacks.HEIGHT)
    alpha = ((x * x + y * y < 0.5) * 255).astype(np.uint8)
    for file in own_stack.glob("*.png"):
        Image.fromarray(np.dstack([stacks.read_picture(file), alpha])).save(file)
    illum("build", own_stack, "-o", tmp_path / "o.illum", "--holdout", 5)
    ours = assert_agrees(illum, tmp_path / "o.illum", own_stack, tmp_path, 5)
    assert ours["mask"] and ours["used"]["masked"]["psnr"] < ours["used"]["psnr"]


def test_held_out_is_worse_than_used(illum, stack, tmp_path):
    illum("build", stack, "-o", tmp_path / "o.illum", "--holdout", 4)
    figures = json.loads(
        illum("evaluate", tmp_path / "o.illum", "--against", stack, "--json").stdout)
    assert (figures["used"]["lights"], figures["heldOut"]["lights"]) == (21, 7)
    assert figures["heldOut"]["psnr"] < figures["used"]["psnr"]


def test_a_table_for_people(illum, built, stack):
    text = illum("evaluate", built, "--against", stack).stdout
    assert "PSNR" in text and "used" in text and str(built.stat().st_size) in text, text


class Page(html.parser.HTMLParser):
    """Collects what the page refers to and whether its tags match."""

    VOID = {"meta", "img", "br", "hr", "input", "link", "circle", "line", "path", "rect"}

    def __init__(self):
        super().__init__()
        self.open, self.sources, self.pictures = [], [], 0

    def handle_starttag(self, tag, attributes):
        if tag not in self.VOID:
            self.open.append(tag)
        self.pictures += tag == "img"
        self.sources += [value for name, value in attributes if name in ("src", "href")]

    def handle_startendtag(self, tag, attributes):
        self.sources += [value for name, value in attributes if name in ("src", "href")]
        self.pictures += tag == "img"

    def handle_endtag(self, tag):
        if tag not in self.VOID:
            assert self.open.pop() == tag


def test_the_report_is_one_file(illum, stack, tmp_path):
    illum("build", stack, "-o", tmp_path / "o.illum", "--holdout", 5)
    illum("evaluate", tmp_path / "o.illum", "--against", stack, "--html", tmp_path / "r.html")
    text = (tmp_path / "r.html").read_text()
    page = Page()
    page.feed(text)
    assert page.open == []
    assert page.pictures >= 6
    assert all(s.startswith(("data:", "#")) for s in page.sources), "nothing from elsewhere"
    assert "<svg" in text, "the dome of light directions"


def test_photographs_of_another_size(illum, built, own_stack):
    for file in own_stack.glob("*.png"):
        Image.open(file).resize((36, 28)).save(file)
    illum.refuses("evaluate", built, "--against", own_stack, mentions=["72", "36"])


def test_the_same_crop_is_judged(illum, stack, tmp_path):
    options = ["--crop", "10,6,40,40"]
    illum("build", stack, "-o", tmp_path / "o.illum", *options)
    figures = json.loads(illum("evaluate", tmp_path / "o.illum", "--against", stack, *options,
                               "--json").stdout)
    assert figures["used"]["psnr"] > 27
