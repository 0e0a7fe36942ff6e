"""Objects of many views: seen from view points and between them, through cameras anywhere."""

import json

import numpy as np
import pytest

import balls
import stacks
from conftest import Illum

LIGHT = (0.4, 0.3, 0.85)
LIT = ("--light", "0.4,0.3,0.85")


def build(tmp_path_factory, name, **capture):
    folder = tmp_path_factory.mktemp(name)
    balls.write_capture(folder / "capture", **capture)
    Illum(folder)("build", folder / "capture", "-o", folder / "o.illum")
    return folder / "o.illum"


@pytest.fixture(scope="module")
def slab(tmp_path_factory, binary):
    return build(tmp_path_factory, "slab", slabs=[balls.Slab()])


CAMERAS = [(f"camera {k}", balls.Camera.looking((x, 0.3, 3))) for k, x in enumerate((-1, 0, 1.2))]


@pytest.fixture(scope="module")
def poses(tmp_path_factory, binary):
    return build(tmp_path_factory, "poses", cameras=CAMERAS)


def see(illum, built, tmp_path, *options, lights=LIT):
    out = tmp_path / "seen.png"
    illum("relight", built, *lights, *options, "-o", out)
    return stacks.read_picture(out)


@pytest.mark.parametrize("u, v", [(0, 0), (1, 0), (0, 1), (0.5, 0.5)])
def test_views_of_a_slab(illum, slab, tmp_path, u, v):
    picture = see(illum, slab, tmp_path, "--view", f"{u},{v}")
    assert balls.likeness(picture, balls.Slab().camera(u, v), LIGHT) > 34


def test_without_a_view_the_middle_one(illum, slab, poses, tmp_path):
    assert np.array_equal(see(illum, slab, tmp_path),
                          see(illum, slab, tmp_path, "--view", "0.5,0.5"))
    assert np.array_equal(see(illum, poses, tmp_path),
                          see(illum, poses, tmp_path, "--view", "camera 1"))


def test_views_between_are_near_to_what_would_be_seen(illum, slab, tmp_path):
    between, nearest = (see(illum, slab, tmp_path, "--view", view)
                        for view in ("0.25,0.25", "0.5,0.5"))
    truth = balls.Slab().camera(0.25, 0.25)
    assert balls.likeness(between, truth, LIGHT) > 22
    assert balls.likeness(between, truth, LIGHT) > balls.likeness(nearest, truth, LIGHT) + 3


def test_poses_by_their_names(illum, poses, tmp_path):
    for name, camera in CAMERAS:
        picture = see(illum, poses, tmp_path, "--view", name)
        assert balls.likeness(picture, camera, LIGHT) > 34, name


def test_a_camera_at_a_view_point_sees_that_view(illum, slab, tmp_path):
    camera = {"kind": "camera", "camera": balls.Slab().camera(0.5, 0).record()}
    (tmp_path / "c.json").write_text(json.dumps(camera))
    through = see(illum, slab, tmp_path, "--camera", tmp_path / "c.json").astype(int)
    stored = see(illum, slab, tmp_path, "--view", "0.5,0").astype(int)
    assert np.abs(balls.over_black(through) - balls.over_black(stored)).max() <= 1


@pytest.mark.parametrize("z", [2.2, 4.0], ids=["before", "behind"])
def test_a_camera_before_and_behind_the_plane_of_view_points(illum, slab, tmp_path, z):
    picture = see(illum, slab, tmp_path, "--camera", f"0.1,0.2,{z},0,0,0,30", "--size", "50x40")
    assert picture.shape == (40, 50, 4)
    camera = balls.Camera.looking((0.1, 0.2, z), degrees=30, width=50, height=40)
    assert balls.likeness(picture, camera, LIGHT) > 20


def test_nothing_is_shown_where_no_view_looked(illum, slab, tmp_path):
    assert see(illum, slab, tmp_path, "--camera", "0,0,-4,0,0,0").max() == 0
    assert see(illum, slab, tmp_path, "--camera", "3,0,2,0,0,0").max() == 0


