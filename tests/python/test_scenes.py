"""Scenes: arrays of every kind, documents, files, and changes, which the next picture shows."""
import copy
import os
import pathlib
import time

import numpy as np
import pytest

import hyalite
from conftest import HALVES, SHIPPED, SMALL, SQUARE, equal, mesh_scene

EYE = np.eye(4)
LIT = {"camera": {"position": [0, 0, 5], "target": [0, 0, 0]}, "background": [1, 1, 1],
       "settings": {"integrator": "normal"}}


def picture(renderer, scene, **more):
    return renderer.render(scene, **{**SMALL, **more}).pixels


@pytest.fixture(scope="module")
def square(renderer):
    return picture(renderer, mesh_scene())


SAME_ARRAYS = {
    "Fortran order": (np.asfortranarray(SQUARE), np.asfortranarray(HALVES)),
    "negative strides": (np.ascontiguousarray(SQUARE[::-1, ::-1])[::-1, ::-1], HALVES),
    "slices": (np.repeat(SQUARE, 2, 0)[::2], np.repeat(HALVES, 3, 1)[:, ::3]),
    "big-endian": (SQUARE.astype(">f8"), HALVES.astype(">i4")),
    "float16": (SQUARE.astype(np.float16), HALVES.astype(np.uint8)),
    "long double": (SQUARE.astype(np.longdouble), HALVES.astype(np.uint64)),
    "whole numbers": (SQUARE.astype(int), HALVES),
    "lists": (SQUARE.tolist(), HALVES.tolist()),
    "a polygon": (SQUARE, [[0, 1, 2, 3]]),
}


@pytest.mark.parametrize("vertices, faces", SAME_ARRAYS.values(), ids=SAME_ARRAYS)
def test_the_same_mesh_by_other_arrays(renderer, square, vertices, faces):
    assert equal(picture(renderer, mesh_scene(vertices, faces)), square)


def test_takes_arrays_that_are_read_only_and_copies_them(renderer, square):
    vertices = SQUARE.copy()
    vertices.flags.writeable = False
    assert equal(picture(renderer, mesh_scene(vertices)), square)
    vertices = SQUARE.copy()
    scene = mesh_scene(vertices)
    vertices[:] = 7
    assert equal(picture(renderer, scene), square)


def moved(value):
    vertices = SQUARE.copy()
    vertices[2, 1] = value
    return vertices


WRONG = {
    "flat vertices": ("vertices", dict(vertices=SQUARE.ravel())),
    "four columns": ("vertices", dict(vertices=np.zeros((4, 4)))),
    "objects": ("vertices", dict(vertices=SQUARE.astype(object))),
    "complex numbers": ("vertices", dict(vertices=SQUARE.astype(complex))),
    "truth": ("vertices", dict(vertices=SQUARE.astype(bool))),
    "text": ("vertices", dict(vertices="text")),
    "ragged lists": ("vertices", dict(vertices=[[0, 0, 0], [1, 0]])),
    "no vertices": ("vertices", dict(vertices=None)),
    "masked vertices": ("vertices", dict(vertices=np.ma.masked_equal(SQUARE, 1))),
    "masked faces": ("faces", dict(faces=np.ma.masked_equal(HALVES, 1))),
    "faces of floats": ("faces", dict(faces=HALVES.astype(float))),
    "faces of two": ("faces", dict(faces=[[0, 1]])),
    "flat faces": ("faces", dict(faces=[0, 1, 2])),
    "no faces": ("faces", dict(faces=None)),
    "index of nothing": ("faces.*index 4;.*0 to 3", dict(faces=[[0, 1, 4]])),
    "negative index": ("faces.*index -1;", dict(faces=[[0, 1, -1]])),
    "huge index": ("faces.*index 4294967296;", dict(faces=[[0, 1, 2**32]])),
    "unsigned index": ("faces.*index 9223372036854775813;", dict(faces=np.array([[0, 1, 2**63 + 5]], np.uint64))),
    "few normals": ("normals", dict(normals=np.ones((3, 3)))),
    "wide uvs": ("uvs", dict(uvs=np.ones((4, 3)))),
    "bright colours": ("colours.*200", dict(colours=np.full((4, 3), 200, np.uint8))),
    "colours without number": ("colours.*nan", dict(colours=np.full((4, 3), np.nan))),
    "3 x 4 matrices": ("instances", dict(instances=EYE[None, :3])),
    "perspective": ("instances", dict(instances=[[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 1, 1]])),
    "no instances": ("instances", dict(instances=np.zeros((0, 4, 4)))),
    "a material that is a number": ("material", dict(material=3)),
    "a name that is a number": ("name", dict(name=3)),
}


