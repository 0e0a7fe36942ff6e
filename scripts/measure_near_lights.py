#!/usr/bin/python3
"""What one depth a pixel costs under lights that are near: measure_near_lights.py ILLUM OUT

Two built-in scenes are built twice, coarse and four times as fine, with a basis that is linear in
the samples, so that under a distant light the mean of the fine pixels is the coarse pixel but for
the noise of rendering. Under a near light each fine pixel has its own direction and falloff; the
mean of these is the truth for the coarse pixel, which has one depth for all.
"""

import pathlib
import subprocess
import sys

import numpy as np
from PIL import Image

COARSE, FINE = 128, 512
ENDS = 0.06  # standard deviation, in linear light, within a pixel
LIGHTS = {"distant": ["--light", "-0.75,0.95,0.75"],
          "near": ["--point", "-0.75,0.95,0.75,2.03,2.03,2.03"]}


def read(file):
    planes = []
    for name in "RGBA":
        plane = file.with_suffix(f".{name}.tif")
        subprocess.run(["oiiotool", file, "--ch", name, "-d", "float", "-o", plane], check=True,
                       capture_output=True)
        planes.append(np.asarray(Image.open(plane), float))
    return np.dstack(planes)


def shrunk(picture, size, axis):
    """Means over `size` equal parts, which need not be of whole pixels."""
    edges = np.linspace(0, picture.shape[axis], size + 1)
    sums = np.concatenate([np.zeros_like(np.take(picture, [0], axis)), np.cumsum(picture, axis)],
                          axis)
    low = np.minimum(np.floor(edges).astype(int), picture.shape[axis] - 1)
    part = np.expand_dims(edges - low, tuple(a for a in range(picture.ndim) if a != axis))
    at = (1 - part) * np.take(sums, low, axis) + part * np.take(sums, low + 1, axis)
    return np.diff(at, axis=axis) * size / picture.shape[axis]


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__.splitlines()[0])
    illum, out = sys.argv[1], pathlib.Path(sys.argv[2])
    out.mkdir(parents=True, exist_ok=True)
    print("| scene | light | rms | rms where surfaces end | rms elsewhere | beyond 0.05 |")
    print("| --- | --- | --- | --- | --- | --- |")
    for scene in ("box", "bear"):
        for size, samples in ((COARSE, 64), (FINE, 4)):
            if not (out / f"{scene}{size}.illum").exists():
                subprocess.run([illum, "build", f"builtin:{scene}", "-o",
                                out / f"{scene}{size}.illum", "--uv", "1x1", "--size", str(size),
                                "--light-count", "64", "--samples", str(samples), "--basis", "sh",
                                "--coefficients", "36", "--coding", "png"], check=True,
                               capture_output=True)
        for name, light in LIGHTS.items():
            pictures = []
            for size in (COARSE, FINE):
                file = out / "relit.exr"
                subprocess.run([illum, "relight", out / f"{scene}{size}.illum", *light, "-o", file],
                               check=True)
                pictures.append(read(file))
            coarse, fine = pictures
            truth = shrunk(shrunk(fine, coarse.shape[0], 0), coarse.shape[1], 1)
            error = np.sqrt(np.mean((coarse - truth)[..., :3] ** 2, axis=2))
            ends = outlines(fine, coarse.shape)
            rms = [np.sqrt(np.mean(error[where] ** 2)) for where in (error >= 0, ends, ~ends)]
            print(f"| {scene} | {name} | " + " | ".join(f"{r:.4f}" for r in rms) +
                  f" | {100 * np.mean(error > 0.05):.2f} % |")


def outlines(fine, shape):
    """Coarse pixels whose fine ones differ much: outlines, edges, hair."""
    grey = fine[..., :3].mean(axis=2, keepdims=True)
    mean, square = (shrunk(shrunk(p, shape[0], 0), shape[1], 1)[..., 0] for p in (grey, grey**2))
    return np.sqrt(np.maximum(square - mean**2, 0)) > ENDS


if __name__ == "__main__":
    main()
