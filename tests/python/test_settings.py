"""Settings: the same pictures as the command line's, whatever was rendered before; and what is wrong with a value."""
import pathlib
import pickle
import random
import subprocess

import numpy as np
import pytest

import hyalite
from conftest import SHIPPED, SMALL, equal, read_pfm, run_python

SKY = str(SHIPPED.parent / "verify" / "sky.pfm")
SCENES = ["cornell", "spheres", "lamps", "metals", "many-lights", "depth-of-field", str(SHIPPED / "tea-table.glb"),
          str(SHIPPED.parent / "verify" / "crystal.obj"), str(SHIPPED.parent / "verify" / "gltf.json")]

CHOICES = {
    "width": [8, 12, 16], "height": [8, 10], "crop": [(1, 5, 2, 6), (0, 8, 0, 8)],
    "camera_position": [(0.5, 1, 3), (-2, 0.5, 0.25)], "look_at": [(0, 0.5, 0), (0.25, 0, -1)],
    "up": ["x", "-z", (0.1, 1, 0.2)], "fov": [30, 100], "aperture": [0.1], "focus_distance": [2, 5], "view_width": [3],
    "spp": [1, 2, 3], "seed": [0, 1, 7],
    "integrator": ["whitted", "path", "path", "normal", "albedo", "ao", "depth"], "max_depth": [1, 3, 5],
    "bvh": ["midpoint", "sah"], "leaf_size": [1, 4], "environment": ["neutral", SKY],
    "environment_rotate": [90], "background": [(0.5, 0.25, 0.125)], "exposure": [-1, 2],
    "filter": ["box", "blackman-harris"], "sampler": ["sobol", "centre"], "flatten": [True], "keep_instances": [True],
    "light_choice": ["power", "tree"], "clamp": [2], "ao_distance": [0.5],
}
ALWAYS = {"width", "height", "spp"}  # small pictures


def drawn(random):
    """Settings, some of which contradict each other."""
    return {name: random.choice(values) for name, values in CHOICES.items()
            if name in ALWAYS or random.random() < 0.2}


def outcome(renderer, scene, layers, settings):
    """All that a render gives, or its error."""
    try:
        image = renderer.render(scene, layers=layers, **settings)
    except hyalite.Error as error:
        return str(error)
    arrays = [image.pixels, image.variance, image.samples, *image.layers.values()]
    return [array.tobytes() for array in arrays], image.rays, image.png(), image.provenance


@pytest.mark.parametrize("source", SCENES, ids=lambda source: pathlib.Path(source).stem)
def test_a_view_after_others_is_that_of_a_new_renderer(renderer, source):
    draw = random.Random(pathlib.Path(source).stem)  # the same in every folder
    scene = hyalite.Scene(source)  # which the renderer keeps
    pictures = 0
    for _ in range(8):
        settings = drawn(draw)
        layers = draw.sample(["albedo", "normal", "depth", "id"], draw.choice([0, 0, 1, 2]))
        kept = outcome(renderer, scene, layers, settings)
        assert kept == outcome(hyalite.Renderer("cpu"), source, layers, settings), (settings, layers)
        pictures += not isinstance(kept, str)
    assert pictures >= 2  # of 8; the others contradict themselves


def test_a_view_after_others_on_a_device(each_renderer, renderer):
    scene = hyalite.Scene("cornell")
    for settings in [{}, {"fov": 30}, {"seed": 3}, {"bvh": "none"}, {"integrator": "normal"},
                     {"crop": (2, 9, 3, 7)}, {}]:
        expected = outcome(hyalite.Renderer("cpu"), "cornell", ["albedo"], {**SMALL, **settings})
        found = outcome(each_renderer, scene, ["albedo"], {**SMALL, **settings})
        assert found[:2] == expected[:2], settings  # a PNG and its provenance name the device


