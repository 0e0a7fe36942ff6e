#!/usr/bin/python3
"""Puts pictures of one size side by side: contact_sheet.py OUT COLUMNS WIDTH PICTURE…

COLUMNS pictures a row, each scaled to WIDTH pixels.
"""

import sys

from PIL import Image

GAP = 4


def main():
    if len(sys.argv) < 5:
        sys.exit(__doc__.splitlines()[0])
    out, columns, width = sys.argv[1], int(sys.argv[2]), int(sys.argv[3])
    pictures = [Image.open(name).convert("RGB") for name in sys.argv[4:]]
    height = round(width * pictures[0].height / pictures[0].width)
    rows = -(-len(pictures) // columns)
    size = (columns * (width + GAP) - GAP, rows * (height + GAP) - GAP)
    sheet = Image.new("RGB", size, (24, 24, 24))
    for index, picture in enumerate(pictures):
        corner = (index % columns * (width + GAP), index // columns * (height + GAP))
        sheet.paste(picture.resize((width, height), Image.LANCZOS), corner)
    sheet.save(out, quality=90, optimize=True)


if __name__ == "__main__":
    main()
