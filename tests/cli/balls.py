"""A patterned ball seen from anywhere, so that every view's picture under any light can be computed.

It lies in the origin and shades by Lambert's law with a constant added, so that no side is black.
Nothing is behind it. Frames are those of docs/conventions.md.
"""

import dataclasses
import json
import subprocess

import numpy as np
from PIL import Image

import stacks

RADIUS = 0.7
LIGHTS = list(stacks.directions(10))


def light_value(normal, light):
    light = np.asarray(light, float) / np.linalg.norm(light)
    return 0.15 + 0.75 * np.clip(normal @ light, 0, None)


def albedo(point):
    x, y, z = np.moveaxis(point, -1, 0)
    return np.stack([0.5 + 0.3 * np.sin(5 * x + 2 * z), 0.5 + 0.3 * np.cos(6 * y),
                     0.45 + 0.25 * np.sin(4 * (x + y))], axis=-1)


@dataclasses.dataclass
class Camera:
    """A pinhole camera that looks along its own -z."""

    eye: np.ndarray
    rotation: np.ndarray  # object from camera
    focal: np.ndarray     # across, down
    centre: np.ndarray
    width: int
    height: int

    @staticmethod
    def looking(eye, target=(0, 0, 0), degrees=40, width=48, height=40, up=(0, 1, 0)):
        eye = np.asarray(eye, float)
        back = eye - np.asarray(target, float)
        back /= np.linalg.norm(back)
        right = np.cross(up, back)
        right /= np.linalg.norm(right)
        focal = 0.5 * height / np.tan(np.radians(degrees) / 2)
        return Camera(eye, np.stack([right, np.cross(back, right), back], axis=1),
                      np.array([focal, focal]), np.array([width / 2, height / 2]), width, height)

    def rays(self, side):
        """Directions through side x side places of every pixel: height, width, side^2, 3."""
        steps = (np.arange(side) + 0.5) / side
        y, x, j, i = np.meshgrid(np.arange(self.height), np.arange(self.width), steps, steps,
                                 indexing="ij")
        across = (x + i - self.centre[0]) / self.focal[0]
        down = (y + j - self.centre[1]) / self.focal[1]
        rays = np.stack([across, -down, -np.ones_like(across)], axis=-1)
        return (rays @ self.rotation.T).reshape(self.height, self.width, side * side, 3)

    def record(self):
        return {"size": {"width": self.width, "height": self.height},
                "objectFromCamera": {"rotation": list(self.rotation.reshape(-1)),
                                     "translation": list(self.eye)},
                "focalX": self.focal[0], "focalY": self.focal[1],
                "centre": {"x": self.centre[0], "y": self.centre[1]}}


def shot(camera, light, side=4):
    """Linear colours premultiplied by coverage, coverage, and depth along the axis."""
    rays = camera.rays(side)
    a = np.sum(rays * rays, axis=-1)
    b = rays @ camera.eye
    root = b * b - a * (camera.eye @ camera.eye - RADIUS**2)
    hits = root > 0
    distance = np.where(hits, (-b - np.sqrt(np.maximum(root, 0))) / a, 0)
    point = camera.eye + distance[..., None] * rays
    colour = albedo(point) * light_value(point / RADIUS, light)[..., None] * hits[..., None]
    # Rays are one unit long along the axis, so that distances along them are depths.
    depth = np.median(np.where(hits, distance, np.inf), axis=2)
    return colour.mean(axis=2), hits.mean(axis=2), depth


