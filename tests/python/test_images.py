"""Images: arrays without a copy, what is known of them, and files."""
import copy
import gc
import os
import pathlib

import numpy as np
import pytest

import hyalite
from conftest import SMALL, equal


@pytest.fixture(scope="module")
def image(renderer):
    return renderer.render("cornell", width=24, height=16, spp=4, layers=["albedo", "depth"])


def test_arrays_have_the_shape_of_the_image(image):
    assert image.shape == image.pixels.shape == image.variance.shape == (16, 24, 3)
    assert image.samples.shape == image.layers["depth"].shape == (16, 24)
    assert image.layers["albedo"].shape == (16, 24, 3)
    assert image.pixels.dtype == image.variance.dtype == np.float32 and image.samples.dtype == np.uint32
    assert list(image.layers) == ["albedo", "depth"]
    assert (image.samples == 4).all()


def test_denoised_images_keep_their_samples_and_the_data(renderer, image):
    clean = renderer.render("cornell", width=24, height=16, spp=4, layers=["depth"], denoise=True)
    assert list(clean.layers) == ["noisy", "denoising_first", "denoising_first_samples", "depth",
                                  "denoising_albedo", "denoising_normal", "denoising_depth"]
    assert equal(clean.layers["noisy"], image.pixels) and equal(clean.variance, image.variance)
    assert (clean.layers["denoising_first_samples"] == 2).all()
    assert clean.provenance["denoised"] == "hyalite denoiser 3"
    assert "denoised" not in image.provenance


def test_pixels_are_a_view_that_nobody_can_write(image):
    assert np.shares_memory(image.pixels, image.pixels)
    for array in (image.pixels, image.variance, image.samples, *image.layers.values()):
        with pytest.raises(ValueError):
            array[0] = 0
        with pytest.raises(ValueError):
            array.setflags(write=True)


def test_arrays_outlive_their_image(renderer):
    image = renderer.render("cornell", layers=["albedo"], **SMALL)
    arrays = [image.pixels, image.variance, image.samples, image.layers["albedo"]]
    before = [array.copy() for array in arrays]
    del image
    gc.collect()
    for seed in range(20):  # other images take memory that was freed
        renderer.render("spheres", seed=seed, **SMALL)
    assert all(equal(array, copied) for array, copied in zip(arrays, before))


def test_numpy_takes_an_image_as_its_pixels(image):
    assert equal(np.asarray(image), image.pixels)
    assert np.asarray(image, dtype=np.float64).dtype == np.float64
    copied = np.array(image)
    copied[:] = 0
    assert image.pixels.max() > 0


def test_an_image_of_own_pixels_is_a_copy():
    pixels = np.full((2, 3, 3), 0.5)
    image = hyalite.Image(pixels)
    pixels[:] = 0
    assert image.shape == (2, 3, 3) and (image.pixels == 0.5).all()
    assert image.variance is None and image.samples is None and image.layers == {} and image.is_finished


def test_alpha_is_an_array_beside_the_pixels(tmp_path):
    alpha = np.array([[0, 0.5, 1]], np.float32)
    image = hyalite.Image(alpha[..., None] * [0.25, 0.5, 0.75], alpha)
    assert equal(image.alpha, alpha) and image.pixels.shape == np.asarray(image).shape == (1, 3, 3)
    assert hyalite.Image(image.pixels).alpha is None
    for name in ["a.exr", "a.png"]:
        image.save(tmp_path / name)
        loaded = hyalite.load_image(tmp_path / name)
        assert np.abs(loaded.alpha - alpha).max() < 1 / 255
    assert (tmp_path / "a.png").read_bytes() == image._repr_png_()
    assert not loaded.pixels[0, 0].any() and equal(loaded.pixels[0, 1], loaded.pixels[0, 2])  # straight
    difference = hyalite.diff(image, image.pixels)
    assert (difference.identical, difference.differing_pixels, difference.alpha_max) == (False, 0, 1)
    assert difference.report["alpha"]["inTest"] is False and difference.alpha_mean == 0.5
    with pytest.raises(hyalite.UsageError, match="alpha"):
        hyalite.Image(image.pixels, alpha.T)


