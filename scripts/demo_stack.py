#!/usr/bin/python3
"""Renders the demonstration's photographs: an enamelled medal on felt, under 60 lights.

    demo_stack.py FOLDER [SIDE]

A height field with procedural ornament, shaded with a GGX microfacet lobe over a diffuse base and
shadowed by marching through the heights toward each light. Writes photo_NN.jpg and lights.lp.
Axes as in docs/conventions.md: x right, y up, z toward the viewer; one unit is half the picture.
"""

import math
import multiprocessing
import pathlib
import sys

import numpy as np
from PIL import Image

SUPERSAMPLES = 2
RINGS = [(16, 18), (30, 16), (45, 12), (60, 9), (76, 5)]  # elevation in degrees, number of lights


def smoothstep(low, high, x):
    t = np.clip((x - low) / (high - low), 0, 1)
    return t * t * (3 - 2 * t)


def dome_of(distance, radius, height):
    """A round cap: `height` at distance 0, nothing beyond `radius`."""
    return height * np.sqrt(np.clip(1 - (distance / radius) ** 2, 0, None))


def beads(x, y, count, ring_radius, radius, height, turn=0.0):
    """`count` caps on a circle; every pixel meets only the nearest one."""
    step = 2 * math.pi / count
    nearest = np.round((np.arctan2(y, x) - turn) / step) * step + turn
    distance = np.hypot(x - ring_radius * np.cos(nearest), y - ring_radius * np.sin(nearest))
    return dome_of(distance, radius, height)


def smooth_noise(side, cells, seed):
    """Values in [-1, 1], smooth over a cell."""
    coarse = np.random.default_rng(seed).uniform(-1, 1, (cells, cells)).astype(np.float32)
    picture = Image.fromarray(coarse).resize((side, side), Image.BICUBIC)
    return np.asarray(picture)


