"""Damaged and malicious objects: one sentence, exit 1, no picture left, little memory."""

import json
import struct
import zipfile
import zlib

import numpy as np
import pytest

from conftest import BINARY

MEBI = 1 << 20
# Of one refusal. Sanitizers keep what is freed for a while.
PEAK_LIMIT = (2000 if "sanitize" in str(BINARY) else 400) * MEBI


def entries_of(file):
    with zipfile.ZipFile(file) as archive:
        return {entry.filename: archive.read(entry) for entry in archive.infolist()}


def write_archive(file, entries, deflated=()):
    with zipfile.ZipFile(file, "w") as archive:
        for name, data in entries.items():
            how = zipfile.ZIP_DEFLATED if name in deflated else zipfile.ZIP_STORED
            archive.writestr(zipfile.ZipInfo(name), data, how)
    return file


def refuses_everywhere(illum, file, tmp_path, words=()):
    """relight, info or verify, and evaluate must all find the fault; info may not look at tiles."""
    out = tmp_path / "o.png"
    outcome = illum("relight", file, "--light", "0.3,0.2,0.9", "-o", out, expect=1)
    assert not out.exists() and list(tmp_path.glob("*.png*")) == [], outcome
    assert outcome.stderr.startswith("illum: ") and outcome.stderr.count("\n") == 1, outcome
    for word in [words] if isinstance(words, str) else words:
        assert word in outcome.stderr, outcome
    verified = illum("verify", file, expect=1)
    assert "illum: " in verified.stderr, verified
    for result in (outcome, verified):
        assert result.peak_bytes < PEAK_LIMIT, result.peak_bytes
    return outcome


def edited(lossless, tmp_path, edit):
    """The object with a changed manifest, checksums made right again."""
    entries = entries_of(lossless)
    manifest = json.loads(entries["object.json"])
    edit(manifest)
    entries["object.json"] = json.dumps(manifest).encode()
    return write_archive(tmp_path / "edited.illum", entries, ["object.json"])


def local_headers(data):
    """Where every entry begins, and where its bytes do."""
    with zipfile.ZipFile(data) as archive:
        raw = data.read_bytes()
        for entry in archive.infolist():
            at = entry.header_offset
            name, extra = struct.unpack_from("<HH", raw, at + 26)
            yield entry, at, at + 30 + name + extra


