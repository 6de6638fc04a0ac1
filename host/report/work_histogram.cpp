#include "host/report/work_histogram.h"

#include <algorithm>
#include <cmath>

namespace hyalite::core {

std::vector<WorkBin> binWork(std::span<const float> testsPerSample) {
    std::vector<WorkBin> bins;
    for (const float tests : testsPerSample) {
        const std::size_t index = tests < 1.0f ? 0 : static_cast<std::size_t>(std::ilogb(tests)) + 1;
        while (bins.size() <= index)
            bins.push_back(
                {bins.empty() ? 0.0 : bins.back().end, std::ldexp(1.0, static_cast<int>(bins.size())), 0});
        ++bins[index].pixelCount;
    }
    const auto hasPixels = [](const WorkBin &bin) { return bin.pixelCount > 0; };
    bins.erase(bins.begin(), std::find_if(bins.begin(), bins.end(), hasPixels));
    return bins;
}

} // namespace hyalite::core
