"""Renders a scene file of Hyalite by Cycles, inside Blender: cycles.py says what for.

    blender -b --python cycles_scene.py -- SCENE.json UNIT OUT.pfm WIDTH HEIGHT SPP SEED THRESHOLD

Knows what the two scenes of cycles.py have: a camera, an environment or darkness, meshes of OBJ files, which may be
moved, and materials that are diffuse, emit, or are conductors, all of which are white here. UNIT is that of the scene
in metres: Cycles is less exact on rooms of hundreds of metres. THRESHOLD is the noise at which Cycles takes no more samples
of a pixel; 0: each has SPP. What else decides speed is Blender's default.
"""
import json
import math
import os
import sys

import bpy
import mathutils
import numpy


def turned(point):
    """From Hyalite's space, where y is up, to Blender's, where z is."""
    x, y, z = point
    return mathutils.Vector((x, -z, y))


def add_shader(tree, kind, colour):
    node = tree.nodes.new(kind)
    node.inputs["Color"].default_value = (*(colour if isinstance(colour, list) else [colour] * 3), 1)
    return node


def make_material(look):
    material = bpy.data.materials.new("material")
    material.use_nodes = True
    tree = material.node_tree
    tree.nodes.clear()
    if look["type"] == "conductor":
        shader = add_shader(tree, "ShaderNodeBsdfGlossy", 1)
        shader.inputs["Roughness"].default_value = look["roughness"]
        shader.distribution = "MULTI_GGX"  # light that facets send to each other is kept, as in Hyalite
    else:
        shader = add_shader(tree, "ShaderNodeBsdfDiffuse", look["albedo"])
    if "emission" in look:
        both = tree.nodes.new("ShaderNodeAddShader")
        tree.links.new(shader.outputs[0], both.inputs[0])
        tree.links.new(add_shader(tree, "ShaderNodeEmission", look["emission"]).outputs[0], both.inputs[1])
        shader = both
    tree.links.new(shader.outputs[0], tree.nodes.new("ShaderNodeOutputMaterial").inputs["Surface"])
    return material


def add_mesh(path, place, unit, material):
    """The importer turns a mesh by itself."""
    bpy.ops.wm.obj_import(filepath=path)
    placed = bpy.context.object
    placed.location, placed.scale = unit * turned(place), [unit] * 3
    placed.data.materials.clear()
    placed.data.materials.append(material)


def set_camera(scene, view, unit):
    camera = bpy.data.cameras.new("camera")
    camera.sensor_fit = "HORIZONTAL"
    camera.angle = math.radians(view["horizontalFov"])
    placed = bpy.data.objects.new("camera", camera)
    placed.location = unit * turned(view["position"])
    placed.rotation_euler = turned(view["direction"]).to_track_quat("-Z", "Y").to_euler()
    scene.collection.objects.link(placed)
    scene.camera = placed


def set_world(scene, path):
    """An environment must look the same from all sides: Blender counts longitudes from elsewhere."""
    scene.world = bpy.data.worlds.new("world")
    scene.world.use_nodes = True
    tree = scene.world.node_tree
    tree.nodes["Background"].inputs["Color"].default_value = (0, 0, 0, 1)
    if path:
        image = tree.nodes.new("ShaderNodeTexEnvironment")
        image.image = bpy.data.images.load(path)
        tree.links.new(image.outputs["Color"], tree.nodes["Background"].inputs["Color"])
        # The map that aims at bright parts, as fine as the image. Left to Cycles it is finer: 2 s more to start, and
        # twice the time a sample, for no less noise.
        scene.world.cycles.sampling_method = "MANUAL"
        scene.world.cycles.sample_map_resolution = image.image.size[0]


def set_cycles(scene, depth, spp, seed, threshold):
    """No clamping, no denoiser, and a box filter. Hyalite counts all segments of a path, Cycles neither the first nor the
    one to the light."""
    scene.render.engine = "CYCLES"
    cycles = scene.cycles
    cycles.device = "CPU"
    cycles.samples, cycles.seed = spp, seed
    cycles.use_denoising = False
    cycles.use_adaptive_sampling = threshold > 0
    cycles.adaptive_threshold = threshold
    cycles.max_bounces = cycles.diffuse_bounces = cycles.glossy_bounces = depth - 2
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = cycles.blur_glossy = 0
    cycles.pixel_filter_type = "BOX"  # one pixel wide


def write_pfm(exr, path):
    """Lines go upwards in a PFM, as in Blender's images."""
    image = bpy.data.images.load(exr)
    width, height = image.size
    pixels = numpy.empty(width * height * 4, numpy.float32)
    image.pixels.foreach_get(pixels)
    with open(path, "wb") as file:
        file.write(b"PF\n%d %d\n-1.0\n" % (width, height) + pixels.reshape(-1, 4)[:, :3].astype("<f4").tobytes())


def main():
    path, unit, out, *numbers, threshold = sys.argv[sys.argv.index("--") + 1:]
    unit = float(unit)
    width, height, spp, seed = (int(number) for number in numbers)
    folder = os.path.dirname(path)
    with open(path) as file:
        document = json.load(file)
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    looks = {name: make_material(look) for name, look in document["materials"].items()}
    for mesh in document["meshes"]:
        add_mesh(os.path.join(folder, mesh["file"]), mesh.get("translate", [0, 0, 0]), unit, looks[mesh["material"]])
    set_camera(scene, document["camera"], unit)
    set_world(scene, os.path.join(folder, document["environment"]["file"]) if "environment" in document else None)
    set_cycles(scene, document["settings"]["maxDepth"], spp, seed, float(threshold))
    render = scene.render
    render.resolution_x, render.resolution_y = width, height
    render.image_settings.file_format = "OPEN_EXR"
    render.image_settings.color_depth = "32"
    render.filepath = out + ".exr"
    bpy.ops.render.render(write_still=True)
    write_pfm(render.filepath, out)


main()
