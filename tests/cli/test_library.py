"""The programs of docs/examples, compiled beside the tool: what people write against the library."""

import os
import pathlib
import subprocess

import numpy as np
import pytest

import balls
import stacks
from conftest import BINARY, Illum

# BUILD/tools/illum/illum and BUILD/docs/examples.
EXAMPLES = pathlib.Path(os.environ.get("ILLUM_EXAMPLES", BINARY.parents[2] / "docs/examples"))


def run(program, *arguments, code=0):
    done = subprocess.run([EXAMPLES / program, *map(str, arguments)], capture_output=True,
                          text=True, timeout=300)
    assert done.returncode == code, done.stderr
    return done.stderr


def test_relight_a_photograph(built, tmp_path):
    run("relight_photograph", built, tmp_path / "lit.png")
    picture = stacks.read_picture(tmp_path / "lit.png").astype(float)
    assert picture.shape == (stacks.HEIGHT, stacks.WIDTH, 3)
    expected = (stacks.render((-1, 0.5, 1)) * (1.0, 0.8, 0.6)
                + stacks.render((1, 0.5, 1)) * (0.1, 0.15, 0.2))
    assert stacks.psnr(picture, stacks.display_bytes(expected)) > 24


@pytest.fixture(scope="module")
def slab(tmp_path_factory, binary):
    folder = tmp_path_factory.mktemp("slab")
    balls.write_capture(folder / "capture", slabs=[balls.Slab()], depth=True)
    Illum(folder)("build", folder / "capture", "-o", folder / "o.illum")
    return folder / "o.illum"


def test_fly_around_a_slab(slab, tmp_path):
    run("fly_around_slab", slab, tmp_path)
    assert sorted(file.name for file in tmp_path.iterdir()) == [f"{i}.png" for i in range(8)]
    for frame in range(8):
        x, y = np.cos(0.785 * frame), np.sin(0.785 * frame)
        eye = (2 * 0.9 * 0.3 * x, 2 * 0.9 * 0.3 * y, 3)
        truth = balls.Camera.looking(eye, degrees=40, width=320, height=240)
        picture = stacks.read_picture(tmp_path / f"{frame}.png")
        assert picture.shape == (240, 320, 4)
        assert balls.likeness(picture, truth, (-x, -y, 1)) > 20, frame


def centre_of_light(picture):
    """Column and row, as shares of the picture."""
    light = picture.astype(float).sum(axis=2)
    rows, columns = np.mgrid[:light.shape[0], :light.shape[1]] / np.array(light.shape)[:, None, None]
    return (columns * light).sum() / light.sum(), (rows * light).sum() / light.sum()


def write_panorama(folder, column):
    """Dark but for a bright spot at the horizon in this column of 32."""
    values = np.full((16, 32), 0.02)
    values[6:10, column - 1:column + 2] = 40
    balls.write_exr(folder / "around.exr", values)
    return folder / "around.exr"


def test_light_with_a_panorama(built, tmp_path):
    """The example turns it by 90 degrees: light from -z then comes from a side, and moves it."""
    centres = []
    for name, column in (("ahead", 16), ("behind", 1)):
        folder = tmp_path / name
        folder.mkdir()
        run("light_with_panorama", built, write_panorama(folder, column), folder / "lit.png")
        picture = stacks.read_picture(folder / "lit.png")
        assert picture.shape == (stacks.HEIGHT, stacks.WIDTH, 3) and picture.mean() > 5
        centres.append(centre_of_light(picture)[0])
    # Turned about y by 90 degrees, -z goes to -x and +z to +x.
    assert centres[0] < centres[1] - 0.02


@pytest.mark.parametrize("program, more", [("relight_photograph", []), ("fly_around_slab", []),
                                           ("light_with_panorama", ["o.png"])])
def test_a_missing_object_is_a_sentence(program, more, tmp_path):
    sentence = run(program, tmp_path / "nothing.illum", tmp_path / "o", *more, code=1)
    assert "nothing.illum" in sentence and sentence.count("\n") == 1
    run(program, code=2)
