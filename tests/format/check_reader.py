#!/usr/bin/env python3
"""check_reader.py FORMAT_SAMPLE READ_ILLUM FORMAT_MD FOLDER: makes sample objects, holds the format's
worked example to what our own relighter says of them, and the page's quote to the example. Ends with 77
where numpy or PIL is missing."""
import importlib.util
import pathlib
import subprocess
import sys

TOLERANCE = 2e-5  # the relighter adds in single precision


def quotes_are_true(page, program):
    """Whether every ```python block of the page stands in the program, apart from its indentation."""
    lines = [line.strip() for line in program.splitlines()]
    blocks = [block.split("```")[0] for block in page.split("```python\n")[1:]]
    wanted = [[line.strip() for line in block.splitlines()] for block in blocks]
    return len(wanted) > 0 and all(
        any(lines[i:i + len(block)] == block for i in range(len(lines))) for block in wanted)


def main():
    sample, reader, page, folder = sys.argv[1:]
    if not quotes_are_true(pathlib.Path(page).read_text(), pathlib.Path(reader).read_text()):
        print(f"{page} quotes what {reader} does not say")
        return 1
    try:
        spec = importlib.util.spec_from_file_location("read_illum", reader)
        read_illum = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(read_illum)
    except ImportError as error:
        print(f"skipped: {error}")
        return 77
    subprocess.run([sample, folder], check=True)
    folder = pathlib.Path(folder)
    pictures, depths, worst, checked = {}, {}, 0, 0
    for line in (folder / "expected.txt").read_text().splitlines():
        name, group, *numbers = line.split()
        light, (x, y), rgb = map(float, numbers[:3]), map(int, numbers[3:5]), numbers[5:8]
        key = name, int(group), tuple(light)
        if key not in pictures:
            pictures[key] = read_illum.relight(folder / f"{name}.illum", key[2], key[1])
        if numbers[8] != "none":
            if key[:2] not in depths:
                depths[key[:2]] = read_illum.read_depth(folder / f"{name}.illum", key[1])
            ours, theirs = float(numbers[8]), depths[key[:2]][y, x]
            checked += 1
            if ours != theirs and not abs(ours - theirs) < TOLERANCE:
                print(f"{line}: the example says the depth is {theirs}")
                return 1
        for ours, theirs in zip(map(float, rgb), pictures[key][y, x]):
            worst, checked = max(worst, abs(ours - theirs)), checked + 1
            if abs(ours - theirs) > TOLERANCE:
                print(f"{line}: the example says {pictures[key][y, x]}")
                return 1

    # The program's own way, as the manual shows it.
    shown = subprocess.run([sys.executable, reader, folder / "plain.illum", "0,0,1", "40,20"],
                           check=True, capture_output=True, text=True).stdout
    print(f"{checked} values within {worst:.1e}; {shown.strip()}")
    return 0 if checked > 100 and len(depths) > 10 and shown.startswith("40,20: ") else 1


if __name__ == "__main__":
    sys.exit(main())
