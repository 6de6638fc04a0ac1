#!/usr/bin/env python3
"""Measures how soon the viewer shows another view.

    tests/bench/view.py [--program build/release/bin/hyalite] [--device DEVICE] [--moves 40] [SCENE...]

For each scene it starts `hyalite view`, waits for the first samples, and moves the camera many times, as a page does. A line
has the milliseconds from the request to the first picture of the new view, which is small, and to the first in full size, of
one sample: median, and all but a twentieth of them. The program has rendered the scene before: kernels are there.
"""
import argparse
import http.client
import json
import signal
import statistics
import subprocess
import time
import urllib.parse


class Page:
    """A connection to a viewer, as its page has one."""

    def __init__(self, url):
        address = urllib.parse.urlsplit(url)
        self.connection = http.client.HTTPConnection(address.netloc)
        self.headers = {"Origin": f"http://{address.netloc}"}
        front = self.answer("GET", f"/?{address.query}")
        self.headers["Cookie"] = front.getheader("Set-Cookie").split(";")[0]

    def answer(self, method, path, body=None):
        self.connection.request(method, path, body, self.headers)
        response = self.connection.getresponse()
        response.content = response.read()
        return response

    def states(self):
        """Those that the viewer tells, one after another."""
        self.connection.request("GET", "/events", headers=self.headers)
        for line in self.connection.getresponse():
            if line.startswith(b"data: "):
                yield json.loads(line[len("data: "):])

    def frame(self):
        """What the last frame is; its pixels are fetched, too."""
        content = self.answer("GET", "/frame").content
        return json.loads(content[:content.index(b"\n")])


class Watcher:
    """Two connections, as a page has them: one for news, the other for wishes and frames."""

    def __init__(self, url):
        self.page = Page(url)
        self.news = Page(url).states()
        self.shown = 0

    def frame_of(self, view, may_be_preview):
        """The first frame of a view behind this one, and the state that told of it."""
        while True:
            state = next(self.news)
            number = state["renderers"][0]["raw"]
            if number == self.shown:
                continue
            self.shown = number
            frame = self.page.frame()
            if frame["view"] > view and (may_be_preview or not frame["isPreview"]):
                return frame, state


def milliseconds(since):
    return 1e3 * (time.perf_counter() - since)


def measure(program, device, scene, moves):
    words = [program, "view", scene, "--quiet", *(["--device", device] if device else [])]
    viewer = subprocess.Popen(words, stdout=subprocess.PIPE, text=True)
    try:
        watcher = Watcher(viewer.stdout.readline().strip())
        frame, state = watcher.frame_of(0, False)
        x, y, z = state["camera"]["position"]
        step = 0.01 * max(abs(value) for value in (x, y, z, 1.0))
        first, full = [], []
        for move in range(moves):
            view = frame["view"]
            begin = time.perf_counter()
            watcher.page.answer("POST", "/change",
                                json.dumps({"camera-position": [x + (move % 10 + 1) * step, y, z]}))
            small, _ = watcher.frame_of(view, True)
            first.append(milliseconds(begin))
            frame, _ = (small, None) if not small["isPreview"] else watcher.frame_of(view, False)
            full.append(milliseconds(begin))
        return state, small, first, full
    finally:
        viewer.send_signal(signal.SIGINT)
        viewer.wait()


def text(times):
    return f"{statistics.median(times):.0f} ms, 95 % within {sorted(times)[int(0.95 * len(times)) - 1]:.0f} ms"


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--program", default="build/release/bin/hyalite")
    parser.add_argument("--device")
    parser.add_argument("--moves", type=int, default=40)
    parser.add_argument("scenes", nargs="*", default=["spheres", "cat", "cornell", "tea-table"])
    options = parser.parse_args()
    for scene in options.scenes:
        state, small, first, full = measure(options.program, options.device, scene, options.moves)
        print(f"{scene}, {state['width']}x{state['height']}, {state['integrator']}: {small['width']}x{small['height']} "
              f"after {text(first)}; whole after {text(full)}", flush=True)


main()
