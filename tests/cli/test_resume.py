"""Ctrl-C, kill -9 and --resume: the object is whole and the same, or not there."""

import os
import random
import signal
import subprocess
import time

import pytest

import stacks

OPTIONS = ["--coding", "png", "--tile", 64, "--basis", "sh", "--coefficients", 9, "--threads", 2]


@pytest.fixture(scope="module")
def source(tmp_path_factory):
    """Large enough for a build to last a while."""
    folder = tmp_path_factory.mktemp("source") / "photographs"
    stacks.write_stack(folder, count=24, width=600, height=400, suffix=".jpg", quality=92)
    return folder


@pytest.fixture(scope="module")
def uninterrupted(source, tmp_path_factory, binary):
    """The bytes of a build that nobody disturbed, and the seconds that it took."""
    out = tmp_path_factory.mktemp("whole") / "o.illum"
    begun = time.monotonic()
    subprocess.run([binary, "build", source, "-o", out, *map(str, OPTIONS)], check=True)
    return out.read_bytes(), time.monotonic() - begun


def start(illum, source, out, *more):
    return illum.start("build", source, "-o", out, *OPTIONS, *more, stderr=subprocess.PIPE)


def tiles_of(out):
    return sum(1 for p in out.with_name(out.name + ".partial").rglob("planes/**/*") if p.is_file())


def wait_for_tiles(process, out, count):
    while process.poll() is None and tiles_of(out) < count:
        time.sleep(0.002)


def test_interrupted_then_resumed(illum, source, uninterrupted, tmp_path):
    out = tmp_path / "o.illum"
    process = start(illum, source, out)
    wait_for_tiles(process, out, 2)
    process.send_signal(signal.SIGINT)
    _, err = process.communicate(timeout=60)
    if process.returncode == 0:
        pytest.skip("the build was done before the signal came")
    assert process.returncode == 130, err
    assert err.startswith(b"illum: ") and b"--resume" in err and err.count(b"\n") == 1, err
    assert not out.exists() and (tmp_path / "o.illum.partial").is_dir()
    illum("build", source, "-o", out, *OPTIONS, "--resume")
    assert out.read_bytes() == uninterrupted[0]
    assert [p.name for p in tmp_path.iterdir()] == ["o.illum"]


def test_two_signals_end_it_at_once(illum, source, uninterrupted, tmp_path):
    process = start(illum, source, tmp_path / "o.illum")
    time.sleep(uninterrupted[1] * 0.3)
    for _ in range(50):
        if process.poll() is not None:
            break
        process.send_signal(signal.SIGINT)
        time.sleep(0.02)
    process.communicate(timeout=10)
    assert process.returncode in (0, 130, -signal.SIGINT)


@pytest.mark.parametrize("seed", range(12))
def test_killed_at_a_random_moment(illum, source, uninterrupted, tmp_path, seed):
    """Killed up to three times, each time resumed; the bytes are those of the undisturbed build."""
    whole, seconds = uninterrupted
    moments = random.Random(seed)
    out = tmp_path / "o.illum"
    for attempt in range(3):
        process = start(illum, source, out, *(["--resume"] if attempt else []))
        time.sleep(moments.uniform(0, seconds))
        if process.poll() is None:
            process.send_signal(signal.SIGKILL)
        process.communicate(timeout=60)
        if out.exists():
            break
    if out.exists():
        assert out.read_bytes() == whole, "an object that is there is whole"
        # Killed while it tidied up behind the finished object: the next build empties what is left.
        illum("build", source, "-o", out, *OPTIONS, "--force")
    else:
        illum("build", source, "-o", out, *OPTIONS, "--resume")
    assert out.read_bytes() == whole
    assert not (tmp_path / "o.illum.partial").exists()


@pytest.mark.parametrize("tiles", [1, 5, 20, 40])
def test_killed_after_some_tiles(illum, source, uninterrupted, tmp_path, tiles):
    out = tmp_path / "o.illum"
    process = start(illum, source, out)
    wait_for_tiles(process, out, tiles)
    process.kill()
    process.communicate(timeout=60)
    kept = tiles_of(out)
    begun = time.monotonic()
    illum("build", source, "-o", out, *OPTIONS, "--resume")
    assert out.read_bytes() == uninterrupted[0], f"{kept} tiles kept, {time.monotonic() - begun} s"


