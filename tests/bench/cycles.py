#!/usr/bin/env python3
"""Compares the time until a picture is clean with that of Cycles, Blender's path tracer.

    tests/bench/cycles.py HYALITE FOLDER [SCENE...] [--until noise,.08,.05] [--quick]

Needs Debian's packages blender, python3-numpy and mesa-vulkan-drivers. FOLDER keeps what is made. SCENE is cornell,
metals, still-life, or a glTF file; without any, the first three. --quick shows that the script works: its pictures are
small and each is timed once.

1. Both programs render a scene from the same files: the Cornell box, white rough metals, the still life, or what a glTF
   file holds under a sky. The script fails unless the pictures have the same mean, as a whole and in 16 regions. Of
   textured materials Blender's reading and models differ a little, so that those pictures may differ more.
2. Two renders with different seeds differ by their noise alone. Half of the squared difference is the variance of a
   pixel. The noise is the square root of the mean variance, without the noisiest 0.1 % of the pixels, divided by the
   mean of the picture. Samples are doubled until the noise is below 5 % (--until noise). The last two counts say how
   many it takes.
3. User seconds of a process with so many samples, less those of a process with one sample: the median of three turns,
   in which the programs follow each other. Step 2 has run the same commands, so that kernels are in the driver's cache.
   Between the last two counts, the logarithms of samples and seconds are taken for a line.
4. The same until the mean HDR-FLIP of a picture, against 1,024 samples of the same program by another seed, is below
   those numbers of --until; beside them Cycles with adaptive samples, by thresholds of noise of 1/1, 1/2, 1/4 ... in
   place of counts, and ours denoised.
"""
import argparse
import collections
import datetime
import functools
import json
import math
import os
import resource
import shutil
import statistics
import subprocess
import sys

try:
    import numpy
except ImportError:
    sys.exit("cycles.py: install the package python3-numpy")

HERE = os.path.dirname(os.path.abspath(__file__))
CORNELL = os.path.join(HERE, "..", "..", "assets", "scenes", "cornell.json")
NOISE = 0.05  # standard deviation of a pixel, of the mean of all
NOISIEST = 0.001  # share of the pixels that is left out
MAX_SAMPLES = 4096
TRUE_SAMPLES = 1024
SAME, ALIKE = (0.01, 0.02), (0.05, 0.15)  # relative differences that the means of a picture and of its regions may have

Scene = collections.namedtuple("Scene", "name path unit_metres width height may_differ")


def fail(message):
    sys.exit("cycles.py: " + message)