def test_a_camera_between_poses(illum, poses, tmp_path):
    picture = see(illum, poses, tmp_path, "--camera", "0.5,0.3,3,0,0,0")
    assert picture.shape == (40, 48, 4), "as large as the views are"
    assert balls.likeness(picture, balls.Camera.looking((0.5, 0.3, 3)), LIGHT) > 20
    one = see(illum, poses, tmp_path, "--camera", "0.5,0.3,3,0,0,0", "--blend", "1")
    assert not np.array_equal(picture, one)


def test_up_turns_the_picture(illum, slab, tmp_path):
    upright, turned = (see(illum, slab, tmp_path, "--camera", "0,0,3,0,0,0", "--size", "40x40",
                           *up) for up in ((), ("--up", "1,0,0")))
    difference = np.abs(balls.over_black(np.rot90(upright)) - balls.over_black(turned))
    assert difference.max() <= 2


def test_an_aperture_blurs_what_is_out_of_focus(illum, slab, tmp_path):
    def middle(*options):
        return balls.over_black(see(illum, slab, tmp_path, *options))[10:26, 14:30]

    stored = middle()
    focused = stacks.psnr(middle("--aperture", "0.9", "--focus", "0.65"), stored)
    missed = stacks.psnr(middle("--aperture", "0.9", "--focus", "-1.5"), stored)
    assert focused > missed + 6
    assert stacks.psnr(middle("--focus", "0.65"), stored) > focused


OTHER_LIGHTS = {
    "point": ("--point", "1,1,2,3,3,3"),
    "spot": ("--spot", "1,1,2,0,0,0,40,3,3,3"),
    "sky": ("--sky", "clear,1,1,1"),
    "lighting": ("--lighting", "setup.json"),
}


@pytest.mark.parametrize("kind", OTHER_LIGHTS)
@pytest.mark.parametrize("response", ["display", "linear"])
def test_every_kind_of_light_between_views(illum, tmp_path_factory, tmp_path, kind, response):
    """Far between the views of one slab, whose window every view shows alike."""
    built = tmp_path_factory.getbasetemp() / f"{response}.illum"
    if not built.exists():
        folder = tmp_path / "capture"
        balls.write_capture(folder, slabs=[balls.Slab(count=2, width=24, height=20)])
        illum("build", folder, "-o", built, "--response", response)
    lighting = {"lighting": 1, "lights": [
        {"kind": "directional", "direction": [0, 0.3, 1]},
        {"kind": "sphere", "centre": [1, 0, 2], "radius": 0.2, "intensity": 2, "samples": 8}]}
    (tmp_path / "setup.json").write_text(json.dumps(lighting))
    options = ("relight", built, *OTHER_LIGHTS[kind], "-o", "o.exr")
    illum(*options, "--view", "0,0", cwd=tmp_path)
    stored = exr(tmp_path / "o.exr")
    camera = {"kind": "camera", "camera": balls.Slab(width=24, height=20).camera(0, 0).record()}
    (tmp_path / "c.json").write_text(json.dumps(camera))
    illum(*options, "--camera", "c.json", cwd=tmp_path)
    assert stored.max() > 0.1
    np.testing.assert_allclose(exr(tmp_path / "o.exr"), stored, atol=1e-5, rtol=1e-4)


def exr(file):
    from test_light import read_exr
    return read_exr(file)


def test_many_lights_of_a_view_between(illum, slab, tmp_path):
    stacks.write_light_file(tmp_path, ["a.jpg", "b.jpg"], [LIGHT, (-1, 0, 0.5)])
    illum("relight", slab, "--lights", tmp_path / "lights.lp", "--view", "0.3,0.6", "-o",
          tmp_path / "all")
    assert sorted(p.name for p in (tmp_path / "all").iterdir()) == ["a.png", "b.png"]
    assert np.array_equal(stacks.read_picture(tmp_path / "all/a.png"),
                          see(illum, slab, tmp_path, "--view", "0.3,0.6"))