def kill_after_tiles(illum, source, out, count):
    process = start(illum, source, out)
    wait_for_tiles(process, out, count)
    process.kill()
    process.communicate(timeout=60)
    if out.exists():
        pytest.skip("the build was done before it could be killed")


def test_finished_tiles_are_not_made_again(illum, source, uninterrupted, tmp_path):
    out = tmp_path / "o.illum"
    kill_after_tiles(illum, source, out, 5)
    partial = tmp_path / "o.illum.partial"
    first = min(p for p in partial.rglob("planes/**/*") if p.suffix == ".png")
    before = first.stat()
    os.utime(first, ns=(before.st_atime_ns, 10**18))
    folder = tmp_path / "o"
    process = start(illum, source, out, "--resume")
    seen = None
    while process.poll() is None:
        try:
            seen = first.stat().st_mtime_ns
        except FileNotFoundError:
            break
        assert seen == 10**18, "the tile was written anew"
        time.sleep(0.001)
    process.communicate(timeout=60)
    assert out.read_bytes() == uninterrupted[0] and not folder.exists()


def test_the_exact_basis_is_resumed(illum, source, tmp_path):
    exact = ("--basis", "exact", "--coding", "png", "--tile", 64)
    illum("build", source, "-o", tmp_path / "whole.illum", *exact)
    out = tmp_path / "o.illum"
    process = illum.start("build", source, "-o", out, *exact)
    wait_for_tiles(process, out, 5)
    process.kill()
    process.communicate(timeout=60)
    assert not out.exists() and tiles_of(out) >= 5
    illum("build", source, "-o", out, *exact, "--resume")
    assert out.read_bytes() == (tmp_path / "whole.illum").read_bytes()


def test_resume_refuses_other_settings(illum, source, tmp_path):
    out = tmp_path / "o.illum"
    kill_after_tiles(illum, source, out, 3)
    outcome = illum("build", source, "-o", out, "--resume", "--coding", "jpeg", expect=1)
    assert "o.illum.partial" in outcome.stderr and outcome.stderr.count("\n") == 1, outcome


def test_resume_refuses_other_photographs(illum, source, own_stack, tmp_path):
    out = tmp_path / "o.illum"
    kill_after_tiles(illum, source, out, 3)
    illum("build", own_stack, "-o", out, *OPTIONS, "--resume", expect=1)


def test_without_resume_it_begins_again(illum, source, uninterrupted, tmp_path):
    out = tmp_path / "o.illum"
    kill_after_tiles(illum, source, out, 3)
    illum("build", source, "-o", out, *OPTIONS)
    assert out.read_bytes() == uninterrupted[0]
    assert not (tmp_path / "o.illum.partial").exists()


def test_resume_with_nothing_to_resume(illum, source, uninterrupted, tmp_path):
    illum("build", source, "-o", tmp_path / "o.illum", *OPTIONS, "--resume")
    assert (tmp_path / "o.illum").read_bytes() == uninterrupted[0]


def test_somebody_elses_folder_of_that_name(illum, source, tmp_path):
    (tmp_path / "o.illum.partial").mkdir()
    (tmp_path / "o.illum.partial" / "diary.txt").write_text("mine")
    illum.refuses("build", source, "-o", tmp_path / "o.illum", *OPTIONS, leaves=tmp_path)


def test_a_damaged_partial_folder(illum, source, uninterrupted, tmp_path):
    """A tile cut short, as after a power failure: made again or refused, never packed."""
    out = tmp_path / "o.illum"
    kill_after_tiles(illum, source, out, 6)
    tile = min(p for p in (tmp_path / "o.illum.partial").rglob("planes/**/*")
               if p.suffix == ".png")
    tile.write_bytes(tile.read_bytes()[:50])
    outcome = illum("build", source, "-o", out, *OPTIONS, "--resume", expect=None)
    assert outcome.code in (0, 1), outcome
    if outcome.code == 0:
        assert out.read_bytes() == uninterrupted[0]


def test_two_builds_of_the_same_object(illum, source, uninterrupted, tmp_path):
    """The second is refused, or both finish; the object is whole either way."""
    out = tmp_path / "o.illum"
    first, second = start(illum, source, out), start(illum, source, out)
    errors = [p.communicate(timeout=120)[1] for p in (first, second)]
    assert sorted((first.returncode, second.returncode))[0] == 0, errors
    assert out.read_bytes() == uninterrupted[0]
