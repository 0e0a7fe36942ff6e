#!/usr/bin/env python3
"""read_illum.py OBJECT.illum X,Y,Z [COLUMN,ROW ...]

Relights an object's first view (PNG coding, level 0) under one light of intensity 1 from direction X,Y,Z
and prints the linear RGB of the pixels asked for. Written from docs/format.md alone, to be read beside it:
plain loops, no checks of hostile input. Needs numpy and PIL."""
import io
import json
import math
import sys
import zipfile
import zlib

import numpy as np
from PIL import Image


def reachable_samples(n):
    """Which samples of a square interpolation can touch (format.md, "Samples that are coded")."""
    mask, radius = np.zeros((n + 2, n + 2), bool), n - 1
    distance = [max(0, 2 * i - radius, radius - (2 * i + 2)) for i in range(n - 1)]
    for j in range(n - 1):
        for i in range(n - 1):
            if distance[i] ** 2 + distance[j] ** 2 <= radius ** 2:
                mask[j:j + 4, i:i + 4] = True
    return mask


def coding_order(n):
    """(level, row, column, along the row) of every sample that is coded, in order."""
    side, mask = n + 2, reachable_samples(n)
    centre = side // 2
    top = centre.bit_length() - 1
    yield top + 1, centre, centre, True
    for level in range(top, -1, -1):
        stride = 1 << level
        for along_row in (True, False):
            for row in range(centre % stride, side, stride):
                if (row - centre >> level) % 2 == along_row:
                    continue
                for column in range(centre % stride, side, stride):
                    odd = (column - centre >> level) % 2 == 1
                    if (odd or not along_row) and mask[row, column]:
                        yield level, row, column, along_row


def predict(field, mask, level, row, column, along_row):
    """From samples known already, `field[row, column]` holding one integer per column and square."""
    side, stride = mask.shape[0], 1 << level
    inward = -1 if (column if along_row else row) > side // 2 else 1

    def at(multiple):
        r, c = (row, column + multiple * stride) if along_row else (row + multiple * stride, column)
        return (r, c) if 0 <= r < side and 0 <= c < side and mask[r, c] else None

    def v(multiple):
        return field[at(inward * multiple)]

    if at(-inward):
        if at(3 * inward) and at(-3 * inward):
            return 9 * (v(1) + v(-1)) - v(3) - v(-3) + 8 >> 4
        if at(3 * inward):
            return 6 * v(1) + 3 * v(-1) - v(3) + 4 >> 3
        return v(1) + v(-1) + 1 >> 1
    if at(3 * inward) and at(5 * inward):
        return 15 * v(1) - 10 * v(3) + 3 * v(5) + 4 >> 3
    if at(3 * inward):
        return 3 * v(1) - v(3) + 1 >> 1
    return v(1)