def test_what_a_file_loses_is_a_warning(tmp_path):
    image = hyalite.Image(np.full((1, 2, 3), [0.1, 1e6, 2]), np.ones((1, 2)))
    with pytest.warns(UserWarning, match="HDR has no alpha"):
        image.save(tmp_path / "a.hdr")
    with pytest.warns(UserWarning, match="2 values are beyond 65504"):
        image.save(tmp_path / "a.exr", half=True, compression="piz")
    loaded = hyalite.load_image(tmp_path / "a.exr").pixels
    assert equal(loaded[0, 0], np.array([np.float16(0.1), 65504, 2], np.float32))
    with pytest.raises(hyalite.UsageError, match='compression.*"piz"'):
        image.save(tmp_path / "a.exr", compression="pizz")


@pytest.mark.parametrize("pixels", [
    np.zeros((2, 2)), np.zeros((2, 2, 4)), np.zeros((0, 0, 3)), np.zeros((2, 2, 3), complex),
    np.zeros((2, 2, 3), bool), np.zeros((2, 2, 3), object), [[[1, 2, 3], [4]]], "text", None,
], ids=str)
def test_refuses_what_is_no_picture(pixels):
    with pytest.raises(hyalite.UsageError, match="pixels|image"):
        hyalite.Image(pixels)


def test_linear_files_keep_every_bit(image, tmp_path):
    for name in ["a.exr", "a.pfm"]:
        image.save(tmp_path / name)
        assert equal(hyalite.load_image(tmp_path / name), image), name


def test_a_png_is_the_picture_that_notebooks_show(image, tmp_path):
    image.save(tmp_path / "a.png")
    assert (tmp_path / "a.png").read_bytes() == image.png() == image._repr_png_()
    levels = hyalite.load_image(tmp_path / "a.png").pixels * 255
    assert np.abs(levels - np.round(levels)).max() < 1e-4  # levels are whole, but for the rounding of floats
    assert image.png("aces") != image.png()


def test_files_have_any_name(image, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    not_utf8 = os.fsdecode(b"b\xff.png")
    for name in ["Bild 文.png", pathlib.Path("p.png"), "UPPER.PNG", b"bytes.png", not_utf8]:
        image.save(name)
        assert os.path.exists(name)
        assert hyalite.load_image(name).shape == image.shape


@pytest.mark.parametrize("name", ["a.bmp", "a", "-", "", "nul\0.png"])
def test_saves_nothing_by_other_names(image, tmp_path, monkeypatch, name):
    monkeypatch.chdir(tmp_path)
    with pytest.raises(ValueError):
        image.save(name)
    assert list(tmp_path.iterdir()) == []


def test_says_why_a_file_cannot_be_written_or_read(image, tmp_path):
    with pytest.raises(hyalite.Error, match="create the folder") as refused:
        image.save(tmp_path / "none" / "a.png")
    assert refused.value.kind == "output not written"
    (tmp_path / "text.png").write_text("no picture")
    for name in ["none.png", "text.png"]:
        with pytest.raises(hyalite.Error, match=name) as refused:
            hyalite.load_image(tmp_path / name)
        assert refused.value.kind == "bad input"
    with pytest.raises(hyalite.UsageError, match="tone"):
        image.png("filmic")


def test_a_png_of_any_numbers():
    image = hyalite.Image(np.full((4, 4, 3), [np.nan, -1, np.inf]))
    assert image.png().startswith(b"\x89PNG")


def test_a_copy_of_an_image_is_the_image(image):
    for copied in (copy.copy(image), copy.deepcopy(image)):
        assert equal(copied, image) and list(copied.layers) == list(image.layers)


def test_an_image_is_shown_by_its_size(image):
    assert repr(image) == "<hyalite.Image 24x16>"


def test_the_provenance_tells_what_was_rendered(image):
    assert image.provenance["scene"].endswith("cornell.json")
    assert image.rays["primary"] == 24 * 16 * 4 and image.seconds > 0
