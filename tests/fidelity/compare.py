#!/usr/bin/env python3
"""Compares pictures of Khronos' sample models with those that ten other renderers made of them.

    tests/fidelity/compare.py HYALITE MODELS PICTURES CONFIG LIGHTS FOLDER [--spp N] [--size PIXELS] [NAME...]

Needs Debian's packages python3-numpy and python3-pil, and these files, none of which is part of this repository:

MODELS     Models/ of github.com/KhronosGroup/glTF-Sample-Assets
PICTURES   public/thumbnails/goldens/ of github.com/KhronosGroup/glTF-Render-Fidelity
CONFIG     test/config.json of github.com/KhronosGroup/glTF-Render-Fidelity-Generator: views and lights
LIGHTS     folder of that repository's environments/; a .pfm or .exr of the same name will do
FOLDER     keeps what is made: index.html has our picture beside all others, a row a model, and what we warned of

--size     the longest side of the pictures; 512, as published, unless it is smaller
NAME...    only these models. Those of which a file is missing, or that are refused, are left out and named.

The published pictures have Stephen Hill's ACES curve at an exposure of 1/0.6. Prints the mean FLIP error of our picture
against the median of all renderers, pixel by pixel, and against the nearest path tracer, beside the smallest and the
largest error that one of the other renderers has against that median. Pictures are compared over white.
"""
import html
import json
import math
import os
import re
import subprocess
import sys

try:
    import numpy
    from PIL import Image
except ImportError:
    sys.exit("compare.py: install the packages python3-numpy and python3-pil")

PATH_TRACERS = ("blender-cycles", "dspbr-pt", "stellar", "three-gpu-pathtracer", "vray")
EXPOSURE = math.log2(1 / 0.6)
HEAD = """<!doctype html><meta charset="utf-8"><meta name="viewport" content="width=device-width"><title>Fidelity</title>
<style>body{font:14px sans-serif;background:#fff}figure{display:inline-block;margin:2px}img{max-width:90vw}
figcaption{font-size:12px}pre{white-space:pre-wrap;overflow-wrap:anywhere;color:#a40}</style>"""


def fail(message):
    sys.exit("compare.py: " + message)


def over_white(path, size=None):
    picture = Image.open(path).convert("RGBA")
    if size and picture.size != size:
        picture = picture.resize(size, Image.LANCZOS)
    paper = Image.new("RGBA", picture.size, "white")
    return Image.alpha_composite(paper, picture).convert("RGB")


def model_of(models, name):
    """The first kind of file that is there, binary ones first; without --, None."""
    for kind, suffix in (("glTF-Binary", ".glb"), ("glTF", ".gltf")):
        path = os.path.join(models, name, kind, name + suffix)
        if os.path.exists(path):
            return path
    return None


def light_of(lights, scenario):
    stem = os.path.splitext(os.path.basename(scenario.get("lighting", "lightroom_14b.hdr")))[0]
    for suffix in (".hdr", ".exr", ".pfm"):
        path = os.path.join(lights, stem + suffix)
        if os.path.exists(path):
            return path
    return None


def view_of(scenario, size):
    """Options of the camera. It stands on a sphere around the target; theta is around +y from +z, phi from +y."""
    target = numpy.array([scenario.get("target", {}).get(axis, 0) for axis in "xyz"], float)
    orbit = {"theta": 0, "phi": 90, "radius": 1, **scenario.get("orbit", {})}
    theta, phi = math.radians(orbit["theta"]), math.radians(orbit["phi"])
    back = numpy.array([math.sin(phi) * math.sin(theta), math.cos(phi), math.sin(phi) * math.cos(theta)])
    position = target + orbit["radius"] * back
    dimensions = {"width": 768, "height": 768, **scenario.get("dimensions", {})}
    half = math.tan(math.radians(scenario.get("verticalFoV", 45)) / 2)
    fov = 2 * math.degrees(math.atan(half * dimensions["width"] / dimensions["height"]))
    triple = "{0[0]:.9g},{0[1]:.9g},{0[2]:.9g}".format
    return ["--width", str(size[0]), "--height", str(size[1]), "--fov", "%.9g" % fov, "--camera-position",
            triple(position), "--look-at", triple(position - back), "--up", "y"]


def flip(hyalite, reference, picture, report):
    subprocess.run([hyalite, "diff", reference, picture, "--report", report], stdout=subprocess.DEVNULL)
    with open(report) as file:
        return json.load(file)["flip"]["mean"]


