#include "host/cli/explanations.h"

#include "host/base/message.h"
#include "host/lab/comparison_run.h"
#include "host/reference/explain.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace hyalite::core {

namespace {

void printExplanation(const glm::uvec2 &pixel, const reference::Explanation &why) {
    printResult(
        "  ({}, {})  {}{}\n", pixel.x, pixel.y, reference::causeName(why.cause),
        why.marginPixels
            ? fmt::format(
                  ", sample {}, bounce {}: in double precision, it would be decided so {:.2g} pixels away",
                  why.sampleIndex, why.rayDepth - 1, *why.marginPixels)
            : ", no reason found within a quarter of a pixel");
}

} // namespace

void printDivergence(const glm::uvec2 &pixel, const std::optional<Divergence> &divergence) {
    if (!divergence) {
        printResult(
            "divergence   pixel ({}, {}): the paths agree in every step; what differs is how work is cut or "
            "summed\n",
            pixel.x, pixel.y);
        return;
    }
    printResult("divergence   pixel ({}, {}), sample {}, bounce {}: {}\n", pixel.x, pixel.y,
                divergence->sampleIndex, divergence->rayDepth - 1, divergence->quantity);
    printResult("  first      {}\n  second     {}\n", divergence->valueA, divergence->valueB);
}

std::size_t explainOutliers(const PreparedScene &scene, const Pixels &outliers) {
    constexpr std::size_t maxExplained = 2000;
    constexpr std::size_t maxPrinted = 8;
    std::size_t unexplained = outliers.size() > maxExplained ? outliers.size() - maxExplained : 0;
    std::array<std::size_t, 5> counts{};
    for (std::size_t i = 0; i < std::min(outliers.size(), maxExplained); ++i) {
        const glm::uvec2 pixel = imagePixel(scene.crop, outliers[i]);
        const reference::Explanation why =
            reference::explainOutlier(scene.packed, scene.loaded.settings, pixel);
        ++counts[static_cast<std::size_t>(why.cause)];
        const bool isExplained = why.cause != reference::Cause::Rounding && why.marginPixels;
        unexplained += isExplained ? 0u : 1u;
        if (i < maxPrinted)
            printExplanation(pixel, why);
    }
    if (outliers.size() > maxPrinted)
        printResult("  ...\n");
    for (std::size_t cause = 0; cause < counts.size(); ++cause)
        if (counts[cause] > 0)
            printResult("  {:<22} {}\n", reference::causeName(static_cast<reference::Cause>(cause)),
                        counts[cause]);
    return unexplained;
}

} // namespace hyalite::core
