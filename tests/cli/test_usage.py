"""Exit codes, help, what is told where."""

import json
import os
import pty
import re
import select

import pytest

import stacks
from conftest import BINARY, ROOT


@pytest.mark.parametrize("arguments", [
    [], ["frobnicate"], ["build"], ["build", "STACK"], ["build", "STACK", "-o"],
    ["build", "STACK", "-o", "OUT.illum", "--basis", "fourier"],
    ["build", "STACK", "-o", "OUT.illum", "--coding", "gif"],
    ["build", "STACK", "-o", "OUT.illum", "--quality", "101"],
    ["build", "STACK", "-o", "OUT.illum", "--quality", "-3"],
    ["build", "STACK", "-o", "OUT.illum", "--bits", "9"],
    ["build", "STACK", "-o", "OUT.illum", "--coefficients", "many"],
    ["build", "STACK", "-o", "OUT.illum", "--crop", "1,2,3"],
    ["build", "STACK", "-o", "OUT.illum", "--shrink", "0"],
    ["build", "STACK", "-o", "OUT.illum", "--max-memory", "lots"],
    ["build", "STACK", "-o", "OUT.illum", "--tile", "13"],
    ["build", "STACK", "-o", "OUT.illum", "--holdout", "-1"],
    ["build", "STACK", "-o", "OUT.illum", "--uv", "3x3"],
    ["build", "STACK", "-o", "OUT.illum", "--samples", "4"],
    ["build", "STACK", "-o", "OUT.illum", "--frobnicate"],
    ["relight", "OBJECT"], ["relight", "OBJECT", "-o", "OUT.png"],
    ["relight", "OBJECT", "--light", "0,0", "-o", "OUT.png"],
    ["relight", "OBJECT", "--light", "0,0,0", "-o", "OUT.png"],
    ["relight", "OBJECT", "--light", "0,0,nan", "-o", "OUT.png"],
    ["relight", "OBJECT", "--light", "0,0,1,1", "-o", "OUT.png"],
    ["relight", "OBJECT", "--light", "a,b,c", "-o", "OUT.png"],
    ["relight", "OBJECT", "--light", "0,0,1,nan,1,1", "-o", "OUT.png"],
    ["relight", "OBJECT", "--light", "0,0,1", "-o", "OUT.gif"],
    ["relight", "OBJECT", "--light", "0,0,1", "--level", "9", "-o", "OUT.png"],
    ["relight", "OBJECT", "--light", "0,0,1", "--exposure", "bright", "-o", "OUT.png"],
    ["evaluate", "OBJECT"], ["info"], ["verify"],
], ids=" ".join)
def test_wrong_usage_is_2(illum, stack, built, tmp_path, arguments):
    places = {"STACK": stack, "OBJECT": built}
    arguments = [tmp_path / a if a.startswith("OUT") else places.get(a, a) for a in arguments]
    outcome = illum(*arguments, expect=2)
    assert outcome.stdout == "" and outcome.stderr.startswith("illum: "), outcome
    assert list(tmp_path.iterdir()) == [], outcome


@pytest.mark.parametrize("arguments", [["--help"], ["build", "--help"], ["relight", "--help"]],
                         ids=" ".join)
def test_help_is_asked_for(illum, arguments):
    outcome = illum(*arguments)
    assert "illum" in outcome.stdout and outcome.stderr == "", outcome


def test_every_command_is_in_the_help(illum):
    text = illum("--help").stdout
    for command in ("build", "capture", "convert", "evaluate", "info", "normals", "relight", "verify"):
        assert re.search(rf"\b{command}\b", text), text


def test_version(illum):
    project = (ROOT / "CMakeLists.txt").read_text()
    declared = re.search(r"project\(Illumigraph VERSION ([\d.]+)", project).group(1)
    assert declared in illum("--version").stdout


def test_nothing_on_stderr_without_a_terminal(illum, stack, tmp_path):
    outcome = illum("build", stack, "-o", tmp_path / "o.illum")
    assert all(line.startswith("illum: note: ") for line in outcome.stderr.splitlines()), outcome
    assert "\r" not in outcome.stderr and "\x1b" not in outcome.stderr
    assert illum("relight", tmp_path / "o.illum", "--light", "0,0,1", "-o",
                 tmp_path / "o.png").stderr == ""


def run_on_terminal(*arguments):
    """The exit code and everything that a terminal would show."""
    child, terminal = pty.fork()
    if child == 0:
        os.execv(BINARY, [str(BINARY), *map(str, arguments)])
    shown = b""
    while True:
        if not select.select([terminal], [], [], 120)[0]:
            raise TimeoutError(shown)
        try:
            chunk = os.read(terminal, 4096)
        except OSError:  # how Linux says that the other end is closed
            break
        if not chunk:
            break
        shown += chunk
    return os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]), shown.decode(errors="replace")


def test_progress_on_a_terminal(tmp_path):
    stacks.write_stack(tmp_path / "p", count=24, width=900, height=700)
    code, shown = run_on_terminal("build", tmp_path / "p", "-o", tmp_path / "o.illum",
                                  "--planes", 18)
    assert code == 0, shown
    assert "\r" in shown and re.search(r"\d+ ?%", shown), shown


def test_build_json(illum, stack, tmp_path):
    report = json.loads(illum("build", stack, "-o", tmp_path / "o.illum", "--json").stdout)
    assert report["bytes"] == (tmp_path / "o.illum").stat().st_size