class Comparison:
    def __init__(self, hyalite, folder, name, scenario, published):
        self.hyalite, self.folder, self.name, self.scenario = hyalite, folder, name, scenario
        self.published, self.warnings = published, ""

    def path(self, which):
        return os.path.join(self.folder, self.name, which + ".png")

    def prepare(self, longest):
        """The published pictures, all of one size, at most so many pixels wide and high, and their median."""
        os.makedirs(os.path.join(self.folder, self.name), exist_ok=True)
        width, height = Image.open(next(iter(self.published.values()))).size
        share = min(1, longest / max(width, height))
        self.size = round(width * share), round(height * share)
        pictures = []
        for renderer, path in self.published.items():
            picture = over_white(path, self.size)
            picture.save(self.path(renderer))
            pictures.append(numpy.asarray(picture))
        median = numpy.median(numpy.stack(pictures), axis=0)
        Image.fromarray(numpy.round(median).astype("uint8")).save(self.path("median"))

    def render(self, model, light, spp):
        """Whether there is a picture of the whole model. Where others have +x in the middle of a light, we have -z."""
        ours = self.path("rendered")
        command = [self.hyalite, "render", model, "-o", ours, "--environment", light, "--environment-rotate", "-90",
                   "--integrator", "path", "--spp", str(spp), "--max-depth", "16", "--denoise", "--tone", "aces",
                   "--exposure", "%.6f" % EXPOSURE, "--allow-path", light, *view_of(self.scenario, self.size)]
        command += [] if self.scenario.get("renderSkybox") else ["--alpha"]
        done = subprocess.run(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        self.warnings = "".join(line.replace(model + ": ", "") + "\n" for line in done.stderr.splitlines()
                                if line.startswith("hyalite: ") and "occlusionTexture" not in line)
        if done.returncode != 0 or "there is no such file" in done.stderr:
            return False
        over_white(ours).save(self.path("ours"))
        return True

    def judge(self):
        report = os.path.join(self.folder, self.name, "flip.json")
        self.errors = {which: flip(self.hyalite, self.path("median"), self.path(which), report)
                       for which in ("ours", *self.published)}
        tracers = {which: flip(self.hyalite, self.path(which), self.path("ours"), report)
                   for which in self.published if which in PATH_TRACERS}
        self.nearest = min(tracers, key=tracers.get) if tracers else "-"
        self.to_nearest = tracers.get(self.nearest, math.nan)

    def row(self):
        others = sorted(self.errors[which] for which in self.published)
        return "| %s | %.3f | %.3f | %s | %.3f to %.3f |" % (
            self.name, self.errors["ours"], self.to_nearest, self.nearest, others[0], others[-1])

    def html(self):
        def figure(which):
            error = " %.3f" % self.errors[which] if which in self.errors else ""
            return "<figure><img src='%s/%s.png'><figcaption>%s%s</figcaption></figure>" % (
                self.name, which, which, error)

        return "<h2>%s</h2><pre>%s</pre>%s" % (
            self.name, html.escape(self.warnings), "".join(map(figure, ("ours", "median", *self.published))))


def main():
    arguments, numbers = sys.argv[1:], {"--spp": 256, "--size": 512}
    for option in numbers:
        if option in arguments[:-1]:
            at = arguments.index(option)
            numbers[option] = int(arguments[at + 1])
            del arguments[at:at + 2]
    if len(arguments) < 6:
        sys.exit(__doc__)
    hyalite, models, pictures, config, lights, folder = (os.path.abspath(each) for each in arguments[:6])
    wanted = arguments[6:]
    if not os.access(hyalite, os.X_OK):
        fail(hyalite + " is not a program")
    with open(config) as file:
        scenarios = {re.sub("^khronos-", "", each["name"]): each for each in json.load(file)["scenarios"]}
    left_out, page = [], []
    print("| model | to the median | to the nearest path tracer | which | the others to the median |")
    print("|---|---|---|---|---|", flush=True)
    for name, scenario in scenarios.items():
        shown = os.path.join(pictures, scenario["name"])
        model, light = model_of(models, name), light_of(lights, scenario)
        if wanted and name not in wanted or not os.path.isdir(shown):
            continue
        published = {file.split("-golden")[0]: os.path.join(shown, file) for file in sorted(os.listdir(shown))}
        comparison = Comparison(hyalite, folder, name, scenario, published)
        if model is None or light is None:
            left_out.append(name)
            continue
        comparison.prepare(numbers["--size"])
        if not comparison.render(model, light, numbers["--spp"]):
            left_out.append(name)
            print(comparison.warnings, file=sys.stderr)
            continue
        comparison.judge()
        print(comparison.row(), flush=True)
        page.append(comparison.html())
        with open(os.path.join(folder, "index.html"), "w") as file:
            file.write(HEAD + "".join(page))
    print("\nleft out: " + ", ".join(left_out or ["none"]))


main()
