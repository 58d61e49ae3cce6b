# SPDX-License-Identifier: Apache-2.0
"""A scene of ours in Blender's Cycles, for bench_cycles: blender -b -P cycles.py -- SCENE MATERIAL

Prints `ready`, then answers each line `SAMPLES SEED THREADS FILE` of standard input: renders 256x256
pixels, writes their red, green and blue to FILE as 32-bit floats, lowest row first, and prints
`took SECONDS`, the processor's for the render. Cycles is left as it comes but for what would make it
render another picture: 8 bounces of each kind, no denoising, no adaptive sampling, no clamping, no blur
of caustics, a box filter as wide as a pixel.

Of the scene's keys those are understood that the built-in scene `sphere` has. Lamps are Cycles' own
area lights, which it draws best, before black backs.
"""
import array
import json
import math
import re
import sys
import time

import bpy
from mathutils import Matrix, Vector

SIDE = 256


def in_blender(p):
    """y is up here, z there."""
    return Vector((p[0], -p[2], p[1]))


def turned(p, degrees):
    """About y."""
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    return (c * p[0] + s * p[2], p[1], c * p[2] - s * p[0])


def rgb(value):
    return tuple(value) if isinstance(value, list) else (value,) * 3


def material(name, surface):
    """`surface` makes the node that scatters, in the node tree that it is given."""
    made = bpy.data.materials.new(name)
    made.use_nodes = True
    tree = made.node_tree
    tree.nodes.clear()
    out = tree.nodes.new("ShaderNodeOutputMaterial")
    tree.links.new(surface(tree).outputs[0], out.inputs["Surface"])
    return made


def node(tree, kind, distribution=None, **inputs):
    made = tree.nodes.new(kind)
    if distribution:
        made.distribution = distribution
    for name, value in inputs.items():
        made.inputs[name].default_value = value
    return made


def matte(entry):
    colour = (*rgb(entry["matte"]), 1)
    if "checker" not in entry:
        return lambda tree: node(tree, "ShaderNodeBsdfDiffuse", Color=colour, Roughness=0)

    def checkered(tree):
        size = entry["size"]
        diffuse = node(tree, "ShaderNodeBsdfDiffuse", Roughness=0)
        fields = node(tree, "ShaderNodeTexChecker", Scale=1 / size, Color1=colour,
                      Color2=(*rgb(entry["checker"]), 1))
        place = tree.nodes.new("ShaderNodeNewGeometry")
        lifted = tree.nodes.new("ShaderNodeVectorMath")  # away from the border of fields at z = -1
        lifted.inputs[1].default_value = (0, 0, size / 2)
        tree.links.new(place.outputs["Position"], lifted.inputs[0])
        tree.links.new(lifted.outputs[0], fields.inputs["Vector"])
        tree.links.new(fields.outputs["Color"], diffuse.inputs["Color"])
        return diffuse
    return checkered


# Of the ball: what bench/transport.cpp and bench/cycles.cpp call by these names.
BALLS = {
    "matte": lambda tree: node(tree, "ShaderNodeBsdfDiffuse", Color=(0.5, 0.5, 0.5, 1), Roughness=0),
    # Reflectance of the index 0.2 + 3.4 i along the normal.
    "glossy metal": lambda tree: node(tree, "ShaderNodeBsdfGlossy", "GGX", Color=(0.9363,) * 3 + (1,),
                                      Roughness=0.4),
    "glass": lambda tree: node(tree, "ShaderNodeBsdfGlass", "SHARP", Color=(1,) * 4, Roughness=0, IOR=1.5),
}


def mesh(name, corners, wears):
    made = bpy.data.meshes.new(name)
    made.from_pydata([in_blender(c) for c in corners], [], [range(len(corners))])
    made.materials.append(wears)
    bpy.context.collection.objects.link(bpy.data.objects.new(name, made))


def lamp(name, centre, across, along, shape, radiance):
    """Shines to where `along` x `across` points; its back is black."""
    x, y = in_blender(across), in_blender(along)
    light = bpy.data.lights.new(name, "AREA")
    light.shape, light.size, light.size_y = shape, x.length, y.length
    area = x.length * y.length * (math.pi / 4 if shape == "DISK" else 1)
    light.energy, light.color = 4 * area, radiance  # Cycles' unit of an area light
    placed = bpy.data.objects.new(name, light)
    bpy.context.collection.objects.link(placed)
    axes = Matrix((x.normalized(), y.normalized(), x.cross(y).normalized())).transposed()
    placed.matrix_world = Matrix.Translation(in_blender(centre)) @ axes.to_4x4()
    if shape == "DISK":
        turns = [2 * math.pi * i / 256 for i in range(256)]
        rim = [(math.cos(t) / 2, math.sin(t) / 2) for t in turns]
    else:
        rim = [(-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5)]
    behind = Vector(centre) + Vector(across).cross(Vector(along)).normalized() * 1e-3
    mesh(name + " back", [behind + Vector(across) * u + Vector(along) * v for u, v in rim],
         material(name + " back", matte({"matte": 0})))


