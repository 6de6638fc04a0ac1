"""`hyalite verify --minutes`: what it finds, its report, and the templates that run it."""
import json
import os
import pathlib
import re
import subprocess
import xml.etree.ElementTree

import jsonschema
import pytest

SOURCE = pathlib.Path(os.environ["HYALITE_SOURCE"])
BUILD = pathlib.Path(os.environ["HYALITE_BUILD"])
SCHEMA = json.loads((SOURCE / "assets/hyalite-verify.schema.json").read_text())
HEALTH = SOURCE / "assets/health"

# A layer between the program and the driver, in which bits flip: tests/faults/flips.h.
LAYER = {
    "VK_ADD_LAYER_PATH": str(BUILD / "faults"),
    "VK_INSTANCE_LAYERS": "VK_LAYER_HYALITE_faults",
    "NODEVICE_SELECT": "1",
}


@pytest.fixture
def verify(program, tmp_path):
    """Runs verify; returns its exit code and its report, which the schema allows."""

    def run(*arguments, **variables):
        file = tmp_path / "report.json"
        done = subprocess.run(
            [program, "verify", "--quiet", "--report", file, *arguments],
            capture_output=True,
            text=True,
            env={**os.environ, **variables},
        )
        assert done.returncode in (0, 1), done.stderr
        report = json.loads(file.read_text())
        jsonschema.validate(report, SCHEMA)
        assert report["isSound"] == (done.returncode == 0)
        assert done.stdout.splitlines()[-1] == ("sound" if report["isSound"] else "FAULTY")
        return done.returncode, report

    return run


def flipping(tmp_path, period, seed, buffers):
    return {
        **LAYER,
        "HYALITE_FLIPS": f"{period}:{seed}",
        "HYALITE_FLIP_BUFFERS": ",".join(buffers),
        "HYALITE_FLIP_LOG": str(tmp_path / "flips"),
    }


def test_a_sound_device_is_sound(verify, tmp_path):
    loads = ["materials", "memory", "arithmetic"]
    code, report = verify(
        "--device", "0", "--device", "cpu", "--passes", "4", "--memory", "16", "--loads", ",".join(loads),
        "--junit", tmp_path / "junit.xml",
    )  # fmt: skip
    assert code == 0, report
    device, cpu = report["devices"]
    assert [load["name"] for load in device["loads"]] == loads
    assert [load["name"] for load in cpu["loads"]] == ["materials"]
    for load in device["loads"] + cpu["loads"]:
        assert load["passes"] == 4 and load["wrongPasses"] == 0 and load["speed"]["median"] > 0, load
    suites = xml.etree.ElementTree.parse(tmp_path / "junit.xml").getroot()
    assert len(suites) == 2 and all(suite.get("failures") == "0" for suite in suites)
    assert len(suites[0]) == len(device["loads"])


def test_every_flip_that_reaches_a_film_is_found(verify, tmp_path):
    """The layer compares each film, too; both must agree on which are wrong, and on the first wrong pixel."""
    buffers = ["the film", "the finished samples", "the materials", "the lights", "the spheres"]
    code, report = verify("--device", "0", "--passes", "30", "--loads", "materials", **flipping(tmp_path, 4, 1, buffers))
    assert code == 1
    lines = [line.split() for line in (tmp_path / "flips").read_text().splitlines()]
    films = [line[1] for line in lines if line[0] == "film"]
    truth = {number + 1: int(pixel) for number, pixel in enumerate(films) if pixel != "equal"}
    assert sum(line[0] == "flip" for line in lines) >= 8 and len(truth) >= 3, lines
    load = report["devices"][0]["loads"][0]
    faults = report["devices"][0]["faults"]
    assert load["passes"] == len(films)
    found = {fault["pass"]: fault["pixel"][1] * 96 + fault["pixel"][0] for fault in faults if fault["kind"] == "film"}
    assert found == truth
    assert load["wrongPasses"] == len(truth)
    for fault in faults:
        tile, (x, y) = fault["tile"], fault["pixel"]
        assert tile["x"] <= x < tile["x"] + tile["width"] and tile["y"] <= y < tile["y"] + tile["height"]
    assert sum(report["devices"][0]["patterns"]["bits"].values()) > 0