class Medal:
    """Heights and materials, sampled on a side x side grid."""

    def __init__(self, side):
        axis = ((np.arange(side) + 0.5) / side * 2 - 1).astype(np.float32)
        self.side = side
        self.x, self.y = np.meshgrid(axis, -axis)
        self.radius = np.hypot(self.x, self.y)
        self.angle = np.arctan2(self.y, self.x)
        self.height, self.enamel = self._ornament()
        self.margin = side // 2
        self.padded = np.pad(self.height, self.margin, mode="edge")
        self.felt = self.radius > 0.885
        self.normal = self._normals()
        self.open_sky = self._open_sky()

    def _ornament(self):
        r, a = self.radius, self.angle
        body = 0.09 * (1 - smoothstep(0.868, 0.885, r))
        rim = dome_of(np.abs(r - 0.84), 0.035, 0.035) + dome_of(np.abs(r - 0.66), 0.014, 0.014)
        border = beads(self.x, self.y, 48, 0.745, 0.034, 0.034)
        border += beads(self.x, self.y, 48, 0.695, 0.011, 0.012, math.pi / 48)

        petals = 0.33 + 0.19 * np.abs(np.cos(4 * a)) ** 0.8
        leaf = smoothstep(0, 0.10, petals - r) * smoothstep(0.13, 0.2, r)
        vein = dome_of(np.abs(np.sin(4 * a + math.pi / 2)) * r, 0.018, 0.012)
        relief = leaf * (0.035 + 0.03 * np.cos(8 * a) * smoothstep(0.1, 0.45, r)) + leaf * vein
        rays = beads(self.x, self.y, 8, 0.57, 0.042, 0.045, math.pi / 8)
        centre = dome_of(r, 0.125, 0.085) + dome_of(np.abs(r - 0.155), 0.018, 0.03)
        centre += 0.004 * np.cos(24 * a + 90 * r) * smoothstep(0.12, 0.1, r)

        ground = (r < 0.645) & (leaf < 0.02) & (rays < 0.002) & (r > 0.18)
        waves = np.cos(90 * r + 3 * np.cos(16 * a)) + np.cos(32 * a + 40 * r)
        guilloche = 0.0022 * waves * ground
        hammered = 0.0012 * smooth_noise(self.side, 90, 7) * (r < 0.885)
        nap = (0.0022 * smooth_noise(self.side, self.side // 4, 11)
               + 0.012 * smooth_noise(self.side, 12, 12)) * (r > 0.885)
        height = body + rim + border + relief + rays + centre + guilloche + hammered + nap
        return height.astype(np.float32), ground

    def _normals(self):
        spacing = 2 / self.side
        down, right = np.gradient(self.height, spacing)
        n = np.stack([-right, down, np.ones_like(right)])
        return (n / np.linalg.norm(n, axis=0)).astype(np.float32)

    def _open_sky(self):
        """The fraction of the sky that a point sees, from the horizons in twelve directions."""
        total = np.zeros_like(self.height)
        for k in range(12):
            azimuth = 2 * math.pi * (k + 0.5) / 12
            slope = np.full_like(self.height, -1e9)
            for step in np.unique(np.geomspace(1, 0.12 * self.side, 14).astype(int)):
                rise = self._shifted(azimuth, step) - self.height
                np.maximum(slope, rise / (step * 2 / self.side), out=slope)
            total += 1 / (1 + np.clip(slope, 0, None) ** 2)
        return total / 12

    def _shifted(self, azimuth, pixels):
        """Heights `pixels` further toward `azimuth`; edges repeat."""
        x = self.margin + round(pixels * math.cos(azimuth))
        y = self.margin - round(pixels * math.sin(azimuth))
        return self.padded[y : y + self.side, x : x + self.side]

    def sunlit(self, light):
        """1 where the light is seen, 0 in shadow; the edge softens as a small lamp's does."""
        azimuth = math.atan2(light[1], light[0])
        rise_per_pixel = light[2] / math.hypot(light[0], light[1]) * 2 / self.side
        reach = min((self.height.max() - self.height.min()) / rise_per_pixel + 3, self.margin)
        clearance = np.full_like(self.height, 1e9)
        for step in np.unique(np.geomspace(2, reach, 56).astype(int)):
            ray_above = self.height + step * rise_per_pixel - self._shifted(azimuth, step)
            np.minimum(clearance, ray_above * (60 / (step + 12)), out=clearance)
        return smoothstep(-0.012, 0.016, clearance)


def microfacet(normal, light, roughness, specular):
    """GGX with Smith's shadowing (Walter et al. 2007), seen from +z; `specular` is F0."""
    half = np.array([light[0], light[1], light[2] + 1], dtype=np.float32)
    half /= np.linalg.norm(half)
    n_h = np.clip(np.tensordot(half, normal, 1), 0, 1)
    n_l = np.clip(np.tensordot(light, normal, 1), 0, 1)
    n_v = normal[2]
    alpha2 = roughness**4
    lobe = alpha2 / (math.pi * (n_h**2 * (alpha2 - 1) + 1) ** 2)

    def smith(cosine):  # the masking term divided by the cosine
        return 2 / (cosine + np.sqrt(alpha2 + (1 - alpha2) * cosine * cosine))

    fresnel = specular + (1 - specular) * (1 - half[2]) ** 5
    return fresnel * (lobe * smith(n_l) * smith(n_v) / 4 * n_l)[..., None]


def material_of(medal):
    """Diffuse colour, F0 and roughness of every pixel."""
    worn = smoothstep(0.6, 1.0, medal.open_sky)[..., None]
    tone = 1 + 0.12 * smooth_noise(medal.side, 30, 5)[..., None]
    bronze = np.array([0.30, 0.17, 0.075]) * tone * (0.35 + 0.65 * worn)
    enamel = np.array([0.010, 0.055, 0.24]) * (1 + 0.5 * np.cos(6 * medal.radius)[..., None])
    fibres = smooth_noise(medal.side, medal.side // 3, 9)[..., None]
    felt = np.array([0.085, 0.012, 0.020]) * (1 + 0.25 * fibres)
    is_enamel, is_felt = medal.enamel[..., None], medal.felt[..., None]
    diffuse = np.where(is_felt, felt, np.where(is_enamel, enamel, bronze))
    metal = np.array([0.95, 0.64, 0.36]) * (0.45 + 0.55 * worn)
    specular = np.where(is_felt, 0.0, np.where(is_enamel, 0.04, metal))
    roughness = np.where(medal.felt, 1.0, np.where(medal.enamel, 0.30, 0.42))
    return [a.astype(np.float32) for a in (diffuse, specular, roughness)]


def photograph(medal, material, light):
    """Linear light: direct, shadowed, and a faint bounce that open places receive."""
    diffuse, specular, roughness = material
    n_l = np.clip(np.tensordot(light, medal.normal, 1), 0, 1)[..., None]
    direct = diffuse * n_l + 0.75 * microfacet(medal.normal, light, roughness, specular)
    bounce = (diffuse + 0.15 * specular) * (0.06 * light[2] + 0.015) * medal.open_sky[..., None]
    return 1.9 * (direct * medal.sunlit(light)[..., None] + bounce)


def display_bytes(linear):
    """Averages the supersamples in linear light, then clamps and encodes as sRGB."""
    side, s = linear.shape[0] // SUPERSAMPLES, SUPERSAMPLES
    linear = np.clip(linear, 0, 1).reshape(side, s, side, s, 3).mean(axis=(1, 3))
    encoded = np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)
    return np.round(encoded * 255).astype(np.uint8)


def dome():
    for elevation, count in RINGS:
        for k in range(count):
            azimuth = 2 * math.pi * (k + 0.5 * (elevation % 2)) / count + math.radians(elevation)
            e = math.radians(elevation)
            horizontal = math.cos(e) * math.cos(azimuth), math.cos(e) * math.sin(azimuth)
            yield np.array([*horizontal, math.sin(e)], dtype=np.float32)


def write_photograph(task):
    file, light = task
    picture = Image.fromarray(display_bytes(photograph(SCENE, MATERIAL, light)))
    picture.save(file, quality=95, subsampling=0)


def main():
    global SCENE, MATERIAL
    if len(sys.argv) not in (2, 3):
        sys.exit("usage: demo_stack.py FOLDER [SIDE]")
    folder = pathlib.Path(sys.argv[1])
    side = int(sys.argv[2]) if len(sys.argv) == 3 else 512
    folder.mkdir(parents=True, exist_ok=True)
    SCENE = Medal(side * SUPERSAMPLES)
    MATERIAL = material_of(SCENE)
    lights = list(dome())
    names = [f"photo_{k:02d}.jpg" for k in range(len(lights))]
    with multiprocessing.get_context("fork").Pool() as pool:
        pool.map(write_photograph, [(folder / n, l) for n, l in zip(names, lights)], chunksize=1)
    lines = [f"{n} {l[0]:.7f} {l[1]:.7f} {l[2]:.7f}" for n, l in zip(names, lights)]
    (folder / "lights.lp").write_text(f"{len(lines)}\n" + "\n".join(lines) + "\n")


if __name__ == "__main__":
    main()
