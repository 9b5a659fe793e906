"""Soft shadows of a glTF scene by Blender's Cycles: a renderer that shares no code with Penumbra, to check its truth.

Run by hand, in Blender 3.4 with numpy (Debian: blender, python3-numpy, openimageio-tools):

    blender -b --factory-startup -t 1 --python scripts/cycles_reference.py -- scenes/foliage.glb \\
        -o tests/image/cycles_foliage.exr --size 320x180 --eye 1.6,1.4,1.8 --target 1,0.55,-1.2 --fov 50 \\
        --sun=-40,40 --sun-angle 2 --spp 4096

The options are those of `penumbra render`, which needs `--ground off` besides. The picture has two layers of 16-bit
floats, named as Penumbra names its own: shadow.V, visibility of the sun (1 for the sky), and depth.Z, metres from the
camera's plane (0 for the sky), by which a test knows where both saw the same surface. Its metadata hold the command,
the version, the samples and the noise. 4096 samples of 320 x 180 pixels take ten minutes of one core.

How visibility is made from a picture:
- Cycles 3.4 draws points uniformly on the tangent-plane disc of radius tan(angle / 2) (kernel/light/distant.h: emission
  over density is the same for each), which is Penumbra's sun.
- A diffuse surface would weigh each ray by its cosine, up to tan(angle / 2) / tan(elevation) more on one side of the
  disc than on the other. The toon BSDF at its full size, 90 degrees, weighs all of the hemisphere alike.
- The picture is divided by the one value that all surfaces have in a picture without shadows. What faces away from the
  sun is 0.
- No bounces, a black world, flat normals, no terminator offsets, no clamping, no threshold of weak light.
- The narrowest pixel filter, 0.01 pixels, so that each ray goes through its pixel's centre.
- An alpha mask is a transparent surface where the alpha of the base level, bilinear, is under the cutoff.

The noise is measured: half of the samples has another seed; half the deviation of the difference is that of the mean.
This setting differs by its noise alone (0.0022 rms at 1024 samples, bias under 0.0001) from the exact visibility of
scenes/knife_edge.glb under a sun of 8 degrees, 40 degrees high.
"""

import argparse
import math
import pathlib
import subprocess
import sys
import tempfile

import bpy
import numpy
from mathutils import Matrix, Vector

SEEDS = (1, 2)


def numbers(text):
    return [float(x) for x in text.split(",")]


def parse_arguments():
    parser = argparse.ArgumentParser(prog="cycles_reference.py", description=__doc__.splitlines()[0])
    parser.add_argument("scene", type=pathlib.Path)
    parser.add_argument("-o", "--output", type=pathlib.Path, required=True)
    parser.add_argument("--size", default="320x180", help="WIDTHxHEIGHT")
    parser.add_argument("--eye", type=numbers, required=True, help="X,Y,Z of glTF, metres")
    parser.add_argument("--target", type=numbers, required=True, help="X,Y,Z of glTF, metres")
    parser.add_argument("--fov", type=float, default=45, help="of the picture's height, degrees")
    parser.add_argument("--sun", type=numbers, required=True, help="AZIMUTH,ELEVATION, degrees; write --sun=-40,40")
    parser.add_argument("--sun-angle", type=float, default=0.53, help="full angle, degrees")
    parser.add_argument("--spp", type=int, default=4096)
    return parser.parse_args(sys.argv[sys.argv.index("--") + 1 :])


def blender_axes(v):
    """A glTF vector (+Y up) in Blender (+Z up)."""
    return Vector((v[0], -v[2], v[1]))


def looking_along(forward, up):
    """The rotation of a camera or light, which look along their -Z."""
    right = forward.cross(up).normalized()
    return Matrix((right, right.cross(forward), -forward)).transposed().to_4x4()


def add_object(name, data, matrix):
    thing = bpy.data.objects.new(name, data)
    thing.matrix_world = matrix
    bpy.context.scene.collection.objects.link(thing)
    return thing


def import_scene(path):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.import_scene.gltf(filepath=str(path), import_shading="FLAT")
    for thing in list(bpy.data.objects):
        if thing.type in ("LIGHT", "CAMERA"):
            bpy.data.objects.remove(thing)
        elif thing.type == "MESH":
            thing.cycles.shadow_terminator_offset = 0
            thing.cycles.shadow_terminator_geometry_offset = 0
            thing.data.use_auto_smooth = False  # Else the file's normals shade.


def alpha_input(material):
    principled = next(node for node in material.node_tree.nodes if node.type == "BSDF_PRINCIPLED")
    return principled.inputs["Alpha"]


def weigh_all_directions_alike(material):
    """Replaces a material by one that shows the sun's visibility, and keeps its alpha mask."""
    material.use_nodes = True
    tree = material.node_tree
    nodes, link = tree.nodes, tree.links.new
    toon = nodes.new("ShaderNodeBsdfToon")
    toon.component = "DIFFUSE"
    toon.inputs["Color"].default_value = (1, 1, 1, 1)
    toon.inputs["Size"].default_value = 1
    toon.inputs["Smooth"].default_value = 0
    surface = next(node for node in nodes if node.type == "OUTPUT_MATERIAL").inputs["Surface"]
    alpha = alpha_input(material)
    if material.blend_method != "CLIP" or not alpha.is_linked:
        link(toon.outputs[0], surface)
        return
    for node in nodes:
        if node.type == "TEX_IMAGE":
            node.interpolation = "Linear"
            node.image.alpha_mode = "CHANNEL_PACKED"
    hole = nodes.new("ShaderNodeMath")
    hole.operation = "LESS_THAN"
    hole.inputs[1].default_value = material.alpha_threshold
    link(alpha.links[0].from_socket, hole.inputs[0])
    mix = nodes.new("ShaderNodeMixShader")
    link(hole.outputs[0], mix.inputs[0])
    link(toon.outputs[0], mix.inputs[1])
    link(nodes.new("ShaderNodeBsdfTransparent").outputs[0], mix.inputs[2])
    link(mix.outputs[0], surface)


