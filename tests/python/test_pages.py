"""Pages and JUnit XML of `compare` and `diff`, read apart from the program's own code."""
import base64
import json
import os
import re
import subprocess
import xml.etree.ElementTree as tree

import numpy as np
import pytest

import hyalite

SMALL = ["--width", "24", "--height", "16", "--spp", "2", "--device", "cpu"]


@pytest.fixture
def run(program, tmp_path):
    def run(*words, code=0):
        done = subprocess.run([program, *words], capture_output=True, cwd=tmp_path, timeout=300)
        assert done.returncode == code, done
    return run


def report_in(file):
    before, report, after = re.fullmatch(
        r'(.*<script type="application/json" id="report">)(.*?)(</script.*)', file.read_text(), re.S).groups()
    assert not re.search(r"(https?:|src=|<link|@import)", before + after)
    return json.loads(report)


def pictures_of(report):
    page = report["page"]
    x0, x1, y0, y1 = page["window"]
    texts = [picture["pixels"] for picture in page["pictures"]]
    return [np.frombuffer(base64.b64decode(text or texts[0]), "<f4").reshape(y1 - y0, x1 - x0, page["channels"])
            for text in texts]


def distances(first, second):
    """Steps between floats, -0 and +0 being one apart."""
    def place(values):
        bits = np.ascontiguousarray(values).view("<i4").astype(np.int64)
        return np.where(bits >= 0, bits, -1 - (bits & 0x7fffffff))
    return np.abs(place(first) - place(second))


def test_a_page_of_two_files_has_their_bits(run, tmp_path):
    for name, seed in (("a.exr", "1"), ("b.exr", "2")):
        run("render", "cornell", "-o", name, "--seed", seed, *SMALL)
    run("diff", "a.exr", "b.exr", "--html", "page.html", code=1)
    report = report_in(tmp_path / "page.html")
    files = [np.asarray(hyalite.load_image(tmp_path / name)) for name in ("a.exr", "b.exr")]
    for picture, file in zip(pictures_of(report), files):
        assert picture.tobytes() == file.tobytes()
    steps = distances(*files)
    assert report["maxUlpDistance"] == steps.max()
    for least, most, count in report["page"]["ulps"]:
        assert count == np.count_nonzero((steps >= least) & (steps <= most))
    assert sum(count for *_, count in report["page"]["ulps"]) == steps.size
    flip = np.frombuffer(base64.b64decode(report["page"]["flip"]), "<f4")
    assert flip.mean() == pytest.approx(report["flip"]["mean"], rel=1e-5)
    for picture, seed in zip(report["page"]["pictures"], "12"):
        origin = dict(picture["origin"])
        assert origin["settings.seed"] == seed and origin["software"].startswith("hyalite ")
    assert not report["passed"] and report["page"]["verdict"] == "not identical"


def test_a_page_of_equal_renders_has_one_picture(run, tmp_path):
    run("render", "cornell", "-o", "a.exr", *SMALL)
    run("compare", "cornell", *SMALL, "--html", "page.html", "--junit", "cases.xml")
    report = report_in(tmp_path / "page.html")
    assert report["page"]["pictures"][1]["pixels"] is None
    for picture in pictures_of(report):
        assert picture.tobytes() == np.asarray(hyalite.load_image(tmp_path / "a.exr")).tobytes()
    assert report["page"]["ulps"] == [[0, 0, 24 * 16 * 3]]
    assert report["passed"] and report["page"]["verdict"] == "equal, bit for bit"
    suite = tree.parse(tmp_path / "cases.xml").getroot()[0]
    assert suite.get("tests") == "1" and suite.get("failures") == "0" and not len(suite[0])


def test_a_crop_keeps_its_place(run, tmp_path):
    run("compare", "cornell", *SMALL, "--crop", "4,12,6,10", "--against", "cpu-double", "--html", "page.html")
    page = report_in(tmp_path / "page.html")["page"]
    assert page["corner"] == [4, 6] and page["window"] == [0, 8, 0, 4]


