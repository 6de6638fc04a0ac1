"""The Python module as its users have it: `hyalite` is found by PYTHONPATH, and HYALITE_PROGRAM is the command line."""
import os
import pathlib
import subprocess
import sys

import numpy as np
import pytest

import hyalite

SMALL = dict(width=16, height=16, spp=1)
SHIPPED = pathlib.Path(hyalite.render("cornell", device="cpu", **SMALL).provenance["scene"]).parent

SQUARE = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], float)
HALVES = np.array([[0, 1, 2], [0, 2, 3]])


@pytest.fixture(scope="session")
def renderer():
    return hyalite.Renderer("cpu")


@pytest.fixture(params=["cpu", "0"], scope="session")
def each_renderer(request):
    """The CPU twin and the first Vulkan device."""
    return hyalite.Renderer(request.param)


@pytest.fixture(scope="session")
def program():
    found = os.environ.get("HYALITE_PROGRAM", "")
    assert os.access(found, os.X_OK), f"HYALITE_PROGRAM is {found!r}: name the program hyalite by it"
    return found


def equal(first, second):
    """Whether two images, or arrays, have the same bits."""
    first, second = np.asarray(first), np.asarray(second)
    return first.shape == second.shape and first.dtype == second.dtype and first.tobytes() == second.tobytes()


def mesh_scene(vertices=SQUARE, faces=HALVES, **more):
    scene = hyalite.Scene()
    scene.add_mesh(vertices, faces, **more)
    return scene


def run_python(code, *, succeeds=True, seconds=60):
    """The standard output of a Python program. One that hangs fails the test."""
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=seconds)
    assert not succeeds or done.returncode == 0, f"exit code {done.returncode}\n{done.stdout}\n{done.stderr}"
    return done.stdout


def read_pfm(path):
    kind, size, scale, pixels = path.read_bytes().split(b"\n", 3)
    assert kind == b"PF"
    width, height = map(int, size.split())
    rows = np.frombuffer(pixels, "<f4" if float(scale) < 0 else ">f4").reshape(height, width, 3)
    return np.ascontiguousarray(rows[::-1])  # PFM begins at the bottom
