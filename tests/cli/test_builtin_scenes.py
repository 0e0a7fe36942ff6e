"""Built-in scenes from the command line: all are listed, all can be built and lit."""

import re

import pytest

SCENES = ["box", "teapot", "bust", "cornell", "bear", "coin"]
TINY = ["--uv", "2x1", "--size", "32", "--light-count", "9", "--samples", "1", "--bounces", "1"]


@pytest.mark.parametrize("command", ["build", "capture"])
def test_the_list_has_a_line_for_each(illum, command):
    lines = illum(command, "builtin:").stdout.splitlines()
    assert [re.match(r"builtin:(\w+) +\w.{10,}", line)[1] for line in lines] == SCENES


@pytest.mark.parametrize("scene", SCENES)
def test_each_is_built_alike_on_any_number_of_threads_and_lit(illum, tmp_path, scene):
    for threads in ("1", "2"):
        illum("build", f"builtin:{scene}", "-o", tmp_path / f"{threads}.illum", *TINY,
              "--threads", threads)
    assert (tmp_path / "1.illum").read_bytes() == (tmp_path / "2.illum").read_bytes()
    illum("relight", tmp_path / "1.illum", "--light", "0.3,0.4,0.8", "-o", tmp_path / "lit.png")
    illum("relight", tmp_path / "1.illum", "--light", "-0.8,0.1,0.2", "-o", tmp_path / "other.png")
    assert (tmp_path / "lit.png").read_bytes() != (tmp_path / "other.png").read_bytes()
