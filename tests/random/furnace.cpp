#include "tests/random/furnace.h"

#include "host/reference/renderer.h"

#include <algorithm>
#include <array>

namespace hyalite::core::testing {

double maxFurnaceRadiance(const PackedScene &packed) {
    const bool mayBeInGlass =
        packed.frame.mediaAtEye != 0 || (packed.camera & layout::cameraOriginsMeetGlass) != 0;
    double index = 1.0;
    for (const layout::MaterialRecord &material : packed.materials)
        if (mayBeInGlass)
            index = std::max(index, static_cast<double>(material.refractiveIndex));
    return index * index;
}

bool gains(const PackedScene &packed, const RenderSettings &settings, const glm::ivec2 &pixel) {
    constexpr int sampleCount = 2000;
    constexpr std::array weights{0.02, 0.1, 0.3, 0.9};
    const double limit = maxFurnaceRadiance(packed) * (1.0 + furnaceAllowance);
    RenderSettings single = settings;
    single.samplesPerPixel = 1;
    std::array<double, weights.size()> products{};
    products.fill(1.0);
    bool isAbove = false;
    for (int i = 1; i <= sampleCount && !isAbove; ++i) {
        single.seed = settings.seed + 7919u * static_cast<std::uint32_t>(i);
        reference::Options options;
        options.threadCount = 1;
        const glm::vec3 sample =
            reference::render(packed, single, Crop{pixel.x, pixel.x + 1, pixel.y, pixel.y + 1}, options)
                .film.pixels.front()
                .sum;
        const double red = static_cast<double>(sample.x);
        double mean = 0.0;
        for (std::size_t k = 0; k < weights.size(); ++k) {
            products[k] *= 1.0 + weights[k] * (red / limit - 1.0);
            mean += products[k] / weights.size();
        }
        isAbove = mean >= 1.0 / furnaceErrorRate;
    }
    return isAbove;
}

} // namespace hyalite::core::testing
