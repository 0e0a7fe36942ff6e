"""OpenEXR files of halves, written and read byte by byte ("OpenEXR File Layout"), because Python has no
library for them here: single part, scan lines, no compression for writing."""

import struct

import numpy as np


def attribute(name, kind, value):
    return name.encode() + b"\0" + kind.encode() + b"\0" + struct.pack("<i", len(value)) + value


def write_half_exr(file, picture):
    """`picture`: height x width x 3 of float16; every bit pattern is kept."""
    height, width, _ = picture.shape
    box = struct.pack("<4i", 0, 0, width - 1, height - 1)
    channels = b"".join(c.encode() + b"\0" + struct.pack("<iB3xii", 1, 0, 1, 1) for c in "BGR") + b"\0"
    header = struct.pack("<ii", 20000630, 2) + b"".join([
        attribute("channels", "chlist", channels), attribute("compression", "compression", b"\0"),
        attribute("dataWindow", "box2i", box), attribute("displayWindow", "box2i", box),
        attribute("lineOrder", "lineOrder", b"\0"),
        attribute("pixelAspectRatio", "float", struct.pack("<f", 1)),
        attribute("screenWindowCenter", "v2f", struct.pack("<2f", 0, 0)),
        attribute("screenWindowWidth", "float", struct.pack("<f", 1))]) + b"\0"
    row_bytes = 6 * width
    first = len(header) + 8 * height
    rows = [struct.pack("<Q", first + y * (8 + row_bytes)) for y in range(height)]
    for y in range(height):
        planes = [np.ascontiguousarray(picture[y, :, c]).tobytes() for c in (2, 1, 0)]
        rows.append(struct.pack("<ii", y, row_bytes) + b"".join(planes))
    file.write_bytes(header + b"".join(rows))
