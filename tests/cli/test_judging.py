"""`illum evaluate` against judge.py, which shares no code with it."""

import html.parser
import json
import subprocess
import sys

import numpy as np
import pytest
from PIL import Image

import judge
import stacks
from conftest import ROOT
from test_light import read_exrs
from test_scenes import write_scene

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


VIEWS = [{"slab": {"viewPoints": [2, 1], "longerSide": 32}},
         {"slab": {"name": "side", "toward": [1, 0.3, 0.5], "viewPoints": [1, 1], "longerSide": 24}}]


@pytest.fixture(scope="module")
def many_views(tmp_path_factory, binary):
    """A scene's capture and an object made of it, with every third light left out."""
    from conftest import Illum
    folder, illum = tmp_path_factory.mktemp("views"), Illum(tmp_path_factory.mktemp("output"))
    scene = write_scene(folder, views=VIEWS, lights={"fibonacci": 9}, meshes=[{"shape": "teapot"}])
    illum("capture", scene, "-o", folder / "truth")
    illum("build", folder / "truth", "-o", folder / "o.illum", "--holdout", 3)
    return folder


def captured(folder, view, lights):
    """The truth of one view over black, linear, under each of so many lights."""
    files = [folder / view["photographs"].format(index=f"{k:04}") for k in range(lights)]
    [mask] = read_exrs([folder / view["mask"]], "Y")
    return [picture * judge.to_bytes(mask) / 255 for picture in read_exrs(files)]


def test_every_view_is_judged_by_that_of_the_same_name(illum, many_views, tmp_path):
    built, truth = many_views / "o.illum", many_views / "truth"
    ours = json.loads(illum("evaluate", built, "--against", truth, "--json").stdout)
    capture = json.loads((truth / "capture.json").read_text())
    assert [v["name"] for v in ours["views"]] == [v["name"] for v in capture["views"]]
    stacks.write_light_file(tmp_path, [l["name"] for l in ours["lights"]],
                            [l["direction"] for l in ours["lights"]])
    everything = []
    for view, mine in zip(capture["views"], ours["views"]):
        relit, figures = tmp_path / mine["name"], []
        illum("relight", built, "--view", mine["name"], "--lights", tmp_path / "lights.lp", "-o",
              relit)
        for light, seen in zip(mine["lights"], captured(truth, view, 9)):
            picture = judge.read_relit(relit / f"{light['name']}.png")
            figures.append((judge.psnr(picture, judge.encode(seen)),
                            judge.ssim(picture, judge.encode(seen))))
            assert light["psnr"] == pytest.approx(figures[-1][0], abs=0.02)
            assert light["ssim"] == pytest.approx(figures[-1][1], abs=1e-3)
        everything.append(figures)
        assert mine["heldOut"]["psnr"] == pytest.approx(
            np.mean([f[0] for f in figures[2::3]]), abs=0.02)
    assert [l["name"] for l in mine["lights"]] == [l["name"] for l in ours["lights"]]
    mean = np.array(everything)[..., 0].mean(axis=0)
    assert [l["psnr"] for l in ours["lights"]] == pytest.approx(list(mean), abs=0.02)
    assert ours["heldOut"]["psnr"] == pytest.approx(mean[2::3].mean(), abs=0.02)
    assert (ours["used"]["lights"], ours["heldOut"]["lights"]) == (6, 3)
    pixels = sum(v["size"][0] * v["size"][1] for v in ours["views"])
    assert ours["bitsPerPixel"] == pytest.approx(8 * built.stat().st_size / pixels)


def test_many_views_on_the_terminal_and_in_the_report(illum, many_views, tmp_path):
    outcome = illum("evaluate", many_views / "o.illum", "--against", many_views / "truth", "--html",
                    tmp_path / "r.html")
    assert "mean of 3 views" in outcome.stdout and "worst pictures" in outcome.stdout
    page, text = Page(), (tmp_path / "r.html").read_text()
    page.feed(text)
    assert page.open == [] and page.pictures == 18
    figures = json.loads(illum("evaluate", many_views / "o.illum", "--against",
                               many_views / "truth", "--json").stdout)
    worst = min((light["psnr"], light["name"], view["name"])
                for view in figures["views"] for light in view["lights"])
    first = outcome.stdout.split("worst pictures\n")[1].splitlines()[0]
    assert first.split()[0] == worst[1] and first.endswith(f"in {worst[2]}")
    assert text.index(f"<b>{worst[1]}</b><span>view {worst[2]}</span>") < text.index("Best pictures")


def test_a_scene_judges_as_its_capture_does(illum, many_views):
    by_scene, by_capture = (
        json.loads(illum("evaluate", many_views / "o.illum", "--against", many_views / name,
                         "--json", "--max-memory", "200M").stdout)
        for name in ("scene.json", "truth"))
    assert by_scene == by_capture


@pytest.mark.parametrize("fault, mentions", [
    ({"views": [*VIEWS, {"slab": {"name": "back", "toward": [-1, 0, 0], "viewPoints": [1, 1],
                                  "longerSide": 24}}]}, "back_u00_v00"),
    ({"views": [{"slab": {"viewPoints": [2, 1], "longerSide": 33}}]}, "33x"),
    ({"views": [{"slab": {"viewPoints": [2, 2], "longerSide": 32}}]}, "elsewhere"),
    ({"views": [{"photograph": {"size": [32, 20]}}]}, "o.illum"),
], ids=["a view that it lacks", "another size", "another grid", "a photograph"])
def test_views_that_cannot_be_judged(illum, many_views, tmp_path, fault, mentions):
    scene = write_scene(tmp_path, meshes=[{"shape": "teapot"}], **fault)
    illum.refuses("evaluate", many_views / "o.illum", "--against", scene, "--html",
                  tmp_path / "r.html", mentions=["o.illum", mentions], leaves=tmp_path)
