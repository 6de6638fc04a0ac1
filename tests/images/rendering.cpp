#include "tests/images/rendering.h"

#include "host/import/load.h"
#include "host/scene/validate.h"

#include <cassert>
#include <cstring>

namespace hyalite::testing {

namespace {

Crop wholeImage(const Scene &scene) { return {0, scene.camera.width, 0, scene.camera.height}; }

} // namespace

Scene shippedScene(const std::string &name, int width, int height, int samplesPerPixel) {
    Scene scene = loadScene(name).scene;
    scene.camera.width = width;
    scene.camera.height = height;
    scene.settings.samplesPerPixel = samplesPerPixel;
    return scene;
}

PackedScene pack(const Scene &scene, std::size_t maxDecoded) {
    validateScene(scene, "the test");
    return packScene(scene, buildBvh(scene.settings.tree, scene, scene.settings.leafSize), maxDecoded);
}

gpu::Result renderOnDevice(const Scene &scene, const gpu::RenderConfig &config, std::size_t maxDecoded) {
    return renderOnDevice(scene, pack(scene, maxDecoded), config);
}

gpu::Result renderOnDevice(const Scene &scene, const PackedScene &packed, const gpu::RenderConfig &config) {
    return gpu::Renderer(testing::testDevice(), config).render(packed, scene.settings, wholeImage(scene));
}

reference::Result renderOnCpu(const Scene &scene, const PackedScene &packed, reference::Precision precision) {
    reference::Options options;
    options.precision = precision;
    return reference::render(packed, scene.settings, wholeImage(scene), options);
}

reference::Result renderOnCpu(const Scene &scene, reference::Precision precision, std::size_t maxDecoded) {
    return renderOnCpu(scene, pack(scene, maxDecoded), precision);
}

std::size_t differingPixels(const Film &a, const Film &b) {
    assert(a.pixels.size() == b.pixels.size());
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i)
        count += std::memcmp(&a.pixels[i], &b.pixels[i], sizeof(a.pixels[i])) != 0 ? 1u : 0u;
    return count;
}

} // namespace hyalite::testing
