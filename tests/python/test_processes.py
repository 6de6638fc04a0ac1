"""Processes: forks and pools get pictures or an error, and never hang; memory stays as it is; imports are fast."""
import subprocess
import sys

import pytest

from conftest import SMALL, run_python

FORKING = f"""
import os, sys, threading, time
import numpy as np
import hyalite
SMALL = {SMALL}

def child(work, ends=os._exit):
    "What a forked process prints for the work, in 10 s."
    reader, writer = os.pipe()
    process = os.fork()
    if process == 0:
        try:
            said = str(work())
        except BaseException as error:
            said = f"{{type(error).__name__}}: {{error}}"
        os.write(writer, said.encode())
        ends(0)
    os.close(writer)
    end = time.monotonic() + 10
    while os.waitpid(process, os.WNOHANG)[0] == 0:
        if time.monotonic() > end:
            os.kill(process, 9)
            os.waitpid(process, 0)
            return "it hangs"
        time.sleep(0.01)
    return os.read(reader, 100000).decode()

def render():
    return hyalite.render("cornell", device="cpu", **SMALL)
"""


def test_a_fork_before_the_first_use_renders():
    assert run_python(FORKING + "print(child(render))") == "<hyalite.Image 16x16>\n"


def test_a_fork_after_scenes_and_images_were_made_renders():
    # They start no threads.
    out = run_python(FORKING + """
hyalite.Scene({"spheres": []}).document
hyalite.Image(np.zeros((2, 2, 3))).png()
print(child(render))
""")
    assert out == "<hyalite.Image 16x16>\n"


@pytest.mark.parametrize("device", ["cpu", "0"])
def test_a_fork_after_the_first_use_gets_an_error(device):
    out = run_python(FORKING + f"""
renderer = hyalite.Renderer({device!r})
image = renderer.render("cornell", **SMALL)
works = [render, lambda: renderer.render("cornell", **SMALL), lambda: hyalite.Renderer("cpu"), hyalite.devices,
         lambda: hyalite.verify("cpu"), lambda: hyalite.compare("cornell", device="cpu", **SMALL)]
for work in works:
    print(child(work))
threading.Thread(target=lambda: renderer.render("cornell", width=64, height=64, spp=64)).start()
time.sleep(0.05)
print(child(works[1]))
print("parent", render())
""")
    *children, parent = out.splitlines()
    assert len(children) == 7 and parent == "parent <hyalite.Image 16x16>"
    for said in children:
        assert said.startswith("UsageError") and "spawn" in said


@pytest.mark.parametrize("device", ["cpu", "0"])
def test_a_fork_reads_images_and_destroys_what_it_has(device):
    # Exit handlers of a driver, which join its threads, are not run: a forked process ends by os._exit.
    out = run_python(FORKING + f"""
renderer = hyalite.Renderer({device!r})
image = renderer.render("cornell", **SMALL)
hyalite.render("cornell", device={device!r}, **SMALL)
print(child(lambda: (image.pixels.shape, image.variance.shape, repr(renderer), repr(hyalite.Scene()))))
def destroy():
    global renderer, image
    hyalite._renderers.clear()
    renderer = image = None
    return "destroyed"
print(child(destroy))
""")
    assert "Error" not in out and out.endswith("destroyed\n"), out


def test_a_fork_while_a_renderer_is_opened_gets_an_error():
    out = run_python(FORKING + """
hyalite.Renderer("cpu").render("cornell", **SMALL)
held = threading.Event(), threading.Event()
def open_slowly():
    with hyalite._renderers_lock:
        held[0].set()
        held[1].wait()
threading.Thread(target=open_slowly).start()
held[0].wait()
print(child(render))
held[1].set()
""")
    assert out.startswith("UsageError"), out


POOL = f"""
import multiprocessing, sys
import hyalite

def total(seed):
    return float(hyalite.render("cornell", device="cpu", seed=seed, **{SMALL}).pixels.sum())

def refused(seed):
    return hyalite.render("cornell", device="cpu", spp=0)

if __name__ == "__main__":
    method, is_used = sys.argv[1:]
    if is_used == "used":
        total(0)
    with multiprocessing.get_context(method).Pool(2) as pool:
        for work in (total, refused):
            try:
                print(pool.map_async(work, range(2)).get(30))
            except hyalite.Error as error:
                print(type(error).__name__, error.kind, error)
    print([total(0), total(1)])
"""


@pytest.mark.parametrize("method, use", [("fork", "fresh"), ("fork", "used"), ("spawn", "fresh"), ("spawn", "used")])
def test_pools_of_processes(tmp_path, method, use):
    program = tmp_path / "pool.py"
    program.write_text(POOL)
    done = subprocess.run([sys.executable, program, method, use], capture_output=True, text=True, timeout=60)
    assert done.returncode == 0, done.stderr
    rendered, refused, expected = done.stdout.splitlines()
    if (method, use) == ("fork", "used"):
        assert rendered.startswith("UsageError usage") and "spawn" in rendered
    else:
        assert rendered == expected
        assert refused.startswith("UsageError usage spp")


def test_memory_stays_as_it_is():
    out = run_python(f"""
import gc
import numpy as np
import hyalite

def resident():
    gc.collect()
    return int(open("/proc/self/statm").read().split()[1]) * 4096 / 2**20

def refused(renderer):
    try:
        renderer.render("cornell", progress=lambda task, share: 1 / 0, **{SMALL})
    except ZeroDivisionError:
        pass

def arrays(renderer):
    scene = hyalite.Scene()
    scene.add_mesh(np.random.rand(3000, 3), np.arange(3000).reshape(1000, 3))
    image = renderer.render(scene, layers=["albedo"], **{SMALL})
    image.variance, image.layers, image.png(), image.provenance

scene = hyalite.Scene("cornell")
renderer = hyalite.Renderer("cpu")
works = [lambda: renderer.render(scene, **{SMALL}), lambda: arrays(renderer), lambda: refused(renderer),
         lambda: hyalite.Renderer("cpu").render(scene, **{SMALL})]
for count in (30, 30, 60):
    before = resident()
    for work in works:
        for _ in range(count):
            work()
print(resident() - before)
""")
    # MiB for 240 pictures: none is measured; a scene's arrays leaked are 0.1 each, a renderer's tables more.
    assert float(out) < 4


def test_the_import_is_fast_and_loads_no_numpy():
    out = run_python("""
import sys, time
begin = time.process_time()
import hyalite
print(time.process_time() - begin, "numpy" in sys.modules)
""")
    seconds, has_numpy = out.split()
    assert float(seconds) < 0.15 and has_numpy == "False"  # measured: 0.03 to 0.05
