"""OpenImageIO's libraries are loaded where a picture needs them and nowhere else."""

import os
import subprocess

import pytest

import stacks
from conftest import BINARY, listing

COMMON = [".jpg", ".png", ".webp"]
OTHERS = [".tif", ".bmp", ".ppm", ".tga"]


def loaded_by(illum, tmp_path, *arguments):
    """What the loader (ld.so) tells of the libraries of a run that succeeds."""
    illum(*arguments, env={**os.environ, "LD_DEBUG": "files",
                           "LD_DEBUG_OUTPUT": str(tmp_path / "loaded")})
    return "".join(file.read_text(errors="replace") for file in tmp_path.glob("loaded.*"))


def stack_of(tmp_path, suffix):
    stacks.write_stack(tmp_path / "p", count=9, suffix=suffix)
    return ["build", tmp_path / "p", "-o", tmp_path / "o.illum"]


def test_the_program_itself_links_few_libraries():
    libraries = subprocess.run(["ldd", BINARY], capture_output=True, text=True, check=True).stdout
    assert "OpenImageIO" not in libraries and len(libraries.splitlines()) < 80, libraries


@pytest.mark.parametrize("suffix", COMMON)
def test_common_formats_load_no_openimageio(illum, tmp_path, suffix):
    loaded = loaded_by(illum, tmp_path, *stack_of(tmp_path, suffix))
    assert "libfmt" in loaded
    assert "illum_oiio.so" not in loaded and "OpenImageIO" not in loaded


def test_scenes_and_objects_load_no_openimageio(illum, tmp_path):
    loaded = loaded_by(illum, tmp_path, "build", "builtin:box", "--uv", "2x2", "--size", 32,
                       "--light-count", 9, "--samples", 1, "-o", tmp_path / "o.illum")
    loaded += loaded_by(illum, tmp_path, "relight", tmp_path / "o.illum", "--light", "0,0,1",
                        "-o", tmp_path / "o.exr")
    assert "libfmt" in loaded and "OpenImageIO" not in loaded


def test_a_tiff_loads_it(illum, tmp_path):
    loaded = loaded_by(illum, tmp_path, *stack_of(tmp_path, ".tif"))
    assert "illum_oiio.so" in loaded and "OpenImageIO" in loaded


@pytest.fixture
def without_module(tmp_path):
    """An environment in which the module is found first where it is none."""
    folder = tmp_path / "libraries"
    folder.mkdir()
    (folder / "illum_oiio.so").write_text("no library")
    return {**os.environ, "LD_LIBRARY_PATH": str(folder)}


@pytest.mark.parametrize("suffix", OTHERS)
def test_without_the_module_other_formats_are_one_sentence(illum, tmp_path, without_module, suffix):
    command = stack_of(tmp_path, suffix)
    before = listing(tmp_path)
    sentence = illum.refuses(*command, code=3, env=without_module)
    assert f"photo 00{suffix}: " in sentence
    assert "pictures are read by illum_oiio.so, which cannot be loaded" in sentence
    assert listing(tmp_path) == before


@pytest.mark.parametrize("suffix", COMMON)
def test_without_the_module_common_formats_build(illum, tmp_path, without_module, suffix):
    illum(*stack_of(tmp_path, suffix), env=without_module)
    illum("verify", tmp_path / "o.illum", env=without_module)
