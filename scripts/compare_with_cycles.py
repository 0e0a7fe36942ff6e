#!/usr/bin/env python3
"""Renders one scene with Illumigraph and with Blender's Cycles and compares the two.

    python3 scripts/compare_with_cycles.py build/release/tools/illum/illum OUT

needs Blender 3.4 (`apt install blender`), which nothing else in the project does. Same camera, same
light, same number of samples, linear pictures, no view transform. Writes into OUT: the scene, both
pictures, `difference.png` (grey = equal, ten times enlarged) and prints the figures that
docs/quality.md quotes.
"""

import json
import math
import pathlib
import subprocess
import sys

SIZE = (384, 288)
SAMPLES = 1024
BOUNCES = 2
FOCAL = 480.0
EYE, TARGET = (1.6, -4.2, 2.6), (0.0, 0.0, 0.3)
LIGHT_ANGLES = (0.75, -0.6)  # theta from +z, phi from +x
LIGHT_RADIUS_DEGREES = 2.0

MATERIALS = {
    "floor": {"baseColour": [0.7, 0.7, 0.65], "metallic": 0, "roughness": 1, "specular": 0},
    "red": {"baseColour": [0.8, 0.15, 0.1], "metallic": 0, "roughness": 1, "specular": 0},
    "blue": {"baseColour": [0.2, 0.3, 0.8], "metallic": 0, "roughness": 1, "specular": 0},
    "metal": {"baseColour": [0.95, 0.75, 0.4], "metallic": 1, "roughness": 0.7, "specular": 0.5},
}


def sphere(radius, centre, steps=64):
    vertices, normals, faces = [], [], []
    for i in range(steps + 1):
        theta = math.pi * i / steps
        for j in range(2 * steps):
            phi = math.pi * j / steps
            n = (math.sin(theta) * math.cos(phi), math.sin(theta) * math.sin(phi), math.cos(theta))
            normals.append(n)
            vertices.append(tuple(c + radius * x for c, x in zip(centre, n)))
    for i in range(steps):
        for j in range(2 * steps):
            a, b = 2 * steps * i + j, 2 * steps * i + (j + 1) % (2 * steps)
            if i > 0:
                faces.append((a, a + 2 * steps, b))
            if i < steps - 1:
                faces.append((b, a + 2 * steps, b + 2 * steps))
    return vertices, normals, faces


def box(half, centre, turn):
    vertices, faces = [], []
    for axis in range(3):
        for side in (-1, 1):
            first = len(vertices)
            u, v = (axis + 1) % 3, (axis + 2) % 3
            for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
                p = [0.0, 0.0, 0.0]
                p[axis], p[u], p[v] = side, side * a, b
                p = [h * x for h, x in zip(half, p)]
                c, s = math.cos(turn), math.sin(turn)
                p = [c * p[0] - s * p[1], s * p[0] + c * p[1], p[2]]
                vertices.append(tuple(x + o for x, o in zip(p, centre)))
            faces += [(first, first + 1, first + 2), (first, first + 2, first + 3)]
    return vertices, None, faces


def meshes():
    floor = ([(-4, -4, 0), (4, -4, 0), (4, 4, 0), (-4, 4, 0)], None, [(0, 1, 2), (0, 2, 3)])
    return {
        "floor": floor,
        "red": box((0.35, 0.35, 0.5), (-0.9, 0.3, 0.5), 0.5),
        "blue": sphere(0.4, (0.2, -0.6, 0.4)),
        "metal": sphere(0.55, (0.7, 0.5, 0.55)),
    }


def to_light():
    theta, phi = LIGHT_ANGLES
    return (math.sin(theta) * math.cos(phi), math.sin(theta) * math.sin(phi), math.cos(theta))


