"""A full disk, no permission, a read-only source: one sentence, nothing half-written."""

import contextlib
import os
import pathlib
import resource
import shutil
import subprocess

import pytest

import stacks
from conftest import BINARY, listing

NOBODY = ("setpriv", "--reuid=65534", "--regid=65534", "--clear-groups")

root_only = pytest.mark.skipif(os.geteuid() != 0, reason="needs root, to become someone else")


@contextlib.contextmanager
def small_disk(folder, kibibytes):
    """A file system of its own, full after so many KiB; skips where mounting is not allowed."""
    folder.mkdir()
    mounted = subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={kibibytes}k", "tmpfs", folder],
                             capture_output=True)
    if mounted.returncode != 0:
        pytest.skip("cannot mount a small tmpfs here")
    try:
        yield folder
    finally:
        subprocess.run(["umount", "-l", folder], check=True)


def large_stack(tmp_path):
    stacks.write_stack(tmp_path / "p", count=16, width=320, height=240, suffix=".jpg", quality=95)
    return tmp_path / "p"


@pytest.mark.parametrize("kibibytes", [8, 40, 100, 200])
@pytest.mark.parametrize("old", [False, True], ids=["new", "over an old object"])
def test_disk_full_while_building(illum, tmp_path, kibibytes, old):
    source = large_stack(tmp_path)
    with small_disk(tmp_path / "disk", kibibytes) as disk:
        out = disk / "o.illum"
        if old:
            out.write_bytes(b"precious")
        illum.refuses("build", source, "-o", out, "--coding", "png", "--bits", 16, "--force",
                      code=3)
        assert out.read_bytes() == b"precious" if old else not out.exists()
        assert {p.name for p in disk.iterdir()} <= {"o.illum", "o.illum.partial"}


def test_a_full_disk_is_enlarged_and_the_build_resumed(illum, tmp_path):
    source = large_stack(tmp_path)
    options = ["--coding", "png", "--tile", 64, "--planes", 9]
    illum("build", source, "-o", tmp_path / "whole.illum", *options)
    whole = (tmp_path / "whole.illum").read_bytes()
    with small_disk(tmp_path / "disk", len(whole) // 2048) as disk:
        illum.refuses("build", source, "-o", disk / "o.illum", *options, code=3)
        subprocess.run(["mount", "-o", "remount,size=16m", disk], check=True)
        illum("build", source, "-o", disk / "o.illum", *options, "--resume")
        assert (disk / "o.illum").read_bytes() == whole
        assert [p.name for p in disk.iterdir()] == ["o.illum"]


@pytest.mark.parametrize("suffix", ["png", "jpg", "exr"])
def test_disk_full_while_relighting(illum, built, tmp_path, suffix):
    with small_disk(tmp_path / "disk", 8) as disk:
        out = disk / f"o.{suffix}"
        with contextlib.suppress(OSError):
            (disk / "filler").write_bytes(bytes(4 * 4096))
        before = listing(disk)
        illum.refuses("relight", built, "--light", "0,0,1", "-o", out, code=3)
        assert listing(disk) == before


def test_a_file_size_limit(illum, tmp_path):
    """What a quota or `ulimit -f` does: SIGXFSZ must not kill the program half-way."""
    source = large_stack(tmp_path)

    def limit():
        resource.setrlimit(resource.RLIMIT_FSIZE, (20_000, 20_000))

    outcome = illum("build", source, "-o", tmp_path / "o.illum", "--coding", "png", "--bits", 16,
                    expect=None, preexec_fn=limit)
    assert outcome.code == 3 and outcome.stderr.startswith("illum: "), outcome
    assert not (tmp_path / "o.illum").exists()


@pytest.fixture
def open_folder(tmp_path, stack, built):
    """A folder that everybody may enter, with a stack, an object and the program in it."""
    folder = pathlib.Path("/var/tmp") / f"illum-{os.getpid()}-{tmp_path.name}"
    shutil.copytree(stack, folder / "photographs")
    shutil.copy(built, folder / "ball.illum")
    subprocess.run(["chmod", "-R", "a+rX,a-w", folder], check=True)
    yield folder
    shutil.rmtree(folder)


def program_is_reachable():
    return subprocess.run([*NOBODY, BINARY, "--version"], capture_output=True).returncode == 0


@root_only
def test_a_folder_that_may_not_be_written(illum, open_folder):
    if not program_is_reachable():
        pytest.skip("another user may not run the program where it lies")
    (open_folder / "mine").mkdir(mode=0o755)
    out = open_folder / "mine"
    for arguments in (["build", open_folder / "photographs", "-o", out / "o.illum"],
                      ["relight", open_folder / "ball.illum", "--light", "0,0,1", "-o",
                       out / "o.png"]):
        illum.refuses(*arguments, code=3, wrapper=NOBODY, cwd="/", mentions="o.",
                      leaves=open_folder)


@root_only
def test_a_read_only_source(illum, open_folder):
    if not program_is_reachable():
        pytest.skip("another user may not run the program where it lies")
    out = open_folder / "theirs"
    out.mkdir()
    out.chmod(0o777)
    before = listing(open_folder / "photographs")
    illum("build", open_folder / "photographs", "-o", out / "o.illum", wrapper=NOBODY, cwd="/")
    illum("relight", open_folder / "ball.illum", "--light", "0,0,1", "-o", out / "o.png",
          wrapper=NOBODY, cwd="/")
    assert listing(open_folder / "photographs") == before


@root_only
@pytest.mark.parametrize("victim", ["photographs/photo 03.png", "photographs/lights.lp",
                                    "photographs", "ball.illum"])
def test_what_may_not_be_read(illum, open_folder, tmp_path, victim):
    if not program_is_reachable():
        pytest.skip("another user may not run the program where it lies")
    (open_folder / victim).chmod(0)
    out = open_folder / "theirs"
    out.mkdir()
    out.chmod(0o777)
    command = (["info", open_folder / victim] if victim.endswith(".illum") else
               ["build", open_folder / "photographs", "-o", out / "o.illum"])
    outcome = illum(*command, expect=None, wrapper=NOBODY, cwd="/")
    (open_folder / victim).chmod(0o755)
    assert outcome.code in (1, 3) and pathlib.Path(victim).name in outcome.stderr, outcome
    assert list(out.iterdir()) == [], outcome


def test_output_to_a_device(illum, built):
    if not os.path.exists("/dev/full"):
        pytest.skip("no /dev/full here")
    with open("/dev/full", "wb") as full:
        process = illum.start("info", built, "--json", stdout=full, stderr=subprocess.PIPE)
        _, err = process.communicate(timeout=60)
    assert process.returncode == 3 and err.startswith(b"illum: "), err
