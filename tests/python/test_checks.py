"""Checks: comparisons, profiles, devices and verification."""
import json
import math
import subprocess

import numpy as np
import pytest

import hyalite
from conftest import SMALL, equal


def test_equal_images_do_not_differ(renderer, tmp_path):
    image = renderer.render("cornell", **SMALL)
    image.save(tmp_path / "a.exr")
    for other in (image, image.pixels, image.pixels.tolist(), tmp_path / "a.exr", str(tmp_path / "a.exr")):
        difference = hyalite.diff(image, other)
        assert difference.identical and difference.differing_pixels == 0
        assert math.isinf(difference.psnr) and difference.flip == 0 and difference.ssim == 1
        assert not difference.error_map.any() and not difference.flip_map.any()


def test_differences_are_where_they_are():
    reference = np.full((16, 20, 3), 0.5, np.float32)
    test = reference.copy()
    test[3, 5] += [0.3, 0, 0]
    difference = hyalite.diff(reference, test)
    assert not difference.identical and difference.differing_pixels == 1
    assert difference.error_map.shape == difference.flip_map.shape == difference.ssim_map.shape == (16, 20)
    assert difference.error_map[3, 5] == pytest.approx(0.09 / 3, rel=1e-5)
    assert np.count_nonzero(difference.error_map) == 1
    assert difference.psnr == pytest.approx(-10 * math.log10(0.09 / 3 / (16 * 20)), abs=1e-3)
    assert difference.flip_map.argmax() == 3 * 20 + 5
    assert difference.flip == pytest.approx(difference.flip_map.mean(), rel=1e-4)


def test_a_png_is_compared_with_the_png_of_a_linear_image(renderer, tmp_path):
    image = renderer.render("cornell", **SMALL)
    image.save(tmp_path / "a.png")
    assert hyalite.diff(tmp_path / "a.png", image).identical


def test_small_images_have_no_ssim():
    assert hyalite.diff(np.ones((8, 8, 3)), np.ones((8, 8, 3))).ssim is None


def test_refuses_images_of_two_sizes():
    with pytest.raises(hyalite.UsageError, match="16 x 4 and 16 x 8"):
        hyalite.diff(np.ones((4, 16, 3)), np.ones((8, 16, 3)))


def test_results_are_shown_in_a_line(renderer):
    image = renderer.render("cornell", width=64, height=64, spp=1)
    assert len(repr(hyalite.diff(image, image))) < 300
    assert len(repr(hyalite.compare("cornell", device="cpu", **SMALL))) < 400


def test_a_device_has_the_bits_of_its_twin():
    comparison = hyalite.compare("cornell", device="0", **SMALL)
    assert comparison.equal and comparison.difference.identical and comparison.report["passed"]
    assert equal(comparison.first, comparison.second)
    assert equal(comparison.first, hyalite.render("cornell", device="cpu", **SMALL))


def test_double_precision_differs(renderer):
    comparison = hyalite.compare("cornell", "cpu-double", device="cpu", **SMALL)
    assert not comparison.equal and comparison.difference.differing_pixels > 0 and comparison.difference.psnr > 30
    assert "divergence" in comparison.report


def test_a_profile_measures_each_frame():
    report = hyalite.profile("cornell", device="0", repeats=3, counts=True, **SMALL)
    plain = hyalite.profile("cornell", device="cpu", repeats=2, verified=False, **SMALL)
    assert json.dumps(report).count("Millis") > 3 and json.dumps(plain)
    for wrong in ({"repeats": 0}, {"warmups": -1}):
        with pytest.raises(hyalite.UsageError, match="profile"):
            hyalite.profile("cornell", device="cpu", **wrong, **SMALL)


def test_devices_are_those_of_the_command_line(program):
    done = subprocess.run([program, "devices", "--json"], capture_output=True, text=True, check=True)
    listed = json.loads(done.stdout)
    listed = listed["devices"] if isinstance(listed, dict) else listed
    assert [device["name"] for device in hyalite.devices()] == [device["name"] for device in listed]
    assert hyalite.Renderer("0").name == listed[0]["name"]


def test_the_twin_is_verified():
    report = hyalite.verify("cpu")
    assert report["passed"]


@pytest.mark.parametrize("device", ["cpu", "0"])
def test_no_kernel_is_verified_by_a_wrong_name(device):
    with pytest.raises(hyalite.UsageError, match="nope.*stack"):
        hyalite.verify(device, kernels=["nope"])


def test_inspects_a_scene_and_what_its_camera_sees():
    report = hyalite.inspect("cornell", coverage=True, width=32, height=32)
    assert report["contents"]["triangles"] > 0 and report["camera"]["width"] == 32
    shares = [item["share"] for item in report["coverage"]["objects"]]
    assert sum(shares) + report["coverage"]["background"] == pytest.approx(1)
    with pytest.raises(hyalite.UsageError, match="spp"):
        hyalite.inspect("cornell", spp=0)
