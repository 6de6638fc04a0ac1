#include "tests/images/rendering.h"

#include "host/gpu/kernel_needs.h"
#include "host/import/load.h"
#include "host/scene/validate.h"
#include "tests/fixtures/test_extent.h"
#include "tests/fixtures/test_scene.h"

#include <cassert>
#include <vector>

namespace hyalite::core::testing {

namespace {

const bool isHastened = (hastenLavapipe(), true);

Crop wholeImage(const TestScene &scene) { return {0, scene.camera.width, 0, scene.camera.height}; }

} // namespace

TestScene shippedScene(const std::string &name, int width, int height, int samplesPerPixel) {
    TestScene scene = loadTestScene(name);
    scene.camera.width = width;
    scene.camera.height = height;
    scene.settings.samplesPerPixel = samplesPerPixel;
    return scene;
}

PackedScene pack(const TestScene &scene, std::size_t maxDecoded) {
    validateScene(scene, "the test");
    validateSettings(scene.settings, scene, "the test");
    return packScene(scene, buildBvh(scene.settings.tree, scene, scene.settings.leafSize),
                     {scene.settings.lightChoice, maxDecoded});
}

gpu::Renderer &rendererBy(const gpu::RenderConfig &config) {
    assert(!config.isStaged && config.spirv.empty());
    static gpu::Renderer renderer(testDevice());
    renderer.configure(config);
    return renderer;
}

std::span<const gpu::RenderConfig> allKernels() {
    static const auto kernels = [] {
        std::vector<gpu::RenderConfig> configs;
        for (const gpu::KernelRow &row : gpu::kernelTable)
            if (gpu::lackFor(row, testDevice()).empty())
                configs.push_back({.kernel = &row});
        return configs;
    }();
    return kernels;
}

std::span<const gpu::RenderConfig> kernelsInTurn(std::size_t turn) {
    return isTestingAll() ? allKernels() : allKernels().subspan(turn % allKernels().size(), 1);
}

gpu::RenderConfig cutShortKernel() {
    return {.tileWidth = 8,
            .tileHeight = 16,
            .steps = 60,
            .samplesInFlight = 4,
            .kernel = gpu::findKernel("skip-list")};
}

gpu::Result renderOnDevice(const TestScene &scene, const gpu::RenderConfig &config, std::size_t maxDecoded) {
    return renderOnDevice(scene, pack(scene, maxDecoded), config);
}

gpu::Result renderOnDevice(const TestScene &scene, const PackedScene &packed,
                           const gpu::RenderConfig &config) {
    if (config.isStaged || !config.spirv.empty())
        return gpu::Renderer(testDevice(), config).render(packed, scene.settings, wholeImage(scene));
    return rendererBy(config).render(packed, scene.settings, wholeImage(scene));
}

reference::Result renderOnCpu(const TestScene &scene, const PackedScene &packed,
                              reference::Precision precision) {
    reference::Options options;
    options.precision = precision;
    return reference::render(packed, scene.settings, wholeImage(scene), options);
}

reference::Result renderOnCpu(const TestScene &scene, reference::Precision precision,
                              std::size_t maxDecoded) {
    return renderOnCpu(scene, pack(scene, maxDecoded), precision);
}

std::size_t differingPixels(const Film &a, const Film &b) {
    assert(a.pixels.size() == b.pixels.size());
    return differingPixelCount(a, b);
}

} // namespace hyalite::core::testing
