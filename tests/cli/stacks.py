"""Small stacks of photographs with a known scene, so that any light's picture can be computed.

A ball lies half sunk in a coloured plane; it shades by Lambert's law, has a soft highlight, and
throws the exact shadow of a parallel light. x right, y up, z toward the viewer; the picture's
longer side is 2.
"""

import math

import numpy as np
from PIL import Image

WIDTH, HEIGHT = 72, 56
BALL_RADIUS = 0.42
AMBIENT = 0.03


def directions(count, lowest_degrees=22.0):
    """Evenly spread over a dome: a spiral of equal areas (Vogel 1979)."""
    top = math.sin(math.radians(lowest_degrees))
    for k in range(count):
        z = 1 - (1 - top) * (k + 0.5) / count
        azimuth = k * math.pi * (3 - math.sqrt(5))
        r = math.sqrt(1 - z * z)
        yield np.array([r * math.cos(azimuth), r * math.sin(azimuth), z])


def grid(width, height):
    longer = max(width, height)
    x = (np.arange(width) + 0.5 - width / 2) * 2 / longer
    y = -(np.arange(height) + 0.5 - height / 2) * 2 / longer
    return np.meshgrid(x, y)


def render(light, width=WIDTH, height=HEIGHT):
    """Linear light, height x width x 3, under a parallel light of intensity 1 from `light`."""
    light = np.asarray(light, float) / np.linalg.norm(light)
    x, y = grid(width, height)
    r2 = x * x + y * y
    on_ball = r2 < BALL_RADIUS**2
    z = np.where(on_ball, np.sqrt(np.maximum(BALL_RADIUS**2 - r2, 0)), 0)
    flat = np.array([0, 0, 1.0])[:, None, None]
    normal = np.where(on_ball, np.stack([x, y, z]) / BALL_RADIUS, flat)

    # A ray from the plane toward the light meets the ball if it passes the centre closely enough.
    along = x * light[0] + y * light[1]
    shadowed = ~on_ball & (along < 0) & (r2 - along**2 < BALL_RADIUS**2)
    lambert = np.clip(np.tensordot(light, normal, 1), 0, None) * ~shadowed
    half = light + np.array([0, 0, 1.0])
    half /= np.linalg.norm(half)
    gloss = 0.25 * np.clip(np.tensordot(half, normal, 1), 0, 1) ** 12 * on_ball * (lambert > 0)
    albedo = np.stack([0.55 + 0.3 * np.sin(5 * x), 0.5 + 0.25 * np.cos(4 * y), 0.35 + 0.2 * x * y])
    return np.moveaxis(albedo * (0.8 * lambert + AMBIENT) + gloss, 0, 2)


def encoded(linear):
    linear = np.clip(linear, 0, 1)
    return np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)


def linear_from_bytes(picture):
    v = np.asarray(picture, float) / 255
    return np.where(v <= 0.04045, v / 12.92, ((v + 0.055) / 1.055) ** 2.4)


def display_bytes(linear):
    return np.round(encoded(linear) * 255).astype(np.uint8)


def psnr(a, b):
    error = np.mean((np.asarray(a, float) - np.asarray(b, float)) ** 2)
    return 99.0 if error == 0 else 10 * math.log10(255**2 / error)


def light_line(name, light):
    return f"{name} {light[0]:.7f} {light[1]:.7f} {light[2]:.7f}\n"


def write_light_file(folder, names, lights, name="lights.lp"):
    text = f"{len(names)}\n" + "".join(light_line(n, l) for n, l in zip(names, lights))
    (folder / name).write_text(text)


def write_stack(folder, count=28, width=WIDTH, height=HEIGHT, suffix=".png", **save_options):
    """`count` photographs and their lights.lp. Returns the light directions."""
    folder.mkdir(parents=True, exist_ok=True)
    lights = list(directions(count))
    names = [f"photo {k:02d}{suffix}" for k in range(count)]
    for name, light in zip(names, lights):
        picture = Image.fromarray(display_bytes(render(light, width, height)))
        picture.save(folder / name, **save_options)
    write_light_file(folder, names, lights)
    return lights


def read_picture(file):
    return np.asarray(Image.open(file))
