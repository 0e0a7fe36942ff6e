"""`illum info` and `illum verify`."""

import json
import shutil
import zipfile

import pytest


def test_info_for_programs(illum, built):
    info = json.loads(illum("info", built, "--json").stdout)
    assert (info["width"], info["height"]) == (72, 56)
    assert info["bytes"] == built.stat().st_size
    assert info["response"] == "display"
    assert (info["version"], info["lights"], info["heldOut"]) == (1, 28, 0)
    for key in ("format", "planes", "coefficients", "basis", "coding", "bits", "curve", "levels",
                "tile", "bitsPerPixel"):
        assert key in info, sorted(info)


def test_info_for_people(illum, built):
    text = illum("info", built).stdout
    for word in ("72", "56", "planes", "coefficients", "display", "lights"):
        assert word in text, text


def test_info_counts_planes_and_coefficients(illum, stack, tmp_path):
    illum("build", stack, "-o", tmp_path / "o.illum", "--basis", "sh", "--coefficients", 9)
    info = json.loads(illum("info", tmp_path / "o.illum", "--json").stdout)
    assert info["planes"] == 27 and info["coefficients"] == 9


def test_held_out_lights_are_told(illum, stack, tmp_path):
    illum("build", stack, "-o", tmp_path / "o.illum", "--holdout", 5)
    info = json.loads(illum("info", tmp_path / "o.illum", "--json").stdout)
    assert (info["lights"], info["heldOut"]) == (28, 5)


def test_verify_sound(illum, built, lossless):
    for file in (built, lossless):
        assert illum("verify", file).stderr == ""


def test_verify_a_folder(illum, stack, tmp_path):
    illum("build", stack, "-o", f"{tmp_path / 'ball'}/")
    illum("verify", tmp_path / "ball")
    (tmp_path / "ball" / "stray.txt").write_text("not of this object")
    outcome = illum("verify", tmp_path / "ball", expect=1)
    assert "stray.txt" in outcome.stdout + outcome.stderr, outcome


def test_the_archive_is_as_the_format_says(built):
    with zipfile.ZipFile(built) as archive:
        names = [entry.filename for entry in archive.infolist()]
        assert {"object.json", "basis.bin", "poster.jpg"} <= set(names), names
        assert archive.testzip() is None
        for entry in archive.infolist():
            may_deflate = entry.filename in ("object.json", "basis.bin")
            assert entry.compress_type == zipfile.ZIP_STORED or may_deflate, entry
        assert len({entry.date_time for entry in archive.infolist()}) == 1, "no clock"
        manifest = json.loads(archive.read("object.json"))
        assert archive.read("poster.jpg")[:2] == b"\xff\xd8"
    assert isinstance(manifest, dict)


def test_unpacked_and_repacked_by_others(illum, built, tmp_path):
    """A person may unzip an object, and the tree may be zipped again without compression."""
    with zipfile.ZipFile(built) as archive:
        archive.extractall(tmp_path / "tree")
    shutil.make_archive(str(tmp_path / "deflated"), "zip", tmp_path / "tree")
    with zipfile.ZipFile(tmp_path / "again.illum", "w", zipfile.ZIP_STORED) as archive:
        for file in sorted((tmp_path / "tree").rglob("*")):
            if file.is_file():
                archive.write(file, file.relative_to(tmp_path / "tree"))
    illum("relight", tmp_path / "again.illum", "--light", "0,0,1", "-o", tmp_path / "o.png")


@pytest.mark.parametrize("command", ["info", "verify"])
def test_a_missing_object(illum, tmp_path, command):
    illum.refuses(command, tmp_path / "nothing.illum", mentions="nothing.illum")
