"""Threads: they share renderers, scenes and images, and the interpreter ends while they work."""
import threading

import numpy as np
import pytest

import hyalite
from conftest import HALVES, SMALL, SQUARE, equal, run_python

SCENES = ["cornell", "spheres", "lamps"]


def together(*works):
    """Runs functions at once, each in a thread, and raises what one of them raises."""
    failures = []

    def guard(work):
        try:
            work()
        except BaseException as failure:
            failures.append(failure)

    threads = [threading.Thread(target=guard, args=[work]) for work in works]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(60)
        assert not thread.is_alive(), "it hangs"
    if failures:
        raise failures[0]


def repeatedly(renderer, source, expected, count=6):
    def work():
        for _ in range(count):
            assert equal(renderer.render(source, **SMALL), expected)

    return work


def test_renders_of_threads_are_those_of_one(each_renderer, renderer):
    expected = {source: renderer.render(source, **SMALL) for source in SCENES}
    shared = {source: hyalite.Scene(source) for source in SCENES}
    together(*[repeatedly(one, shared[source], expected[source])
               for one in (each_renderer, hyalite.Renderer("cpu")) for source in SCENES])


def test_the_first_render_of_several_threads_opens_one_renderer():
    out = run_python(f"""
import hyalite, threading
threads = [threading.Thread(target=lambda: hyalite.render("cornell", device="cpu", **{SMALL})) for _ in range(8)]
for thread in threads: thread.start()
for thread in threads: thread.join()
print(len(hyalite._renderers))
""")
    assert out == "1\n"


def test_threads_read_one_image(renderer):
    image = renderer.render("cornell", width=128, height=128, spp=2, layers=["normal"])
    read = []
    together(*[lambda: read.append((image.variance.tobytes(), image.samples.tobytes(), image.png(), image.provenance,
                                    image.layers["normal"].tobytes())) for _ in range(8)])
    assert all(one == read[0] for one in read)


def test_threads_add_to_one_scene():
    scene = hyalite.Scene()
    vertices = np.tile(SQUARE, (2000, 1))  # long enough for another thread to come between
    together(*[lambda: [scene.add_mesh(vertices, HALVES) for _ in range(10)] for _ in range(8)])
    names = [mesh["file"] for mesh in scene.document["meshes"]]
    assert len(names) == len(set(names)) == 80


def test_a_scene_changes_while_others_render_it():
    scene = hyalite.Scene("cornell")
    end = threading.Event()

    def change():
        number = 0
        while not end.is_set():
            number += 1
            scene["settings"] = {"spp": 1 + number % 3}

    def render():
        own = hyalite.Renderer("cpu")
        try:
            for _ in range(40):
                assert set(own.render(scene, width=8, height=8).samples.flat) in ({1}, {2}, {3})
        finally:
            end.set()

    scene["settings"] = {"spp": 1}
    together(change, render, render)


def test_a_render_that_waits_shows_the_scene_as_it_was_given(renderer):
    scene = hyalite.Scene("cornell")
    expected = renderer.render(scene, **SMALL)
    begun, waited = threading.Event(), []

    def progress(task, share):
        begun.set()

    first = threading.Thread(target=lambda: renderer.render("spheres", width=256, height=256, spp=65536, time_limit=1,
                                                            progress=progress))
    second = threading.Thread(target=lambda: waited.append(renderer.render(scene, **SMALL)))
    first.start()
    assert begun.wait(30)
    second.start()
    second.join(0.2)  # it waits now
    assert not waited
    scene["settings"] = {"integrator": "normal"}
    first.join()
    second.join()
    assert equal(waited[0], expected)


@pytest.mark.parametrize("device", ["cpu", "0"])
@pytest.mark.parametrize("progress", ["None", "lambda task, share: None"])
def test_the_interpreter_ends_while_threads_render(device, progress):
    for _ in range(2):  # an abort is a matter of luck without a callback
        out = run_python(f"""
import hyalite, threading, time
renderer = hyalite.Renderer({device!r})
def work():
    while True:
        renderer.render("cornell", width=64, height=64, spp=50, progress={progress})
for _ in range(2):
    threading.Thread(target=work, daemon=True).start()
hyalite.render("cornell", device={device!r}, **{SMALL})
time.sleep(0.3)
print("end")
""")
        assert out == "end\n"


@pytest.mark.parametrize("device", ["cpu", "0"])
def test_the_interpreter_ends_with_live_renderers(device):
    run_python(f"""
import hyalite, sys
kept = [hyalite.Renderer({device!r}), hyalite.render("cornell", device={device!r}, **{SMALL})]
sys.kept = [kept, kept[1].pixels]  # destroyed last of all
kept.append(kept)
""")
