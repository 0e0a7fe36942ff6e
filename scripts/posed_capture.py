#!/usr/bin/env python3
"""Makes a folder with a capture.json of photographs whose cameras other files tell of.

    scripts/posed_capture.py grid DATA -o FOLDER [--pictures views] [--step 1]
    scripts/posed_capture.py poses DATA -o FOLDER

`grid`: a camera moved in a plane (the light field "shop" of github.com/linusmossberg/
light-field-renderer): DATA/PICTURES.csv names the pictures with columns file, cam_x_mm and
cam_y_mm, x to the right and y up; DATA/geometry.json has the picture's size, the focal length and
the centre in pixels. The file names' own rows and columns are not looked at: column 0 is the
rightmost camera and row 0 the lowest. --step takes every second, third … place in both directions.

`poses`: cameras anywhere: DATA/poses.json has a list `views` of file, w, h, f, cx, cy and the
rotation R and translation t that take points to the camera's frame, x right, y down, z ahead;
DATA/images has the pictures, and DATA/proxy.obj may be a mesh of what they show.

The pictures are linked to, not copied. Lengths are metres for `grid`, as in the file for `poses`.
"""

import argparse
import csv
import json
import pathlib
import sys

IDENTITY = [1, 0, 0, 0, 1, 0, 0, 0, 1]


def camera(size, focal, centre, rotation, eye):
    return {"kind": "camera", "camera": {
        "size": {"width": size[0], "height": size[1]},
        "objectFromCamera": {"rotation": rotation, "translation": eye},
        "focalX": focal, "focalY": focal, "centre": {"x": centre[0], "y": centre[1]}}}


def places(rows, axis, step):
    """Every `step`-th of the places along one axis."""
    return sorted({float(row[axis]) for row in rows})[::step]


def grid_views(data, pictures, step):
    geometry = json.loads((data / "geometry.json").read_text())
    # The file's centres are counted from the middle of the first pixel.
    centre = [c + 0.5 for c in geometry["principal"]]
    with open(data / f"{pictures}.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    across, up = (set(places(rows, axis, step)) for axis in ("cam_x_mm", "cam_y_mm"))
    for row in rows:
        x, y = float(row["cam_x_mm"]), float(row["cam_y_mm"])
        if x in across and y in up:
            yield (row["file"], data / pictures / row["file"],
                   camera(geometry["image"], geometry["focal_px"], centre, IDENTITY,
                          [x / 1000, y / 1000, 0]))


def posed_views(data):
    for view in json.loads((data / "poses.json").read_text())["views"]:
        r, t = view["R"], view["t"]
        eye = [-sum(r[k][i] * t[k] for k in range(3)) for i in range(3)]
        # Columns are the camera's axes in the object's frame: ours has y up and z behind.
        rotation = [sign * r[k][i] for i in range(3) for k, sign in enumerate((1, -1, -1))]
        yield (view["file"], data / "images" / view["file"],
               camera((view["w"], view["h"]), view["f"], (view["cx"], view["cy"]), rotation, eye))


def write(folder, views, proxy):
    folder.mkdir(parents=True)
    records = []
    for index, (name, file, geometry) in enumerate(views):
        link = f"{index:04}{file.suffix}"
        (folder / link).symlink_to(file.resolve(strict=True))
        records.append({"name": name, "geometry": geometry, "photographs": link})
    capture = {"format": "illum-capture", "version": [1, 0],
               "lights": [{"name": "light", "direction": [0, 0, 1]}], "views": records}
    if proxy.exists():
        (folder / "proxy.obj").symlink_to(proxy.resolve())
        capture["proxy"] = "proxy.obj"
    (folder / "capture.json").write_text(json.dumps(capture, indent=1) + "\n")
    print(f"{folder}: {len(records)} views")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("kind", choices=("grid", "poses"))
    parser.add_argument("data", type=pathlib.Path)
    parser.add_argument("-o", "--output", type=pathlib.Path, required=True)
    parser.add_argument("--pictures", default="views")
    parser.add_argument("--step", type=int, default=1)
    options = parser.parse_args()
    if options.step < 1:
        sys.exit(f"--step: expected at least 1, found {options.step}")
    if options.output.exists():
        sys.exit(f"{options.output}: exists already")
    views = (grid_views(options.data, options.pictures, options.step) if options.kind == "grid"
             else posed_views(options.data))
    write(options.output, views, options.data / "proxy.obj")


if __name__ == "__main__":
    main()
