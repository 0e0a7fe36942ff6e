"""Photographs and light files that are wrong: one sentence, exit 1, nothing left."""

import os
import shutil
import struct
import zlib

import numpy as np
import pytest
from PIL import Image

import stacks

VICTIM = "photo 13.png"


def remove(folder):
    (folder / VICTIM).unlink()


def truncate(folder):
    file = folder / VICTIM
    file.write_bytes(file.read_bytes()[: file.stat().st_size // 2])


def cut_to_header(folder):
    file = folder / VICTIM
    file.write_bytes(file.read_bytes()[:20])


def empty(folder):
    (folder / VICTIM).write_bytes(b"")


def text_instead(folder):
    (folder / VICTIM).write_text("This is not a photograph.\n" * 40)


def noise_instead(folder):
    (folder / VICTIM).write_bytes(np.random.default_rng(3).bytes(5000))


def zeros_instead(folder):
    (folder / VICTIM).write_bytes(bytes(5000))


def another_size(folder):
    Image.open(folder / VICTIM).resize((64, 56)).save(folder / VICTIM)


def turned(folder):
    Image.open(folder / VICTIM).transpose(Image.ROTATE_90).save(folder / VICTIM)


def folder_instead(folder):
    (folder / VICTIM).unlink()
    (folder / VICTIM).mkdir()


def dangling_link(folder):
    (folder / VICTIM).unlink()
    (folder / VICTIM).symlink_to("nowhere.png")


def looping_link(folder):
    (folder / VICTIM).unlink()
    (folder / VICTIM).symlink_to(VICTIM)


def flipped_bits(folder):
    data = bytearray((folder / VICTIM).read_bytes())
    for at in range(len(data) // 3, len(data) - 20, 97):
        data[at] ^= 0x55
    (folder / VICTIM).write_bytes(data)


def huge_declared_size(folder):
    """A PNG that says 2^31-1 x 2^31-1, with a right checksum."""
    header = b"IHDR" + struct.pack(">IIBBBBB", 2**31 - 1, 2**31 - 1, 8, 2, 0, 0, 0)
    data = bytearray((folder / VICTIM).read_bytes())
    data[12:33] = header + struct.pack(">I", zlib.crc32(header))
    (folder / VICTIM).write_bytes(data)


def page_description(folder):
    """A text format that OpenImageIO or a delegate of it might want to interpret."""
    (folder / VICTIM).write_text("<svg xmlns='http://www.w3.org/2000/svg' width='72' height='56'/>")


def command_pipe_name(folder):
    text = (folder / "lights.lp").read_text().replace(VICTIM, "|touch owned.png")
    (folder / "lights.lp").write_text(text)


def all_photographs_gone(folder):
    for file in folder.glob("*.png"):
        file.unlink()


def no_light_file(folder):
    (folder / "lights.lp").unlink()


def two_light_files(folder):
    (folder / "lights.lp").rename(folder / "one.lp")
    shutil.copy(folder / "one.lp", folder / "other.lp")


def name_that_leaves_the_folder(folder):
    text = (folder / "lights.lp").read_text().replace(VICTIM, "../../../../etc/passwd")
    (folder / "lights.lp").write_text(text)


PHOTOGRAPH_CASES = [
    (remove, VICTIM), (truncate, VICTIM), (cut_to_header, VICTIM), (empty, VICTIM),
    (text_instead, VICTIM), (noise_instead, VICTIM), (zeros_instead, VICTIM),
    (another_size, ["64", "72"]), (turned, ["56"]), (folder_instead, VICTIM),
    (dangling_link, VICTIM), (looping_link, VICTIM), (flipped_bits, VICTIM),
    (huge_declared_size, VICTIM), (page_description, VICTIM), (command_pipe_name, "touch owned"),
    (all_photographs_gone, []), (no_light_file, []), (two_light_files, ["one.lp", "other.lp"]),
    (name_that_leaves_the_folder, "passwd"),
]


@pytest.mark.parametrize("spoil, words", PHOTOGRAPH_CASES, ids=lambda v: getattr(v, "__name__", ""))
def test_photographs(illum, own_stack, tmp_path, spoil, words):
    spoil(own_stack)
    illum.refuses("build", own_stack, "-o", tmp_path / "o.illum", mentions=words, leaves=tmp_path)


def test_truncated_jpeg(illum, tmp_path):
    stacks.write_stack(tmp_path / "p", count=12, suffix=".jpg", quality=95)
    file = tmp_path / "p" / "photo 07.jpg"
    file.write_bytes(file.read_bytes()[:-400])
    illum.refuses("build", tmp_path / "p", "-o", tmp_path / "o.illum", mentions="photo 07.jpg",
                  leaves=tmp_path)


def test_truncated_progressive_jpeg(illum, tmp_path):
    stacks.write_stack(tmp_path / "p", count=12, suffix=".jpg", quality=95, progressive=True)
    file = tmp_path / "p" / "photo 07.jpg"
    file.write_bytes(file.read_bytes()[: file.stat().st_size // 3])
    illum.refuses("build", tmp_path / "p", "-o", tmp_path / "o.illum", mentions="photo 07.jpg",
                  leaves=tmp_path)


def test_an_unreadable_photograph_of_a_late_moment(illum, tmp_path):
    """One that is fine at its head and broken in its last rows is found, late as it is."""
    stacks.write_stack(tmp_path / "p", count=12, suffix=".tif")
    file = tmp_path / "p" / "photo 07.tif"
    file.write_bytes(file.read_bytes()[:9000])
    illum.refuses("build", tmp_path / "p", "-o", tmp_path / "o.illum", "--tile", 64,
                  mentions="photo 07.tif", leaves=tmp_path)


def test_lines_of_a_light_file_may_change_places(illum, own_stack, stack, tmp_path):
    """Names decide which photograph is meant; the order of lines never does."""
    lines = (own_stack / "lights.lp").read_text().splitlines()
    (own_stack / "lights.lp").write_text("\n".join([lines[0], *reversed(lines[1:])]) + "\n")
    illum("build", own_stack, "-o", tmp_path / "o.illum")
    outcome = illum("evaluate", tmp_path / "o.illum", "--against", stack, "--json")
    assert '"psnr"' in outcome.stdout.lower() or "psnr" in outcome.stdout.lower()
    light = list(stacks.directions(28))[3]
    illum("relight", tmp_path / "o.illum", "--light", ",".join(map(str, light)), "-o",
          tmp_path / "o.png")
    truth = stacks.display_bytes(stacks.render(light))
    assert stacks.psnr(stacks.read_picture(tmp_path / "o.png"), truth) > 28


def light_lines(folder):
    return (folder / "lights.lp").read_text().splitlines()


def with_line(folder, number, text):
    lines = light_lines(folder)
    lines[number] = text
    (folder / "lights.lp").write_text("\n".join(lines) + "\n")


LIGHT_FILES = {
    "nan": ("photo 04.png nan 0 1", ":6:"),
    "infinite": ("photo 04.png 0 inf 1", ":6:"),
    "zero": ("photo 04.png 0 0 0", ":6:"),
    "words": ("photo 04.png left up front", ":6:"),
    "two_numbers": ("photo 04.png 0.5 0.5", ":6:"),
    "overflow": ("photo 04.png 1e999 0 1", ":6:"),
    "negative_intensity": ("photo 04.png 0 0 1 -2", ":6:"),
    "zero_intensity": ("photo 04.png 0 0 1 0", ":6:"),
    "no_name": ("0.1 0.2 0.9", ":6:"),
    "same_name_other_direction": ("photo 03.png 0 0 1", "photo 03.png"),
    "binary": ("photo 04.png \0\1\2\3", "binary"),
}


@pytest.mark.parametrize("case", LIGHT_FILES)
def test_light_file_lines(illum, own_stack, tmp_path, case):
    line, word = LIGHT_FILES[case]
    with_line(own_stack, 5, line)
    illum.refuses("build", own_stack, "-o", tmp_path / "o.illum", mentions=["lights.lp", word],
                  leaves=tmp_path)


@pytest.mark.parametrize("count", ["27", "29", "-3", "1000000000", "99999999999999999999"])
def test_light_file_counts(illum, own_stack, tmp_path, count):
    with_line(own_stack, 0, count)
    illum.refuses("build", own_stack, "-o", tmp_path / "o.illum", mentions="lights.lp",
                  leaves=tmp_path)


@pytest.mark.parametrize("content", [b"", b"0\n", b"\n\n\n", b"# only a comment\n", b"\xff" * 300,
                                     b"28\n", b"a" * 3_000_000], ids=lambda b: str(b[:12]))
def test_light_file_contents(illum, own_stack, tmp_path, content):
    (own_stack / "lights.lp").write_bytes(content)
    illum.refuses("build", own_stack, "-o", tmp_path / "o.illum", mentions="lights.lp",
                  leaves=tmp_path)


def test_light_file_that_is_a_folder(illum, own_stack, tmp_path):
    (tmp_path / "l").mkdir()
    illum.refuses("build", own_stack, "-o", tmp_path / "o.illum", "--light-file", tmp_path / "l",
                  leaves=tmp_path)


def test_intensities_of_a_wrong_number(illum, own_stack, tmp_path):
    (own_stack / "light_intensities.txt").write_text("1 1 1\n" * 27)
    illum.refuses("build", own_stack, "-o", tmp_path / "o.illum", mentions="light_intensities.txt",
                  leaves=tmp_path)


def test_duplicates_are_merged_with_a_word(illum, own_stack, tmp_path):
    lines = light_lines(own_stack)
    (own_stack / "lights.lp").write_text("\n".join(["29", *lines[1:], lines[3]]) + "\n")
    outcome = illum("build", own_stack, "-o", tmp_path / "o.illum")
    assert "repeated" in outcome.stderr, outcome


@pytest.mark.parametrize("options, word", [
    (["--crop", "60,0,20,20"], "72"), (["--crop", "0,0,0,5"], "0"), (["--shrink", "100"], "100"),
    (["--mask", "MISSING"], "MISSING"), (["--mask", "SMALL"], "small.png"),
    (["--light-file", "MISSING"], "MISSING"), (["--holdout", "1"], "1"),
], ids=" ".join)
def test_options_that_do_not_fit_the_photographs(illum, own_stack, tmp_path, options, word):
    Image.new("L", (9, 9), 255).save(tmp_path / "small.png")
    options = [{"SMALL": tmp_path / "small.png"}.get(o, o) for o in options]
    outcome = illum("build", own_stack, "-o", tmp_path / "o.illum", *options, expect=None)
    assert outcome.code in (1, 2) and word in outcome.stderr, outcome
    assert not (tmp_path / "o.illum").exists() and not (tmp_path / "o.illum.partial").exists()


@pytest.mark.parametrize("source", ["nowhere", "a file", "an empty folder"])
def test_no_folder_of_photographs(illum, tmp_path, source):
    (tmp_path / "a file").write_text("x")
    (tmp_path / "an empty folder").mkdir()
    illum.refuses("build", tmp_path / source, "-o", tmp_path / "o.illum", mentions=source,
                  leaves=tmp_path)


def test_too_little_memory_says_how_much(illum, stack, tmp_path):
    sentence = illum.refuses("build", stack, "-o", tmp_path / "o.illum", "--max-memory", "4k",
                             code=3, leaves=tmp_path)
    assert any(unit in sentence for unit in ("KiB", "MiB", "GiB")), sentence


def test_a_fifo_is_not_waited_for(illum, own_stack, tmp_path):
    (own_stack / VICTIM).unlink()
    os.mkfifo(own_stack / VICTIM)
    illum.refuses("build", own_stack, "-o", tmp_path / "o.illum", timeout=30, leaves=tmp_path)
