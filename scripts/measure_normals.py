#!/usr/bin/python3
"""The normals of an object against true ones, beside plain least squares on its photographs.

    scripts/measure_normals.py ILLUM STACK MASK NORMALS.npy OUT

STACK: photographs in linear light with lights.lp; NORMALS.npy: height x width x 3, x right, y up,
z toward the viewer. Needs numpy, Pillow and OpenImageIO's oiiotool. Prints a table in Markdown.
"""

import pathlib
import subprocess
import sys

import numpy as np
from PIL import Image


def read_lights(file):
    lines = [line.split() for line in file.read_text().splitlines()[1:] if line.strip()]
    lights = np.array([[float(v) for v in line[1:4]] for line in lines])
    return [line[0] for line in lines], lights / np.linalg.norm(lights, axis=1)[:, None]


def grey_floats(files, folder):
    """The mean of R, G and B of each file, by one run of oiiotool."""
    folder.mkdir(parents=True, exist_ok=True)
    third, command, outputs = 1 / 3, ["oiiotool"], []
    for file in files:
        outputs.append(folder / f"{file.stem}.tif")
        command += [file, "--ch", "R,G,B", f"--chsum:weight={third},{third},{third}", "-d", "float",
                    "-o", outputs[-1]]
    subprocess.run(command, check=True)
    return np.stack([np.asarray(Image.open(o), float) for o in outputs], axis=-1)


def least_squares(brightness, lights):
    """Woodham 1980, over all lights."""
    return np.linalg.lstsq(lights, brightness.T, rcond=None)[0].T


def read_normals(file, folder):
    channels = []
    for name in "RGB":
        channels.append(folder / f"normal_{name}.tif")
        subprocess.run(["oiiotool", file, "--ch", name, "-d", "float", "-o", channels[-1]],
                       check=True)
    return np.stack([np.asarray(Image.open(c), float) for c in channels], axis=-1)


def angles(normals, truth):
    length = np.linalg.norm(normals, axis=1)
    assert (length > 0).all(), "a pixel of the mask has no normal"
    cosine = (normals * truth).sum(axis=1) / length
    return np.degrees(np.arccos(np.clip(cosine, -1, 1)))


def main():
    illum, stack, mask_file, truth_file, out = map(pathlib.Path, sys.argv[1:])
    out.mkdir(parents=True, exist_ok=True)
    truth = np.load(truth_file)
    mask = (np.asarray(Image.open(mask_file).convert("L")) > 127) & (
        np.linalg.norm(truth, axis=2) > 0.5)

    names, lights = read_lights(stack / "lights.lp")
    photographs = grey_floats([stack / n for n in names], out / "grey")[mask]
    rows = [("least squares on the photographs", least_squares(photographs, lights))]

    built = out / "object.illum"
    subprocess.run([illum, "build", stack, "--mask", mask_file, "--transfer", "linear", "-o", built,
                    "--force"], check=True, stdout=subprocess.DEVNULL)
    for method in ("plain", "robust"):
        exr = out / f"{method}.exr"
        subprocess.run([illum, "normals", built, "--method", method, "-o", exr], check=True)
        rows.append((f"`illum normals --method {method}`", read_normals(exr, out)[mask]))

    print("| normals | mean angle | median | below 5° |\n|---|---|---|---|")
    for name, normals in rows:
        error = angles(normals, truth[mask])
        print(f"| {name} | {error.mean():.2f}° | {np.median(error):.2f}° "
              f"| {100 * (error < 5).mean():.0f} % |")


if __name__ == "__main__":
    main()
