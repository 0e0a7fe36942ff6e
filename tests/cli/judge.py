#!/usr/bin/python3
"""Judges relit pictures by the photographs, independently of Illumigraph: numpy and Pillow alone.

    judge.py RELIT_FOLDER PHOTOGRAPHS_FOLDER [--lights FILE.lp] [--holdout K] [--ssim] [--json]

RELIT_FOLDER holds STEM.png for every photograph STEM.* that the light file names, as
`illum relight --lights` writes them. Figures are over 8-bit sRGB values, per light over all pixels and
channels, then the mean over lights; identical pictures have 99 dB (docs/quality.md).
"""

import argparse
import json
import pathlib
import sys

import numpy as np
from PIL import Image

MAX_PSNR = 99.0


def light_file_names(path):
    """The photographs' names, in order: every line is NAME x y z, after an optional count."""
    lines = [line.strip() for line in path.read_text().splitlines()]
    lines = [line for line in lines if line and not line.startswith("#")]
    if lines and len(lines[0].split()) == 1:
        lines = lines[1:]
    return [pathlib.PureWindowsPath(line.rsplit(None, 3)[0]).name for line in lines]


def encode(linear):
    """The sRGB transfer function of IEC 61966-2-1."""
    linear = np.clip(linear, 0, 1)
    return np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)


def decode(encoded):
    return np.where(encoded <= 0.04045, encoded / 12.92, ((encoded + 0.055) / 1.055) ** 2.4)


def to_bytes(unit):
    return np.floor(255 * np.clip(unit, 0, 1) + 0.5)


def as_rgb(values):
    """Grey, grey and alpha, RGB or RGBA to RGB and alpha or None."""
    if values.ndim == 2:
        values = values[:, :, None]
    channels = values.shape[2]
    alpha = values[:, :, -1:] if channels in (2, 4) else None
    colour = values[:, :, : 1 if channels <= 2 else 3]
    return np.broadcast_to(colour, (*colour.shape[:2], 3)), alpha


def read_16_bits(path):
    """A 16-bit RGB PNG. Pillow reduces it to 8 bits: reading it as big- and as little-endian
    gives the high and the low bytes."""
    halves = []
    for raw_mode in ("RGB;16B", "RGB;16L"):
        image = Image.open(path)
        codec, box, offset, _ = image.tile[0]
        image.tile = [(codec, box, offset, raw_mode)]
        halves.append(np.asarray(image, np.float64))
    return (256 * halves[0] + halves[1]) / 65535


def read_unit(path):
    """Values in [0, 1] as they stand in the file, and whether it says that they are linear (gAMA 1)."""
    image = Image.open(path)
    linear = abs(image.info.get("gamma", 0) - 1) < 1e-4
    raw_mode = image.tile[0][3] if image.tile else ""
    if raw_mode == "RGB;16B":
        return read_16_bits(path), linear
    if image.mode.startswith("I"):
        return np.asarray(image, np.float64) / 65535, linear
    if image.mode == "P":
        image = image.convert("RGBA" if "transparency" in image.info else "RGB")
    return np.asarray(image, np.float64) / 255, linear


def over_black(encoded, coverage):
    """What an encoded picture shows in front of black, with straight coverage."""
    return encoded if coverage is None else encode(decode(encoded) * coverage)


def read_relit(path):
    return over_black(*as_rgb(read_unit(path)[0]))


def read_photograph(path, mask, transfer):
    """Encoded, over black. sRGB unless the file or `transfer` says otherwise."""
    unit, linear = read_unit(path)
    colour, alpha = as_rgb(unit)
    if transfer:
        linear = transfer == "linear"
    return over_black(encode(colour) if linear else colour, alpha if mask is None else mask)


def psnr(picture, truth):
    error = np.mean((to_bytes(picture) - to_bytes(truth)) ** 2)
    return MAX_PSNR if error == 0 else min(MAX_PSNR, 10 * np.log10(255**2 / error))


