"""A regression test of a Vulkan driver: pytest test_driver.py

Every device must have the bits of the CPU twin, whatever the kernel, and those that are shipped as hashes."""
import pytest

import hyalite

DEVICES = [device for device in hyalite.devices() if device.get("index") is not None and device["isUsable"]]


def test_there_is_a_device():
    assert DEVICES


@pytest.mark.parametrize("device", DEVICES, ids=lambda device: device["name"])
@pytest.mark.parametrize("scene", ["cornell", "spheres-nested", "metals"])
def test_equals_the_cpu(scene, device):
    comparison = hyalite.compare(scene, device=device["index"], spp=2, width=48, height=48)
    assert comparison.equal, comparison.report["divergence"]


@pytest.mark.parametrize("device", DEVICES, ids=lambda device: device["name"])
def test_has_the_shipped_bits(device):
    report = hyalite.verify(device["index"], kernels=["skip-list"])
    assert report["passed"], report["devices"]
