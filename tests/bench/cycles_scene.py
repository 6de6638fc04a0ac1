"""Renders a scene file of Hyalite by Cycles, inside Blender: cycles.py says what for.

    blender -b --python cycles_scene.py -- SCENE.json UNIT OUT.pfm WIDTH HEIGHT SPP SEED THRESHOLD

Knows what the scenes of cycles.py have: a camera, an environment or darkness, meshes of OBJ files, which may be moved, and
of glTF files, and materials that are diffuse, emit, or are conductors, all of which are white here. A mesh without a
material keeps those of its file, as Blender reads them. UNIT is that of the scene in metres: Cycles is less exact on rooms
of hundreds of metres. THRESHOLD is the noise at which Cycles takes no more samples of a pixel; 0: each has SPP. What else
decides speed is Blender's default.
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
    """The importers turn a mesh by themselves."""
    if not path.endswith(".obj"):
        numpy.bool = bool  # which Blender 3.4 reads, and Debian's NumPy has no more
        bpy.ops.import_scene.gltf(filepath=path)
        return
    bpy.ops.wm.obj_import(filepath=path)
    for placed in bpy.context.selected_objects:
        placed.location, placed.scale = unit * turned(place), [unit] * 3
        if material:
            placed.data.materials.clear()
            placed.data.materials.append(material)
    if not material:
        mend_materials(os.path.splitext(path)[0] + ".mtl")


def mend_materials(path):
    """What the importer leaves out of MTL, of version 3.4: normal maps, factors of emission, and that roughness is no
    colour. Materials with a roughness reflect as glass does; the others are diffuse."""
    with open(path) as file:
        for word, *words in (line.split() for line in file if line.strip()):
            if word == "newmtl":
                tree = bpy.data.materials[words[0]].node_tree
                node = tree.nodes["Principled BSDF"]
                node.inputs["Roughness"].default_value = 0  # of the diffuse part
            elif word in ("Pr", "map_Pr"):
                node.inputs["Specular"].default_value = 0.5
                if word == "Pr":
                    node.inputs["Roughness"].default_value = float(words[0])
                else:
                    node.inputs["Roughness"].links[0].from_node.image.colorspace_settings.name = "Non-Color"
            elif word == "Ke":
                node.inputs["Emission Strength"].default_value = float(words[0])
            elif word == "norm":
                colours, normals = tree.nodes.new("ShaderNodeTexImage"), tree.nodes.new("ShaderNodeNormalMap")
                colours.image = bpy.data.images.load(os.path.join(os.path.dirname(path), words[-1]))
                colours.image.colorspace_settings.name = "Non-Color"
                for link in node.inputs["Base Color"].links[0].from_node.inputs["Vector"].links:
                    tree.links.new(link.from_socket, colours.inputs["Vector"])
                tree.links.new(colours.outputs["Color"], normals.inputs["Color"])
                tree.links.new(normals.outputs["Normal"], node.inputs["Normal"])


def set_camera(scene, view, unit):
    camera = bpy.data.cameras.new("camera")
    camera.sensor_fit = "HORIZONTAL"
    camera.angle = math.radians(view["horizontalFov"])
    placed = bpy.data.objects.new("camera", camera)
    placed.location = unit * turned(view["position"])
    direction = view.get("direction") or [to - at for to, at in zip(view["target"], view["position"])]
    placed.rotation_euler = turned(direction).to_track_quat("-Z", "Y").to_euler()
    scene.collection.objects.link(placed)
    scene.camera = placed


def load_image(path):
    """Blender does not read PFM."""
    if not path.endswith(".pfm"):
        return bpy.data.images.load(path)
    with open(path, "rb") as file:
        _, size, _, values = file.read().split(b"\n", 3)
    width, height = map(int, size.split())
    pixels = numpy.ones((height, width, 4), numpy.float32)
    pixels[..., :3] = numpy.frombuffer(values, "<f4").reshape(height, width, 3)
    image = bpy.data.images.new("image", width, height, float_buffer=True)
    image.pixels.foreach_set(pixels.ravel())
    return image


def set_world(scene, folder, environment):
    scene.world = bpy.data.worlds.new("world")
    scene.world.use_nodes = True
    tree = scene.world.node_tree
    background = tree.nodes["Background"]
    background.inputs["Color"].default_value = (0, 0, 0, 1)
    if environment:
        image = tree.nodes.new("ShaderNodeTexEnvironment")
        image.image = load_image(os.path.join(folder, environment["file"]))
        tree.links.new(image.outputs["Color"], background.inputs["Color"])
        background.inputs["Strength"].default_value = environment.get("scale", 1)
        # The middle of an image is -z in Hyalite, which is +y here, and +x for Blender.
        mapping = tree.nodes.new("ShaderNodeMapping")
        mapping.inputs["Rotation"].default_value[2] = math.radians(-90 - environment.get("rotateDegrees", 0))
        tree.links.new(tree.nodes.new("ShaderNodeTexCoord").outputs["Generated"], mapping.inputs["Vector"])
        tree.links.new(mapping.outputs["Vector"], image.inputs["Vector"])
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
    cycles.max_bounces = cycles.diffuse_bounces = cycles.glossy_bounces = cycles.transmission_bounces = depth - 2
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
    looks = {name: make_material(look) for name, look in document.get("materials", {}).items()}
    for mesh in document["meshes"]:
        add_mesh(os.path.join(folder, mesh["file"]), mesh.get("translate", [0, 0, 0]), unit,
                 looks.get(mesh.get("material")))
    set_camera(scene, document["camera"], unit)
    set_world(scene, folder, document.get("environment"))
    set_cycles(scene, document["settings"]["maxDepth"], spp, seed, float(threshold))
    render = scene.render
    render.resolution_x, render.resolution_y = width, height
    render.image_settings.file_format = "OPEN_EXR"
    render.image_settings.color_depth = "32"
    render.filepath = out + ".exr"
    bpy.ops.render.render(write_still=True)
    write_pfm(render.filepath, out)


main()