def add_object(entry, materials, look, number):
    degrees = entry.get("rotate", [0, 0, 0])[1]
    at = lambda p: turned(p, degrees)
    if entry.get("test"):
        bpy.ops.mesh.primitive_uv_sphere_add(segments=256, ring_count=128, radius=entry["sphere"]["radius"])
        ball = bpy.context.object
        ball.data.materials.append(look)
        for polygon in ball.data.polygons:
            polygon.use_smooth = True
        return
    wears = materials[entry["surface"]]
    name = entry.get("name", f"object {number}")
    if "quad" in entry:
        corner, u, v = (Vector(entry["quad"][k]) for k in ("corner", "u", "v"))
        if "emission" in wears:  # to the side of u x v
            lamp(name, at(corner + u / 2 + v / 2), at(v), at(u), "RECTANGLE", rgb(wears["emission"]))
        else:
            mesh(name, [at(p) for p in (corner, corner + u, corner + u + v, corner + v)],
                 material(name, matte(wears)))
    else:
        disc = entry["disc"]
        n = Vector(disc["normal"]).normalized()
        u = n.orthogonal().normalized() * 2 * disc["radius"]
        lamp(name, at(disc["center"]), at(n.cross(u)), at(u), "DISK", rgb(wears["emission"]))


def build(scene_text, ball):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    data = json.loads(re.sub(r"//[^\n]*", "", scene_text))
    scene = bpy.context.scene
    scene.world = bpy.data.worlds.new("world")
    scene.world.use_nodes = True
    scene.world.node_tree.nodes["Background"].inputs["Color"].default_value = (
        *rgb(data["environment"]["constant"]), 1)
    look = material("ball", BALLS[ball])
    for number, entry in enumerate(data["objects"]):
        add_object(entry, data["materials"], look, number)

    camera = bpy.data.cameras.new("camera")
    camera.sensor_fit, camera.angle = "VERTICAL", math.radians(data["camera"]["fov"])
    placed = bpy.data.objects.new("camera", camera)
    bpy.context.collection.objects.link(placed)
    eye, target = (in_blender(data["camera"][k]) for k in ("position", "target"))
    placed.location = eye
    placed.rotation_mode = "QUATERNION"
    placed.rotation_quaternion = (target - eye).to_track_quat("-Z", "Y")
    scene.camera = placed

    render, cycles = scene.render, scene.cycles
    render.engine, cycles.device = "CYCLES", "CPU"
    render.resolution_x = render.resolution_y = SIDE
    render.threads_mode = "FIXED"
    cycles.use_denoising = cycles.use_adaptive_sampling = False
    cycles.max_bounces = cycles.diffuse_bounces = cycles.glossy_bounces = cycles.transmission_bounces = 8
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = cycles.blur_glossy = 0
    cycles.caustics_reflective = cycles.caustics_refractive = True
    cycles.pixel_filter_type, cycles.filter_width = "BOX", 1
    scene.view_settings.view_transform = "Raw"
    render.image_settings.file_format = "OPEN_EXR"
    render.image_settings.color_depth = "32"
    return scene


def answer(scene, samples, seed, threads, path):
    scene.cycles.samples, scene.cycles.seed, scene.render.threads = samples, seed, threads
    scene.render.filepath = path + ".exr"
    begin = time.process_time()
    bpy.ops.render.render(write_still=True)
    seconds = time.process_time() - begin
    picture = bpy.data.images.load(scene.render.filepath, check_existing=False)
    picture.colorspace_settings.name = "Non-Color"
    values = list(picture.pixels)
    bpy.data.images.remove(picture)
    with open(path, "wb") as out:
        array.array("f", [x for i, x in enumerate(values) if i % 4 != 3]).tofile(out)
    print(f"took {seconds:.6f}", flush=True)


def main():
    path, ball = sys.argv[sys.argv.index("--") + 1:]
    with open(path, encoding="utf-8") as text:
        scene = build(text.read(), ball)
    print("ready", flush=True)
    for line in sys.stdin:
        samples, seed, threads, out = line.split()
        answer(scene, int(samples), int(seed), int(threads), out)


main()
