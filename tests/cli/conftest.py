"""Drives the built `illum`. ILLUM_BIN names another binary, ILLUM_SHARED another data folder."""

import dataclasses
import os
import pathlib
import shutil
import signal
import subprocess
import threading

import pytest

import stacks

ROOT = pathlib.Path(__file__).resolve().parents[2]
RELEASE = ROOT / "build/release/tools/illum/illum"
BINARY = pathlib.Path(os.environ.get("ILLUM_BIN", RELEASE)).resolve()
SHARED = pathlib.Path(os.environ.get("ILLUM_SHARED", ROOT.parent / "shared"))

# A sanitizer's finding must not look like the program's own exit code 1.
os.environ.setdefault("ASAN_OPTIONS", "exitcode=99")
os.environ.setdefault("UBSAN_OPTIONS", "exitcode=99:print_stacktrace=1")


@dataclasses.dataclass
class Outcome:
    code: int
    stdout: str
    stderr: str
    peak_bytes: int

    def __str__(self):
        return f"exit {self.code}\nstdout:\n{self.stdout}\nstderr:\n{self.stderr}"


def wait_for(process, timeout):
    """The exit code and the peak of resident memory; a process that overruns is killed."""
    killer = threading.Timer(timeout, process.kill)
    killer.start()
    try:
        _, status, usage = os.wait4(process.pid, 0)
    finally:
        killer.cancel()
    process.returncode = os.waitstatus_to_exitcode(status)
    return process.returncode, usage.ru_maxrss * 1024


class Illum:
    """The program, with its output kept in files so that its resource use can be asked for."""

    def __init__(self, folder):
        self.folder = folder

    def start(self, *arguments, cwd=None, wrapper=(), **popen):
        command = [*map(str, wrapper), str(BINARY), *map(str, arguments)]
        return subprocess.Popen(command, cwd=cwd, stdin=subprocess.DEVNULL, **popen)

    def __call__(self, *arguments, expect=0, cwd=None, timeout=300, wrapper=(), **popen):
        out_file, err_file = self.folder / "stdout", self.folder / "stderr"
        with open(out_file, "wb") as out, open(err_file, "wb") as err:
            process = self.start(*arguments, cwd=cwd, wrapper=wrapper, stdout=out, stderr=err,
                                 **popen)
            code, peak = wait_for(process, timeout)
        outcome = Outcome(code, out_file.read_text(errors="replace"),
                          err_file.read_text(errors="replace"), peak)
        assert "Sanitizer" not in outcome.stderr, outcome
        assert "runtime error" not in outcome.stderr, outcome
        if expect is not None:
            assert outcome.code == expect, f"illum {' '.join(map(str, arguments))}\n{outcome}"
        return outcome

    def refuses(self, *arguments, code=1, mentions=(), leaves=None, **options):
        """One sentence on stderr, nothing on stdout, and the folder `leaves` as it was before."""
        before = listing(leaves) if leaves else None
        outcome = self(*arguments, expect=code, **options)
        assert outcome.stdout == "", outcome
        sentence = one_sentence(outcome)
        for word in [mentions] if isinstance(mentions, str) else mentions:
            assert word in sentence, f"{word!r} is not in: {sentence}"
        if leaves:
            assert listing(leaves) == before, outcome
        return sentence


def one_sentence(outcome):
    """The program's last word: a single line that says whose it is."""
    lines = outcome.stderr.splitlines()
    assert outcome.stderr.endswith("\n") and lines, outcome
    assert all(line.startswith("illum: ") for line in lines), outcome
    faults = [line for line in lines if not line.startswith("illum: note: ")]
    assert len(faults) == 1 and faults[0] == lines[-1], outcome
    sentence = faults[0].removeprefix("illum: ")
    assert 10 < len(sentence) < 600 and "terminate" not in sentence, outcome
    return sentence


def listing(folder):
    """Every path under `folder` with its bytes' number; what a command must not have changed."""
    return sorted((str(p.relative_to(folder)), p.stat().st_size if p.is_file() else -1)
                  for p in pathlib.Path(folder).rglob("*"))


@pytest.fixture(scope="session", autouse=True)
def binary():
    if not BINARY.is_file():
        pytest.exit(f"{BINARY} is not built; set ILLUM_BIN or build the preset `release`", 1)
    return BINARY


@pytest.fixture
def illum(tmp_path_factory):
    return Illum(tmp_path_factory.mktemp("output"))


@pytest.fixture(scope="session")
def stack(tmp_path_factory):
    """28 photographs of the ball; read only."""
    folder = tmp_path_factory.mktemp("stack") / "photographs"
    stacks.write_stack(folder)
    return folder


@pytest.fixture
def own_stack(stack, tmp_path):
    """A copy of `stack` that a test may spoil."""
    folder = tmp_path / "photographs"
    shutil.copytree(stack, folder)
    return folder


@pytest.fixture(scope="session")
def built(stack, tmp_path_factory):
    """The stack's object at default settings; read only."""
    folder = tmp_path_factory.mktemp("built")
    Illum(tmp_path_factory.mktemp("output"))("build", stack, "-o", folder / "ball.illum")
    return folder / "ball.illum"


@pytest.fixture(scope="session")
def lossless(stack, tmp_path_factory):
    """The stack's object with lossless tiles of several pictures, for what damages it."""
    folder = tmp_path_factory.mktemp("lossless")
    Illum(tmp_path_factory.mktemp("output"))(
        "build", stack, "-o", folder / "ball.illum", "--basis", "sh", "--coefficients", 4,
        "--coding", "png", "--tile", 64)
    return folder / "ball.illum"


def shared_data(*parts):
    """A path of the shared data. Without it: skips, or fails if ILLUM_REQUIRE_SHARED is set."""
    path = SHARED.joinpath(*parts)
    if not path.exists():
        sentence = f"{path} is not there: the shared test data is missing (ILLUM_SHARED names it)"
        if os.environ.get("ILLUM_REQUIRE_SHARED"):
            pytest.fail(sentence)
        pytest.skip(sentence)
    return path


def interrupt(process):
    process.send_signal(signal.SIGINT)
