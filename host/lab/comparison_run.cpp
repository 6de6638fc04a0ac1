#include "host/lab/comparison_run.h"

#include <utility>

namespace hyalite::core {

ComparisonRun openComparison(const ComparisonRequest &request, const PreparedScene &scene,
                             Observer &observer) {
    const gpu::ProcessorUse processors = processorsFor(request.threadCount, scene);
    const gpu::RenderConfig config = renderConfigFor(request.deviceOptions);
    std::unique_ptr<Backend> first = openBackend(request.device, observer, processors, config);
    return {std::move(first), openBackend(request.against, observer, processors,
                                          isReference(request.against) ? gpu::RenderConfig{} : config)};
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

nlohmann::ordered_json comparisonRunToJson(const ComparisonRun &run, const PreparedScene &scene,
                                           const std::string &commandLine) {
    const Integrator integrator = scene.loaded.settings.integrator;
    nlohmann::ordered_json json = provenanceToJson(provenanceOf(scene, commandLine));
    json["first"] = rendererToJson(run.first->identity(scene.packed, integrator));
    json["second"] = rendererToJson(run.second->identity(scene.packed, integrator));
    return json;
}

} // namespace hyalite::core