HOSTILE_OPTIONS = [
    (("--view", "2,0"), "from 0 to 1"),
    (("--view", "back:0,0"), "front"),
    (("--view", "camera 9"), "front"),
    (("--camera", "1,2,3"), "ex,ey,ez"),
    (("--camera", "0,0,3,0,0,0,40,1"), "ex,ey,ez"),
    (("--camera", "0,0,nan,0,0,0"), "ex,ey,ez"),
    (("--camera", "0,0,3,0,0,3"), "--camera"),
    (("--camera", "0,3,0,0,0,0"), "--camera"),
    (("--camera", "0,0,3,0,0,0,180"), "field of view"),
    (("--camera", "0,0,3,0,0,0", "--size", "0x5"), "--size"),
    (("--camera", "0,0,3,0,0,0", "--size", "10x10x10"), "--size"),
    (("--camera", "0,0,3,0,0,0", "--view", "0,0"), "--view"),
    (("--camera", "0,0,3,0,0,0", "--level", "1"), "--level"),
    (("--camera", "0,0,3,0,0,0", "--size", "60000x60000"), "--max-memory"),
    (("--size", "10x10"), "--camera"),
    (("--blend", "3"), "--blend"),
    (("--aperture", "-1", "--focus", "0"), "aperture"),
]


@pytest.mark.parametrize("options, word", HOSTILE_OPTIONS, ids=lambda o: " ".join(o)
                         if isinstance(o, tuple) else "")
def test_options_that_mean_nothing(illum, slab, tmp_path, options, word):
    illum.refuses("relight", slab, *LIT, *options, "-o", tmp_path / "o.png", code=2,
                  mentions=word, leaves=tmp_path)


HOSTILE_CAMERAS = {
    "no file": None,
    "no JSON": "{",
    "a list": "[]",
    "no kind": "{}",
    "an unknown field": '{"kind": "look", "eye": [0,0,3], "target": [0,0,0], "fov": 3}',
    "a photograph": '{"kind": "photograph", "size": {"width": 3, "height": 3}}',
    "an eye in its target": '{"kind": "look", "eye": [0,0,3], "target": [0,0,3]}',
    "a number that is none": '{"kind": "look", "eye": [0,0,1e999], "target": [0,0,0]}',
    "no size": '{"kind": "camera", "camera": {"focalX": 3}}',
    "deep": "[" * 100000,
}


@pytest.mark.parametrize("name", HOSTILE_CAMERAS)
def test_camera_files_that_are_none(illum, slab, tmp_path, name):
    file = tmp_path / "camera.json"
    if HOSTILE_CAMERAS[name] is not None:
        file.write_text(HOSTILE_CAMERAS[name])
    illum.refuses("relight", slab, *LIT, "--camera", file, "-o", tmp_path / "o.png", code=1,
                  mentions="camera.json", leaves=tmp_path)


def test_a_photograph_has_one_view(illum, built, tmp_path):
    illum.refuses("relight", built, *LIT, "--view", "0,0", "-o", tmp_path / "o.png", code=2,
                  mentions="photograph", leaves=tmp_path)


def frames(folder):
    return sorted(p.name for p in folder.iterdir())


def test_an_orbit_begins_at_the_middle_view(illum, slab, tmp_path):
    illum("relight", slab, *LIT, "--path", "orbit", "--arc", "20", "--frames", "3", "-o",
          tmp_path / "film")
    assert frames(tmp_path / "film") == [f"frame_0000{k}.png" for k in range(3)]
    pictures = [stacks.read_picture(tmp_path / "film" / name)
                for name in frames(tmp_path / "film")]
    stored = see(illum, slab, tmp_path)
    assert np.abs(balls.over_black(pictures[1]) - balls.over_black(stored)).max() <= 1
    for picture, degrees in zip(pictures, (-10, 0, 10)):
        a = np.radians(degrees)
        eye = 3 * np.array([np.sin(a), 0, np.cos(a)])
        camera = balls.Camera.looking(eye, width=44, height=36,
                                      degrees=2 * np.degrees(np.arctan(0.9 / 3)))
        assert balls.likeness(picture, camera, LIGHT) > 20


