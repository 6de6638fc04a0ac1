// A mesh from arrays, seen many times, in the light of an environment that is an array, too.
#include <hyalite/hyalite.h>

#include <cmath>
#include <cstdint>
#include <iostream>
#include <numbers>
#include <vector>

namespace {

/// A torus around +y, with its normals.
struct Torus {
    std::vector<double> vertices;
    std::vector<double> normals;
    std::vector<std::uint32_t> faces; ///< of four corners

    Torus(double radius, double tube, std::uint32_t rings, std::uint32_t sides) {
        for (std::uint32_t ring = 0; ring < rings; ++ring)
            for (std::uint32_t side = 0; side < sides; ++side) {
                const double around = 2.0 * std::numbers::pi * ring / rings;
                const double along = 2.0 * std::numbers::pi * side / sides;
                const double out = std::cos(along);
                normals.insert(normals.end(),
                               {out * std::cos(around), std::sin(along), out * std::sin(around)});
                const double distance = radius + tube * out;
                vertices.insert(vertices.end(), {distance * std::cos(around), tube * std::sin(along),
                                                 distance * std::sin(around)});
                const std::uint32_t nextRing = (ring + 1) % rings;
                const std::uint32_t nextSide = (side + 1) % sides;
                faces.insert(faces.end(), {ring * sides + side, ring * sides + nextSide,
                                           nextRing * sides + nextSide, nextRing * sides + side});
            }
    }
};

/// A chain: every second link stands upright. Row-major matrices.
std::vector<double> chain(int links) {
    std::vector<double> matrices;
    for (int i = 0; i < links; ++i) {
        const double x = 2.6 * (i - 0.5 * (links - 1));
        const double turn = i % 2;                              // a quarter about x
        matrices.insert(matrices.end(), {1, 0, 0, x,            //
                                         0, 1 - turn, -turn, 0, //
                                         0, turn, 1 - turn, 0,  //
                                         0, 0, 0, 1});
    }
    return matrices;
}

/// Light from above, twice as bright as that from below.
std::vector<float> sky(int width, int height) {
    std::vector<float> radiance;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            radiance.insert(radiance.end(), 3, y < height / 2 ? 1.0f : 0.5f);
    return radiance;
}

} // namespace

int main() {
    try {
        const Torus torus(2.0, 0.5, 48, 24);
        hyalite::Scene scene;
        scene.addMaterial("gold", R"({"type": "conductor", "metal": "gold", "roughness": 0.2})");
        scene.addMesh(
            {.vertices = torus.vertices, .faces = torus.faces, .cornersPerFace = 4, .normals = torus.normals},
            "gold", chain(5));
        scene.setEnvironment(64, 32, sky(64, 32));

        hyalite::RenderOptions options;
        options.watch.progress = [](const std::string &task, double share) {
            std::cerr << "\r" << task << " " << static_cast<int>(100.0 * share) << " %  ";
        };
        hyalite::Renderer renderer;
        renderer.render(scene, {{"spp", 32}, {"width", 320}, {"height", 160}}, options).save("chain.png");
        std::cerr << "\n";
        return 0;
    } catch (const hyalite::Error &error) {
        std::cerr << hyalite::toText(error.kind()) << ": " << error.what() << "\n";
        return 2;
    }
}