def axes_of_camera():
    """x, y and z of the camera in the object frame; it looks along -z, +z of the object is up."""
    z = [e - t for e, t in zip(EYE, TARGET)]
    length = math.sqrt(sum(c * c for c in z))
    z = [c / length for c in z]
    x = [-z[1], z[0], 0.0]
    length = math.hypot(*x)
    x = [c / length for c in x]
    y = [z[1] * x[2] - z[2] * x[1], z[2] * x[0] - z[0] * x[2], z[0] * x[1] - z[1] * x[0]]
    return x, y, z


def write_scene(out):
    """The scene in the form that `illum` reads: scene.json and one OBJ file a material."""
    for name, (vertices, normals, faces) in meshes().items():
        lines = [f"v {x:.9g} {y:.9g} {z:.9g}" for x, y, z in vertices]
        lines += [f"vn {x:.9g} {y:.9g} {z:.9g}" for x, y, z in normals or []]
        corner = "{0}//{0}" if normals else "{0}"
        for face in faces:
            lines.append("f " + " ".join(corner.format(v + 1) for v in face))
        (out / f"{name}.obj").write_text("\n".join(lines) + "\n")
    x, y, z = axes_of_camera()
    rotation = [c for row in zip(x, y, z) for c in row]
    scene = {
        "illumScene": 1,
        "meshes": [{"file": f"{name}.obj", "material": name} for name in MATERIALS],
        "materials": MATERIALS,
        "views": [{"camera": {
            "name": "view",
            "frame": {"rotation": rotation, "translation": list(EYE)},
            "focal": [FOCAL, FOCAL],
            "size": list(SIZE),
        }}],
        "lights": {"directions": [list(to_light())], "radiusDegrees": LIGHT_RADIUS_DEGREES},
        "samples": SAMPLES,
        "bounces": BOUNCES,
        "filterRadius": 0.5,
        "seed": 1,
    }
    (out / "scene.json").write_text(json.dumps(scene, indent=1))


# --- inside Blender ---


def blender_material(bpy, name):
    description = MATERIALS[name]
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    nodes, links = material.node_tree.nodes, material.node_tree.links
    nodes.clear()
    output = nodes.new("ShaderNodeOutputMaterial")
    if description["metallic"]:
        shader = nodes.new("ShaderNodeBsdfPrincipled")
        shader.distribution = "GGX"
        shader.inputs["Metallic"].default_value = 1
    else:
        shader = nodes.new("ShaderNodeBsdfDiffuse")
    if "Roughness" in shader.inputs:
        shader.inputs["Roughness"].default_value = (
            description["roughness"] if description["metallic"] else 0
        )
    colour = "Base Color" if description["metallic"] else "Color"
    shader.inputs[colour].default_value = (*description["baseColour"], 1)
    links.new(shader.outputs["BSDF"], output.inputs["Surface"])
    return material


def render_with_cycles(bpy, out):
    import mathutils

    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    for name, (vertices, normals, faces) in meshes().items():
        mesh = bpy.data.meshes.new(name)
        mesh.from_pydata(vertices, [], faces)
        for polygon in mesh.polygons:
            polygon.use_smooth = normals is not None
        mesh.materials.append(blender_material(bpy, name))
        scene.collection.objects.link(bpy.data.objects.new(name, mesh))

    sun = bpy.data.lights.new("sun", "SUN")
    sun.energy = math.pi  # the irradiance that a light of intensity 1 has
    sun.angle = math.radians(2 * LIGHT_RADIUS_DEGREES)
    lamp = bpy.data.objects.new("sun", sun)
    lamp.rotation_mode = "QUATERNION"
    lamp.rotation_quaternion = mathutils.Vector(to_light()).to_track_quat("Z", "Y")
    scene.collection.objects.link(lamp)

    data = bpy.data.cameras.new("camera")
    data.sensor_fit = "HORIZONTAL"
    data.lens = FOCAL / SIZE[0] * data.sensor_width
    camera = bpy.data.objects.new("camera", data)
    x, y, z = (mathutils.Vector(axis) for axis in axes_of_camera())
    matrix = mathutils.Matrix((x, y, z)).transposed().to_4x4()
    matrix.translation = EYE
    camera.matrix_world = matrix
    scene.collection.objects.link(camera)
    scene.camera = camera

    scene.world = bpy.data.worlds.new("black")
    scene.world.color = (0, 0, 0)
    scene.render.engine = "CYCLES"
    cycles = scene.cycles
    cycles.device = "CPU"
    cycles.samples = SAMPLES
    cycles.use_adaptive_sampling = False
    cycles.use_denoising = False
    cycles.pixel_filter_type = "BOX"
    cycles.filter_width = 1
    for name in ("max", "diffuse", "glossy"):
        setattr(cycles, f"{name}_bounces", BOUNCES)
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = 0
    cycles.blur_glossy = 0
    cycles.light_sampling_threshold = 0
    scene.render.film_transparent = True
    scene.render.resolution_x, scene.render.resolution_y = SIZE
    scene.render.resolution_percentage = 100
    scene.view_settings.view_transform = "Raw"
    settings = scene.render.image_settings
    settings.file_format, settings.color_depth = "OPEN_EXR", "32"
    scene.render.filepath = str(out / "cycles.exr")
    bpy.ops.render.render(write_still=True)