@pytest.mark.parametrize("words, arrays", WRONG.values(), ids=WRONG)
def test_says_what_is_wrong_with_arrays(words, arrays):
    with pytest.raises((hyalite.UsageError, TypeError), match=words) as refused:
        mesh_scene(**arrays)
    assert "C++" not in str(refused.value) and "_hyalite" not in str(refused.value)


UNUSABLE = {
    "no number": ("mesh 1: row 2: .*nan", dict(vertices=moved(np.nan))),
    "infinity": ("mesh 1: row 2: .*inf", dict(vertices=moved(np.inf))),
    "too far": ("mesh 1: row 2", dict(vertices=moved(1e38))),
    "no face": ("mesh 1: no triangle", dict(faces=np.zeros((0, 3), int))),
    "no area": ("mesh 1: no triangle", dict(faces=[[0, 0, 1]])),
    "flat instance": ("mesh 1: row 0", dict(instances=np.diag([0, 1, 1, 1.0]))),
    "unknown material": ("nope", dict(material="nope")),
    "material of no type": ("material 1", dict(material={"type": "nope"})),
}


@pytest.mark.parametrize("words, arrays", UNUSABLE.values(), ids=UNUSABLE)
def test_checks_numbers_when_the_scene_is_loaded(renderer, words, arrays):
    scene = mesh_scene(**arrays)
    for use in (scene.check, lambda: picture(renderer, scene)):
        with pytest.raises(hyalite.Error, match=words) as refused:
            use()
        assert refused.value.kind == "bad input"


def test_a_mesh_that_is_refused_leaves_nothing_behind():
    scene = hyalite.Scene()
    with pytest.raises(hyalite.UsageError):
        scene.add_mesh(SQUARE, [[0, 1, 9]], material={"type": "mirror"})
    assert scene.document == {}


def test_instances_place_a_mesh(renderer, square):
    assert equal(picture(renderer, mesh_scene(instances=EYE)), square)
    shift = EYE.copy()
    shift[:3, 3] = [3, 0, 0]
    pair = mesh_scene(instances=[EYE, shift])
    both = mesh_scene()
    both.add_mesh(SQUARE + [3, 0, 0], HALVES)
    difference = hyalite.diff(picture(renderer, pair), picture(renderer, both))
    assert difference.differing_pixels == 0  # whole numbers are moved exactly
    mirrored = mesh_scene(instances=np.diag([-1, 1, 1, 1.0]))
    assert not equal(picture(renderer, mirrored), np.zeros_like(square))


def test_a_scene_far_away_looks_the_same(renderer):
    # Steps of float64 at 1e7 are 2e-9: a millionth of the mesh, which is 5e-3 across. Those of float32 are 1.
    random = np.random.default_rng(1)
    vertices = random.random((30, 3)) * 5e-3
    faces = np.array([random.choice(30, 3, replace=False) for _ in range(40)])
    near = renderer.render(mesh_scene(vertices, faces), width=64, height=64, spp=4)
    far = renderer.render(mesh_scene(vertices + 1e7, faces), width=64, height=64, spp=4)
    assert hyalite.diff(near, far).psnr > 60  # measured: 142


