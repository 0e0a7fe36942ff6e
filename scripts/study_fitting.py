#!/usr/bin/env python3
"""The study behind docs/math/fitting.md: which interpolator between lights, which criterion, which planes.

    scripts/study_fitting.py SHARED/data

Needs NumPy and Pillow. Everything follows from second moments over a third of the pixels: errors are
mean squares before clamping and rounding, in dB, the mean over the lights that were left out, and then
over five folds (every fifth light, from the first, second, ... on). Not the program's code: written apart,
so that the two check each other.
"""

import sys
from math import factorial, pi
from pathlib import Path

import numpy as np
from PIL import Image

STACKS = [
    "realrti01_door",
    "realrti03_icon_michele",
    "realrti08_clay_shell",
    "realrti09_coin_a",
    "realrti11_metal_statue_a",
    "diligent_cat",
    "harvardps_scholar",
]
NUGGETS = 10.0 ** np.arange(-5, 0.6, 0.5)
SPLINE_ORDERS = (1.25, 1.5, 1.75, 2.0, 2.5, 3.0)
LENGTHS = (0.25, 0.5, 1.0, 2.0, 4.0)
PLANES = (9, 18, 27, 36, 45)


def load(folder):
    """Light directions (lights x 3), samples (3 lights x pixels), by channel."""
    lines = (folder / "lights.lp").read_text().splitlines()
    entries = [line.rsplit(None, 3) for line in lines[1 : 1 + int(lines[0])]]
    directions = np.array([[float(v) for v in e[1:]] for e in entries])
    directions /= np.linalg.norm(directions, axis=1)[:, None]
    pictures = []
    for entry in entries:
        pixels = np.asarray(Image.open(folder / entry[0]).convert("RGB")).reshape(-1, 3)
        pictures.append(pixels[:: max(3, len(pixels) // 70000)])
    samples = np.stack(pictures).transpose(2, 0, 1).reshape(3 * len(entries), -1)
    return directions, samples.astype(np.float32) / 255


def harmonics(d, order):
    """Real spherical harmonics up to the order, as in Wong et al. 1997, section 4.1."""
    z, sine = d[:, 2], np.sqrt(np.maximum(0, 1 - d[:, 2] ** 2))
    phi = np.arctan2(d[:, 1], d[:, 0])
    p = {(0, 0): np.ones(len(d))}
    for m in range(order + 1):
        if m > 0:
            p[m, m] = (2 * m - 1) * sine * p[m - 1, m - 1]
        for l in range(m + 1, order + 1):
            lower = p[l - 2, m] if l >= m + 2 else 0
            p[l, m] = ((2 * l - 1) * z * p[l - 1, m] - (l + m - 1) * lower) / (l - m)
    columns = []
    for l in range(order + 1):
        for m in range(-l, l + 1):
            n = np.sqrt((2 * l + 1) / (2 * pi) * factorial(l - abs(m)) / factorial(l + abs(m)))
            azimuth = np.cos(m * phi) if m > 0 else np.sin(-m * phi) if m < 0 else 0.5**0.5
            columns.append(n * p[l, abs(m)] * azimuth)
    return np.stack(columns, 1)


def kernel(kind, parameter, a, b):
    cosine = np.clip(a @ b.T, -1, 1)
    angle = np.arccos(cosine)
    if kind == "exponential":
        return np.exp(-angle / parameter)
    if kind == "matern 3/2":
        r = 2 * np.sin(angle / 2) * 3**0.5 / parameter
        return (1 + r) * np.exp(-r)
    degrees = np.arange(1, 31)
    coefficients = np.r_[0, (2 * degrees + 1) / (degrees * (degrees + 1.0)) ** parameter]
    return np.polynomial.legendre.legval(cosine, coefficients / coefficients.sum())


def candidates(kind):
    parameters = SPLINE_ORDERS if kind == "spline" else LENGTHS
    return [(kind, p, t, n) for p in parameters for t in range(4) for n in NUGGETS]


def bordered_inverse(c, lights):
    kind, parameter, trend, nugget = c
    f = harmonics(lights, trend)
    n, t = f.shape
    a = np.zeros((n + t, n + t))
    a[:n, :n] = kernel(kind, parameter, lights, lights) + (nugget + 1e-10) * np.eye(n)
    a[:n, n:], a[n:, :n] = f, f.T
    return np.linalg.inv(a)


def weights(c, inverse, lights, where):
    """One row per direction: universal kriging."""
    right = np.concatenate([kernel(c[0], c[1], where, lights), harmonics(where, c[2])], 1)
    return (right @ inverse)[:, : len(lights)]


def decibels(errors):
    return np.mean(-10 * np.log10(np.maximum(errors, 1e-12)))


def quadratic(rows, gram):
    return np.maximum(np.einsum("ij,jk,ik->i", rows, gram, rows), 0)


def leave_one_out(inverse, gram):
    """Dubrule 1983: the upper left block of the bordered inverse is Q."""
    q = inverse[: len(gram), : len(gram)]
    return quadratic(q / np.diag(q)[:, None], gram)


def mean_over_channels(moments, lights):
    return sum(moments[c * lights :][:lights, c * lights :][:, :lights] for c in range(3)) / 3


def folds(count):
    for f in (4, 0, 1, 2, 3):
        held = np.arange(f, count, 5)
        yield np.setdiff1d(np.arange(count), held), held


def judge_candidates(directions, gram):
    """For every fold and candidate: (criterion by leave-one-out, error of held-out lights)."""
    table = {}
    for fold, (used, held) in enumerate(folds(len(directions))):
        for kind in ("exponential", "matern 3/2", "spline"):
            for c in candidates(kind):
                if (c[2] + 1) ** 2 >= len(used):
                    continue
                inverse = bordered_inverse(c, directions[used])
                loo = leave_one_out(inverse, gram[np.ix_(used, used)])
                w = weights(c, inverse, directions[used], directions[held])
                both = np.r_[held, used]
                error = quadratic(np.c_[np.eye(len(held)), -w], gram[np.ix_(both, both)])
                table[fold, c] = (decibels(loo), -10 * np.log10(np.mean(loo)), decibels(error))
    return table


def mean_choice(table, chooser, keep):
    """Mean over folds of the held-out figure of the candidate that is best by column `chooser`."""
    figures = []
    for fold in range(5):
        rows = [v for (f, c), v in table.items() if f == fold and keep(c)]
        figures.append(max(rows, key=lambda v: v[chooser])[2])
    return np.mean(figures)


def interpolation_study(stacks):
    print("Held-out dB, mean of five folds; chosen by leave-one-out unless said otherwise")
    columns = {
        "exponential": (0, lambda c: c[0] == "exponential"),
        "matern 3/2": (0, lambda c: c[0] == "matern 3/2"),
        "spline 2": (0, lambda c: c[:2] == ("spline", 2.0)),
        "spline, trend 0": (0, lambda c: c[0] == "spline" and c[2] == 0),
        "spline, trend <= 2": (0, lambda c: c[0] == "spline" and c[2] <= 2),
        "spline, trend <= 3": (0, lambda c: c[0] == "spline"),
        "all": (0, lambda c: True),
        "all, by mean square": (1, lambda c: True),
        "all, best in hindsight": (2, lambda c: True),
    }
    print("| stack | " + " | ".join(columns) + " |\n|" + "---|" * (len(columns) + 1))
    rows = []
    for name, (directions, moments, _) in stacks.items():
        gram = mean_over_channels(moments, len(directions))
        table = judge_candidates(directions, gram)
        rows.append([mean_choice(table, *column) for column in columns.values()])
        print(f"| {name} | " + " | ".join(f"{v:.2f}" for v in rows[-1]) + " |")
    print("| mean | " + " | ".join(f"{v:.2f}" for v in np.mean(rows, 0)) + " |\n")


def cap_nodes(z_least):
    i = np.arange(1500) + 0.5
    z, phi = 1 - (1 - z_least) * i / 1500, i * pi * (3 - 5**0.5)
    r = np.sqrt(1 - z * z)
    return np.stack([r * np.cos(phi), r * np.sin(phi), z], 1)


def by_channel(block):
    return np.kron(np.eye(3), block)


def fold_planes(directions, moments, mean, used, held, metric):
    """Held-out dB without truncation, then for each number of planes."""
    lights, count = directions[used], len(directions)
    gram = mean_over_channels(moments, count)
    options = [c for c in candidates("spline") if c[2] <= 2]
    score = lambda c: decibels(
        leave_one_out(bordered_inverse(c, lights), gram[np.ix_(used, used)])
    )
    best = max(options, key=score)
    inverse = bordered_inverse(best, lights)
    dome = weights(best, inverse, lights, cap_nodes(lights[:, 2].min()))
    own = weights(best, inverse, lights, lights)
    choices = {
        "samples": np.eye(len(used)),
        "solid angle": dome.T @ dome / len(dome),
        "both": 0.5 * dome.T @ dome / len(dome) + 0.5 * own.T @ own / len(own),
    }
    m = choices["both" if metric == "least squares" else metric]
    if metric == "least squares":
        m = np.eye(len(used))
    values, vectors = np.linalg.eigh(m)
    values = np.maximum(values, 1e-10 * values[-1])
    root = by_channel(np.sqrt(values)[:, None] * vectors.T)
    back = by_channel(vectors / np.sqrt(values))
    rows = lambda which: np.concatenate([c * count + which for c in range(3)])
    covariance = moments - np.outer(mean, mean)
    inside = covariance[np.ix_(rows(used), rows(used))]
    v = np.linalg.eigh(root @ inside @ root.T)[1][:, ::-1]
    to_held = by_channel(weights(best, inverse, lights, directions[held]))
    both = np.r_[rows(held), rows(used)]
    offset = mean[rows(held)] - to_held @ mean[rows(used)]

    def error(operator, shift):
        full = np.concatenate([np.eye(3 * len(held)), -to_held @ operator], 1)
        squares = quadratic(full, covariance[np.ix_(both, both)]) + (offset - to_held @ shift) ** 2
        return decibels(squares.reshape(3, -1).mean(0))

    figures = [error(np.eye(3 * len(used)), np.zeros(3 * len(used)))]
    for k in PLANES:
        functions, analysis = back @ v[:, :k], v[:, :k].T @ root
        shift = np.zeros(3 * len(used))
        if metric == "least squares":
            at_lights = by_channel(own) @ functions
            normal = at_lights.T @ at_lights
            analysis = np.linalg.solve(
                normal + 1e-6 * np.trace(normal) / len(normal) * np.eye(len(normal)), at_lights.T
            )
            residual = mean[rows(used)] - by_channel(own) @ mean[rows(used)]
            shift = functions @ (analysis @ residual)
        figures.append(error(functions @ analysis, shift))
    return figures


def plane_study(stacks):
    print("Held-out dB by number of planes, mean of five folds")
    print("| stack | planes from | all | " + " | ".join(map(str, PLANES)) + " |")
    print("|" + "---|" * (len(PLANES) + 3))
    for name, (directions, moments, mean) in stacks.items():
        for metric in ("samples", "solid angle", "both", "least squares"):
            figures = np.mean(
                [
                    fold_planes(directions, moments, mean, used, held, metric)
                    for used, held in folds(len(directions))
                ],
                0,
            )
            print(f"| {name} | {metric} | " + " | ".join(f"{v:.2f}" for v in figures) + " |")


def main():
    data = Path(sys.argv[1])
    stacks = {}
    for name in STACKS:
        directions, samples = load(data / name / "stack")
        moments = (samples @ samples.T).astype(float) / samples.shape[1]
        stacks[name] = (directions, moments, samples.mean(1).astype(float))
    interpolation_study(stacks)
    plane_study(stacks)


if __name__ == "__main__":
    main()
