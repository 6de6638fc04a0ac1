#!/usr/bin/env python3
"""Makes the gallery anew: of each scene a denoised picture, and a noisy one that took the same processor time.

    PYTHONPATH=build/release/python tests/bench/gallery.py [--seconds 30] [--device DEVICE] FOLDER [SCENE...]

Needs Debian's package python3-numpy and the module `hyalite`. FOLDER gets SCENE.png and noisy/SCENE.png. The processor
seconds of all threads are those of samples and denoiser, without start, scene and pipelines. Prints a row of
assets/gallery/README.md for each scene: samples and mean HDR-FLIP of both, against a picture by another seed with 8 times
the samples of the noisy one.
"""
import argparse
import os
import sys

try:
    import numpy as np

    import hyalite
    from clean import processor_seconds
except ImportError as error:
    sys.exit(f"gallery.py: {error}: install python3-numpy, build the module, and set PYTHONPATH")

# Settings of each picture, and its tone curve.
PICTURES = {
    "cornell": ({}, "gamma"),
    "lamps": ({"integrator": "path"}, "gamma"),
    "studio-cat": ({"width": 384, "height": 384}, "agx"),
    "caustics": ({"width": 384, "height": 384, "clamp": 4}, "agx"),
    "metals": ({"width": 480, "height": 300}, "agx"),
    "depth-of-field": ({"width": 480, "height": 300}, "agx"),
    "many-lights": ({"width": 512, "height": 384}, "agx"),
    "still-life": ({}, "gamma"),
    "tea-table": ({"width": 480, "height": 360, "max_depth": 12}, "agx"),
}


def timed(renderer, scene, **settings):
    before = processor_seconds()
    image = renderer.render(scene, **settings)
    return image, processor_seconds() - before


def in_time(renderer, scene, seconds, **settings):
    """The picture of as many samples as take about so long, and their number."""
    few, spp = 4, 12
    renderer.render(scene, spp=few, **settings)  # scene and pipelines
    at_few = timed(renderer, scene, spp=few, **settings)[1]
    image, took = timed(renderer, scene, spp=spp, **settings)
    for _ in range(4):
        if abs(took - seconds) <= 0.1 * seconds:
            break
        spp = max(few + 1, round(few + (seconds - at_few) * (spp - few) / max(took - at_few, 0.01)))
        image, took = timed(renderer, scene, spp=spp, **settings)
    return image, spp


def write(image, tone, *path):
    os.makedirs(os.path.join(*path[:-1]), exist_ok=True)
    with open(os.path.join(*path), "wb") as file:
        file.write(image.png(tone))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", metavar="FOLDER")
    parser.add_argument("scenes", nargs="*", default=list(PICTURES), metavar="SCENE")
    parser.add_argument("--seconds", type=float, default=30)
    parser.add_argument("--device", default="auto")
    arguments = parser.parse_args()
    hyalite.prepare_process()  # as the command line prepares its own
    renderer = hyalite.Renderer(device=arguments.device)
    for scene in arguments.scenes:
        settings, tone = PICTURES[scene]
        noisy, raw_spp = in_time(renderer, scene, arguments.seconds, **settings)
        clean, spp = in_time(renderer, scene, arguments.seconds, denoise=True, **settings)
        truth = renderer.render(scene, spp=min(65536, 8 * raw_spp), seed=777, **settings)
        flips = [hyalite.diff(np.ascontiguousarray(truth.pixels), each).flip for each in (noisy, clean)]
        write(noisy, tone, arguments.folder, "noisy", f"{scene}.png")
        write(clean, tone, arguments.folder, f"{scene}.png")
        print(
            f"| {scene} | {raw_spp}, {flips[0]:.3f} | ![noisy](noisy/{scene}.png) "
            f"| {spp}, {flips[1]:.3f} | ![denoised]({scene}.png) |",
            flush=True,
        )


if __name__ == "__main__":
    main()
