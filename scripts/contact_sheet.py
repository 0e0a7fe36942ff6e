#!/usr/bin/python3
"""Puts pictures of one size side by side: contact_sheet.py OUT COLUMNS WIDTH PICTURE…

COLUMNS pictures a row, each scaled to WIDTH pixels.
"""

import sys

from PIL import Image

GAP = 4
GROUND = (24, 24, 24)


def on_ground(picture):
    """What a transparent picture looks like on the sheet."""
    picture = picture.convert("RGBA")
    ground = Image.new("RGBA", picture.size, GROUND)
    return Image.alpha_composite(ground, picture).convert("RGB")


def main():
    if len(sys.argv) < 5:
        sys.exit(__doc__.splitlines()[0])
    out, columns, width = sys.argv[1], int(sys.argv[2]), int(sys.argv[3])
    pictures = [on_ground(Image.open(name)) for name in sys.argv[4:]]
    height = round(width * pictures[0].height / pictures[0].width)
    rows = -(-len(pictures) // columns)
    size = (columns * (width + GAP) - GAP, rows * (height + GAP) - GAP)
    sheet = Image.new("RGB", size, GROUND)
    for index, picture in enumerate(pictures):
        corner = (index % columns * (width + GAP), index // columns * (height + GAP))
        sheet.paste(picture.resize((width, height), Image.LANCZOS), corner)
    sheet.save(out, quality=80, optimize=True)


if __name__ == "__main__":
    main()
