"""Renders a glTF file by Cycles, inside Blender: compare.py says how.

    blender -b --python cycles.py -- MODEL LOOK SKY OUT.exr POSITION TARGET FOV WIDTH HEIGHT SPP
"""
import math
import sys

import bpy
import mathutils
import numpy

for word in ("bool", "int", "float", "object"):  # of numpy before 1.24, which the importer of Blender 3.4 uses
    if word not in numpy.__dict__:
        setattr(numpy, word, getattr(__import__("builtins"), word))


def point(text):
    """From glTF's space, where y is up, to Blender's."""
    x, y, z = (float(part) for part in text.split(","))
    return mathutils.Vector((x, -z, y))


def set_look(look):
    """Metals keep their energy as ours do; what is matte gets a Lambertian BSDF of the same colour."""
    for material in bpy.data.materials:
        if not material.use_nodes:
            continue
        tree = material.node_tree
        for node in [node for node in tree.nodes if node.type == "BSDF_PRINCIPLED"]:
            node.distribution = "MULTI_GGX"
            if look != "matte":
                continue
            matte = tree.nodes.new("ShaderNodeBsdfDiffuse")
            matte.inputs["Color"].default_value = node.inputs["Base Color"].default_value
            for theirs, own in (("Base Color", "Color"), ("Normal", "Normal")):
                if node.inputs[theirs].links:
                    tree.links.new(node.inputs[theirs].links[0].from_socket, matte.inputs[own])
            for link in list(node.outputs[0].links):
                tree.links.new(matte.outputs[0], link.to_socket)


def set_camera(scene, position, target, fov):
    camera = bpy.data.cameras.new("camera")
    camera.sensor_fit = "HORIZONTAL"
    camera.angle = math.radians(fov)
    camera.clip_start, camera.clip_end = 1e-3, 1e5
    placed = bpy.data.objects.new("camera", camera)
    placed.location = position
    placed.rotation_mode = "QUATERNION"
    placed.rotation_quaternion = (target - position).to_track_quat("-Z", "Y")
    scene.collection.objects.link(placed)
    scene.camera = placed


def set_sky(scene, path):
    world = bpy.data.worlds.new("world")
    world.use_nodes = True
    nodes = world.node_tree.nodes
    image = nodes.new("ShaderNodeTexEnvironment")
    image.image = bpy.data.images.load(path)
    world.node_tree.links.new(image.outputs["Color"], nodes["Background"].inputs["Color"])
    scene.world = world


def set_cycles(scene, spp):
    """An unbiased path tracer with a box filter, as ours is."""
    scene.render.engine = "CYCLES"
    cycles = scene.cycles
    cycles.device = "CPU"
    cycles.samples = spp
    cycles.use_adaptive_sampling = cycles.use_denoising = False
    cycles.max_bounces = cycles.diffuse_bounces = cycles.glossy_bounces = cycles.transmission_bounces = 24
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = cycles.blur_glossy = 0
    cycles.pixel_filter_type = "BOX"


def main():
    model, look, sky, out, position, target, *numbers = sys.argv[sys.argv.index("--") + 1:]
    fov, width, height, spp = (int(number) for number in numbers)
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.import_scene.gltf(filepath=model, convert_lighting_mode="COMPAT")  # watts, as ours
    for light in bpy.data.lights:
        light.shadow_soft_size = 0
    scene = bpy.context.scene
    set_look(look)
    set_camera(scene, point(position), point(target), fov)
    set_sky(scene, sky)
    set_cycles(scene, spp)
    render = scene.render
    render.resolution_x, render.resolution_y, render.resolution_percentage = width, height, 100
    render.image_settings.file_format = "OPEN_EXR"
    render.image_settings.color_depth = "32"
    render.image_settings.color_mode = "RGB"
    render.use_file_extension = False
    render.filepath = out
    bpy.ops.render.render(write_still=True)


main()