def test_an_orbit_says_where_nothing_is_seen(illum, slab, tmp_path):
    outcome = illum("relight", slab, *LIT, "--path", "orbit", "--frames", "4", "-o",
                    tmp_path / "film")
    assert "3 of 4 pictures show nothing, frame_00001" in outcome.stderr
    assert len(frames(tmp_path / "film")) == 4


def test_an_orbit_of_a_camera_at_another_elevation(illum, poses, tmp_path):
    options = ("--camera", "0,0,3,0,0,0", "--size", "30x20", "--path", "orbit", "--elevation",
               "5.7105931375", "--frames", "1")
    illum("relight", poses, *LIT, *options, "-o", tmp_path / "film")
    picture = stacks.read_picture(tmp_path / "film/frame_00000.png")
    eye = np.array([0, 0.0995037190, 0.9950371902]) * 3
    assert picture.shape == (20, 30, 4)
    assert balls.likeness(picture, balls.Camera.looking(eye, width=30, height=20), LIGHT) > 20


def test_a_path_goes_through_its_cameras(illum, slab, tmp_path):
    looks = [{"kind": "look", "eye": [x, 0.1, 3], "target": [0, 0, 0]} for x in (-0.5, 0.5)]
    (tmp_path / "path.json").write_text(json.dumps({"path": 1, "frames": 3, "cameras": looks}))
    illum("relight", slab, *LIT, "--path", tmp_path / "path.json", "--format", "jpg", "-o",
          tmp_path / "film")
    assert frames(tmp_path / "film") == [f"frame_0000{k}.jpg" for k in range(3)]
    illum("relight", slab, *LIT, "--path", tmp_path / "path.json", "-o", tmp_path / "film",
          "--force", "--frames", "5")
    assert len(frames(tmp_path / "film")) == 3 + 5
    for k, eye in ((0, "-0.5,0.1,3"), (2, "0,0.1,3"), (4, "0.5,0.1,3")):
        alone = see(illum, slab, tmp_path, "--camera", f"{eye},0,0,0")
        assert np.array_equal(alone, stacks.read_picture(tmp_path / f"film/frame_0000{k}.png"))


def test_a_path_of_full_cameras(illum, slab, tmp_path):
    records = [{"kind": "camera", "camera": balls.Slab().camera(u, 0.5).record()} for u in (0, 1)]
    (tmp_path / "path.json").write_text(json.dumps({"path": 1, "cameras": records}))
    illum("relight", slab, *LIT, "--path", tmp_path / "path.json", "-o", tmp_path / "film")
    for k, view in enumerate(("0,0.5", "1,0.5")):
        stored = balls.over_black(see(illum, slab, tmp_path, "--view", view))
        film = balls.over_black(stacks.read_picture(tmp_path / f"film/frame_0000{k}.png"))
        assert np.abs(stored - film).max() <= 1


def test_an_orbit_round_a_photograph_shows_a_card(illum, built, tmp_path):
    illum("relight", built, *LIT, "--path", "orbit", "--arc", "100", "--frames", "3", "-o",
          tmp_path / "film")
    left, front, right = (stacks.read_picture(tmp_path / f"film/frame_0000{k}.png")
                          for k in range(3))
    assert front[..., 3].mean() > 250
    assert 0.4 < left[..., 3].mean() / front[..., 3].mean() < 0.9
    assert np.abs(front[5:-5, 5:-5, :3].astype(int) -
                  see(illum, built, tmp_path)[5:-5, 5:-5].astype(int)).max() <= 2


