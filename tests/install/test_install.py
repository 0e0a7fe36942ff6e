"""Installs a build somewhere else and compiles a program of somebody else's against it.

ILLUM_BUILD names the build folder (default build/release).
"""

import os
import pathlib
import shutil
import subprocess

import numpy as np
import pytest
from PIL import Image

import stacks

ROOT = pathlib.Path(__file__).resolve().parents[2]
BUILD = pathlib.Path(os.environ.get("ILLUM_BUILD", ROOT / "build/release")).resolve()


def run(*command):
    done = subprocess.run([*map(str, command)], capture_output=True, text=True, timeout=600)
    assert done.returncode == 0, f"{command}\n{done.stdout}\n{done.stderr}"
    return done.stdout


@pytest.fixture(scope="module")
def prefix(tmp_path_factory):
    folder = tmp_path_factory.mktemp("installed")
    run("cmake", "--install", BUILD, "--prefix", folder)
    return folder


@pytest.fixture(scope="module")
def consumer(prefix, tmp_path_factory):
    """The consumer's build folder."""
    folder = tmp_path_factory.mktemp("consumer")
    run("cmake", "-S", ROOT / "tests/install", "-B", folder, "-G", "Ninja",
        "-DCMAKE_BUILD_TYPE=Release", f"-DCMAKE_PREFIX_PATH={prefix}")
    run("cmake", "--build", folder)
    return folder


@pytest.fixture(scope="module")
def ball(prefix, tmp_path_factory):
    """An object that the installed program made."""
    folder = tmp_path_factory.mktemp("ball")
    stacks.write_stack(folder / "photographs")
    run(prefix / "bin/illum", "build", folder / "photographs", "-o", folder / "ball.illum")
    return folder / "ball.illum"


def test_what_is_installed(prefix):
    assert (prefix / "bin/illum").is_file()
    for header in (ROOT / "include/illum").glob("*.h"):
        assert (prefix / "include/illum" / header.name).is_file(), header.name
    documents = prefix / "share/doc/Illumigraph"
    assert (documents / "LICENSE").is_file() and (documents / "docs/format.md").is_file()


@pytest.fixture(scope="module")
def tiffs(tmp_path_factory):
    """Photographs that OpenImageIO reads."""
    folder = tmp_path_factory.mktemp("tiffs") / "photographs"
    stacks.write_stack(folder, suffix=".tif")
    return folder


def test_the_installed_program_finds_its_module(prefix, tiffs, tmp_path):
    libraries = run("ldd", prefix / "bin/illum")
    assert "OpenImageIO" not in libraries and str(BUILD) not in libraries
    # Both may be moved together.
    shutil.copytree(prefix, tmp_path / "moved")
    for place in prefix, tmp_path / "moved":
        environment = {**os.environ, "LD_DEBUG": "files",
                       "LD_DEBUG_OUTPUT": str(tmp_path / "loaded")}
        subprocess.run([place / "bin/illum", "build", tiffs, "-o", tmp_path / "o.illum",
                        "--force"], check=True, env=environment)
        loaded = "".join(file.read_text() for file in tmp_path.glob("loaded.*"))
        assert f"{place}/bin/../lib/illumigraph/illum_oiio.so" in loaded


def test_a_program_without_its_module_says_so(prefix, tiffs, tmp_path):
    alone = shutil.copy(prefix / "bin/illum", tmp_path / "illum")
    done = subprocess.run([alone, "build", tiffs, "-o", tmp_path / "o.illum"],
                          capture_output=True, text=True)
    assert done.returncode == 3 and done.stderr.count("\n") == 1, done.stderr
    assert "photo 00.tif: TIFF pictures are read by illum_oiio.so" in done.stderr
    stacks.write_stack(tmp_path / "photographs", suffix=".jpg")
    run(alone, "build", tmp_path / "photographs", "-o", tmp_path / "o.illum")


def test_nothing_remembers_where_it_was_built(prefix):
    for file in prefix.rglob("*.cmake"):
        assert str(ROOT) not in file.read_text() and str(BUILD) not in file.read_text(), file


def test_the_consumer_relights(consumer, ball, tmp_path):
    run(consumer / "relight_once", ball, tmp_path / "lit.png")
    picture = np.asarray(Image.open(tmp_path / "lit.png"), float)
    assert picture.shape == (stacks.HEIGHT, stacks.WIDTH, 3)
    left, right = picture[:, : stacks.WIDTH // 2], picture[:, stacks.WIDTH // 2 :]
    assert left[..., 0].mean() > right[..., 0].mean(), "the warm light comes from the left"


def test_the_consumer_gets_sentences(consumer, tmp_path):
    done = subprocess.run([consumer / "relight_once", tmp_path / "nothing.illum", "o.png"],
                          capture_output=True, text=True)
    assert done.returncode == 1 and "nothing.illum" in done.stderr


def test_reading_brings_none_of_the_authoring_libraries(consumer):
    loaded = run("ldd", consumer / "relight_once")
    for library in ("OpenImageIO", "openblas", "lcms", "webp", "opencv"):
        assert library not in loaded, loaded


def test_authoring_can_be_linked_too(prefix, tiffs, tmp_path):
    (tmp_path / "CMakeLists.txt").write_text(
        "cmake_minimum_required(VERSION 3.25)\nproject(Author LANGUAGES CXX)\n"
        "set(CMAKE_CXX_STANDARD 20)\n"
        "find_package(Illumigraph REQUIRED COMPONENTS read author)\n"
        "add_executable(author author.cpp)\n"
        "target_link_libraries(author PRIVATE Illumigraph::illum_author)\n"
        "install(TARGETS author DESTINATION bin)\n")
    (tmp_path / "author.cpp").write_text(
        '#include "illum/capture.h"\n#include "illum/error.h"\n'
        "int main(int, char** argv) {\n"
        "  illum::Progress progress;\n"
        "  try { illum::openPhotographs(argv[1], {}, progress); }\n"
        "  catch (const illum::Error&) { return 7; }\n"
        "}\n")
    run("cmake", "-S", tmp_path, "-B", tmp_path / "b", "-G", "Ninja",
        f"-DCMAKE_PREFIX_PATH={prefix}")
    run("cmake", "--build", tmp_path / "b")
    run("cmake", "--install", tmp_path / "b", "--prefix", tmp_path / "i")
    for author in tmp_path / "b/author", tmp_path / "i/bin/author":
        assert subprocess.run([author, "/nowhere"]).returncode == 7
        assert subprocess.run([author, tiffs]).returncode == 0
        assert "OpenImageIO" not in run("ldd", author)


def test_another_minor_version_is_not_taken(prefix, tmp_path):
    (tmp_path / "CMakeLists.txt").write_text(
        "cmake_minimum_required(VERSION 3.25)\nproject(Other LANGUAGES NONE)\n"
        "find_package(Illumigraph 0.2 REQUIRED)\n")
    done = subprocess.run(["cmake", "-S", tmp_path, "-B", tmp_path / "b", "-G", "Ninja",
                           f"-DCMAKE_PREFIX_PATH={prefix}"], capture_output=True, text=True)
    assert done.returncode != 0 and "version" in done.stderr