def test_truncated_at_every_entry(illum, lossless, tmp_path):
    raw = lossless.read_bytes()
    places = {0, 1, 10, len(raw) - 1, len(raw) - 10, len(raw) - 22, len(raw) - 23}
    for entry, header, start in local_headers(lossless):
        places |= {header, header + 7, start, start + entry.compress_size // 2}
    with zipfile.ZipFile(lossless) as archive:
        places |= {archive.start_dir, archive.start_dir + 9}
    for place in sorted(places):
        file = tmp_path / "cut.illum"
        file.write_bytes(raw[:place])
        outcome = illum("relight", file, "--light", "0,0,1", "-o", tmp_path / "o.png", expect=1)
        assert outcome.stderr.startswith("illum: ") and outcome.stderr.count("\n") == 1, place
        assert not (tmp_path / "o.png").exists(), place
        illum("verify", file, expect=1)
        illum("info", file, expect=1)


def test_bit_flips_are_found(illum, lossless, tmp_path):
    """One bit in the bytes of every entry, and a fixed choice all over the file."""
    raw = lossless.read_bytes()
    starts = [start + entry.compress_size // 2 for entry, _, start in local_headers(lossless)]
    random = np.random.default_rng(42)
    for place in starts + list(random.integers(0, len(raw), 40)):
        flipped = bytearray(raw)
        flipped[place] ^= 1 << int(random.integers(8))
        file = tmp_path / "flipped.illum"
        file.write_bytes(flipped)
        outcome = illum("verify", file, expect=None)
        assert outcome.code == 1, f"byte {place}: {outcome}"


def test_bit_flips_in_a_tile_are_not_shown(illum, lossless, tmp_path):
    raw = bytearray(lossless.read_bytes())
    tile = next(start + e.compress_size // 2 for e, _, start in local_headers(lossless)
                if e.filename.startswith("planes/"))
    raw[tile] ^= 4
    (tmp_path / "flipped.illum").write_bytes(raw)
    refuses_everywhere(illum, tmp_path / "flipped.illum", tmp_path, "planes/")


def missing(name):
    def edit(entries):
        del entries[name if name in entries else next(e for e in entries if e.startswith(name))]
    return edit


def replaced(prefix, data):
    def edit(entries):
        entries[next(e for e in entries if e.startswith(prefix))] = data
    return edit


ARCHIVES = {
    "no_manifest": (missing("object.json"), "object.json"),
    "no_table": (missing("basis.bin"), "basis.bin"),
    "no_tile": (missing("planes/"), "planes/"),
    "empty_manifest": (replaced("object.json", b""), "object.json"),
    "manifest_is_not_json": (replaced("object.json", b"{ hello"), "object.json"),
    "manifest_is_a_number": (replaced("object.json", b"17"), "object.json"),
    "manifest_is_a_list": (replaced("object.json", b"[]"), "object.json"),
    "manifest_nested_deeply": (replaced("object.json", b"[" * 200_000), "object.json"),
    "manifest_is_binary": (replaced("object.json", bytes(range(256)) * 8), "object.json"),
    "empty_table": (replaced("basis.bin", b""), "basis.bin"),
    "short_table": (replaced("basis.bin", b"ILTB"), "basis.bin"),
    "noise_table": (replaced("basis.bin", np.random.default_rng(1).bytes(9000)), "basis.bin"),
    "empty_tile": (replaced("planes/", b""), "planes/"),
    "noise_tile": (replaced("planes/", np.random.default_rng(2).bytes(900)), "planes/"),
}


@pytest.mark.parametrize("case", ARCHIVES)
def test_archives_of_wrong_content(illum, lossless, tmp_path, case):
    edit, word = ARCHIVES[case]
    entries = entries_of(lossless)
    edit(entries)
    refuses_everywhere(illum, write_archive(tmp_path / "x.illum", entries), tmp_path, word)


def png(width, height, rows=b"", times=1):
    """`rows` is repeated `times` before it is compressed."""
    def chunk(kind, body):
        checksum = struct.pack(">I", zlib.crc32(kind + body))
        return struct.pack(">I", len(body)) + kind + body + checksum

    coder = zlib.compressobj()
    data = b"".join([coder.compress(rows) for _ in range(times)] + [coder.flush()])
    header = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", data) +
            chunk(b"IEND", b""))


@pytest.mark.parametrize(
    "picture", [png(1, 1, bytes(4)), png(4096, 4096), png(2**31 - 1, 2**31 - 1)],
    ids=["small", "large", "absurd"])
def test_tiles_of_another_size(illum, lossless, tmp_path, picture):
    entries = entries_of(lossless)
    replaced("planes/", picture)(entries)
    refuses_everywhere(illum, write_archive(tmp_path / "x.illum", entries), tmp_path, "planes/")


@pytest.mark.parametrize("bomb", ["object.json", "basis.bin"])
def test_zip_bomb(illum, lossless, tmp_path, bomb):
    """1.5 GB of blanks in 1.5 MB. Made in pieces, because a child's peak counts its parent's."""
    file = tmp_path / "bomb.illum"
    entries = entries_of(lossless)
    with zipfile.ZipFile(file, "w") as archive:
        for name, data in entries.items():
            entry = zipfile.ZipInfo(name)
            if name == bomb:
                entry.compress_type = zipfile.ZIP_DEFLATED
                with archive.open(entry, "w", force_zip64=False) as pipe:
                    for _ in range(1500):
                        pipe.write(b" " * MEBI)
            else:
                archive.writestr(entry, data)
    assert file.stat().st_size < 8 * MEBI
    refuses_everywhere(illum, file, tmp_path, bomb)


def test_zip_bomb_in_a_tile(illum, lossless, tmp_path):
    """A PNG of the right size whose compressed rows go on for 300 MB."""
    entries = entries_of(lossless)
    tile = next(name for name in entries if name.startswith("planes/"))
    size = struct.unpack(">II", entries[tile][16:24])
    entries[tile] = png(*size, bytes(MEBI), times=300)
    file = write_archive(tmp_path / "bomb.illum", entries)
    outcome = illum("relight", file, "--light", "0,0,1", "-o", tmp_path / "o.png", expect=None,
                    timeout=30)
    assert outcome.code in (0, 1), "the rows that belong to the picture may be taken"
    assert outcome.peak_bytes < PEAK_LIMIT, outcome.peak_bytes


@pytest.mark.parametrize("name", ["../evil.txt", "/tmp/evil.txt", "planes/../../evil.txt",
                                  "a\\..\\evil.txt", "./object.json"])
def test_paths_that_leave_the_archive(illum, lossless, tmp_path, name):
    entries = entries_of(lossless)
    entries[name] = b"evil"
    file = write_archive(tmp_path / "x.illum", entries)
    outcome = illum("verify", file, expect=1)
    assert "illum: " in outcome.stderr, outcome
    illum("relight", file, "--light", "0,0,1", "-o", tmp_path / "o.png", expect=None)
    assert not (tmp_path.parent / "evil.txt").exists()


def test_the_same_entry_twice(illum, lossless, tmp_path):
    entries = entries_of(lossless)
    file = write_archive(tmp_path / "x.illum", entries)
    with zipfile.ZipFile(file, "a") as archive, pytest.warns(UserWarning):
        archive.writestr("object.json", b"{}")
    outcome = illum("verify", file, expect=1)
    assert "object.json" in outcome.stdout + outcome.stderr, outcome


def keys_of(manifest, path=()):
    if isinstance(manifest, dict):
        for key, value in manifest.items():
            yield from keys_of(value, path + (key,))
    elif isinstance(manifest, list) and manifest:
        yield from keys_of(manifest[0], path + (0,))
    elif isinstance(manifest, (int, float)) and not isinstance(manifest, bool):
        yield path


def set_at(manifest, path, value):
    for key in path[:-1]:
        manifest = manifest[key]
    manifest[path[-1]] = value


@pytest.mark.parametrize("value", [-1, 0, 2**31 - 1, 2**64, 1e308, 0.5, "x"], ids=repr)
def test_no_number_of_the_manifest_is_trusted(illum, lossless, tmp_path, value):
    """Every number, one after the other, becomes a wild one: refused or harmless, never a crash."""
    manifest = json.loads(entries_of(lossless)["object.json"])
    paths = list(keys_of(manifest))
    assert len(paths) > 10
    for path in paths:
        file = edited(lossless, tmp_path, lambda m, path=path: set_at(m, path, value))
        outcome = illum("relight", file, "--light", "0,0,1", "-o", tmp_path / "o.png", expect=None)
        (tmp_path / "o.png").unlink(missing_ok=True)
        assert outcome.code in (0, 1), f"{path}: {outcome}"
        assert outcome.peak_bytes < PEAK_LIMIT, f"{path}: {outcome.peak_bytes}"
        assert outcome.stderr.count("\n") == outcome.code, f"{path}: {outcome}"


@pytest.mark.parametrize("width, height", [(10**9, 10**9), (2**31 - 1, 1), (0, 0), (-5, 56)])
def test_huge_declared_sizes(illum, lossless, tmp_path, width, height):
    def edit(manifest):
        manifest["groups"][0]["geometry"]["size"] = {"width": width, "height": height}
    refuses_everywhere(illum, edited(lossless, tmp_path, edit), tmp_path, "object.json")


def bump_version(manifest, major):
    def walk(value):
        if isinstance(value, dict):
            for key, inner in value.items():
                if "ersion" in key or key == "major":
                    if isinstance(inner, (int, float)):
                        value[key] = major
                    elif isinstance(inner, str):
                        value[key] = f"{major}.0"
                    elif isinstance(inner, list):
                        value[key] = [major, 0]
                    else:
                        walk(inner)
    walk(manifest)


def test_future_versions_are_refused_in_words(illum, lossless, tmp_path):
    file = edited(lossless, tmp_path, lambda m: bump_version(m, 99))
    outcome = refuses_everywhere(illum, file, tmp_path, "99")
    assert "version" in outcome.stderr, outcome


def test_unknown_fields_are_skipped(illum, lossless, tmp_path):
    file = edited(lossless, tmp_path, lambda m: m.update(fragrance={"notes": ["cedar", 7]}))
    illum("relight", file, "--light", "0,0,1", "-o", tmp_path / "o.png")


@pytest.mark.parametrize("content", [
    b"", b"PK", b"PK\x05\x06" + bytes(18), b"PK\x03\x04" + bytes(60), b"\0" * 5000,
    b"\x89PNG\r\n\x1a\n", b"hello\n" * 900,
], ids=lambda b: str(b[:8]))
def test_files_that_are_no_objects(illum, tmp_path, content):
    file = tmp_path / "x.illum"
    file.write_bytes(content)
    for command in ("info", "verify"):
        illum.refuses(command, file, mentions="x.illum", leaves=tmp_path)


def test_archive_that_says_it_has_a_billion_entries(illum, lossless, tmp_path):
    raw = bytearray(lossless.read_bytes())
    end = raw.rindex(b"PK\x05\x06")
    struct.pack_into("<HH", raw, end + 8, 65535, 65535)
    (tmp_path / "x.illum").write_bytes(raw)
    refuses_everywhere(illum, tmp_path / "x.illum", tmp_path)


def test_entry_that_says_it_is_huge(illum, lossless, tmp_path):
    raw = bytearray(lossless.read_bytes())
    with zipfile.ZipFile(lossless) as archive:
        at = archive.start_dir
    struct.pack_into("<II", raw, at + 20, 0xFFFFFFF0, 0xFFFFFFF0)
    (tmp_path / "x.illum").write_bytes(raw)
    refuses_everywhere(illum, tmp_path / "x.illum", tmp_path)


def test_folder_form_with_a_damaged_tile(illum, stack, tmp_path):
    folder = tmp_path / "ball"
    illum("build", stack, "-o", f"{folder}/")
    tile = next(p for p in sorted((folder / "planes").rglob("*")) if p.is_file())
    data = bytearray(tile.read_bytes())
    data[len(data) // 2] ^= 1
    tile.write_bytes(data)
    refuses_everywhere(illum, folder, tmp_path, tile.name)


def test_folder_form_with_a_link_to_elsewhere(illum, stack, tmp_path):
    folder = tmp_path / "ball"
    illum("build", stack, "-o", f"{folder}/")
    (folder / "basis.bin").unlink()
    (folder / "basis.bin").symlink_to("/dev/zero")
    outcome = illum("relight", folder, "--light", "0,0,1", "-o", tmp_path / "o.png", expect=1,
                    timeout=60)
    assert outcome.peak_bytes < PEAK_LIMIT, outcome