HOSTILE_PATHS = {
    "no file": (None, "path.json"),
    "no JSON": ("{", "byte"),
    "no cameras": ('{"path": 1, "cameras": []}', "cameras"),
    "a newer one": ('{"path": 2, "cameras": [{}]}', "'path'"),
    "an unknown kind": ('{"path": 1, "cameras": [{"kind": "lock"}]}', "cameras[0].kind"),
    "through its target": ('{"path": 1, "frames": 3, "cameras": ['
                           '{"kind": "look", "eye": [0,0,1], "target": [0,0,0]},'
                           '{"kind": "look", "eye": [0,0,-1], "target": [0,0,0]}]}', "frame 1"),
    "too many frames": ('{"path": 1, "frames": 1000000000, "cameras": ['
                        '{"kind": "look", "eye": [0,0,1], "target": [0,0,0]}]}', "frames"),
}


@pytest.mark.parametrize("name", HOSTILE_PATHS)
def test_path_files_that_are_none(illum, slab, tmp_path, name):
    text, word = HOSTILE_PATHS[name]
    file = tmp_path / "path.json"
    if text is not None:
        file.write_text(text)
    sentence = illum.refuses("relight", slab, *LIT, "--path", file, "-o", tmp_path / "film",
                             code=1, mentions=word, leaves=tmp_path)
    assert "frame 1" in sentence or "path.json" in sentence


@pytest.mark.parametrize("options, word", [
    (("--path", "orbits"), "--path"),
    (("--path", "orbit", "--frames", "0"), "frames"),
    (("--path", "orbit", "--arc", "400"), "arc"),
    (("--path", "orbit", "--elevation", "90"), "elevation"),
    (("--path", "orbit", "--camera", "0,3,0,0,0,0", "--up", "0,0,1", "--elevation", "nan"),
     "elevation"),
    (("--path", "orbit", "--level", "1"), "--level"),
    (("--path", "orbit", "--format", "gif"), "--format"),
    (("--frames", "3"), "--path"),
], ids=lambda o: " ".join(o) if isinstance(o, tuple) else "")
def test_path_options_that_mean_nothing(illum, slab, tmp_path, options, word):
    illum.refuses("relight", slab, *LIT, *options, "-o", tmp_path / "film", code=2,
                  mentions=word, leaves=tmp_path)


def test_a_film_does_not_replace_other_files(illum, slab, tmp_path):
    (tmp_path / "film").mkdir()
    (tmp_path / "film/mine.txt").write_text("mine")
    illum.refuses("relight", slab, *LIT, "--path", "orbit", "-o", tmp_path / "film", code=1,
                  mentions="--force", leaves=tmp_path)


def test_converting_without_changes_gives_the_same_bytes(illum, slab, tmp_path):
    illum("convert", slab, f"{tmp_path}/folder/")
    illum("convert", tmp_path / "folder", tmp_path / "again.illum")
    assert (tmp_path / "again.illum").read_bytes() == slab.read_bytes()


def test_another_grid_of_view_points(illum, slab, tmp_path):
    finer = tmp_path / "finer.illum"
    illum("convert", slab, finer, "--uv", "5x5")
    illum("verify", finer)
    made, between = (see(illum, built, tmp_path, "--view", "0.25,0.75").astype(float)
                     for built in (finer, slab))
    assert stacks.psnr(balls.over_black(made), balls.over_black(between)) > 30
    kept, stored = (see(illum, built, tmp_path, "--view", "1,0.5") for built in (finer, slab))
    assert np.array_equal(kept, stored)


def test_conversions_that_cannot_be(illum, slab, poses, tmp_path):
    illum.refuses("convert", slab, tmp_path / "o.illum", "--uv", "0x3", code=2, mentions="--uv",
                  leaves=tmp_path)
    illum.refuses("convert", poses, tmp_path / "o.illum", "--uv", "3x3", code=1,
                  mentions="slabs", leaves=tmp_path)
