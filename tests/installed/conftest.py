"""Programs that are not of the house: they use Hyalite as it is installed, in an empty folder.

HYALITE_BUILD is the build folder, HYALITE_SOURCE the source folder."""
import os
import pathlib
import subprocess
import sys
import sysconfig

import pytest

BUILD = pathlib.Path(os.environ["HYALITE_BUILD"])
SOURCE = pathlib.Path(os.environ["HYALITE_SOURCE"])


def run(*command, **options):
    """The standard output of a command, which must succeed."""
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, **options)
    assert done.returncode == 0, f"{command}\n{done.stdout}\n{done.stderr}"
    return done.stdout


class Installation:
    def __init__(self, prefix):
        self.prefix = prefix
        run("cmake", "--install", BUILD, "--prefix", prefix)
        self.library = self.find("libhyalite.so").parent
        self.modules = self.find("hyalite/__init__.py").parent.parent

    def find(self, name):
        found = sorted(self.prefix.glob(f"lib/**/{name}"))
        assert found, f"{name} is not installed; the Python module needs python3-dev and pybind11-dev"
        return found[0]

    def environment(self, **more):
        """That of a user who has installed it in a folder of their own."""
        return {
            **os.environ,
            "CMAKE_PREFIX_PATH": str(self.prefix),
            # Nothing but its own file: who uses the library need not have what it was built with.
            "PKG_CONFIG_LIBDIR": str(self.library / "pkgconfig"),
            "LD_LIBRARY_PATH": str(self.library),
            "PYTHONPATH": str(self.modules),
            **more,
        }

    def python(self, *arguments, **options):
        return run(sys.executable, *arguments, env=self.environment(), **options)

    def compile(self, source, folder):
        """Compiles one file by pkg-config, warnings being errors. Returns the program."""
        flags = run("pkg-config", "--cflags", "--libs", "hyalite", env=self.environment()).split()
        program = folder / pathlib.Path(source).stem
        run("g++", "-std=c++20", "-Wall", "-Wextra", "-Wpedantic", "-Werror", source, "-o", program, *flags)
        return program


@pytest.fixture(scope="session")
def installed(tmp_path_factory):
    return Installation(tmp_path_factory.mktemp("prefix"))


def blocks(document, language):
    """The blocks of a document that open with ```language, joined."""
    text, inside = [], False
    for line in (SOURCE / document).read_text().splitlines():
        if line.startswith("```"):
            inside = not inside and line == f"```{language}"
        elif inside:
            text.append(line)
    assert text, f"{document} has no block of {language}"
    return "\n".join(text) + "\n"
