#include "host/cli/identity.h"

#include "host/report/hash.h"
#include "host/report/render_report.h"

#include "pixel_sources.h"

#include <fmt/format.h>

#include <span>

namespace hyalite {

namespace {

template <class Record> std::uint64_t chain(const std::vector<Record> &records, std::uint64_t hash) {
    return hash64(std::as_bytes(std::span(records)), hash);
}

/// Trees put triangles into different orders, which changes no pixel: so the sum of a hash for each.
std::uint64_t hashTriangles(const PackedScene &scene) {
    std::uint64_t sum = 0;
    for (std::size_t i = 0; i < scene.triangles.size(); ++i) {
        layout::TriangleRecord triangle = scene.triangles[i];
        triangle.flags &= ~layout::triangleEndsLeaf;
        sum += hash64(std::as_bytes(std::span(&scene.normals[i], 1)),
                      hash64(std::as_bytes(std::span(&triangle, 1))));
    }
    return sum;
}

std::uint64_t hashScene(const PackedScene &scene) {
    layout::FrameRecord frame = scene.frame;
    frame.seed = frame.maxDepth = frame.imageWidth = frame.imageHeight = 0; // which have names of their own
    std::uint64_t hash = hash64(std::as_bytes(std::span(&frame, 1)));
    hash = chain(scene.spheres, hash);
    hash = chain(scene.lights, hash);
    hash = chain(scene.materials, hash);
    const std::uint64_t triangles = hashTriangles(scene);
    return hash64(std::as_bytes(std::span(&triangles, 1)), hash);
}

} // namespace

RenderIdentity identityOf(const PreparedScene &scene, const Backend &backend) {
    RenderIdentity identity;
    const layout::FrameRecord &frame = scene.packed.frame;
    const Crop &crop = scene.crop;
    identity.emplace_back("image", fmt::format("{}x{}", frame.imageWidth, frame.imageHeight));
    identity.emplace_back("crop", fmt::format("{},{},{},{}", crop.x0, crop.x1, crop.y0, crop.y1));
    const nlohmann::ordered_json settings = settingsToJson(scene.loaded.scene.settings);
    for (const auto &[name, value] : settings.items())
        if (name != "spp" && name != "bvh" && name != "leafSize" && name != "exposure")
            identity.emplace_back(name, value.is_string() ? value.get<std::string>() : value.dump());
    identity.emplace_back("scene and camera", fmt::format("{:016x}", hashScene(scene.packed)));
    identity.emplace_back("precision", backend.precision());
    identity.emplace_back("kernels of this program", pixelSources);
    return identity;
}

} // namespace hyalite