def read_table(data):
    """values[square, column, row, col] and the south pole's constants of one table of basis.bin."""
    assert data[:5] == b"ILBT\x01"
    sphere, n = data[5], int.from_bytes(data[6:8], "little")
    columns, width = int.from_bytes(data[8:12], "little"), data[12]
    squares, poles = 1 + sphere, 0 if sphere else columns
    payload = np.frombuffer(zlib.decompress(data[20:]), np.uint8)
    heads, payload = payload[:5 * columns].reshape(5, columns).T.tolist(), payload[5 * columns:]
    zigzag = sum(byte.astype(np.int64) << 8 * (width - 1 - b)
                 for b, byte in enumerate(payload.reshape(width, -1)))
    codes = np.where(zigzag % 2, -(zigzag // 2) - 1, zigzag // 2)

    mask, order = reachable_samples(n), list(coding_order(n))
    field = np.zeros((n + 2, n + 2, columns, squares), np.int64)
    start = poles
    for level in sorted({step[0] for step in order}, reverse=True):
        steps = [step for step in order if step[0] == level]
        block = codes[start:start + columns * squares * len(steps)]
        start += block.size
        block = block.reshape(columns, squares, len(steps))
        units = 16 >> level if level < 4 else 1
        for i, (_, row, column, along_row) in enumerate(steps):
            guess = 0 if level == order[0][0] else predict(field, mask, level, row, column, along_row)
            field[row, column] = guess + units * block[:, :, i]
    middle = (n + 1) // 2
    pole = (field[1, middle] + field[middle, 1] + field[middle, n] + field[n, middle] + 2 >> 2)[:, 0]
    pole = pole + 16 * codes[:poles] if poles else pole

    values = np.zeros((squares, columns, n + 2, n + 2), np.float32)
    south = np.zeros(columns, np.float32)
    for c in range(columns):
        s_low, s_high, w_low, w_high, r = heads[c]
        s, w = s_low | s_high << 8, w_low | w_high << 8
        unit = math.ldexp(16 + (s & 15), (s >> 4) - 96)
        weight = (w - 65536 if w > 32767 else w) / 1024
        values[:, c] = np.moveaxis(field[:, :, c], 2, 0) * unit + weight * values[:, c - r].astype(float)
        south[c] = pole[c] * unit + weight * float(south[c - r])
    return values, south


def interpolate(values, square, x, y):
    """Catmull-Rom at chart point x, y."""
    n = values.shape[2] - 2
    u, v = x * (n - 1), y * (n - 1)
    i, j = min(max(int(u), 0), n - 2), min(max(int(v), 0), n - 2)

    def weights(t):
        return np.array([-t + 2 * t**2 - t**3, 2 - 5 * t**2 + 3 * t**3,
                         t + 4 * t**2 - 3 * t**3, -t**2 + t**3]) / 2

    return np.einsum("j,cji,i->c", weights(v - j), values[square, :, j:j + 4, i:i + 4], weights(u - i))


def table_at(values, south, light):
    """Every column's value for a light from the unit vector `light`."""
    x, y, z = light
    if z >= 0 or values.shape[0] == 2:
        scale = 0.5 / (1 + abs(z))
        return interpolate(values, 0 if z >= 0 else 1, 0.5 + x * scale, 0.5 + y * scale)
    horizontal = math.hypot(x, y)
    if horizontal == 0:
        return south.astype(float)
    equator = interpolate(values, 0, 0.5 + 0.5 * x / horizontal, 0.5 + 0.5 * y / horizontal)
    share = 2 * math.acos(z) / math.pi - 1
    return (1 - share) * equator + share * south


def mesh_at(data, light):
    """The exact basis: the weight of every light's picture for a light from the unit vector `light`."""
    assert data[:5] == b"ILBD\x01"
    lights, closing = np.frombuffer(data, "<u4", 2, 8)
    count = int(lights + closing)
    sites = np.frombuffer(data, "<f8", 3 * count, 16).reshape(count, 3)
    triangles = np.frombuffer(data, "<u2", offset=16 + 24 * count).reshape(-1, 3).astype(int)
    shares = np.zeros(count)
    nearest = np.linalg.norm(sites - light, axis=1)
    if nearest.min() < 1e-6:
        shares[nearest.argmin()] = 1
    else:
        # Barycentric coordinates in every triangle; the one that the light lies in has none below 0.
        all_shares = np.linalg.solve(sites[triangles].transpose(0, 2, 1),
                                     np.broadcast_to(light, (len(triangles), 3))[:, :, None])[:, :, 0]
        inside = all_shares.min(axis=1).argmax()
        shares[triangles[inside]] = all_shares[inside].clip(0) / all_shares[inside].clip(0).sum()
    weights = shares[:lights].copy()
    for site in range(lights, count):
        around = {int(corner) for triangle in triangles if site in triangle for corner in triangle}
        around = [corner for corner in around if corner < lights] or list(range(lights))
        weights[around] += shares[site] / len(around)
    return weights


def layout(planes, width, height, split):
    """Cell size and number of columns of a tile's atlas."""
    cell_w, cell_h = -(-width // 8) * 8, -(-height // 8) * 8
    cells = -(-planes // 3) * (2 if split else 1)
    columns = min(range(1, cells + 1), key=lambda c: max(c * cell_w, -(-cells // c) * cell_h))
    return cell_w, cell_h, columns


def read_tile(png, planes, width, height, split):
    """codes[plane, row, column]."""
    atlas = np.asarray(Image.open(io.BytesIO(png)).convert("RGB")).astype(int)
    cell_w, cell_h, columns = layout(planes, width, height, split)

    def cell(index):
        y, x = index // columns * cell_h, index % columns * cell_w
        return atlas[y:y + height, x:x + width]

    codes = np.stack([cell(k // 3)[:, :, k % 3] for k in range(planes)])
    if split:
        low = -(-planes // 3)
        codes = codes * 256 + np.stack([cell(low + k // 3)[:, :, k % 3] for k in range(planes)])
    return codes


def read_manifest(archive):
    manifest = json.loads(archive.read("object.json"))
    assert manifest["format"] == "illum" and manifest["version"][0] == 1
    return manifest


def picture_of(manifest, group):
    """What says the view's size; for a slab's view also its frame."""
    geometry = group["geometry"]
    return manifest["slabs"][geometry["slab"]] if geometry["kind"] == "slab" else (
        geometry if geometry["kind"] == "photograph" else geometry[geometry["kind"]])


def tiles(manifest, group):
    """(name, top, left, height, width) of the tiles of level 0."""
    size, tile = picture_of(manifest, group)["size"], manifest["tile"]
    for y in range(0, size["height"], tile):
        for x in range(0, size["width"], tile):
            yield (f"{x // tile}_{y // tile}", y, x, min(tile, size["height"] - y),
                   min(tile, size["width"] - x))


def read_depth(path, index):
    """rows x columns, infinite where the view shows nothing."""
    archive = zipfile.ZipFile(path)
    manifest = read_manifest(archive)
    group = manifest["groups"][index]
    size, depth = picture_of(manifest, group)["size"], group["depth"]
    out = np.empty((size["height"], size["width"]))
    for name, y, x, h, w in tiles(manifest, group):
        samples = np.asarray(Image.open(io.BytesIO(archive.read(f"depth/{index}/0/{name}.png"))))
        grey = depth["steps"] <= 254
        code = samples.astype(int) if grey else samples[:, :, 0] * 256 + samples[:, :, 1].astype(int)
        values = depth["from"] + (depth["to"] - depth["from"]) * code / depth["steps"]
        out[y:y + h, x:x + w] = np.where(code == (255 if grey else 65535), np.inf, values)
    return out


def relight(path, light, index=0):
    """Linear RGB, rows x columns x 3, of the view with that index."""
    archive = zipfile.ZipFile(path)
    manifest = read_manifest(archive)
    coding, group = manifest["coding"], manifest["groups"][index]
    assert coding["name"] == "png"

    # The light in the group's frame: the rotation's inverse is its transpose.
    light = np.array(light) / np.linalg.norm(light)
    if group["geometry"]["kind"] == "slab":
        pose = picture_of(manifest, group)["objectFromSlab"]
        light = np.array(pose["rotation"]).reshape(3, 3).T @ light

    basis = manifest["bases"][group["basis"]]
    first = basis["tableOffset"]
    table = archive.read("basis.bin")[first:first + basis["tableBytes"]]
    column = mesh_at(table, light) if basis["kind"] == "exact" else table_at(*read_table(table), light)
    if basis["kind"] == "full":
        b, mean = column[:-3].reshape(-1, 3), column[-3:]
    else:
        matrix = np.array(basis["colourMatrix"]).reshape(3, 3)
        b, mean = np.concatenate([scalar * matrix.T for scalar in column]), np.zeros(3)

    size = picture_of(manifest, group)["size"]
    out = np.empty((size["height"], size["width"], 3))
    for name, y, x, h, w in tiles(manifest, group):
        codes = read_tile(archive.read(f"planes/{index}/0/{name}.png"), len(basis["offsets"]), w, h,
                          coding["bits"] > 8)
        s = np.array(basis["offsets"])[:, None, None] + coding["step"] * codes
        plane = (codes.astype(np.uint16).view(np.float16) if coding["curve"] == "half" else
                 s if coding["curve"] == "linear" else s * np.abs(s))
        colour = mean + np.einsum("khw,kc->hwc", plane, b[basis["functions"]])
        if manifest["response"] == "display":
            colour = np.clip(colour, 0, 1)
            colour = np.where(colour <= 0.04045, colour / 12.92, ((colour + 0.055) / 1.055) ** 2.4)
        elif manifest["response"] == "cone":
            colour = np.maximum(colour, 0)
        if manifest.get("mask", False):
            mask = Image.open(io.BytesIO(archive.read(f"mask/{index}/0/{name}.png")))
            colour = colour * (np.asarray(mask)[:, :, None] / 255)
        out[y:y + h, x:x + w] = colour
    return out


def main():
    path, light, *pixels = sys.argv[1:]
    picture = relight(path, [float(v) for v in light.split(",")])
    for pixel in pixels:
        column, row = map(int, pixel.split(","))
        print(f"{pixel}: " + " ".join(f"{v:.6f}" for v in picture[row, column]))


if __name__ == "__main__":
    main()
