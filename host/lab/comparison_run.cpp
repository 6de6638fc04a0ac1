#include "host/lab/comparison_run.h"

#include "host/jobs/layers.h"
#include "host/report/junit.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <utility>
#include <vector>

namespace hyalite::core {

ComparisonRun openComparison(const ComparisonRequest &request, const PreparedScene &scene,
                             Observer &observer) {
    const gpu::ProcessorUse processors = processorsFor(request.threadCount, scene);
    const gpu::RenderConfig config = renderConfigFor(request.deviceOptions);
    std::unique_ptr<Backend> first = openBackend(request.device, observer, processors, config);
    return {std::move(first), openBackend(request.against, observer, processors,
                                          isReference(request.against) ? gpu::RenderConfig{} : config)};
}

ComparedRenders renderBoth(const ComparisonRun &run, const PreparedScene &scene, Observer &observer) {
    /// The film, and what compositors see of it.
    const auto renderAll = [&](Backend &backend) {
        BackendResult result = unlessFailed(render(backend, scene.packed, scene.loaded.settings, scene.crop,
                                                   observer, {.name = backend.name()}));
        const std::vector<ViewFilm> views =
            renderViews(backend, scene, layerViewsOf(scene), {}, {}, observer, TimeLimit());
        LoadedImage image{result.film.toImage(), Encoding::Linear,
                          alphasOf(result.film, views, scene.loaded.settings)};
        return std::pair(std::move(result), std::move(image));
    };
    auto [a, imageA] = renderAll(*run.first);
    auto [b, imageB] = renderAll(*run.second);
    ImageComparison comparison = compareImages(imageB, imageA);
    const std::size_t differingLight = a.film.light.empty() ? 0 : differingPixelCount(a.film, b.film);
    return {std::move(a),
            std::move(b),
            std::move(imageA.image),
            std::move(imageB.image),
            std::move(imageA.alpha),
            std::move(imageB.alpha),
            std::move(comparison),
            differingLight};
}

glm::ivec2 worstPixel(const ComparedRenders &renders) {
    const PixelMetrics &metrics = renders.comparison.pixels;
    if (metrics.maxAbsoluteDifference > 0.0)
        return {metrics.worstX, metrics.worstY};
    const int width = renders.imageA.width();
    if (const std::optional<AlphaMetrics> &alpha = renders.comparison.alpha; metrics.identical() && alpha)
        return {static_cast<int>(alpha->worstIndex) % width, static_cast<int>(alpha->worstIndex) / width};
    const std::vector<glm::vec3> &a = renders.imageA.pixels();
    const std::vector<glm::vec3> &b = renders.imageB.pixels();
    const auto hasEqualBits = [](const glm::vec3 &x, const glm::vec3 &y) {
        using Bits = std::array<std::uint32_t, 3>;
        return std::bit_cast<Bits>(x) == std::bit_cast<Bits>(y);
    };
    const auto index = static_cast<int>(std::ranges::mismatch(a, b, hasEqualBits).in1 - a.begin());
    return metrics.identical() ? glm::ivec2(0) : glm::ivec2(index % width, index / width);
}

glm::uvec2 imagePixel(const Crop &crop, const glm::ivec2 &pixel) {
    return {static_cast<std::uint32_t>(crop.x0 + pixel.x), static_cast<std::uint32_t>(crop.y0 + pixel.y)};
}

nlohmann::ordered_json divergenceToJson(const glm::uvec2 &pixel,
                                        const std::optional<Divergence> &divergence) {
    nlohmann::ordered_json json;
    json["pixel"] = {pixel.x, pixel.y};
    if (!divergence)
        return json;
    json["sample"] = divergence->sampleIndex;
    json["bounce"] = divergence->rayDepth - 1;
    json["quantity"] = divergence->quantity;
    json["first"] = divergence->valueA;
    json["second"] = divergence->valueB;
    return json;
}

std::optional<Divergence> findFirstDivergence(Backend &first, Backend &second, const PreparedScene &scene,
                                              const glm::uvec2 &pixel) {
    const RenderSettings &settings = scene.loaded.settings;
    const int sampleCount = settings.samplesPerPixel;
    for (int sample = 0; sample < sampleCount; ++sample) {
        const std::uint32_t index = static_cast<std::uint32_t>(sample);
        if (std::optional<Divergence> divergence =
                findDivergence(first.trace(scene.packed, settings, pixel, index),
                               second.trace(scene.packed, settings, pixel, index),
                               scene.packed.frame.firstTriangleId, scene.loaded.scene.origin))
            return divergence;
    }
    return std::nullopt;
}

std::string describe(const glm::uvec2 &pixel, const std::optional<Divergence> &divergence) {
    const std::string place = fmt::format("pixel ({}, {})", pixel.x, pixel.y);
    if (!divergence)
        return place + ": the paths agree in every step; what differs is how work is cut or summed";
    return place + fmt::format(", sample {}, bounce {}: {}: first {}, second {}", divergence->sampleIndex,
                               divergence->rayDepth - 1, divergence->quantity, divergence->valueA,
                               divergence->valueB);
}

nlohmann::ordered_json tracesToJson(Backend &first, Backend &second, const PreparedScene &scene,
                                    const glm::uvec2 &pixel, const Divergence &divergence) {
    const auto stepsBy = [&](Backend &backend) {
        nlohmann::ordered_json steps = nlohmann::ordered_json::array();
        for (const TraceStep &step :
             describeTrace(backend.trace(scene.packed, scene.loaded.settings, pixel, divergence.sampleIndex),
                           scene.packed.frame.firstTriangleId, scene.loaded.scene.origin))
            steps.push_back({step.rayDepth - 1, step.quantity, step.value});
        return steps;
    };
    return {{"step", divergence.eventIndex}, {"first", stepsBy(first)}, {"second", stepsBy(second)}};
}

TestSuite comparisonSuite(const ComparisonRun &run, const PreparedScene &scene, double seconds,
                          const std::string &failure) {
    const std::string renderers =
        fmt::format("{} against {}", run.first->description(), run.second->description());
    return {renderers, {{"hyalite compare", scene.loaded.file.string(), seconds, failure}}};
}

std::string comparisonsToJunit(std::span<const TestSuite> suites) {
    return junitText("hyalite compare", suites);
}

nlohmann::ordered_json comparisonRunToJson(const ComparisonRun &run, const PreparedScene &scene,
                                           const std::string &commandLine) {
    const Integrator integrator = scene.loaded.settings.integrator;
    nlohmann::ordered_json json = provenanceToJson(provenanceOf(scene, commandLine));
    json["first"] = rendererToJson(run.first->identity(scene.packed, integrator));
    json["second"] = rendererToJson(run.second->identity(scene.packed, integrator));
    return json;
}

} // namespace hyalite::core