def test_masses_of_meshes_are_added_in_time_that_grows_with_their_number():
    def seconds(count):
        scene = hyalite.Scene()
        begin = time.process_time()
        for _ in range(count):
            scene.add_mesh(SQUARE, HALVES)
        return time.process_time() - begin

    seconds(100)
    # Eight times the meshes: eight times the time, or 64 times if each copies the document. The noise of a busy machine
    # is below a factor of 2.5.
    assert seconds(1600) < 20 * seconds(200)


def test_textures_and_environments_are_seen(renderer):
    scene = mesh_scene(uvs=SQUARE[:, :2], material={
        "type": "diffuse", "albedo": 1, "textures": {"baseColour": {"file": "red"}}})
    scene.add_texture("red", np.full((2, 2, 3), [255, 0, 0], np.uint8))
    albedo = picture(renderer, scene, integrator="albedo")
    assert (albedo[8, 8] == [1, 0, 0]).all()
    scene.set_environment(np.full((2, 4, 3), [0, 0.25, 0]))
    assert picture(renderer, scene)[0, 0].tolist() == [0, 0.25, 0]


@pytest.mark.parametrize("levels", [
    np.zeros((2, 2)), np.zeros((2, 2), np.uint16), np.zeros((2, 2), bool), np.zeros(3, np.uint8),
    np.zeros((2, 2, 2), np.uint8), np.zeros((0, 2), np.uint8), [[0, 1]], None, "text",
], ids=lambda levels: f"{type(levels).__name__} {getattr(levels, 'shape', '')} {getattr(levels, 'dtype', '')}")
def test_refuses_other_textures(levels):
    with pytest.raises(hyalite.UsageError, match="texture"):
        hyalite.Scene().add_texture("t", levels)


def test_numbers_of_numpy_in_a_document(renderer):
    plain = {**LIT, "spheres": [{"centre": [0, 0, 0], "radius": 1}]}
    numpy = {**LIT, "spheres": [{"centre": np.zeros(3, np.float32), "radius": np.int64(1)}]}
    assert hyalite.Scene(numpy).document == hyalite.Scene(plain).document


WRONG_DOCUMENTS = [{"x": {1, 2}}, {"x": object()}, {"x": 1j}, {(1, 2): 3}, {"x": float("nan")},
                   {"x": np.float32("inf")}]


@pytest.mark.parametrize("document", WRONG_DOCUMENTS, ids=lambda document: repr(document)[:12])
def test_says_what_no_document_holds(document):
    with pytest.raises((hyalite.Error, TypeError, ValueError)) as refused:
        hyalite.Scene(document)
    assert "tolist" not in str(refused.value) and "last read" not in str(refused.value)


@pytest.mark.parametrize("document", [{"meshes": {}}, {"meshes": "x"}, {"materials": []}, {"materials": 3}], ids=str)
def test_adds_nothing_to_a_document_that_is_wrong(document):
    scene = hyalite.Scene(document)
    with pytest.raises(hyalite.Error) as refused:
        scene.add_mesh(SQUARE, HALVES, material={"type": "mirror"})
        scene.check()
    assert refused.value.kind in ("bad input", "usage")


def test_says_which_key_is_wrong(renderer):
    with pytest.raises(hyalite.Error, match="/sphere: unknown key.*spheres"):
        picture(renderer, {"sphere": []})


def test_copies_change_on_their_own():
    for copied in (hyalite.Scene, copy.copy, copy.deepcopy):
        scene = hyalite.Scene(LIT)
        other = copied(scene)
        other["background"] = [0, 0, 0]
        assert scene["background"] == [1, 1, 1] and other["background"] == [0, 0, 0]


def test_the_document_is_a_copy():
    scene = hyalite.Scene(LIT)
    scene.document["background"][0] = 7
    assert scene["background"] == [1, 1, 1]
    with pytest.raises(KeyError):
        scene["nothing"]
    assert "camera" in scene and "nothing" not in scene


