#!/usr/bin/env python3
"""Measures how much nearer to the truth denoised pictures are than noisy ones, and a joint bilateral filter beside them.

    PYTHONPATH=build/release/python tests/bench/denoise.py [--device DEVICE] [--references FOLDER] [--spp 4,16,64]
        [--size 480x320] [--reference-spp 4096] [SCENE...]

Needs Debian's package python3-numpy and the module `hyalite`. References, by another seed, are rendered into FOLDER unless
they are there: SCENE-480x320.pfm. Without scenes, it takes the eight shipped ones whose light comes by paths.

A line for each scene and number of samples: the relative squared error, (x - truth)^2 / (truth^2 + 0.01), without the worst
0.1 % of the pixels, and the mean HDR-FLIP; of the noisy picture, of the denoised one, and of the bilateral filter; the
ratio of the errors of the first two; and of squares of 32 x 32 pixels, in how many of a hundred the denoised picture has a
larger error than the noisy one, by more than a tenth of the picture's mean error.
"""
import argparse
import os
import sys

try:
    import numpy as np

    import hyalite
except ImportError as error:
    sys.exit(f"denoise.py: {error}: install python3-numpy, build the module, and set PYTHONPATH")

SCENES = "cornell caustics still-life studio-cat metals many-lights depth-of-field tea-table".split()


def errors_of(image, truth):
    return ((image - truth) ** 2 / (truth**2 + 0.01)).mean(-1)


def relative_mse(image, truth):
    errors = np.sort(errors_of(image, truth), axis=None)
    return errors[: len(errors) * 999 // 1000].mean()


def worse_squares(clean, noisy, truth, side=32):
    """In per cent."""
    height, width = (size // side * side for size in truth.shape[:2])

    def sums(image):
        errors = errors_of(image, truth)[:height, :width]
        return errors.reshape(height // side, side, width // side, side).mean((1, 3))

    return 100 * (sums(clean) > sums(noisy) + 0.1 * sums(noisy).mean()).mean()


def shifted(image, dy, dx):
    return np.pad(image, ((5, 5), (5, 5), (0, 0)), "edge")[5 + dy :, 5 + dx :][: image.shape[0], : image.shape[1]]


def bilateral(image):
    """Means over 11 x 11 pixels by distance, albedo, normal and depth, as Dammertz and others, HPG 2010, weigh them."""
    depth = image.layers["denoising_depth"][..., None]
    features = np.concatenate(
        [
            image.layers["denoising_albedo"] / 0.1,
            image.layers["denoising_normal"] / 0.2,
            np.log(np.maximum(depth, 1e-6)) / 0.05,
        ],
        -1,
    )
    total, weights = np.zeros_like(image.pixels, float), 0.0
    for dy in range(-5, 6):
        for dx in range(-5, 6):
            apart = ((features - shifted(features, dy, dx)) ** 2).sum(-1, keepdims=True)
            weight = np.exp(-apart - (dx * dx + dy * dy) / 18)
            total = total + weight * shifted(image.layers["noisy"], dy, dx)
            weights = weights + weight
    return (total / weights).astype("f4")


def reference(scene, arguments, size):
    path = os.path.join(arguments.references, f"{scene}-{arguments.size}.pfm")
    if not os.path.exists(path):
        hyalite.render(scene, spp=arguments.reference_spp, seed=777, device=arguments.device, **size).save(path)
    return hyalite.load_image(path).pixels.astype(float)


def parsed(description, option, default):
    """The arguments of a script that compares with references, one option of its own among them, and the size."""
    parser = argparse.ArgumentParser(description=description, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scenes", nargs="*", default=SCENES, metavar="SCENE")
    parser.add_argument("--device", default="auto")
    parser.add_argument("--references", default=".", metavar="FOLDER")
    parser.add_argument("--reference-spp", type=int, default=4096)
    parser.add_argument("--size", default="480x320")
    parser.add_argument(option, default=default)
    arguments = parser.parse_args()
    width, height = map(int, arguments.size.split("x"))
    return arguments, {"width": width, "height": height, "integrator": "path"}


def main():
    arguments, size = parsed(__doc__, "--spp", "4,16,64")
    print("| scene | spp | noisy | denoised | ratio | bilateral | worse squares |\n|---|---|---|---|---|---|---|")
    for scene in arguments.scenes:
        truth = reference(scene, arguments, size)
        for spp in map(int, arguments.spp.split(",")):
            image = hyalite.render(scene, spp=spp, denoise=True, device=arguments.device, **size)
            noisy, clean = image.layers["noisy"], image.pixels
            figures = [
                (relative_mse(each, truth), hyalite.diff(truth.astype("f4"), np.ascontiguousarray(each)).flip)
                for each in (noisy, clean, bilateral(image))
            ]
            texts = [f"{error:.2g}, {flip:.3f}" for error, flip in figures]
            ratio = figures[0][0] / figures[1][0]
            print(
                f"| {scene} | {spp} | {texts[0]} | {texts[1]} | {ratio:.1f} | {texts[2]} "
                f"| {worse_squares(clean, noisy, truth):.1f} % |",
                flush=True,
            )


if __name__ == "__main__":
    main()