def add_camera(options):
    camera = bpy.data.cameras.new("eye")
    camera.sensor_fit = "VERTICAL"
    camera.angle = math.radians(options.fov)
    camera.clip_start, camera.clip_end = 0.01, 10000
    eye, target = blender_axes(options.eye), blender_axes(options.target)
    rotation = looking_along((target - eye).normalized(), Vector((0, 0, 1)))
    bpy.context.scene.camera = add_object("eye", camera, Matrix.Translation(eye) @ rotation)


def add_sun(options):
    azimuth, elevation = (math.radians(x) for x in options.sun)
    level = math.cos(elevation)
    to_sun = blender_axes((math.sin(azimuth) * level, math.sin(elevation), math.cos(azimuth) * level))
    sun = bpy.data.lights.new("sun", "SUN")
    sun.angle = math.radians(options.sun_angle)
    sun.energy = 10
    sun.cycles.use_multiple_importance_sampling = False  # Else rays of the BSDF have a part in it.
    add_object("sun", sun, looking_along(-to_sun, Vector((0, 1, 0))))


def set_up_cycles(options):
    scene = bpy.context.scene
    scene.world = bpy.data.worlds.new("black")
    scene.world.color = (0, 0, 0)
    scene.render.engine = "CYCLES"
    scene.render.resolution_x, scene.render.resolution_y = (int(x) for x in options.size.split("x"))
    scene.render.resolution_percentage = 100
    scene.render.use_persistent_data = False
    scene.render.image_settings.file_format = "OPEN_EXR_MULTILAYER"
    scene.render.image_settings.color_depth = "32"
    scene.view_layers[0].use_pass_z = True
    cycles = scene.cycles
    cycles.device = "CPU"
    cycles.use_adaptive_sampling = False
    cycles.use_denoising = False
    cycles.pixel_filter_type = "BLACKMAN_HARRIS"
    cycles.filter_width = 0.01
    cycles.max_bounces = 0
    cycles.transparent_max_bounces = 1024
    cycles.sample_clamp_direct = 0
    cycles.light_sampling_threshold = 0


def oiiotool(*arguments):
    subprocess.run(["oiiotool", *map(str, arguments)], check=True)


def render(folder, name, samples, seed):
    """Radiance and depth, from the bottom row up."""
    scene = bpy.context.scene
    scene.cycles.samples = samples
    scene.cycles.seed = seed
    whole = folder / f"{name}.exr"
    scene.render.filepath = str(whole)
    bpy.ops.render.render(write_still=True)
    return pixels(folder, whole, "ViewLayer.Combined.R"), pixels(folder, whole, "ViewLayer.Depth.Z")


def pixels(folder, file, channel):
    part = folder / "part.exr"
    oiiotool(file, "--ch", f"R={channel},G={channel},B={channel}", "-d", "float", "-o", part)
    image = bpy.data.images.load(str(part))
    image.colorspace_settings.name = "Non-Color"
    width, height = image.size
    values = numpy.empty(width * height * 4, dtype=numpy.float32)
    image.pixels.foreach_get(values)
    bpy.data.images.remove(image)
    return values.reshape(height, width, 4)[:, :, 0].astype(numpy.float64)


def save(folder, path, channels, metadata):
    """Writes named channels of 16-bit floats."""
    height, width = next(iter(channels.values())).shape
    arguments = []
    for name, values in channels.items():
        raw = folder / f"{name}.pfm"
        raw.write_bytes(f"Pf\n{width} {height}\n-1.0\n".encode() + values.astype("<f4").tobytes())
        arguments += [raw, "--chnames", name]
    arguments += ["--chappend"] * (len(channels) - 1)
    for name, value in metadata.items():
        arguments += ["--sattrib", name, value]
    oiiotool("--nosoftwareattrib", *arguments, "-d", "half", "--compression", "zip", "-o", path)


def main():
    options = parse_arguments()
    import_scene(options.scene)
    for material in bpy.data.materials:
        weigh_all_directions_alike(material)
    add_camera(options)
    add_sun(options)
    set_up_cycles(options)
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        halves = [render(folder, f"half{seed}", options.spp // 2, seed) for seed in SEEDS]
        for thing in bpy.data.objects:
            thing.visible_shadow = False
        unshadowed, depth = render(folder, "unshadowed", 1, SEEDS[0])
        sky = depth > 1e9
        first, second = (numpy.where(sky, 1.0, lit / unshadowed.max()) for lit, _ in halves)
        mean = (first + second) / 2
        penumbra = (mean > 0.02) & (mean < 0.98)
        error = (first - second)[penumbra] / 2
        noise = f"{error.std():.5f} rms, {numpy.abs(error).max():.5f} at most, where 0.02 < V < 0.98"
        print(f"{penumbra.mean():.1%} of the pixels in penumbra; noise {noise}")
        metadata = {
            "Software": f"Blender {bpy.app.version_string} Cycles",
            "reference:command": "cycles_reference.py " + " ".join(sys.argv[sys.argv.index("--") + 1 :]),
            "reference:samples": str(options.spp),
            "reference:noise": noise,
        }
        save(folder, options.output, {"shadow.V": mean, "depth.Z": numpy.where(sky, 0.0, depth)}, metadata)


main()