def write_sky(path):
    """A soft lamp overhead in a dim sky."""
    width, height = 256, 128
    with open(path, "wb") as file:
        file.write(b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y %d +X %d\n" % (height, width))
        for y in range(height):
            up = max(0, math.cos(math.pi * (y + 0.5) / height))
            fraction, exponent = math.frexp(0.25 + 4 * up ** 16)
            file.write(bytes([int(fraction * 256)] * 3 + [exponent + 128]) * width)


def write_ball(path, columns=64, rows=32):
    """A smooth ball of radius 1. Cycles has no spheres, so both programs get the same triangles."""
    with open(path, "w") as file:
        for row in range(rows + 1):
            for column in range(columns):
                down, around = math.pi * row / rows, 2 * math.pi * column / columns
                point = (math.sin(down) * math.cos(around), math.cos(down), -math.sin(down) * math.sin(around))
                file.write("v %.7g %.7g %.7g\nvn %.7g %.7g %.7g\n" % (*point, *point))
        for row in range(rows):
            for column in range(columns):
                a, b = (row * columns + 1 + (column + step) % columns for step in (0, 1))
                corners = [a, a + columns, b + columns, b]
                if row in (0, rows - 1):  # a triangle at a pole
                    corners.pop(3 if row == 0 else 2)
                file.write("f " + " ".join("%d//%d" % (corner, corner) for corner in corners) + "\n")


def write_metals(folder):
    """Five balls of metal on a grey floor. With an index of 0 a metal reflects everything, at every angle."""
    write_sky(os.path.join(folder, "sky.hdr"))
    write_ball(os.path.join(folder, "ball.obj"))
    with open(os.path.join(folder, "floor.obj"), "w") as file:
        file.write("v -50 0 50\nv 50 0 50\nv 50 0 -50\nv -50 0 -50\nf 1 2 3 4\n")
    metals = {"metal %g" % roughness: {"type": "conductor", "index": 0, "extinction": 1, "roughness": roughness}
              for roughness in (0.3, 0.45, 0.6, 0.75, 0.9)}
    balls = [{"file": "ball.obj", "translate": [2.2 * index - 4.4, 1, 0], "material": name}
             for index, name in enumerate(metals)]
    path = os.path.join(folder, "metals.json")
    with open(path, "w") as file:
        json.dump({"camera": {"position": [0, 5, 12], "direction": [0, -4.2, -12], "horizontalFov": 50},
                   "environment": {"file": "sky.hdr"},
                   "materials": {"floor": {"type": "diffuse", "albedo": 0.5}, **metals},
                   "meshes": [{"file": "floor.obj", "material": "floor"}] + balls,
                   "settings": {"integrator": "path", "maxDepth": 16, "bvh": "sah"}}, file, indent=1)
    return path


def write_model(hyalite, folder, model):
    """A glTF file under the sky, from where Hyalite looks at it."""
    write_sky(os.path.join(folder, "sky.hdr"))
    inspected = subprocess.run([hyalite, "inspect", model, "--json"], stdout=subprocess.PIPE)
    if inspected.returncode != 0:
        fail("cannot inspect " + model)
    camera = json.loads(inspected.stdout)["camera"]
    path = os.path.join(folder, os.path.splitext(os.path.basename(model))[0] + ".json")
    with open(path, "w") as file:
        json.dump({"camera": {"position": camera["position"], "direction": camera["direction"],
                              "horizontalFov": 0.6 * camera["horizontalFov"]},  # the model fills the picture
                   "environment": {"file": "sky.hdr"}, "meshes": [{"file": model}],
                   "settings": {"integrator": "path", "maxDepth": 8, "bvh": "sah"}}, file, indent=1)
    return path


class Program:
    """`files` begins the names of its files. `command` takes a scene, a picture, a count of samples and a seed. `plain`
    is the program whose pictures of many samples this one's become."""

    def __init__(self, name, files, command, plain=None):
        self.name, self.files, self.command, self.plain = name, files, command, plain or self

    def stem(self, scene):
        return "%s-%s" % (self.files, scene.name)

    def render(self, scene, spp, seed):
        """The picture, and the user seconds of the process."""
        stem = self.stem(scene)
        command = self.command(scene, stem + ".pfm", str(spp), str(seed))
        before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
        with open(stem + ".log", "w") as log:
            code = subprocess.run(command, stdout=log, stderr=log).returncode
        seconds = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before
        if code != 0:
            fail("exit code %d of\n%s\n%s.log says why" % (code, " ".join(command), stem))
        with open(stem + ".pfm", "rb") as file:
            values = file.read().split(b"\n", 3)[3]
        return numpy.frombuffer(values, "<f4").reshape(scene.height, scene.width, 3).astype(float), seconds

    def noise(self, scene, spp):
        a, b = (self.render(scene, spp, seed)[0] for seed in (1, 2))
        variances = numpy.sort(((a - b) ** 2 / 2).mean(2).ravel())
        kept = variances[:len(variances) - math.ceil(NOISIEST * len(variances))]
        return math.sqrt(kept.mean()) / ((a.mean() + b.mean()) / 2)

    def keep_truth(self, scene):
        self.render(scene, TRUE_SAMPLES, 99)
        os.replace(self.stem(scene) + ".pfm", self.stem(scene) + "-true.pfm")

    def flip(self, hyalite, scene, spp):
        self.render(scene, spp, 1)
        report = self.stem(scene) + "-flip.json"
        subprocess.run([hyalite, "diff", self.plain.stem(scene) + "-true.pfm", self.stem(scene) + ".pfm", "--report",
                        report], stdout=subprocess.DEVNULL)
        with open(report) as file:
            return json.load(file)["flip"]["mean"]

    def samples_needed(self, scene, error_of, wanted):
        """The count at which error_of(scene, count) is as wanted, 2 or more, and the power of two above. It falls like a
        power of the count between the two last, whatever its exponent."""
        spp, error, last = 2, error_of(scene, 2), None
        while error > wanted:
            if spp >= MAX_SAMPLES:
                fail("%s has an error of %.3f in %s at %d samples" % (self.name, error, scene.name, spp))
            spp, error, last = 2 * spp, error_of(scene, 2 * spp), error
        return spp * (error / wanted) ** (1 / math.log2(last / error)) if last else 2, spp


def regions(picture):
    height, width, _ = picture.shape
    return picture.reshape(4, height // 4, 4, width // 4, 3).mean((1, 3, 4))


def match(scene, cycles, hyalite, spp):
    theirs, ours = (program.render(scene, spp, 0)[0] for program in (cycles, hyalite))
    share, shares = ours.mean() / theirs.mean(), regions(ours) / regions(theirs)
    print("| %s | %.4f | %.4f to %.4f |" % (scene.name, share, shares.min(), shares.max()), flush=True)
    differences = abs(share - 1), abs(shares - 1).max()
    if any(difference > may for difference, may in zip(differences, scene.may_differ)):
        (mean, region), (mean_may, region_may) = differences, scene.may_differ
        fail("the pictures of %s do not match: means differ by %.1f %%, which may be %g %%, and those of a region by "
             "%.1f %%, which may be %g %%" % (scene.name, 100 * mean, 100 * mean_may, 100 * region, 100 * region_may))


def race(title, scene, needed, turns):
    """Prints a row a program of what Program.samples_needed() says. The others are compared with the first."""
    programs = list(needed)
    starts, seconds = ({program: [] for program in programs} for _ in range(2))
    for _ in range(turns):
        for program, (samples, spp) in needed.items():
            start = program.plain.render(scene, 1, 1)[1]
            fewer, more = (program.render(scene, count, 1)[1] for count in (max(spp // 2, 2), spp))
            starts[program].append(start)
            fewer, more = max(fewer - start, 0.01), max(more - start, 0.01)
            seconds[program].append(more * (more / fewer) ** math.log2(samples / spp))
    first = statistics.median(seconds[programs[0]])
    for program in programs:
        start, own = (statistics.median(of[program]) for of in (starts, seconds))
        print("| %s | %s | %s | %.0f | %.2f | %.2f | %.2f |" % (
            scene.name, title, program.name, needed[program][0], start, own, first / own), flush=True)


def print_versions(hyalite):
    def lines_of(*command):
        return subprocess.run(command, stdout=subprocess.PIPE, text=True).stdout.splitlines()

    with open("/proc/cpuinfo") as file:
        models = [line.split(":")[1].strip() for line in file if line.startswith("model name")]
    drivers = [line.split(None, 1)[1] for line in lines_of(hyalite, "devices")
               if line.split()[:2] == ["driver", "llvmpipe"]]
    if not drivers:
        fail("install the package mesa-vulkan-drivers")
    print("| what | value |\n|---|---|")
    print("| date | %s |" % datetime.date.today())
    print("| machine | %s, %d threads |" % (models[0] if models else "unknown", os.cpu_count()))
    print("| programs | %s, %s |" % (lines_of("blender", "--version")[0], lines_of(hyalite, "--version")[0]))
    print("| driver | %s |" % drivers[0], flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("hyalite", metavar="HYALITE", type=os.path.abspath)
    parser.add_argument("folder", metavar="FOLDER", type=os.path.abspath)
    parser.add_argument("scenes", nargs="*", default=["cornell", "metals", "still-life"], metavar="SCENE")
    parser.add_argument("--until", default="noise,.08,.05")
    parser.add_argument("--quick", action="store_true")
    arguments = parser.parse_args()
    hyalite, folder, is_quick = arguments.hyalite, arguments.folder, arguments.quick
    wanted = arguments.until.split(",")
    if not os.access(hyalite, os.X_OK):
        fail(hyalite + " is not a program")
    if not shutil.which("blender"):
        fail("install the package blender")
    os.makedirs(folder, exist_ok=True)
    os.environ["MESA_SHADER_CACHE_DIR"] = os.environ["HYALITE_CACHE"] = folder  # no kernels or tunings of other runs

    def run_blender(is_adaptive):
        def command(scene, picture, spp, seed):
            count, threshold = (str(MAX_SAMPLES), str(1 / int(spp))) if is_adaptive else (spp, "0")
            return ["blender", "-b", "--factory-startup", "-noaudio", "--python-exit-code", "1", "--python",
                    os.path.join(HERE, "cycles_scene.py"), "--", scene.path, str(scene.unit_metres), picture,
                    str(scene.width), str(scene.height), count, seed, threshold]

        return command

    def run_on(device, *options):
        return lambda scene, picture, spp, seed: [
            hyalite, "render", scene.path, "-o", picture, "--device", device, "--width", str(scene.width), "--height",
            str(scene.height), "--spp", spp, "--seed", seed, "--quiet", *allowed, *options]

    def program(name, files, command, plain=None):
        return Program(name, os.path.join(folder, files), command, plain)

    cycles = program("Cycles", "cycles", run_blender(False))
    lavapipe = program("Hyalite, lavapipe", "lavapipe", run_on("llvmpipe"))
    twin = program("Hyalite, CPU twin", "cpu", run_on("cpu"))
    adaptive = program("Cycles, adaptive", "adaptive", run_blender(True), cycles)
    denoised = program("Hyalite, lavapipe, denoised", "denoised", run_on("llvmpipe", "--denoise"), lavapipe)
    endings = (".gltf", ".glb")
    allowed = [word for name in arguments.scenes if name.endswith(endings)
               for word in ("--allow-path", os.path.dirname(os.path.abspath(name)))]
    still_life = os.path.join(os.path.dirname(hyalite), "..", "share", "hyalite", "scenes", "still-life.json")

    def scene_of(name):
        scale = 0.4 if is_quick else 1

        def scene(path, unit_metres, width, height, may_differ):
            return Scene(os.path.splitext(os.path.basename(name))[0], path, unit_metres, 4 * round(scale * width / 4),
                         4 * round(scale * height / 4), may_differ)

        if name == "cornell":
            return scene(CORNELL, 0.001, 256, 256, SAME)
        if name == "metals":
            return scene(write_metals(folder), 1, 320, 200, SAME)
        if name == "still-life":
            return scene(still_life, 1, 240, 160, ALIKE)
        if name.endswith(endings):
            return scene(write_model(hyalite, folder, os.path.abspath(name)), 1, 320, 320, ALIKE)
        fail("SCENE is cornell, metals, still-life, or a glTF file")

    scenes = [scene_of(name) for name in arguments.scenes]
    turns = 1 if is_quick else 3
    print_versions(hyalite)
    print("\n| scene | mean, of Cycles' | of regions |\n|---|---|---|")
    for scene in scenes:
        match(scene, cycles, lavapipe, 256 if is_quick else 1024)
    print("\n| scene | until | program | samples | user s with one sample | user s more | times as fast |")
    print("|---|---|---|---|---|---|---|")
    for scene in scenes:
        if "noise" in wanted:
            needed = {each: each.samples_needed(scene, each.noise, NOISE) for each in (cycles, lavapipe, twin)}
            race("noise 5 %", scene, needed, turns)
        flips = [float(flip) for flip in wanted if flip != "noise"]
        for each in (cycles, lavapipe) if flips else ():
            each.keep_truth(scene)
        for flip in flips:
            needed = {each: each.samples_needed(scene, functools.partial(each.flip, hyalite), flip)
                      for each in (cycles, adaptive, lavapipe, denoised)}
            race("FLIP %g" % flip, scene, needed, turns)


main()
