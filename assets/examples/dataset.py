"""A data set: views of a scene from all around, with depth, normals and ids, and the poses of their cameras.

    python3 dataset.py tea-table folder --views 100

It writes folder/view.0000.npz, ... with the arrays "rgb" (float32, linear), "depth" (planar, world units, 1e10 where
nothing is), "normal" (world space) and "id" (a colour for each primitive), and folder/cameras.json.
"""
import argparse
import json
import math
import pathlib

import numpy as np

import hyalite


def positions(count, low, high):
    """Points on a circle around what lies in the box, a little above its middle."""
    distance = 1.2 * np.linalg.norm(high - low)
    for i in range(count):
        angle = 2.0 * math.pi * i / count
        yield (low + high) / 2 + distance * np.array([math.sin(angle), 0.35, math.cos(angle)])


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("scene")
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--views", type=int, default=100)
    parser.add_argument("--size", type=int, default=256)
    parser.add_argument("--spp", type=int, default=16)
    options = parser.parse_args()

    options.folder.mkdir(parents=True, exist_ok=True)
    scene = hyalite.Scene(options.scene)
    renderer = hyalite.Renderer()  # opened once; the scene is read and built once, too
    bounds = hyalite.inspect(scene)["bounds"]
    low, high = np.array(bounds["low"]), np.array(bounds["high"])
    centre = (low + high) / 2
    cameras = []
    for i, position in enumerate(positions(options.views, low, high)):
        image = renderer.render(
            scene, spp=options.spp, width=options.size, height=options.size, camera_position=position,
            look_at=centre, seed=i, layers=["depth", "normal", "id"],
        )
        np.savez_compressed(options.folder / f"view.{i:04}.npz", rgb=image.pixels, **image.layers)
        cameras.append({"position": position.tolist(), "look_at": centre.tolist()})
    (options.folder / "cameras.json").write_text(json.dumps(cameras, indent=1))
    print(f"{len(cameras)} views by {renderer.description}")


if __name__ == "__main__":
    main()
