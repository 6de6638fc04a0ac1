#!/usr/bin/env python3
"""Measures how true the noise of `--noise` is, and how many samples it spares.

    PYTHONPATH=build/release/python tests/bench/adaptive.py estimate [--seeds 1000] [--size 64x48] [SCENE[:NOISE]...]
    PYTHONPATH=build/release/python tests/bench/adaptive.py spare [--size 240x160] [SCENE[:NOISE]...]

Needs Debian's package python3-numpy and the module `hyalite`. Without scenes, it takes the eight shipped ones whose light
comes by paths, each with the noise of about 64 samples a pixel. Pictures are judged by the mean relative squared error,
(x - truth)^2 / (truth^2 + 0.01), whose square root the noise is.

`estimate` renders a scene with many seeds, and prints a line: the noise that is asked for; the mean number of samples; the
mean squared noise that the renders tell, divided by their mean squared error, after the first round and at the end; and
how much brighter adaptive renders are than renders with the same number of samples in each pixel, as the mean of
(adaptive - uniform) / (truth + 0.1) over all pixels and seeds, with that mean divided by its standard error in parentheses.
The truth is of 16,384 samples by other seeds.

`spare` prints a line: the noise, the mean number of samples, and their share in what renders with the same number of
samples in each pixel need for the same squared error in the mean, and for the same in the worst of a hundred squares of
16 x 16 pixels; then the same shares in processor seconds.
"""
import argparse
import sys
import time

try:
    import numpy as np

    import hyalite
except ImportError as error:
    sys.exit(f"adaptive.py: {error}: install python3-numpy, build the module, and set PYTHONPATH")

NOISES = {
    "cornell": 0.04,
    "caustics": 0.35,
    "still-life": 0.06,
    "depth-of-field": 0.12,
    "many-lights": 0.15,
    "metals": 0.08,
    "studio-cat": 0.07,
    "tea-table": 0.1,
}


def errors_of(image, truth):
    return ((image - truth) ** 2 / (truth**2 + 0.01)).mean(-1)


def truth_of(renderer, scene, size, count=16):
    return sum(
        renderer.render(scene, spp=1024, seed=10**6 + i, **size).pixels.astype(float) for i in range(count)
    ) / count


def estimate(renderer, scene, noise, size, seeds):
    truth = truth_of(renderer, scene, size)
    figures = {"first": [], "adaptive": [], "uniform": []}
    samples = []

    def add(kind, image):
        squared = image.provenance.get("noise", {"mean": 0})["mean"] ** 2
        brightness = (image.pixels / (truth + 0.1)).mean()
        figures[kind].append((squared, errors_of(image.pixels, truth).mean(), brightness))

    for seed in range(1, seeds + 1):
        add("first", renderer.render(scene, noise=1e-6, spp=16, seed=seed, **size))
        image = renderer.render(scene, noise=noise, spp=4096, seed=seed, **size)
        add("adaptive", image)
        samples.append(image.samples.mean())
        # A number that does not depend on this seed's samples, which would choose those that it likes.
        add("uniform", renderer.render(scene, spp=round(samples[0]), seed=seed + 10**7, **size))
    means = {kind: np.mean(rows, 0) for kind, rows in figures.items()}
    ratios = [means[kind][0] / means[kind][1] for kind in ("first", "adaptive")]
    brighter = np.array([a[2] - u[2] for a, u in zip(figures["adaptive"], figures["uniform"])])
    deviations = brighter.mean() / (brighter.std(ddof=1) / seeds**0.5)
    return (
        f"| {100 * noise:g} % | {np.mean(samples):.0f} | {ratios[0]:.2f} | {ratios[1]:.2f} "
        f"| {100 * brighter.mean():.3f} % ({deviations:.1f}) |"
    )


def worst_of(errors, side=16):
    height, width = (size // side * side for size in errors.shape)
    squares = errors[:height, :width].reshape(height // side, side, width // side, side).mean((1, 3))
    return np.quantile(squares, 0.99)


def timed(render):
    start = time.process_time()
    image = render()
    return image, time.process_time() - start


def spare(renderer, scene, noise, size, seeds=3):
    truth = truth_of(renderer, scene, size)
    counts = [16, 32, 64, 128, 256, 512, 1024]
    uniform = np.zeros((len(counts), 3))  # mean error, worst error, seconds
    adaptive = np.zeros(4)  # and samples
    for seed in range(1, seeds + 1):
        for i, spp in enumerate(counts):
            image, seconds = timed(lambda: renderer.render(scene, spp=spp, seed=seed, **size))
            errors = errors_of(image.pixels, truth)
            uniform[i] += np.array([errors.mean(), worst_of(errors), seconds]) / seeds
        image, seconds = timed(lambda: renderer.render(scene, noise=noise, spp=4096, seed=seed, **size))
        errors = errors_of(image.pixels, truth)
        adaptive += np.array([errors.mean(), worst_of(errors), seconds, image.samples.mean()]) / seeds

    def along(column, error, values):  # of a uniform render with that error
        return np.exp(np.interp(-np.log(error), -np.log(uniform[:, column]), np.log(values)))

    shares = [adaptive[3] / along(column, adaptive[column], counts) for column in (0, 1)]
    seconds = [adaptive[2] / along(column, adaptive[column], uniform[:, 2]) for column in (0, 1)]
    return (
        f"| {100 * noise:g} % | {adaptive[3]:.0f} | {shares[0]:.2f} | {shares[1]:.2f} | {seconds[0]:.2f} "
        f"| {seconds[1]:.2f} |"
    )


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("what", choices=("estimate", "spare"))
    parser.add_argument("scenes", nargs="*", default=list(NOISES), metavar="SCENE[:NOISE]")
    parser.add_argument("--device", default="auto")
    parser.add_argument("--seeds", type=int, default=1000)
    parser.add_argument("--size")
    arguments = parser.parse_intermixed_args()
    is_estimate = arguments.what == "estimate"
    width, height = map(int, (arguments.size or ("64x48" if is_estimate else "240x160")).split("x"))
    size = {"width": width, "height": height, "integrator": "path"}
    hyalite.prepare_process()  # as the command line prepares its own
    renderer = hyalite.Renderer(arguments.device)
    for word in arguments.scenes:
        name, _, noise = word.partition(":")
        scene = hyalite.Scene(name)
        noise = float(noise) if noise else NOISES[name]
        row = (
            estimate(renderer, scene, noise, size, arguments.seeds)
            if is_estimate
            else spare(renderer, scene, noise, size)
        )
        print(f"| {name} {row}", flush=True)


if __name__ == "__main__":
    main()