def test_pngs_have_their_texts_and_alpha(run, tmp_path):
    far = ["--camera-position", "278,273,-3000", *SMALL]
    run("render", "cornell", "-o", "a.png", "--alpha", *far)
    run("render", "cornell", "-o", "b.png", *far)
    run("diff", "a.png", "b.png", "--html", "page.html", code=1)
    report = report_in(tmp_path / "page.html")
    assert report["encoding"] == "display" and report["page"]["channels"] == 4
    assert dict(report["page"]["pictures"][0]["origin"])["settings.alpha"] == "true"
    alpha = np.asarray(hyalite.load_image(tmp_path / "a.png").alpha)
    assert (alpha < 1).any() and pictures_of(report)[0][..., 3].tobytes() == alpha.tobytes()
    assert (pictures_of(report)[1][..., 3] == 1).all()


def test_names_may_hold_anything(run, tmp_path):
    name = os.fsdecode(b"]]><b a='\"&\x01\x1b\xff\xef\xbf\xbe\xe2\x80\xae.pfm")
    hyalite.Image(np.zeros((4, 4, 3))).save(tmp_path / "a.pfm")
    (tmp_path / "a.pfm").rename(tmp_path / name)
    hyalite.Image(np.ones((4, 4, 3))).save(tmp_path / "b.pfm")
    run("diff", name, "b.pfm", "--html", "page.html", "--junit", "cases.xml", "--max-diff", "0.5", code=1)
    assert report_in(tmp_path / "page.html")["page"]["pictures"][0]["name"].startswith("]]><b a='\"&\x01\x1b\ufffd")
    suite = tree.parse(tmp_path / "cases.xml").getroot()[0]
    assert suite[0].get("name").startswith("]]><b a='\"&\ufffd\ufffd\ufffd")
    assert suite[0][0].get("message") == "16 of 16 pixels differ, by at most 1; --max-diff 0.5: found 1"
    run("diff", "b.pfm", "b.pfm", "--junit", "cases.xml")
    assert not len(tree.parse(tmp_path / "cases.xml").getroot()[0][0])


def test_estimates_have_cases(run, tmp_path):
    size = ["--width", "32", "--height", "32", "--spp", "16", "--device", "cpu"]
    run("compare", "cornell", "--statistical", "--against", "cpu", *size, "--junit", "a.xml")
    assert tree.parse(tmp_path / "a.xml").getroot()[0].get("failures") == "0"
    run("render", "cornell", "-o", "a.exr", *size)
    run("render", "cornell", "-o", "b.exr", "--light-choice", "power", "--max-depth", "2", *size)
    run("diff", "--statistical", "a.exr", "b.exr", "--junit", "b.xml", code=1)
    failure = tree.parse(tmp_path / "b.xml").getroot()[0][0][0]
    assert failure.tag == "failure" and "NOT estimates of one picture" in failure.get("message")
    run("diff", "--statistical", "a.exr", "b.exr", "--html", "page.html", code=2)


@pytest.mark.parametrize("words, code", [
    (["--html", "b.pfm"], 2), (["--html", "x", "--junit", "x"], 2), (["--html", "no/such/page.html"], 7),
    (["--junit", "no/such/cases.xml"], 7), (["--html", ""], 2)])
def test_files_are_opened_before_the_work(run, tmp_path, words, code):
    (tmp_path / "a.pfm").write_text("no picture, which is told by code 3 once it is read")
    hyalite.Image(np.ones((4, 4, 3))).save(tmp_path / "b.pfm")
    before = (tmp_path / "b.pfm").read_bytes()
    run("diff", "a.pfm", "b.pfm", *words, code=code)
    assert (tmp_path / "b.pfm").read_bytes() == before and len(list(tmp_path.iterdir())) == 2