def command_words(settings):
    for name, value in settings.items():
        option = "--" + name.replace("_", "-")
        text = ",".join(map(str, value)) if isinstance(value, tuple) else value
        yield option if value is True else f"{option}={text}"


def test_pictures_are_those_of_the_command_line(renderer, program, tmp_path):
    draw = random.Random(5)
    pictures = 0
    for source in SCENES * 2:
        settings = drawn(draw)
        done = subprocess.run([program, "render", source, "--device", "cpu", "--quiet", "-o", tmp_path / "a.pfm",
                               *command_words(settings)], capture_output=True, text=True, timeout=60)
        try:
            image = renderer.render(source, **settings)
        except hyalite.Error as error:
            assert done.returncode != 0, (source, settings, str(error))
            continue
        assert done.returncode == 0, (source, settings, done.stderr)
        assert equal(read_pfm(tmp_path / "a.pfm"), image), (source, settings)
        pictures += 1
    assert pictures >= 5


def test_files_are_those_of_the_command_line(renderer, program, tmp_path):
    image = renderer.render("cornell", layers=["albedo"], **SMALL)
    for name in ["a.png", "a.exr"]:
        image.save(tmp_path / name)
        by_command = tmp_path / f"command-{name}"
        words = ["--layers", "albedo"] if name.endswith("exr") else []
        subprocess.run([program, "render", "cornell", "--device", "cpu", "--quiet", "-o", by_command, *words,
                        *command_words(SMALL)], check=True, timeout=60)
        assert hyalite.diff(tmp_path / name, by_command).identical
        assert equal(hyalite.load_image(by_command), hyalite.load_image(tmp_path / name))


def test_names_are_those_of_the_command_line(program):
    page = subprocess.run([program, "render", "--help"], capture_output=True, text=True, check=True).stdout
    for name in hyalite.setting_names():
        assert f"--{name.replace('_', '-')} " in page


@pytest.mark.parametrize("name, value", [
    ("spp", np.int8(2)), ("spp", np.float16(2)), ("spp", np.array(2)), ("spp", 2.0), ("spp", None),
    ("flatten", np.bool_(True)), ("camera_position", np.array([0, 1, 5], np.float32)), ("camera_position", [0, 1, 5]),
    ("crop", range(4)), ("environment", pathlib.Path(SKY)),
], ids=str)
def test_values_may_be_numpy_s_and_paths(renderer, name, value):
    renderer.render("cornell", **{**SMALL, name: value})


WRONG = [
    ("spp", 0), ("spp", -1), ("spp", 2.5), ("spp", True), ("spp", "4"), ("spp", [2]), ("spp", float("nan")),
    ("spp", 2**40), ("spp", 10**400), ("spp", 1j), ("spp", {}), ("spp", object()), ("width", 0), ("width", 10**6),
    ("seed", 2**32), ("flatten", 1), ("camera", 0), ("environment", ""), ("camera_position", (0, 1)),
    ("camera_position", (0, 1, float("inf"))), ("look_at", [1, 2, "a"]), ("up", (0, 0, 0)), ("crop", (0, 17, 0, 4)),
    ("crop", slice(0, 4)), ("integrator", "pathh"), ("sampler", "center"), ("fov", 180), ("background", "white"),
    ("leaf_size", 0), ("layers", ["nope"]), ("layers", "albedo"), ("layers", [3]), ("time_limit", -1),
    ("time_limit", float("nan")), ("time_limit", "a"),
]


@pytest.mark.parametrize("name, value", WRONG, ids=lambda value: repr(value)[:20])
def test_a_message_names_the_setting(renderer, name, value):
    with pytest.raises(ValueError, match=name) as refused:
        renderer.render("cornell", **{**SMALL, name: value})
    assert isinstance(refused.value, hyalite.UsageError) and refused.value.kind == "usage"
    assert "C++" not in str(refused.value)


