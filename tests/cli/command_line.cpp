#include "tests/cli/command_line.h"

#include "host/image/image_file.h"
#include "tests/fixtures/test_extent.h"

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include <fmt/format.h>
#include <stdlib.h>

namespace hyalite::core::testing {

namespace fs = std::filesystem;

void CommandLine::SetUp() { hastenLavapipe(); }

Outcome CommandLine::run(const std::string &line) const { return runIn({}, line); }

Outcome CommandLine::runIn(Surroundings surroundings, const std::string &line) const {
    surroundings.folder = folder;
    surroundings.environment.try_emplace("HYALITE_CACHE", (folder / "cache").string()); // not the user's own
    return runProgram(splitWords(line), surroundings);
}

std::string CommandLine::expectFailure(const std::string &line, int exitCode,
                                       const std::vector<std::string> &parts) const {
    const Outcome outcome = run(line);
    EXPECT_EQ(outcome.exitCode, exitCode) << line << '\n' << outcome;
    EXPECT_EQ(outcome.output, "") << line;
    for (const std::string &part : parts)
        EXPECT_TRUE(contains(outcome.errors, part)) << line << "\nhas no \"" << part << "\" in:\n"
                                                    << outcome.errors;
    return outcome.errors;
}

std::string CommandLine::renderPfm(const std::string &line) const {
    const Outcome outcome = run("render " + line + " --quiet -o rendered.pfm");
    EXPECT_EQ(outcome.exitCode, 0) << line << '\n' << outcome;
    EXPECT_EQ(outcome.output + outcome.errors, "") << line;
    return outcome.exitCode == 0 ? load("rendered.pfm") : std::string();
}

Image CommandLine::renderImage(const std::string &line) const {
    const std::string bytes = renderPfm(line);
    return bytes.empty() ? Image() : readImage(folder / "rendered.pfm").image;
}

nlohmann::json CommandLine::renderReport(const std::string &line) const {
    const Outcome outcome = run("render " + line + " --quiet -o reported.pfm --report report.json");
    EXPECT_EQ(outcome.exitCode, 0) << line << '\n' << outcome;
    return outcome.exitCode == 0 ? nlohmann::json::parse(load("report.json")) : nlohmann::json::object();
}

void CommandLine::store(const std::string &name, const std::string &text) const {
    std::ofstream stream(folder / name, std::ios::binary);
    stream << text;
    ASSERT_TRUE(stream.good()) << name;
}

std::string CommandLine::load(const std::string &name) const {
    std::ifstream stream(folder / name, std::ios::binary);
    EXPECT_TRUE(stream.good()) << name;
    std::ostringstream text;
    text << stream.rdbuf();
    return text.str();
}

std::set<std::string> CommandLine::entries() const {
    std::set<std::string> names;
    for (const fs::directory_entry &entry : fs::directory_iterator(folder))
        if (entry.path().filename() != "cache")
            names.insert(entry.path().filename().string());
    return names;
}

bool contains(const std::string &text, const std::string &part) {
    return text.find(part) != std::string::npos;
}

nlohmann::json listDevices() {
    Surroundings surroundings;
    surroundings.folder = ::testing::TempDir();
    const Outcome outcome = runProgram({"devices", "--json"}, surroundings);
    if (outcome.exitCode != 0)
        throw std::runtime_error("devices --json: " + outcome.errors);
    nlohmann::json devices = nlohmann::json::array();
    for (const nlohmann::json &device : nlohmann::json::parse(outcome.output))
        if (device.contains("index"))
            devices.push_back(device);
    return devices;
}

std::string softwareDevice() {
    for (const nlohmann::json &device : listDevices())
        if (contains(device.at("type"), "software") && device.at("isUsable"))
            return std::to_string(device.at("index").get<int>());
    throw std::runtime_error("no usable software device: install mesa-vulkan-drivers");
}

bool hasKernel(const gpu::KernelRow *kernel) {
    const bool queriesRays = kernel != nullptr && kernel->tree == gpu::KernelTree::PrimitiveBoxes;
    return !queriesRays || listDevices().at(std::stoul(softwareDevice())).at("canQueryRays").get<bool>();
}

std::string wavySheetObj(int n) {
    std::string text;
    for (int y = 0; y <= n; ++y)
        for (int x = 0; x <= n; ++x) {
            const double u = 2.0 * x / n - 1.0;
            const double v = 2.0 * y / n - 1.0;
            text +=
                fmt::format("v {:.6f} {:.6f} {:.6f}\n", u, v, 0.25 * std::sin(9.0 * u) * std::cos(7.0 * v));
        }
    const auto corner = [&](int x, int y) { return y * (n + 1) + x + 1; };
    for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x)
            text += fmt::format("f {0} {1} {2}\nf {0} {2} {3}\n", corner(x, y), corner(x + 1, y),
                                corner(x + 1, y + 1), corner(x, y + 1));
    return text;
}

std::string wavySheetScene() {
    return R"({
  "camera": { "position": [0, 0, 4], "target": [0, 0, 0], "horizontalFov": 45, "width": 16, "height": 12 },
  "background": [0.1, 0.2, 0.3],
  "lights": [ { "type": "point", "position": [3, 2, 2], "power": 900 } ],
  "materials": {
    "sheet": { "type": "diffuse", "albedo": [0.8, 0.6, 0.4] },
    "mirror": { "type": "mirror" },
    "glass": { "type": "dielectric", "index": 1.5, "segmentTint": [0.9, 0.95, 1] }
  },
  "spheres": [
    { "centre": [-0.5, 0.2, 0.7], "radius": 0.4, "material": "mirror" },
    { "centre": [0.5, -0.2, 0.7], "radius": 0.4, "material": "glass" }
  ],
  "meshes": [ { "file": "sheet.obj", "material": "sheet" } ],
  "settings": { "spp": 2 }
})";
}

std::string squareObj() { return "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nf 1 2 3 4\n"; }

std::string squareScene() {
    return R"({
  "camera": { "position": [0, 0, 10], "direction": [0, 0, -1], "horizontalFov": 30, "width": 32, "height": 24 },
  "lights": [ { "type": "point", "position": [0, 0, 40], "power": 1e5 } ],
  "materials": { "grey": { "type": "diffuse", "albedo": 0.5, "twoSided": true } },
  "meshes": [ { "file": "square.obj", "material": "grey" } ],
  "settings": { "spp": 1, "sampler": "centre" }
})";
}

int litPixelCount(const Image &image) {
    int count = 0;
    for (const glm::vec3 &pixel : image.pixels())
        count += pixel != glm::vec3(0.0f) ? 1 : 0;
    return count;
}

} // namespace hyalite::core::testing
