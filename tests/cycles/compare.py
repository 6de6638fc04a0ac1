#!/usr/bin/env python3
"""Compares pictures of glTF files with those of Cycles, Blender's path tracer.

    tests/cycles/compare.py HYALITE FOLDER [SPP]

Needs Debian's packages blender, python3-numpy and assimp-testmodels. FOLDER keeps what is made. Materials are matte on
both sides of the comparison, or metal, since Cycles' own principled material is not that of glTF; what is judged is
everything else: nodes, meshes, skins, morphs, textures and where they are, colours, cameras, environments. Prints for
each model the mean of Hyalite's picture divided by that of Cycles, and the mean FLIP error.
"""
import json
import math
import os
import shutil
import struct
import subprocess
import sys

MODELS = "/usr/share/assimp/models/glTF2/"
WIDTH, HEIGHT = 160, 120


def add_nodes(document, nodes):
    """Adds nodes to the scene, beside those that are there."""
    scene = document["scenes"][document.get("scene", 0)]
    for node in nodes:
        scene["nodes"].append(len(document["nodes"]))
        document["nodes"].append(node)


def add_lights(document):
    """A point, a spot and a sun, each of its own colour. A light shines along -z of its node."""
    tilted = [-0.5, 0, 0, 0.8660254037844386]  # 60 degrees down
    document.setdefault("extensions", {})["KHR_lights_punctual"] = {"lights": [
        {"type": "point", "intensity": 2, "color": [1, 0.7, 0.4]},
        {"type": "spot", "intensity": 8, "color": [0.4, 1, 0.5], "spot": {"outerConeAngle": 0.4}},
        {"type": "directional", "intensity": 1.5, "color": [0.5, 0.6, 1]}]}
    document.setdefault("extensionsUsed", []).append("KHR_lights_punctual")
    add_nodes(document, [
        {"translation": place, "rotation": tilted, "extensions": {"KHR_lights_punctual": {"light": light}}}
        for light, place in enumerate(([1.2, 0.9, 0.3], [0.2, 1.9, 1.2], [0, 3, 0]))])


def add_mirrored(document):
    """The first mesh again, under nodes that mirror, shear and turn it."""
    first = len(document["nodes"])
    document["nodes"].append({"mesh": 0, "rotation": [0, 0.3826834, 0, 0.9238795]})
    add_nodes(document, [{"children": [first], "scale": [-0.8, 0.5, 1], "translation": [0, 0.9, 0]}])


def add_tiles(document):
    """The texture tinted, turned and tiled: mirrored in one direction, repeated in the other."""
    document["samplers"] = [{"wrapS": 33648, "wrapT": 10497}]
    document["textures"][0]["sampler"] = 0
    document.setdefault("extensionsUsed", []).append("KHR_texture_transform")
    base = document["materials"][0]["pbrMetallicRoughness"]
    base["baseColorFactor"] = [1, 0.6, 0.3, 1]
    base["baseColorTexture"]["extensions"] = {
        "KHR_texture_transform": {"offset": [0.2, -0.7], "rotation": 0.5, "scale": [0.6, 0.35]}}


# Name, file, look ("matte" or the roughness of a metal), position and target of the camera, horizontal field
# of view, and what is added to the document.
CASES = [
    ("box", "BoxTextured-glTF-Embedded/BoxTextured.gltf", "matte", "1.3,1.1,1.6", "0,0,0", 40),
    ("box, metal 0.2", "BoxTextured-glTF-Embedded/BoxTextured.gltf", 0.2, "1.3,1.1,1.6", "0,0,0", 40),
    ("box, metal 0.5", "BoxTextured-glTF-Embedded/BoxTextured.gltf", 0.5, "1.3,1.1,1.6", "0,0,0", 40),
    ("box, metal 0.9", "BoxTextured-glTF-Embedded/BoxTextured.gltf", 0.9, "1.3,1.1,1.6", "0,0,0", 40),
    ("texcoords", "BoxTexcoords-glTF/boxTexcoords.gltf", "matte", "2.8,1.8,4", "0,0,0", 40),
    ("engine", "2CylinderEngine-glTF-Binary/2CylinderEngine.glb", "matte", "700,500,650", "0,-40,0", 40),
    ("skin", "simple_skin/simple_skin.gltf", "matte", "1.7,2.1,2.4", "0,1,0", 50),
    ("morph", "glTF-Sample-Models/AnimatedMorphCube-glTF/AnimatedMorphCube.gltf", "matte", "2.8,1.8,4", "0,0,0", 40),
    ("texture transform", "textureTransform/TextureTransformTest.gltf", "matte", "0.5,0.3,4", "0,0,0", 45),
    ("strip", "glTF-Asset-Generator/Mesh_PrimitiveMode/Mesh_PrimitiveMode_12.gltf", "matte", "0.3,0.2,1.3", "0,0,0",
     60),
    ("mirrored", "BoxTextured-glTF-Embedded/BoxTextured.gltf", "matte", "1.8,1.5,2.2", "0,0.3,0", 40, add_mirrored),
    ("lights", "BoxTextured-glTF-Embedded/BoxTextured.gltf", "matte", "1.3,1.1,1.6", "0,0,0", 40, add_lights),
    ("tiled", "BoxTextured-glTF-Embedded/BoxTextured.gltf", "matte", "1.3,1.1,1.6", "0,0,0", 40, add_tiles),
]