def test_flips_in_exercised_memory_are_found(verify, tmp_path):
    code, report = verify(
        "--device", "0", "--passes", "10", "--loads", "memory", "--memory", "16",
        **flipping(tmp_path, 2, 3, ["exercised memory"]),
    )  # fmt: skip
    assert code == 1
    faults = [fault for fault in report["devices"][0]["faults"] if fault["load"] == "memory"]
    assert len(faults) >= 3, report["devices"][0]["faults"]
    lines = [line.split() for line in (tmp_path / "flips").read_text().splitlines()]
    flips = {(4 * int(line[-2]), 1 << int(line[-1])) for line in lines if line[0] == "flip"}
    for fault in faults:
        for word in fault["words"]:
            assert (word["byte"], word["found"] ^ word["expected"]) in flips


def test_a_driver_that_computes_otherwise_is_permanently_wrong(verify):
    code, report = verify("--device", "0", "--passes", "12", "--loads", "materials", **LAYER, HYALITE_FAKES="other-pi")
    assert code == 1
    device = report["devices"][0]
    assert device["loads"][0]["wrongPasses"] == device["loads"][0]["passes"]
    permanent = [fault for fault in device["faults"] if fault.get("recurrence") == "permanent"]
    assert permanent and permanent[0]["repeats"] == permanent[0]["replays"] == 10
    assert permanent[0]["divergence"]["first"] != permanent[0]["divergence"]["second"]


def test_an_earlier_report_says_how_fast_it_should_be(verify, tmp_path):
    earlier = tmp_path / "earlier.json"
    arguments = ["--device", "cpu", "--passes", "3", "--loads", "materials"]
    _, report = verify(*arguments)
    speed = report["devices"][0]["loads"][0]["speed"]
    speed["median"] /= 10
    earlier.write_text(json.dumps(report))
    assert verify(*arguments, "--expect", earlier)[0] == 0
    speed["median"] *= 1000
    earlier.write_text(json.dumps(report))
    code, slow = verify(*arguments, "--expect", earlier)
    assert code == 1
    assert slow["devices"][0]["faults"][0]["kind"] == "speed"


def test_options_that_do_not_go_together_are_refused(program, tmp_path):
    for words, text in [
        ("--loads materials", "--minutes"),
        ("--minutes 1 --scenes lights", "--loads"),
        ("--minutes 1 --loads material", 'did you mean "materials"'),
        ("--passes 1 --expect missing.json", "missing.json"),
        ("--minutes 0", "--minutes"),
    ]:
        done = subprocess.run([program, "verify", "--device", "cpu", *words.split()], capture_output=True, text=True, cwd=tmp_path)
        assert done.returncode in (2, 3) and text in done.stderr, done
    junk = tmp_path / "junk.json"
    junk.write_text('{"soakVersion": 7}')
    done = subprocess.run(
        [program, "verify", "--device", "cpu", "--passes", "1", "--expect", junk], capture_output=True, text=True
    )
    assert done.returncode == 3 and "soakVersion 7" in done.stderr, done


def short(words):
    """The arguments of a template for a test: a pass on the processors."""
    text = " ".join(words)
    text = re.sub(r"--minutes \S+", "--passes 1", text)
    return re.sub(r"--device \S+", "--device cpu --loads materials", text).split()


def test_the_prolog_passes_sound_nodes_and_drains_others(program, tmp_path):
    variables = {"MINUTES": "0.05", "DEVICE": "cpu", "REPORTS": str(tmp_path), "SLURM_JOB_ID": "7"}
    prolog = HEALTH / "slurm-prolog.sh"
    done = subprocess.run([prolog], env={**os.environ, **variables, "HYALITE": program}, capture_output=True, text=True)
    assert done.returncode == 0, done
    assert list(tmp_path.iterdir()) == []
    wrong = tmp_path / "wrong"
    wrong.write_text("#!/bin/sh\necho FAULTY; exit 1\n")
    wrong.chmod(0o755)
    assert subprocess.run([prolog], env={**os.environ, **variables, "HYALITE": str(wrong)}).returncode == 1
    assert (tmp_path / "7.txt").read_text() == "FAULTY\n"


def test_the_init_container_runs(program):
    line = re.search(r"command: \[(hyalite, verify.*)\]", (HEALTH / "init-container.yaml").read_text()).group(1)
    words = [word.strip().strip('"') for word in line.split(",")]
    assert subprocess.run([program, *short(words[1:])]).returncode == 0


def test_the_unit_runs(program, tmp_path):
    line = re.search(r"(?m)^ExecStart=/usr/bin/env hyalite (.*)$", (HEALTH / "hyalite-verify.service").read_text()).group(1)
    words = short(line.replace("${STATE_DIRECTORY}", str(tmp_path)).split())
    assert subprocess.run([program, *words]).returncode == 0
    assert json.loads((tmp_path / "verify.json").read_text())["isSound"]
    assert (tmp_path / "verify.xml").exists()