def blur(image):
    """The 11-tap Gaussian of Wang et al. 2004 along both axes, where it fits wholly."""
    weights = np.exp(-0.5 * (np.arange(-5, 6) / 1.5) ** 2)
    weights /= weights.sum()
    for axis in (0, 1):
        length = image.shape[axis] - 10
        image = sum(w * image.take(range(t, t + length), axis) for t, w in enumerate(weights))
    return image


def ssim(picture, truth):
    """Wang et al. 2004, equation 13, on BT.709 luma of the encoded bytes."""
    x, y = (to_bytes(p) @ np.array([0.2126, 0.7152, 0.0722]) for p in (picture, truth))
    mean_x, mean_y = blur(x), blur(y)
    var_x, var_y = blur(x * x) - mean_x**2, blur(y * y) - mean_y**2
    covariance = blur(x * y) - mean_x * mean_y
    c1, c2 = (0.01 * 255) ** 2, (0.03 * 255) ** 2
    return np.mean((2 * mean_x * mean_y + c1) * (2 * covariance + c2)
                   / ((mean_x**2 + mean_y**2 + c1) * (var_x + var_y + c2)))


def judge(relit, photographs, lights, holdout, mask, transfer, with_ssim=False):
    """One row a light: name, held out or not, PSNR and, if wanted, SSIM."""
    coverage = None if mask is None else as_rgb(read_unit(mask)[0])[0][:, :, :1]
    rows = []
    for index, name in enumerate(light_file_names(lights)):
        picture = read_relit(relit / (pathlib.Path(name).stem + ".png"))
        truth = read_photograph(photographs / name, coverage, transfer)
        if picture.shape != truth.shape:
            sys.exit(f"{name}: photograph is {truth.shape}, relit picture {picture.shape}")
        row = {"name": name, "heldOut": holdout > 0 and index % holdout == holdout - 1,
               "psnr": psnr(picture, truth)}
        if with_ssim:
            row["ssim"] = ssim(picture, truth)
        rows.append(row)
    return rows


def mean(rows, held_out, key="psnr"):
    figures = [row[key] for row in rows if row["heldOut"] == held_out]
    return {"lights": len(figures), key: float(np.mean(figures)) if figures else None}


def summary(rows):
    keys = [key for key in ("psnr", "ssim") if rows and key in rows[0]]
    merged = {"used": {}, "heldOut": {}}
    for part, held_out in (("used", False), ("heldOut", True)):
        for key in keys:
            merged[part].update(mean(rows, held_out, key))
    return merged


def find_lights(folder):
    found = sorted(folder.glob("*.lp"))
    if len(found) != 1:
        sys.exit(f"{folder}: expected one .lp file, found {len(found)}")
    return found[0]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("relit", type=pathlib.Path)
    parser.add_argument("photographs", type=pathlib.Path)
    parser.add_argument("--lights", type=pathlib.Path, help="default: the .lp file in the folder")
    parser.add_argument("--holdout", type=int, default=0, help="lights K-1, 2K-1, ... were left out")
    parser.add_argument("--mask", type=pathlib.Path, help="default: the photographs' own alpha")
    parser.add_argument("--transfer", choices=["linear", "srgb"], help="default: as the files say")
    parser.add_argument("--ssim", action="store_true")
    parser.add_argument("--json", action="store_true")
    options = parser.parse_args()

    lights = options.lights or find_lights(options.photographs)
    rows = judge(options.relit, options.photographs, lights, options.holdout, options.mask,
                 options.transfer, options.ssim)
    result = summary(rows)
    if options.json:
        json.dump({**result, "lights": rows}, sys.stdout, indent=2)
        print()
        return
    for part, label in (("used", "used"), ("heldOut", "held out")):
        if result[part].get("lights"):
            figures = "  ".join(f"{key} {result[part][key]:.4f}" for key in ("psnr", "ssim")
                                if key in result[part])
            print(f"{label:9} {result[part]['lights']:4} lights  {figures}")


if __name__ == "__main__":
    main()
