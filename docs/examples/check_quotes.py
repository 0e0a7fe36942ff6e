#!/usr/bin/env python3
"""check_quotes.py EXAMPLES DOCUMENT...: every ```cpp block of the documents must stand, line by line and
apart from its indentation, in one of the programs in EXAMPLES."""
import pathlib
import sys
import textwrap


def blocks(text):
    """(line number, source) of each ```cpp block."""
    block, start = None, 0
    for number, line in enumerate(text.splitlines(), 1):
        if block is None and line.strip() == "```cpp":
            block, start = [], number
        elif block is not None and line.strip() == "```":
            yield start, block
            block = None
        elif block is not None:
            block.append(line)
    if block is not None:
        yield start, block


def dedented(lines):
    return textwrap.dedent("\n".join(lines)).splitlines()


def stands_in(block, program):
    wanted = dedented(block)
    return any(dedented(program[i:i + len(wanted)]) == wanted
               for i in range(len(program) - len(wanted) + 1))


def main():
    examples, *documents = map(pathlib.Path, sys.argv[1:])
    programs = [p.read_text().splitlines() for p in sorted(examples.glob("*.cpp"))]
    quotes, strangers = 0, 0
    for document in documents:
        for line, block in blocks(document.read_text()):
            quotes += 1
            if not block or not any(stands_in(block, program) for program in programs):
                strangers += 1
                print(f"{document}:{line}: this code is in no program of {examples}")
    if quotes == 0:
        print("no quotes found")
    return 1 if strangers or quotes == 0 else 0


if __name__ == "__main__":
    sys.exit(main())