@dataclasses.dataclass
class Slab:
    """View points of z = distance over the square +-reach, a window of +-1.1 by +-0.9."""

    name: str = "front"
    count: int = 3
    reach: float = 0.9
    distance: float = 3.0
    width: int = 44
    height: int = 36
    turn_degrees: float = 0.0  # of the whole, about y

    @property
    def rotation(self):
        c, s = np.cos(np.radians(self.turn_degrees)), np.sin(np.radians(self.turn_degrees))
        return np.array([[c, 0, s], [0, 1, 0], [-s, 0, c]])

    def camera(self, u, v):
        """Seen from (u, v) in [0, 1]."""
        eye = np.array([(2 * u - 1) * self.reach, (2 * v - 1) * self.reach, self.distance])
        focal = self.distance * np.array([self.width / 2.2, self.height / 1.8])
        centre = np.array([(eye[0] + 1.1) * self.width / 2.2, (0.9 - eye[1]) * self.height / 1.8])
        return Camera(self.rotation @ eye, self.rotation, focal, centre, self.width, self.height)

    def record(self):
        r = self.reach
        return {"name": self.name, "size": {"width": self.width, "height": self.height},
                "objectFromSlab": {"rotation": list(self.rotation.reshape(-1)),
                                   "translation": [0, 0, 0]},
                "distance": self.distance, "uCount": self.count, "vCount": self.count,
                "uv": {"left": -r, "bottom": -r, "right": r, "top": r},
                "st": {"left": -1.1, "bottom": -0.9, "right": 1.1, "top": 0.9}}

    def views(self, index=0):
        """(name, geometry, camera) of every view point."""
        steps = self.count - 1
        return [(f"{self.name} {u} {v}", {"kind": "slab", "slab": index, "u": u, "v": v},
                 self.camera(u / steps, v / steps))
                for v in range(self.count) for u in range(self.count)]


def write_exr(file, values):
    tif = file.with_suffix(".tif")
    Image.fromarray(np.asarray(values, np.float32)).save(tif)
    subprocess.run(["oiiotool", tif, "--chnames", "Y", "-d", "float", "-o", file], check=True,
                   capture_output=True)
    tif.unlink()


def write_view(folder, camera, depth, slab_distance=None):
    """The photographs of LIGHTS, mask.png and, if wanted, depth.exr."""
    folder.mkdir(parents=True)
    for k, light in enumerate(LIGHTS):
        colour, coverage, distance = shot(camera, light)
        own = colour / np.maximum(coverage, 1e-9)[..., None]
        Image.fromarray(stacks.display_bytes(own)).save(folder / f"{k}.png")
    Image.fromarray(np.round(255 * coverage).astype(np.uint8)).save(folder / "mask.png")
    if depth:
        write_exr(folder / "depth.exr",
                  distance if slab_distance is None else slab_distance - distance)


def write_capture(folder, slabs=(), cameras=(), depth=False):
    """A capture.json of slabs, or of cameras given as (name, camera), with its pictures."""
    folder.mkdir(parents=True)
    views = [(*view, slab.distance) for k, slab in enumerate(slabs) for view in slab.views(k)]
    views += [(name, {"kind": "camera", "camera": camera.record()}, camera, None)
              for name, camera in cameras]
    records = []
    for index, (name, geometry, camera, distance) in enumerate(views):
        write_view(folder / str(index), camera, depth, distance)
        records.append({"name": name, "geometry": geometry,
                        "photographs": f"{index}/{{light}}.png", "mask": f"{index}/mask.png"})
        if depth:
            records[-1]["depth"] = f"{index}/depth.exr"
    text = {"format": "illum-capture", "version": [1, 0],
            "lights": [{"name": str(k), "direction": list(light)}
                       for k, light in enumerate(LIGHTS)],
            "slabs": [slab.record() for slab in slabs], "views": records}
    (folder / "capture.json").write_text(json.dumps(text))
    return folder


def expected(camera, light):
    """RGBA bytes as a PNG has them: straight, encoded, coverage in alpha."""
    colour, coverage, _ = shot(camera, light)
    own = stacks.display_bytes(colour / np.maximum(coverage, 1e-9)[..., None])
    return np.dstack([own, np.round(255 * coverage).astype(np.uint8)])


def over_black(picture):
    picture = np.asarray(picture, float)
    if picture.shape[2] == 3:
        return picture
    return picture[..., :3] * picture[..., 3:] / 255


def likeness(picture, camera, light):
    """PSNR, over black, against what the camera sees."""
    return stacks.psnr(over_black(picture), over_black(expected(camera, light)))