def test_a_change_is_seen_by_the_next_picture(renderer):
    scene = hyalite.Scene(LIT)
    seen = [picture(renderer, scene)]
    scene.add_mesh(SQUARE, HALVES)
    seen.append(picture(renderer, scene))
    scene["settings"] = {"integrator": "albedo"}
    seen.append(picture(renderer, scene))
    scene["camera"] = {"position": [0, 0, 9], "target": [0, 0, 0]}
    seen.append(picture(renderer, scene))
    assert all(not equal(a, b) for i, a in enumerate(seen) for b in seen[:i])
    for _ in range(2):  # two scenes by turns
        assert equal(picture(renderer, LIT), seen[0]) and equal(picture(renderer, scene), seen[3])


def write_triangle(path, height):
    path.write_text(f"v 0 0 0\nv 1 0 0\nv 1 {height} 0\nf 1 2 3\n")


def test_a_file_that_was_written_anew_is_read_anew(renderer, tmp_path):
    mesh = tmp_path / "mesh.obj"
    seen = []
    for height in (1, 3):
        write_triangle(mesh, height)
        seen.append(picture(renderer, mesh))
        document = {**LIT, "meshes": [{"file": "mesh.obj"}]}
        seen.append(picture(renderer, hyalite.Scene(document, folder=tmp_path)))
    assert not equal(seen[0], seen[2]) and not equal(seen[1], seen[3])


def test_a_name_is_another_file_in_another_folder(renderer, tmp_path, monkeypatch):
    seen = []
    for height in (1, 3):
        folder = tmp_path / str(height)
        folder.mkdir()
        monkeypatch.chdir(folder)
        write_triangle(pathlib.Path("mesh.obj"), height)
        seen.append(picture(renderer, "mesh.obj"))
    assert not equal(*seen)


def test_a_scene_keeps_its_file_when_the_folder_changes(renderer, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    write_triangle(pathlib.Path("mesh.obj"), 1)
    scenes = [hyalite.Scene("mesh.obj"), hyalite.Scene({**LIT, "meshes": [{"file": "mesh.obj"}]})]
    monkeypatch.chdir("/")
    for scene in scenes:
        picture(renderer, scene)


def test_warns_of_a_scene_in_every_render(renderer, tmp_path):
    mesh = tmp_path / "line.obj"
    mesh.write_text("v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\nl 1 2\n")
    scene = hyalite.Scene(mesh)
    for seed in range(2):
        told = []
        picture(renderer, scene, seed=seed, message=lambda kind, text: told.append(kind))
        assert told == ["warning"]


def test_files_by_any_name(renderer, tmp_path):
    folder = tmp_path / "Szene 文"
    folder.mkdir()
    write_triangle(folder / "a.obj", 1)
    write_triangle(pathlib.Path(os.fsdecode(os.fsencode(folder) + b"/b\xff.obj")), 1)
    expected = picture(renderer, folder / "a.obj")
    for name in sorted(folder.iterdir()):
        assert equal(picture(renderer, name), expected)
        assert equal(picture(renderer, os.fsencode(name)), expected)


@pytest.mark.parametrize("source", ["nope", "nope.json", "/tmp", "", "/dev/null"])
def test_says_that_there_is_no_such_scene(source):
    with pytest.raises(hyalite.Error, match="scene|no such file") as refused:
        hyalite.Scene(source)
    assert refused.value.kind == "bad input"


def test_shipped_files_of_meshes_cannot_be_changed():
    scene = hyalite.Scene(SHIPPED / "tea-table.glb")
    with pytest.raises(hyalite.UsageError, match="name this file as a mesh"):
        scene["camera"] = {}


def test_a_scene_is_shown_by_its_name_or_members():
    assert "cornell" in repr(hyalite.Scene("cornell"))
    assert repr(hyalite.Scene(LIT)) == "<hyalite.Scene background, camera, settings>"
    assert repr(hyalite.Scene()) == "<hyalite.Scene>"
