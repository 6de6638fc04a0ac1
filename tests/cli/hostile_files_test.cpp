// Files as strangers make them: refused with the place and the reason or read as they are meant, never a crash, and in
// memory that keeps a proportion to the file.
#include "tests/cli/command_line.h"

#include "host/image/image_file.h"
#include "tests/fixtures/png_fixture.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace hyalite::core::testing {
namespace {

namespace fs = std::filesystem;
using namespace std::string_literals;

const std::string corners = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

std::string repeated(const std::string &part, int count) {
    std::string text;
    text.reserve(part.size() * static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i)
        text += part;
    return text;
}

std::string big32(std::uint32_t value) {
    std::string bytes;
    for (int shift = 24; shift >= 0; shift -= 8)
        bytes += static_cast<char>((value >> shift) & 0xffu);
    return bytes;
}

std::string chunk(const std::string &type, const std::string &data) {
    std::uint32_t crc = 0xffffffffu;
    for (const char c : type + data) {
        crc ^= static_cast<unsigned char>(c);
        for (int bit = 0; bit < 8; ++bit)
            crc = (crc >> 1) ^ ((crc & 1u) != 0 ? 0xedb88320u : 0u);
    }
    return big32(static_cast<std::uint32_t>(data.size())) + type + data + big32(~crc);
}

/// A PNG of one bit a pixel whose pixels are whatever is unpacked from so many zero bytes.
std::string bilevelPng(std::uint32_t width, std::uint32_t height, int packedBytes) {
    return "\x89PNG\r\n\x1a\n"s + chunk("IHDR", big32(width) + big32(height) + "\x01\0\0\0\0"s) +
           chunk("IDAT", std::string(static_cast<std::size_t>(packedBytes), '\0')) + chunk("IEND", "");
}

/// A zlib stream of so many MiB of blanks, made without holding them: a child's peak memory counts its parent's.
std::string packedBlanks(int mebibytes) {
    std::string blanks(std::size_t{1} << 20, ' ');
    std::string packed(blanks.size(), '\0');
    z_stream stream{};
    EXPECT_EQ(deflateInit(&stream, Z_BEST_SPEED), Z_OK);
    stream.next_out = reinterpret_cast<Bytef *>(packed.data());
    stream.avail_out = static_cast<uInt>(packed.size());
    for (int i = 1; i <= mebibytes; ++i) {
        stream.next_in = reinterpret_cast<Bytef *>(blanks.data());
        stream.avail_in = static_cast<uInt>(blanks.size());
        EXPECT_EQ(deflate(&stream, i < mebibytes ? Z_NO_FLUSH : Z_FINISH),
                  i < mebibytes ? Z_OK : Z_STREAM_END);
    }
    packed.resize(stream.total_out);
    deflateEnd(&stream);
    return packed;
}

struct HostileFiles : CommandLine {
    /// Runs a command that reads `file`, which it stores first, and expects it to end with an exit code of the user
    /// guide and without taking memory out of proportion.
    Outcome expectBounded(const std::string &command, const std::string &file,
                          const std::string &content) const {
        store(file, content);
        const Outcome outcome = run(command + " " + file);
        EXPECT_TRUE(outcome.exitCode == 0 || outcome.exitCode == 3 || outcome.exitCode == 5)
            << file << ' ' << outcome;
        EXPECT_FALSE(contains(outcome.errors, "internal error")) << outcome;
#ifndef __SANITIZE_ADDRESS__ // whose shadow is memory, too
        EXPECT_LE(outcome.peakMemoryBytes, (std::size_t{64} << 20) + 64 * content.size()) << file;
#endif
        return outcome;
    }
    void expectTaken(const std::string &file, const std::string &content) const {
        EXPECT_EQ(expectBounded("inspect", file, content).exitCode, 0) << file << ":\n"
                                                                       << content.substr(0, 200);
    }
    void expectRefused(const std::string &file, const std::string &content,
                       const std::vector<std::string> &parts) const {
        const Outcome outcome = expectBounded("inspect", file, content);
        EXPECT_EQ(outcome.exitCode, 3) << file << ":\n" << content.substr(0, 200);
        EXPECT_TRUE(contains(outcome.errors, file)) << outcome;
        EXPECT_LT(outcome.errors.size(), 2000u);
        for (const std::string &part : parts)
            EXPECT_TRUE(contains(outcome.errors, part)) << part << outcome;
        for (const char c : outcome.errors)
            EXPECT_TRUE(c == '\n' || (static_cast<unsigned char>(c) >= 0x20 && c != 0x7F)) << outcome;
    }
};

TEST_F(HostileFiles, ObjOfAnyLineEndsIsReadAlike) {
    for (const char *text :
         {"v 0 0 0\r\nv 1 0 0\r\nv 0 1 0\r\nf 1 2 3\r\n", "v 0 0 0\rv 1 0 0\rv 0 1 0\rf 1 2 3",
          "\xEF\xBB\xBFv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3", "v 0 0 0\nv 1 0 \\\n0\nv 0 1 0\nf 1 2 3\\",
          "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 \\\r\n2 3\r\n"})
        expectTaken("mesh.obj", text);
}

TEST_F(HostileFiles, WhatIsNotObjIsNamed) {
    expectRefused("mesh.obj", "\x1f\x8b\x08\0\0\0"s,
                  {"this is not OBJ text; it looks like gzip data: unpack it"});
    expectRefused("mesh.obj", "\xff\xfev\0 \0000\0"s, {"UTF-16 text: save it as UTF-8"});
    expectRefused("mesh.obj", "v\0 \0000\0 \0000\0 \0000\0\n\0"s, {"UTF-16"});
    expectRefused("mesh.obj", "PK\x03\x04"s + std::string(100, '\x01'), {"a ZIP archive"});
    expectRefused("mesh.obj", "\x01\x02\x03\x04\0\x05"s, {"binary data"});
    expectRefused("mesh.obj", "version https://git-lfs.github.com/spec/v1\n", {"Git LFS"});
    expectTaken("mesh.obj", "# \xc3\xa9\x85 \f\x1a\n" + corners + "f 1 2 3\n");
}

TEST_F(HostileFiles, ProfilesOfLampsAreBounded) {
    store(
        "lamp.json",
        R"({ "lights": [ { "type": "point", "position": [0, 1, 0], "power": 1, "profile": "lamp.ies" } ] })");
    const auto expectProfileRefused = [&](const std::string &content, const std::string &part) {
        store("lamp.ies", content);
        const Outcome outcome = run("inspect lamp.json");
        EXPECT_EQ(outcome.exitCode, 3) << outcome;
        EXPECT_TRUE(contains(outcome.errors, part)) << outcome;
        EXPECT_LT(outcome.errors.size(), 2000u);
        for (const char c : outcome.errors)
            EXPECT_TRUE(c == '\n' || (static_cast<unsigned char>(c) >= 0x20 && c != 0x7F)) << outcome;
#ifndef __SANITIZE_ADDRESS__
        EXPECT_LE(outcome.peakMemoryBytes, (std::size_t{64} << 20) + 64 * content.size());
#endif
    };
    const std::string head = "TILT=NONE\n1 1 1 ";
    expectProfileRefused("\x1f\x8b\x08\0\0\0"s, "gzip data");
    expectProfileRefused(head + "8192 8192 1 2 0 0 0 1 1 50\n", "more than the rest of the file holds");
    expectProfileRefused(head + "\x1b[31m", "lamp.ies:2: number of vertical angles");
    expectProfileRefused(head + std::string(1 << 20, '9'), "number of vertical angles");
    expectProfileRefused("TILT=INCLUDE\n1 65536 0", "angles of TILT");
    // The most that a file becomes: a value of two bytes stands for four all around.
    std::string large = head + "1000 1000 1 2 0 0 0 1 1 50\n";
    for (int gamma = 0; gamma < 1000; ++gamma)
        large += std::to_string(0.09 * gamma) + " ";
    for (int plane = 0; plane < 1000; ++plane)
        large += plane == 999 ? "90 " : std::to_string(0.09 * plane) + " ";
    store("lamp.ies", large + repeated("1 ", 1'000'000));
    const Outcome outcome = run("inspect lamp.json");
    EXPECT_EQ(outcome.exitCode, 0) << outcome;
    EXPECT_TRUE(contains(outcome.output, "1000 angles gamma, 3997 C, 1 cd at most")) << outcome;
}

TEST_F(HostileFiles, PlyTakesMemoryInProportion) {
    const std::string vertices = "element vertex 4\nproperty char x\nproperty char y\nproperty char z\n";
    const std::string head = "ply\nformat binary_little_endian 1.0\n" + vertices;
    const std::string square = "\0\0\0\1\0\0\1\1\0\0\1\0"s;
    // The fewest bytes for a triangle: one index of a byte.
    const std::string strip = repeated("\0\1\2\3"s, 250'000);
    expectTaken("mesh.ply", head +
                                "element tristrips 1\nproperty list int char vertex_indices\nend_header\n" +
                                square + "\x40\x42\x0f\0"s + strip);
    expectTaken("mesh.ply",
                head + "element face 300000\nproperty list uchar uchar vertex_indices\nend_header\n" +
                    square + repeated("\4\0\1\2\3"s, 300'000));
    expectRefused("mesh.ply",
                  head + "element face 4000000000\nproperty list uchar uchar vertex_indices\nend_header\n" +
                      square,
                  {": byte ", "damaged or cut short"});
    expectRefused("mesh.ply",
                  head + "element face 1\nproperty list uint uchar vertex_indices\nend_header\n" + square +
                      "\xff\xff\xff\xff",
                  {": byte ", "4294967295 corners"});
    expectRefused("mesh.stl", std::string(80, ' ') + "\xff\xff\xff\xff",
                  {"4294967295 triangles", "bytes for 0"});
}

TEST_F(HostileFiles, WrongIndicesAreNamedWithTheirLine) {
    for (const char *index :
         {"0", "-4", "4", "99999999999", "-99999999999", "2147483647", "-2147483648", "4294967297",
          "18446744073709551617", "1.5", "1e0", "--1", "1///1", "/1", "1/1/1/1", "//", "nan", "0x1"})
        expectRefused("mesh.obj", corners + "f 1 2 " + index + "\n", {":4: "});
}

TEST_F(HostileFiles, WrongNumbersAreNamedWithTheirLine) {
    for (const char *number : {"1e400", "-1e400", "nan", "-inf", "1,5", "0x10", "1e39", ".", "-", "1..2",
                               "1e99999999999", "\xC3\x28", "1\x1b[31m"})
        expectRefused("mesh.obj", "\n# comment\nv "s + number + " 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
                      {":3: "});
    for (const char *number : {"1e-400", "1e-45", "0.00000000000000000000000000000000000000001"})
        expectTaken("mesh.obj", "v "s + number + " 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    expectRefused("mesh.obj", "v 0." + std::string(100'000, '0') + "1 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
                  {":1: ", "128 characters"});
}

TEST_F(HostileFiles, NumbersDoNotDependOnTheLocale) {
    store("mesh.obj", "v 0.5 0 0\nv 1.25 0 0\nv 0 1.75 0\nf 1 2 3\n");
    store("scene.json", R"({"camera": {"position": [0.5, 0.5, 2.5], "horizontalFov": 60.5}, "materials": {"m":
        {"type": "diffuse", "albedo": 0.5}}, "meshes": [{"file": "mesh.obj", "material": "m"}]})");
    const std::string line = "inspect scene.json";
    const Outcome wanted = run(line);
    ASSERT_EQ(wanted.exitCode, 0) << wanted;
    for (const char *locale : {"de_DE.UTF-8", "de_DE", "tr_TR.UTF-8", "no such locale"}) {
        Surroundings surroundings;
        surroundings.environment["LC_ALL"] = locale;
        const Outcome outcome = runIn(surroundings, line);
        EXPECT_EQ(outcome.exitCode, 0) << outcome;
        EXPECT_EQ(outcome.errors, wanted.errors);
    }
}

TEST_F(HostileFiles, LongObjFilesTakeMemoryInProportion) {
    expectRefused("mesh.obj", corners + "f " + repeated("1 2 3 ", 350'000) + "\n",
                  {":4: ", "1050000 corners", "65536"});
    expectRefused("mesh.obj", corners + "v " + std::string(17 << 20, '1'), {":4: ", "too long"});
    expectRefused("mesh.obj", std::string(1 << 22, '\0'), {"mesh.obj"});
    expectRefused("mesh.obj", repeated("f 1 2 3\n", 200'000), {":1: ", "vertex index 1", "the file has 0"});
    expectTaken("mesh.obj", repeated("\n", 1 << 22) + corners + "f 1 2 3\n");
    expectTaken("mesh.obj", corners + repeated("f 1 2 3\n", 300'000));
    expectTaken("mesh.obj", repeated("f 1 2 3\n", 200'000) + corners);
    expectTaken("mesh.obj", repeated("v 1 1 1\n", 300'000) + corners + "f -1 -2 -3\n");
    // Polygons take the fewest bytes for a triangle, two.
    expectTaken("mesh.obj", corners + "v 1 1 0\nv 2 1 1\nv 3 1 0\nv 3 4 1\nv 9 4 0\nv 8 8 1\n" +
                                repeated("f " + repeated("1 2 3 4 5 6 7 8 9 ", 2000) + "\n", 20));
}

TEST_F(HostileFiles, JsonIsRefusedWithItsPlace) {
    expectRefused("scene.json", std::string(100'000, '['), {"nested deeper than 32"});
    expectRefused("scene.json", repeated("{\"a\":", 100'000), {"/a/a", "nested deeper than 32"});
    for (const char *number : {"1e400", "NaN", "Infinity", "0x10", "01", "1.", "+1", ".5", "1,5"})
        expectRefused("scene.json", "{\"camera\":\n {\"horizontalFov\": "s + number + "}}", {":2:"});
    for (const char *number :
         {"123456789012345678901234567890", "18446744073709551616", "-1", "1.5", "1e300"})
        expectRefused("scene.json", "{\"camera\": {\"width\": "s + number + "}}",
                      {"/camera/width", "allowed"});
    expectRefused("scene.json", R"({"camera": {}, "camera": {}})", {"/camera", "twice"});
    expectRefused("scene.json", "{\"description\": \"\xC3\x28\"}", {":1:"});
    expectRefused("scene.json", "{}\n\0"s, {":2:1: a NUL follows"});
    expectRefused("scene.json", "{}\0{\"camera\": 1}"s, {":1:3: a NUL follows"});
    expectRefused("scene.json", "\xFF\xFE{\0}\0"s, {"UTF-16 text: save it as UTF-8"});
    expectRefused("scene.json", R"({"\u001b[31m": 1})", {"\uFFFD[31m"});
    expectTaken("scene.json", "\xEF\xBB\xBF{\r\n}\r\n");
}

TEST_F(HostileFiles, JsonTakesMemoryInProportion) {
    for (const char *element : {"1,", "[],", "{},", "{\"\":0},", "\"\",", "\"aaaaaaaaaaaaaaaa\","})
        expectRefused("scene.json", "{\"lights\": [" + repeated(element, 400'000) + "1]}", {"/lights"});
    std::string keys = "{\"materials\": {";
    for (int i = 0; i < 200'000; ++i)
        keys += '"' + std::to_string(i) + "\":0,";
    expectRefused("scene.json", keys + "\"a\":0}}", {"/materials"});
    expectRefused("scene.json", "{\"" + std::string(1 << 22, 'x') + "\": 1}", {"scene.json"});
}

TEST_F(HostileFiles, GltfIsRefusedWithItsPlace) {
    const auto gltf = [](const std::string &members) {
        return R"({"asset": {"version": "2.0"}, )" + members + "}";
    };
    expectRefused("scene.gltf", gltf(R"("scenes": [ { "nodes": [ 7 ] } ])"), {"/scenes/0/nodes/0"});
    expectRefused("scene.gltf",
                  gltf(R"("scenes": [ { "nodes": [ 0 ] } ], "nodes": [ { "children": [ 0 ] } ])"),
                  {"/nodes/0"});
    expectRefused("scene.gltf", gltf(R"("extensionsRequired": [ "EXT_none" ])"),
                  {"/extensionsRequired/0", "EXT_none"});
    const std::string scene = R"("scenes": [ { "nodes": [ 0 ] } ], "nodes": [ { "mesh": 0 } ],
        "meshes": [ { "primitives": [ { "attributes": { "POSITION": 0 } } ] } ], )";
    const std::string giant =
        R"("accessors": [ { "componentType": 5126, "type": "VEC3", "count": 2000000000)";
    expectRefused("scene.gltf", gltf(scene + giant + " } ]"), {"/accessors/0"});
    expectRefused(
        "scene.gltf",
        gltf(scene + giant + R"(, "bufferView": 0 } ], "bufferViews": [ { "buffer": 0, "byteLength": 36 } ],
                       "buffers": [ { "byteLength": 36, "uri": "none.bin" } ])"),
        {"/buffers/0", "none.bin"});
    expectRefused("scene.glb", "glTF\2\0\0\0\xff\xff\xff\xff"s, {"scene.glb"});
    expectRefused("scene.glb", "", {"scene.glb"});
    // Nodes that double with each generation would be 2^40 instances.
    std::string nodes = R"("scenes": [ { "nodes": [ 0 ] } ], "nodes": [ )";
    for (int i = 1; i <= 40; ++i)
        nodes += R"({ "children": [ )" + std::to_string(i) + ", " + std::to_string(i) + " ] }, ";
    expectRefused("scene.gltf", gltf(nodes + "{} ]"), {"/nodes/"});
}

TEST_F(HostileFiles, GltfTakesMemoryInProportion) {
    const std::string asset = R"({"asset": {"version": "2.0"}, )";
    expectBounded("inspect", "scene.gltf", asset + R"("nodes": [ )" + repeated("{},", 300'000) + "{} ] }");
    expectRefused("scene.gltf", asset + R"("nodes": [ )" + repeated("{},", 3'000'000) + "{} ] }",
                  {"/nodes", "256 MiB"});
    expectBounded("inspect", "scene.gltf",
                  asset + R"("materials": [ )" + repeated("{},", 300'000) + "{} ] }");
    expectBounded("inspect", "scene.gltf", asset + R"("accessors": [ )" + repeated("0,", 500'000) + "0 ] }");
}

TEST_F(HostileFiles, PngTakesMemoryInProportion) {
    // 33 MB of rows: a stream that could hold them, but does not.
    const std::string cut = bilevelPng(32768, 8192, 40'000);
    store("cut.png", cut);
    const Outcome outcome = run("diff cut.png cut.png");
    EXPECT_EQ(outcome.exitCode, 5) << outcome;
    for (const char *part : {"cut.png: 32768 x 8192 pixels take", "512 MiB and 64 times its size", "PFM"})
        EXPECT_TRUE(contains(outcome.errors, part)) << part << outcome;
#ifndef __SANITIZE_ADDRESS__
    EXPECT_LE(outcome.peakMemoryBytes, (std::size_t{64} << 20) + 64 * cut.size());
#endif
}

TEST_F(HostileFiles, TextsOfPngsAreNotUnpacked) {
    const std::string packed = packedBlanks(200);
    std::string file(storedPng(0, {7}));
    for (const char *type : {"zTXt", "iCCP"})
        file.insert(33, chunk(type, "a\0\0"s + packed)); // behind the header
    store("bomb.png", file);
    const Outcome outcome = run("diff bomb.png bomb.png");
    EXPECT_EQ(outcome.exitCode, 0) << outcome;
#ifndef __SANITIZE_ADDRESS__
    EXPECT_LE(outcome.peakMemoryBytes, (std::size_t{64} << 20) + 64 * file.size());
#endif
}

TEST_F(HostileFiles, FlatPicturesOfUsualSizesAreNoBombs) {
    const Image flat(4096, 4096);
    for (const char *name : {"flat.png", "flat.exr", "flat.hdr"}) {
        AtomicFile file(folder / name);
        writeImage(file, imageFormatOf(name), flat, 0.0);
        file.commit();
        EXPECT_LT(std::filesystem::file_size(folder / name), std::size_t{2} << 20);
        EXPECT_EQ(readImage(folder / name).image.width(), 4096);
    }
}

} // namespace
} // namespace hyalite::core::testing
