"""A few coloured blocks before a wall, rendered from free camera poses, as other programs write such captures.

Poses are computed here from eyes and targets by each program's own rules, so that a test which sees
the blocks where they are has tested the rules. The blocks have no symmetry: any exchanged or
mirrored axis shows.
"""

import json
import math
import subprocess

import numpy as np
from PIL import Image

import balls
import stacks

WIDTH, HEIGHT, DEGREES = 80, 60, 40
TARGET = (0.1, 0.05, 0)
EYES = [(-1.5, 0.9, 3.6), (-0.75, 1.1, 3.9), (0, 0.9, 4), (0.75, 1.1, 3.9), (1.5, 0.9, 3.6)]
LIGHTS = [(0.3, 0.8, 0.6), (-0.7, 0.3, 0.6), (0.6, -0.1, 0.8), (-0.2, 0.5, 0.9)]
# Two corners and a colour of each.
BLOCKS = [((-12, -0.8, -3), (12, -0.6, 4), (0.7, 0.7, 0.7)),
          ((-12, -0.8, -2.2), (12, 9, -2), (0.3, 0.5, 0.6)),
          ((-0.9, -0.6, -0.4), (-0.2, 0.7, 0.2), (0.8, 0.15, 0.1)),
          ((0.1, -0.6, -0.8), (0.9, 0.0, 0.0), (0.1, 0.6, 0.2)),
          ((0.2, -0.6, 0.3), (0.5, -0.3, 0.7), (0.1, 0.2, 0.8))]
SIDES = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]


def obj_text(blocks):
    lines, first = [], 1
    for low, high, _ in blocks:
        for k in range(8):
            lines.append("v %g %g %g" % tuple((high if k >> (2 - i) & 1 else low)[i]
                                              for i in range(3)))
        lines += ["f " + " ".join(str(first + k) for k in side) for side in SIDES]
        first += 8
    return "\n".join(lines) + "\n"


def camera(index):
    return balls.Camera.looking(EYES[index], TARGET, DEGREES, WIDTH, HEIGHT)


def look(index):
    """The same for `--camera`."""
    return ",".join(map(str, (*EYES[index], *TARGET, DEGREES)))


def read_planes(planes):
    """Channels of OpenEXR files, given as (file, channel), by OpenImageIO's tool rather than by
    our code."""
    command, files = ["oiiotool"], []
    for k, (file, channel) in enumerate(planes):
        files.append(file.with_name(f"plane {k}.tif"))
        command += [file, "--ch", channel, "-d", "float", "-o", files[-1]]
    subprocess.run(command, check=True, capture_output=True)
    return [np.asarray(Image.open(file), float) for file in files]


def render(illum, folder, lights=LIGHTS):
    """Linear light: pictures[pose][light]."""
    folder.mkdir(parents=True)
    meshes, materials = [], {}
    for k, block in enumerate(BLOCKS):
        (folder / f"{k}.obj").write_text(obj_text([block]))
        meshes.append({"file": f"{k}.obj", "material": str(k)})
        materials[str(k)] = {"baseColour": block[2], "roughness": 1, "specular": 0}
    # Scenes have the angle across the longer side, --camera from bottom to top.
    across = 2 * math.degrees(math.atan(WIDTH / 2 / camera(0).focal[0]))
    views = [{"camera": {"name": str(k), "eye": eye, "target": TARGET, "up": [0, 1, 0],
                         "fieldOfViewDegrees": across, "size": [WIDTH, HEIGHT]}}
             for k, eye in enumerate(EYES)]
    scene = {"illumScene": 1, "samples": 8, "bounces": 1, "meshes": meshes, "materials": materials,
             "views": views, "lights": {"directions": lights, "radiusDegrees": 3}}
    (folder / "scene.json").write_text(json.dumps(scene))
    illum("capture", folder / "scene.json", "-o", folder / "capture")
    pictures = []
    for k in range(len(EYES)):
        view = folder / "capture/views" / f"{k:04}"
        planes = read_planes([(view / f"light_{light:04}.exr", channel)
                              for light in range(len(lights)) for channel in "RGB"])
        pictures.append([np.dstack(planes[3 * n:3 * n + 3]) for n in range(len(lights))])
    return pictures


def save(picture, file):
    file.parent.mkdir(parents=True, exist_ok=True)
    Image.fromarray(stacks.display_bytes(picture)).save(file)


def write_proxy(folder):
    (folder / "proxy.obj").write_text("# about the blocks' shape\n" + obj_text(BLOCKS))


def matrix(pose):
    """nerfstudio: world from camera, x right, y up, looking along -z."""
    m = np.eye(4)
    m[:3, :3], m[:3, 3] = pose.rotation, pose.eye
    return m.tolist()


def quaternion(r):
    """w, x, y, z of a rotation matrix (Shepperd 1978, the largest of four)."""
    t = np.trace(r)
    squares = np.array([t, *(2 * np.diag(r) - t)]) + 1
    k = int(np.argmax(squares))
    w = np.array([squares[0], r[2, 1] - r[1, 2], r[0, 2] - r[2, 0], r[1, 0] - r[0, 1]])
    x = np.array([r[2, 1] - r[1, 2], squares[1], r[0, 1] + r[1, 0], r[0, 2] + r[2, 0]])
    y = np.array([r[0, 2] - r[2, 0], r[0, 1] + r[1, 0], squares[2], r[1, 2] + r[2, 1]])
    z = np.array([r[1, 0] - r[0, 1], r[0, 2] + r[2, 0], r[1, 2] + r[2, 1], squares[3]])
    q = (w, x, y, z)[k]
    return q / np.linalg.norm(q)


def write_transforms(folder, frames, **fields):
    """`frames`: (file, pose, fields of its own)."""
    first = frames[0][1]
    text = {"w": WIDTH, "h": HEIGHT, "fl_x": first.focal[0], "fl_y": first.focal[1],
            "cx": WIDTH / 2, "cy": HEIGHT / 2, "camera_model": "OPENCV", "k1": 0, "k2": 0,
            "p1": 0, "p2": 0, **fields,
            "frames": [{"file_path": file, "transform_matrix": matrix(pose), **more}
                       for file, pose, more in frames]}
    (folder / "transforms.json").write_text(json.dumps(text))


def write_colmap(folder, images):
    """cameras.txt and images.txt in `folder`; `images`: (name, pose). COLMAP: a point of the
    world is at R p + t of a frame whose x is right, y down, z ahead."""
    folder.mkdir(parents=True, exist_ok=True)
    focal = images[0][1].focal
    (folder / "cameras.txt").write_text(
        "# Camera list with one line of data per camera:\n"
        f"1 PINHOLE {WIDTH} {HEIGHT} {focal[0]:.9f} {focal[1]:.9f} {WIDTH / 2} {HEIGHT / 2}\n")
    lines = ["# Image list with two lines of data per image:"]
    for k, (name, pose) in enumerate(images):
        r = (pose.rotation @ np.diag([1, -1, -1])).T
        numbers = [*quaternion(r), *(-r @ pose.eye)]
        lines += [f"{k + 1} " + " ".join(f"{n:.9f}" for n in numbers) + f" 1 {name}",
                  "12.5 7.25 -1 30 20 -1"]
    (folder / "images.txt").write_text("\n".join(lines) + "\n")