def pixels_of(bpy, numpy, file):
    image = bpy.data.images.load(str(file))
    image.colorspace_settings.name = "Raw"
    values = numpy.empty(len(image.pixels), dtype=numpy.float32)
    image.pixels.foreach_get(values)
    return values.reshape(image.size[1], image.size[0], image.channels)[:, :, :3]


def save_png(bpy, numpy, values, file):
    height, width, _ = values.shape
    image = bpy.data.images.new("picture", width, height, float_buffer=False)
    image.colorspace_settings.name = "Raw"
    rgba = numpy.ones((height, width, 4), dtype=numpy.float32)
    rgba[:, :, :3] = numpy.clip(values, 0, 1)
    image.pixels.foreach_set(rgba.ravel())
    image.filepath_raw, image.file_format = str(file), "PNG"
    image.save()


def displayed(numpy, linear):
    x = numpy.clip(linear, 0, 1)
    return numpy.where(x <= 0.0031308, 12.92 * x, 1.055 * x ** (1 / 2.4) - 0.055)


def compare(bpy, out, ours_file):
    import numpy

    ours, cycles = (pixels_of(bpy, numpy, f) for f in (ours_file, out / "cycles.exr"))
    difference = ours - cycles
    shown = displayed(numpy, ours) - displayed(numpy, cycles)

    def decibels(d):
        return -10 * math.log10(float(numpy.mean(numpy.square(d, dtype=numpy.float64))))

    print(f"linear PSNR {decibels(difference):.1f} dB (peak 1)")
    print(f"PSNR on screen {decibels(shown):.1f} dB")
    print(f"mean of ours {ours.mean():.5f}, of Cycles {cycles.mean():.5f}")
    save_png(bpy, numpy, 0.5 + 10 * difference, out / "difference.png")
    save_png(bpy, numpy, displayed(numpy, ours), out / "ours.png")
    save_png(bpy, numpy, displayed(numpy, cycles), out / "cycles.png")


def main():
    if "--" in sys.argv:  # inside Blender
        import bpy

        out, ours = (pathlib.Path(a) for a in sys.argv[sys.argv.index("--") + 1 :])
        render_with_cycles(bpy, out)
        compare(bpy, out, ours)
        return
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    illum, out = sys.argv[1], pathlib.Path(sys.argv[2]).resolve()
    out.mkdir(parents=True, exist_ok=True)
    write_scene(out)
    subprocess.run([illum, "capture", out / "scene.json", "-o", out / "ours", "--force"], check=True)
    ours = next((out / "ours").rglob("*light*.exr"))
    blender = ["blender", "--background", "--factory-startup", "--python", __file__, "--"]
    subprocess.run([*blender, str(out), str(ours)], check=True)


if __name__ == "__main__":
    main()