@pytest.mark.parametrize("many", [np.ones((400, 400, 3)), np.ones((400, 400, 3)).tolist()], ids=["array", "list"])
def test_a_message_is_short(renderer, many):
    with pytest.raises(hyalite.UsageError, match="environment") as refused:
        renderer.render("cornell", environment=many, **SMALL)
    assert len(str(refused.value)) < 500


def test_a_message_proposes_a_near_word(renderer):
    for name, value, proposed in [("integrator", "pathh", "path"), ("sampler", "center", "centre")]:
        with pytest.raises(hyalite.UsageError, match=f'did you mean "{proposed}"'):
            renderer.render("cornell", **{name: value})
    with pytest.raises(hyalite.UsageError, match='did you mean "spp"'):
        renderer.render("cornell", ssp=4)


def test_a_refused_render_does_no_harm(renderer):
    scene = hyalite.Scene("cornell")
    before = renderer.render(scene, **SMALL)
    for wrong in [{"spp": 0}, {"crop": (0, 99, 0, 99)}, {"up": (0, 0, 0)}, {"environment": "/nope.hdr"}]:
        with pytest.raises(hyalite.Error):
            renderer.render(scene, **{**SMALL, **wrong})
        assert equal(renderer.render(scene, **SMALL), before)


def test_layers_are_the_integrators_pictures(renderer):
    names = ["albedo", "depth", "normal"]
    image = renderer.render("cornell", layers=names, sampler="centre", **SMALL)
    for name in names:
        alone = renderer.render("cornell", integrator=name, sampler="centre", **SMALL).pixels
        layer = image.layers[name]
        if name == "albedo":
            assert equal(layer, alone)
        assert np.isfinite(layer).all() and layer.std() > 0, name
        assert equal(image, renderer.render("cornell", sampler="centre", **SMALL))


def test_a_time_limit_ends_a_render_with_what_is_finished(each_renderer):
    image = each_renderer.render("cornell", width=256, height=256, spp=65536, time_limit=0.2)
    assert not image.is_finished
    assert image.seconds < 10  # hours without the limit
    assert image.samples.max() > 0 and np.isfinite(image.pixels[image.samples > 0]).all()
    assert each_renderer.render("cornell", time_limit=60, **SMALL).is_finished


@pytest.mark.parametrize("device", ["nope", "", -1, 99, None])
def test_says_which_devices_there_are(device):
    with pytest.raises(hyalite.Error, match="(?s)no device matches.*There are:.*cpu") as refused:
        hyalite.Renderer(device)
    assert refused.value.kind == "no device"


@pytest.mark.parametrize("options", [{"threads": -1}, {"threads": 100000}, {"threads": 1.5}, {"kernel": "nope"},
                                     {"kernel": "stack"}], ids=str)
def test_refuses_options_of_a_renderer(options):
    # In a process of its own: what starts 100000 threads crashes.
    run_python(f"""
import hyalite
try:
    hyalite.Renderer("cpu", **{options}).render("cornell", **{SMALL})
except (hyalite.UsageError, TypeError) as error:
    assert {list(options)[0]!r} in str(error), error
else:
    raise SystemExit("it was taken")
""")


def test_threads_do_not_change_the_picture(renderer):
    expected = renderer.render("cornell", **SMALL)
    for threads in (1, 3):
        assert equal(hyalite.Renderer("cpu", threads=threads).render("cornell", **SMALL), expected)


def test_errors_travel_between_processes():
    with pytest.raises(hyalite.Error) as refused:
        hyalite.render("cornell", device="cpu", spp=0)
    copied = pickle.loads(pickle.dumps(refused.value))
    assert type(copied) is hyalite.UsageError and copied.kind == "usage" and str(copied) == str(refused.value)


def test_everything_public_is_documented():
    for name in hyalite.__all__:
        thing = getattr(hyalite, name)
        assert thing.__doc__, name
        if isinstance(thing, type):
            for member, value in vars(thing).items():
                assert member.startswith("_") or value.__doc__, f"{name}.{member}"
