#!/usr/bin/env python3
"""Measures how much sooner a denoised picture is as near to the truth as a noisy one.

    PYTHONPATH=build/release/python tests/bench/clean.py [--device DEVICE] [--references FOLDER] [--flip .08,.05]
        [--size 480x320] [--reference-spp 4096] [SCENE...]

Needs Debian's package python3-numpy and the module `hyalite`; references are those of denoise.py, made where they lack.
Pictures of 2, 4, 8 ... samples are rendered until their mean HDR-FLIP is below the least one. A line for each scene and
FLIP: samples and processor seconds (of all threads, without start, scene and pipelines) of the noisy picture, of the
denoised one, and the share of the latter's seconds. Between two pictures, the logarithms of samples and FLIP are taken for a
line, as are samples and seconds.
"""
import math
import resource
import sys

try:
    import hyalite
    from denoise import parsed, reference
except ImportError as error:
    sys.exit(f"clean.py: {error}: install python3-numpy, build the module, and set PYTHONPATH")


def processor_seconds():
    usage = resource.getrusage(resource.RUSAGE_SELF)
    return usage.ru_utime + usage.ru_stime


def ladder(renderer, scene, truth, least, most, **settings):
    """Rows of samples, seconds and FLIP."""
    rows = []
    spp = 2
    while spp <= most:
        times = []
        for _ in range(1 if spp > 64 else 3):  # the first may have to make pipelines
            before = processor_seconds()
            image = renderer.render(scene, spp=spp, **settings)
            times.append(processor_seconds() - before)
        rows.append((spp, min(times), hyalite.diff(truth.astype("f4"), image).flip))
        if rows[-1][2] < least:
            return rows
        spp *= 2
    return rows


def reached(rows, flip):
    """Samples and seconds; None where no row has so little."""
    if rows[-1][2] > flip:
        return None
    if rows[0][2] <= flip:
        return rows[0][:2]
    after = next(i for i, row in enumerate(rows) if row[2] <= flip)
    (fewer, sooner, worse), (more, later, better) = rows[after - 1], rows[after]
    share = math.log(worse / flip) / math.log(worse / better)
    spp = fewer * (more / fewer) ** share
    return spp, sooner + (later - sooner) * (spp - fewer) / (more - fewer)


def text(found):
    return f"{found[0]:.1f}, {found[1]:.2f} s" if found else "not reached"


def main():
    arguments, size = parsed(__doc__, "--flip", ".08,.05")
    wanted = [float(flip) for flip in arguments.flip.split(",")]
    hyalite.prepare_process()  # as the command line prepares its own
    renderer = hyalite.Renderer(device=arguments.device)
    print("| scene | FLIP | noisy | denoised | share |\n|---|---|---|---|---|")
    for scene in arguments.scenes:
        truth = reference(scene, arguments, size)
        loaded = hyalite.Scene(scene)  # once: given its name, each render would read it, and build its tree
        most = arguments.reference_spp // 4
        noisy, clean = (
            ladder(renderer, loaded, truth, min(wanted), most, denoise=denoise, **size) for denoise in (False, True)
        )
        for flip in wanted:
            raw, less = reached(noisy, flip), reached(clean, flip)
            share = f"{less[1] / raw[1]:.2f}" if raw and less else ""
            print(f"| {scene} | {flip:g} | {text(raw)} | {text(less)} | {share} |", flush=True)


if __name__ == "__main__":
    main()
