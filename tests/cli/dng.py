"""The smallest camera raw file: an uncompressed Adobe DNG 1.4 with an RGGB mosaic."""

import struct

import numpy as np

# XYZ to the camera's own colours; this camera's are linear sRGB's (IEC 61966-2-1).
COLOUR_MATRIX = (3.2404542, -1.5371385, -0.4985314, -0.9692660, 1.8760108, 0.0415560, 0.0556434,
                 -0.2040259, 1.0572252)
ASCII, BYTE, SHORT, LONG, RATIONAL, SIGNED_RATIONAL = 2, 1, 3, 4, 5, 10


def mosaic(linear):
    """One colour a pixel, 16 bits, white at 65535: red and green, below green and blue."""
    values = np.round(np.clip(linear, 0, 1) * 65535)
    out = values[:, :, 1].copy()
    out[0::2, 0::2] = values[0::2, 0::2, 0]
    out[1::2, 1::2] = values[1::2, 1::2, 2]
    return out.astype("<u2")


def packed(kind, values):
    if kind in (ASCII, BYTE):
        return bytes(values), len(values)
    if kind in (RATIONAL, SIGNED_RATIONAL):
        letter = "II" if kind == RATIONAL else "ii"
        return b"".join(struct.pack("<" + letter, round(v * 10000), 10000) for v in values), len(values)
    return struct.pack(f"<{len(values)}{'H' if kind == SHORT else 'I'}", *values), len(values)


def write_dng(path, linear):
    samples = mosaic(linear)
    height, width = samples.shape
    data = samples.tobytes()
    tags = [
        (254, LONG, [0]), (256, LONG, [width]), (257, LONG, [height]), (258, SHORT, [16]),
        (259, SHORT, [1]), (262, SHORT, [32803]), (271, ASCII, b"Test\0"),
        (272, ASCII, b"Camera\0"), (273, LONG, [0]), (274, SHORT, [1]), (277, SHORT, [1]),
        (278, LONG, [height]), (279, LONG, [len(data)]), (33421, SHORT, [2, 2]),
        (33422, BYTE, bytes([0, 1, 1, 2])), (50706, BYTE, bytes([1, 4, 0, 0])),
        (50707, BYTE, bytes([1, 1, 0, 0])), (50708, ASCII, b"Test Camera\0"),
        (50714, LONG, [0]), (50717, LONG, [65535]), (50721, SIGNED_RATIONAL, COLOUR_MATRIX),
        (50728, RATIONAL, [1, 1, 1]), (50778, SHORT, [21])]
    after_tags = 8 + 2 + 12 * len(tags) + 4
    entries, extra = [], b""
    for tag, kind, values in tags:
        raw, count = packed(kind, values)
        if len(raw) > 4:
            offset = after_tags + len(extra)
            extra += raw + b"\0" * (len(raw) % 2)
            raw = struct.pack("<I", offset)
        entries.append([tag, kind, count, raw.ljust(4, b"\0")])
    strip = struct.pack("<I", after_tags + len(extra))
    out = b"II*\0" + struct.pack("<I", 8) + struct.pack("<H", len(entries))
    for tag, kind, count, raw in entries:
        out += struct.pack("<HHI", tag, kind, count) + (strip if tag == 273 else raw)
    path.write_bytes(out + struct.pack("<I", 0) + extra + data)
