// Comparison of two renderers on one scene.
#pragma once

#include "host/engine/open_backends.h"
#include "host/image/comparison.h"
#include "host/reference/divergence.h"
#include "host/report/junit.h"

#include <glm/vec2.hpp>
#include <nlohmann/json.hpp>

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace hyalite::core {

struct ComparisonRequest {
    std::string device = "auto";
    std::string against = "cpu";
    int threadCount = 0;           ///< 0: all
    DeviceOptions deviceOptions{}; ///< of both, unless the second is the reference renderer
};

struct ComparisonRun {
    std::unique_ptr<Backend> first;
    std::unique_ptr<Backend> second;
};

[[nodiscard]] ComparisonRun openComparison(const ComparisonRequest &request, const PreparedScene &scene,
                                           Observer &observer);

/// Both images, and how they differ. The second one is the reference.
struct ComparedRenders {
    BackendResult a;
    BackendResult b;
    Image imageA; ///< of their films
    Image imageB;
    std::vector<float> alphaA; ///< empty: opaque
    std::vector<float> alphaB;
    ImageComparison comparison;
    std::size_t differingLight = 0; ///< pixels of films with layers of light that differ in any bit
};

[[nodiscard]] ComparedRenders renderBoth(const ComparisonRun &run, const PreparedScene &scene,
                                         Observer &observer);

/// The pixel of the images at which a difference is explained: the one with the largest, or the first with any.
[[nodiscard]] glm::ivec2 worstPixel(const ComparedRenders &renders);

/// From a pixel of the crop to that of the whole image.
[[nodiscard]] glm::uvec2 imagePixel(const Crop &crop, const glm::ivec2 &pixel);

[[nodiscard]] nlohmann::ordered_json divergenceToJson(const glm::uvec2 &pixel,
                                                      const std::optional<Divergence> &divergence);

/// Retraces a pixel of the whole image on both sides, sample by sample, until a step differs.
[[nodiscard]] std::optional<Divergence>
findFirstDivergence(Backend &first, Backend &second, const PreparedScene &scene, const glm::uvec2 &pixel);

/// What a divergence is, in one line.
[[nodiscard]] std::string describe(const glm::uvec2 &pixel, const std::optional<Divergence> &divergence);

/// "first" and "second": the steps of both paths, each an array of bounce, quantity and value; and "step", the index of
/// the first that differs.
[[nodiscard]] nlohmann::ordered_json tracesToJson(Backend &first, Backend &second, const PreparedScene &scene,
                                                  const glm::uvec2 &pixel, const Divergence &divergence);

/// The verdict on a scene as a suite of JUnit XML. No failure: it passed.
[[nodiscard]] TestSuite comparisonSuite(const ComparisonRun &run, const PreparedScene &scene, double seconds,
                                        const std::string &failure);
/// The text of suites of comparisons.
[[nodiscard]] std::string comparisonsToJunit(std::span<const TestSuite> suites);

/// The beginning of a report on two renders.
[[nodiscard]] nlohmann::ordered_json comparisonRunToJson(const ComparisonRun &run, const PreparedScene &scene,
                                                         const std::string &commandLine);

} // namespace hyalite::core
