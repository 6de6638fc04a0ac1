#include "host/lab/speed.h"

#include <algorithm>
#include <limits>
#include <memory>

namespace hyalite::core {

std::vector<SpeedFigure> measureSpeed(const std::string &device, const TimeLimit &limit, Observer &observer) {
    constexpr int renderCount = 5;
    constexpr double enoughSeconds = 0.25; // a device that is done at once shows its latency
    constexpr int maxSamples = 4096;
    std::vector<SpeedFigure> figures;
    for (const Trial &trial : trials) {
        if (limit.isReached())
            break;
        const PreparedScene scene = prepareTrial(trial);
        const std::unique_ptr<Backend> backend = openBackend(device, observer, processorsFor(0, scene));
        SpeedFigure figure{trial.scene};
        RenderSettings settings = scene.loaded.settings;
        for (int i = 0; i < renderCount && (i == 0 || !limit.isReached());) {
            const BackendResult result = unlessFailed(backend->render(scene.packed, settings, scene.crop));
            const double seconds = std::max(result.timing.renderSeconds, std::numeric_limits<double>::min());
            figure.megaraysPerSecond =
                std::max(figure.megaraysPerSecond, static_cast<double>(result.rays.total()) * 1e-6 / seconds);
            if (seconds < enoughSeconds && settings.samplesPerPixel < maxSamples)
                settings.samplesPerPixel *= 4;
            else
                ++i;
        }
        figures.push_back(figure);
    }
    return figures;
}

} // namespace hyalite::core
