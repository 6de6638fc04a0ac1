// Time a ray of paths by the size of a scene: by triangles of a mesh, by instances, and by lamps.
#include "tests/bench/meshes.h"
#include "tests/bench/race.h"
#include "tests/bench/rendering.h"
#include "tests/bench/subject.h"
#include "tests/bench/suites.h"

#include <fmt/format.h>
#include <fmt/os.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace hyalite::core::bench {

namespace {

void writeObj(const TriangleMesh &mesh, const std::filesystem::path &file) {
    fmt::ostream out = fmt::output_file(file.string());
    for (const glm::vec3 &p : mesh.positions)
        out.print("v {} {} {}\n", p.x, p.y, p.z);
    for (const MeshTriangle &triangle : mesh.triangles)
        out.print("f {} {} {}\n", triangle.positions.x + 1, triangle.positions.y + 1,
                  triangle.positions.z + 1);
}

/// A noisy sphere of about so many triangles, or a single triangle.
TriangleMesh sphereOf(int triangleCount) {
    if (triangleCount == 1) {
        TriangleMesh mesh;
        mesh.positions = {{-1, 0, 1}, {1, 0, 1}, {0, 1, -1}};
        mesh.triangles = {{{0, 1, 2}}};
        return mesh;
    }
    const int around = std::max(3, static_cast<int>(std::lround(std::sqrt(triangleCount))));
    return noisySphere(around, 1 + std::max(1, static_cast<int>(std::lround(0.5 * triangleCount / around))));
}

/// Calls place(x, z, random) for so many places, one somewhere in each cell of a square grid around the origin whose
/// cells have the size 1. Returns half the side of the square.
template <class Place> double scatter(int count, const Place &place) {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> jitter(0.2, 0.8);
    const int side = static_cast<int>(std::ceil(std::sqrt(count)));
    for (int i = 0; i < count; ++i) {
        const double x = i % side - 0.5 * side + jitter(random);
        const double z = static_cast<double>(i / side) - 0.5 * side + jitter(random);
        place(x, z, random);
    }
    return 0.5 * side;
}

constexpr const char *settings =
    R"("settings": {"integrator": "path", "spp": 8, "maxDepth": 4, "bvh": "sah"})";
constexpr const char *floorAndBalls =
    R"("floor": {"type": "diffuse"}, "ball": {"type": "diffuse", "albedo": 0.7})";

/// Looks down on a square around the origin in the plane y = 0, with the half side `half`, and shows all of it.
std::string cameraAbove(double half) {
    return fmt::format(R"("camera": {{"position": [0, {}, {}], "target": [0, 0, 0], "horizontalFov": 50,
        "width": 512, "height": 512}})",
                       1.8 * half + 1.0, 1.8 * half + 1.0);
}

std::string floorQuad(double half) {
    return fmt::format(
        R"("shapes": [{{"type": "quad", "material": "floor", "transform": [{{"scale": {}}}, {{"rotateDegrees": [-90, 0, 0]}}]}}])",
        half + 1.0);
}

/// One mesh below a sky.
void writeTriangles(fmt::ostream &scene, int count, const std::filesystem::path &folder) {
    writeObj(sphereOf(count), folder / "ball.obj");
    scene.print(R"({{"background": 1, {}, "materials": {{{}}}, {},
        "meshes": [{{"file": "ball.obj", "material": "ball"}}], {}}})",
                cameraAbove(1.0), floorAndBalls, floorQuad(1.0), settings);
}

/// Balls of a thousand triangles, each turned and stretched otherwise, on a floor below a sky.
void writeInstances(fmt::ostream &scene, int count, const std::filesystem::path &folder) {
    writeObj(sphereOf(1000), folder / "ball.obj");
    scene.print(
        R"({{"background": 1, "materials": {{{}}}, "meshes": [{{"file": "ball.obj", "material": "ball",
        "instances": [)",
        floorAndBalls);
    const char *separator = "";
    const double half = scatter(count, [&](double x, double z, std::mt19937 &random) {
        std::uniform_real_distribution<double> size(0.2, 0.5);
        const double turn = std::uniform_real_distribution<double>(0.0, 2.0 * std::numbers::pi)(random);
        const double width = size(random);
        const double height = size(random);
        scene.print("{}[{:.5g},0,{:.5g},{:.7g}, 0,{:.5g},0,{:.5g}, {:.5g},0,{:.5g},{:.7g}]\n", separator,
                    width * std::cos(turn), width * std::sin(turn), x, height, height,
                    -width * std::sin(turn), width * std::cos(turn), z);
        separator = ",";
    });
    scene.print("]}}], {}, {}, {}}}", cameraAbove(half), floorQuad(half), settings);
}

/// Lamps above a floor, each a small sphere.
void writeLamps(fmt::ostream &scene, int count, const std::filesystem::path & /*folder*/) {
    constexpr int colourCount = 8;
    scene.print(R"({{"materials": {{{})", floorAndBalls);
    for (int i = 0; i < colourCount; ++i)
        scene.print(R"(, "lamp{}": {{"type": "diffuse", "albedo": 0, "emission": [{}, {}, 20]}})", i,
                    10 + 10 * i, 80 - 10 * i);
    scene.print(R"(}}, "spheres": [)");
    const char *separator = "";
    const double half = scatter(count, [&](double x, double z, std::mt19937 &random) {
        scene.print(R"({}{{"centre": [{:.7g}, {:.3g}, {:.7g}], "radius": 0.05, "material": "lamp{}"}})",
                    separator, x, std::uniform_real_distribution<double>(0.2, 1.0)(random), z,
                    random() % colourCount);
        separator = ",\n";
    });
    scene.print("], {}, {}, {}}}", cameraAbove(half), floorQuad(half), settings);
}

struct Kind {
    const char *name;
    void (*write)(fmt::ostream &scene, int count, const std::filesystem::path &folder);
};

void measureSize(benchmark::State &state, const Context &context, const Kind &kind, int count) {
    const TemporaryFolder folder;
    const std::string file = (folder.path() / "scene.json").string();
    {
        fmt::ostream scene = fmt::output_file(file);
        kind.write(scene, count, folder.path());
    }
    const Frame frame{kind.name, file};
    Rendering onDevice(frame, context.systemTarget());
    Rendering onCpu(frame, cpuReference);
    if (!haveEqualPictures(onDevice, onCpu, state))
        return;
    race(state, [&] { return onDevice.run(); }, {});
    state.counters["ns/ray"] = 1e9 * state.counters["seconds"].value / onDevice.rayCount();
}

} // namespace

void registerSizes(Context &context) {
    for (int count = 1; count <= 1'000'000; count *= 10)
        for (const Kind &kind :
             {Kind{"triangles", writeTriangles}, Kind{"instances of 1,000 triangles", writeInstances},
              Kind{"lamps", writeLamps}})
            addBenchmark(
                fmt::format("size/{}/{}", count, kind.name), 3,
                [=, &context](benchmark::State &state) { measureSize(state, context, kind, count); });
}

} // namespace hyalite::core::bench
