"""Consumers in C++: CMake, pkg-config, the archive, and the page of the documents."""
import re
import shutil

from conftest import BUILD, SOURCE, blocks, run

EXAMPLES = SOURCE / "assets" / "examples"


def build(installed, folder):
    run("cmake", "-S", folder, "-B", folder / "build", env=installed.environment())
    run("cmake", "--build", folder / "build", "--parallel", "2", env=installed.environment())
    return folder / "build"


def test_the_examples_by_cmake(installed, tmp_path):
    for file in ["CMakeLists.txt", "first.cpp", "arrays.cpp"]:
        shutil.copy(EXAMPLES / file, tmp_path)
    programs = build(installed, tmp_path)
    assert "equal to the CPU twin, bit for bit" in run(programs / "first", cwd=tmp_path)
    run(programs / "arrays", cwd=tmp_path)
    for file in ["cornell.png", "cornell.exr", "chain.png"]:
        assert (tmp_path / file).stat().st_size > 1000


def test_the_first_example_is_short():
    assert len((EXAMPLES / "first.cpp").read_text().splitlines()) <= 40


def test_has_the_bits_of_the_command_line(installed, tmp_path):
    program = installed.compile(EXAMPLES / "first.cpp", tmp_path)
    run(program, cwd=tmp_path, env=installed.environment())
    hyalite = installed.prefix / "bin" / "hyalite"
    size = ["--spp", "16", "--width", "128", "--height", "128"]
    run(hyalite, "render", "cornell", *size, "-o", "command.exr", cwd=tmp_path)
    assert "identical" in run(hyalite, "diff", "cornell.exr", "command.exr", cwd=tmp_path)


def test_the_archive_by_cmake(installed, tmp_path):
    shutil.copy(EXAMPLES / "first.cpp", tmp_path)
    (tmp_path / "CMakeLists.txt").write_text(
        "cmake_minimum_required(VERSION 3.20)\n"
        "project(consumer LANGUAGES CXX)\n"
        "find_package(hyalite 1.0 REQUIRED COMPONENTS static)\n"
        "add_executable(first first.cpp)\n"
        "target_link_libraries(first PRIVATE hyalite::static)\n"
    )
    program = build(installed, tmp_path) / "first"
    assert "libhyalite" not in run("ldd", program)
    environment = {"HYALITE_ASSETS": str(installed.prefix / "share" / "hyalite")}
    assert "equal to the CPU twin" in run(program, cwd=tmp_path, env=environment)


def test_has_no_symbols_but_its_own(installed):
    symbols = run("nm", "-DC", "--defined-only", installed.find("libhyalite.so")).splitlines()
    foreign = [line for line in symbols if not re.search(r" (\w+ for )*(typeinfo name for )?hyalite::(?!core)", line)]
    assert len(symbols) > 50 and foreign == []


def test_headers_know_nothing_of_what_is_inside(installed):
    for header in (installed.prefix / "include" / "hyalite").iterdir():
        assert not re.search(r'#include [<"](?!hyalite/)(.*/|vulkan|glm|nlohmann)', header.read_text()), header


def test_another_version_is_refused(installed, tmp_path):
    (tmp_path / "CMakeLists.txt").write_text(
        "cmake_minimum_required(VERSION 3.20)\nproject(consumer LANGUAGES CXX)\nfind_package(hyalite 2.0)\n"
        'if(hyalite_FOUND)\nmessage(FATAL_ERROR "found")\nendif()\n'
    )
    run("cmake", "-S", tmp_path, "-B", tmp_path / "build", env=installed.environment())


def test_the_page_of_the_documents(installed, tmp_path):
    source = tmp_path / "page.cpp"
    source.write_text(blocks("host/api/README.md", "cpp"))
    run(installed.compile(source, tmp_path), cwd=tmp_path, env=installed.environment())


def test_uninstall_removes_every_file_and_our_folders(tmp_path):
    prefix = tmp_path / "prefix"
    run("cmake", "--install", BUILD, "--prefix", prefix)
    kept = prefix / "share" / "hyalite" / "mine.json"
    kept.write_text("{}")
    run("cmake", "--build", BUILD, "--target", "uninstall")
    assert [path for path in prefix.rglob("*") if path.is_file()] == [kept]
    assert [path for path in prefix.rglob("hyalite")] == [kept.parent]
    kept.unlink()