def rgbe(colour):
    fraction, exponent = math.frexp(max(colour))
    scale = fraction * 256 / max(colour)
    return bytes([int(channel * scale) for channel in colour] + [exponent + 128])


def sky(u, v):
    """Radiance of a smooth sky that looks different in every direction."""
    up = max(0.0, math.cos(v * math.pi))
    side = 0.5 + 0.5 * math.cos(2 * math.pi * (u - 0.3))
    return (0.25 + 0.9 * side * (0.3 + up) + 0.25 * up,
            0.25 + 0.6 * side * (0.3 + up) + 0.4 * up,
            0.25 + 0.3 * side * (0.3 + up) + 0.7 * up)


def write_sky(path, turned):
    """The middle of the image is -z in glTF's space. In Blender's it is a quarter turn beside that."""
    width, height = 64, 32
    with open(path, "wb") as file:
        file.write(b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y %d +X %d\n" % (height, width))
        for y in range(height):
            for x in range(width):
                column = (x + (width // 4 if turned else 0)) % width
                file.write(rgbe(sky((column + 0.5) / width, (y + 0.5) / height)))


def read_gltf(path):
    with open(path, "rb") as file:
        data = file.read()
    if data[:4] != b"glTF":
        return json.loads(data), b""
    length = struct.unpack("<I", data[12:16])[0]
    return json.loads(data[20:20 + length]), data[20 + length:]


def write_gltf(path, document, chunks):
    text = json.dumps(document).encode()
    if path.endswith(".glb"):
        text += b" " * (-len(text) % 4)
        text = struct.pack("<4sIIII", b"glTF", 2, 20 + len(text) + len(chunks), len(text), 0x4E4F534A) + text + chunks
    with open(path, "wb") as file:
        file.write(text)


def with_look(document, look):
    """The document with materials of one look: their base colour alone is left."""
    materials = document.setdefault("materials", [])
    materials.append({})
    for material in materials:
        base = material.setdefault("pbrMetallicRoughness", {})
        base.pop("metallicRoughnessTexture", None)
        base["metallicFactor"] = 0 if look == "matte" else 1
        base["roughnessFactor"] = 1 if look == "matte" else look
        material["extensions"] = {"KHR_materials_specular": {"specularFactor": 0}} if look == "matte" else {}
    for mesh in document.get("meshes", []):
        for primitive in mesh["primitives"]:
            primitive.setdefault("material", len(materials) - 1)
    document["extensionsUsed"] = sorted(set(document.get("extensionsUsed", [])) | {"KHR_materials_specular"})
    return document


def compare(hyalite, folder, spp, case):
    name, file, look, position, target, fov, *additions = case
    own = os.path.join(folder, name.replace(" ", "-").replace(",", ""))
    shutil.rmtree(own, ignore_errors=True)
    shutil.copytree(os.path.dirname(MODELS + file), own)
    model = os.path.join(own, os.path.basename(file))
    document, chunks = read_gltf(model)
    for add in additions:
        add(document)
    write_gltf(model, with_look(document, look), chunks)
    theirs, ours, report = (os.path.join(own, part) for part in ("cycles.exr", "hyalite.pfm", "diff.json"))
    script = os.path.join(os.path.dirname(os.path.abspath(__file__)), "cycles.py")
    numbers = [str(number) for number in (fov, WIDTH, HEIGHT, spp)]
    with open(os.path.join(own, "cycles.log"), "w") as log:
        subprocess.run(["blender", "-b", "-noaudio", "--python-exit-code", "1", "--python", script, "--", model,
                        "matte" if look == "matte" else "metal", os.path.join(folder, "sky_blender.hdr"), theirs,
                        position, target, *numbers], stdout=log, stderr=log, check=True)
    subprocess.run([hyalite, "render", model, "-o", ours, "--environment", os.path.join(folder, "sky.hdr"), "--quiet",
                    "--integrator", "path", "--max-depth", "24", "--filter", "box", "--camera-position", position,
                    "--look-at", target, "--fov", numbers[0], "--width", numbers[1], "--height", numbers[2], "--spp",
                    numbers[3]], check=True)
    subprocess.run([hyalite, "diff", theirs, ours, "--report", report], stdout=subprocess.DEVNULL)
    with open(report) as file:
        difference = json.load(file)
    with open(ours, "rb") as file:
        values = file.read().split(b"\n", 3)[3]
    mean = sum(struct.unpack("<%df" % (WIDTH * HEIGHT * 3), values)) / (WIDTH * HEIGHT * 3)
    share = mean / (mean - difference["meanDifference"])
    print("| %s | %.4f | %.4f |" % (name, share, difference["flip"]["mean"]), flush=True)


def main():
    if len(sys.argv) not in (3, 4):
        sys.exit(__doc__)
    hyalite, folder = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2])
    for need, package in ((shutil.which("blender"), "blender"), (os.path.isdir(MODELS), "assimp-testmodels")):
        if not need:
            sys.exit("compare.py: install the package " + package)
    os.makedirs(folder, exist_ok=True)
    write_sky(os.path.join(folder, "sky.hdr"), False)
    write_sky(os.path.join(folder, "sky_blender.hdr"), True)
    print("| model | mean, of Cycles' | FLIP |\n|---|---|---|")
    for case in CASES:
        compare(hyalite, folder, int(sys.argv[3]) if len(sys.argv) == 4 else 1024, case)


main()
