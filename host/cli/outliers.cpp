#include "host/cli/outliers.h"

#include "host/base/error.h"
#include "host/image/tone_map.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>

namespace hyalite::core {

bool Tolerance::allows(float a, float b) const {
    if (ulpDistance(a, b) <= ulps)
        return true;
    return std::abs(static_cast<double>(a) - static_cast<double>(b)) <= absolute;
}

Tolerance parseTolerance(const std::string &text) {
    std::size_t end = 0;
    double value = -1.0;
    try {
        value = std::stod(text, &end);
    } catch (const std::exception &) {
        end = 0;
    }
    const std::string unit = text.substr(end);
    const bool isUlps = unit == "ulp" || unit == "ulps";
    if (end == 0 || !(value >= 0.0) || !std::isfinite(value) || !(isUlps || unit.empty()) ||
        (isUlps && value > 1e9))
        throw Error(
            ErrorKind::Usage,
            fmt::format("--tolerance {}: give a difference of radiance such as 1e-5, or ULPs such as 4ulp",
                        text));
    return isUlps ? Tolerance{0.0, static_cast<std::uint32_t>(value)} : Tolerance{value, 0};
}

Pixels findOutliers(const Image &a, const Image &b, const Tolerance &tolerance) {
    Pixels outliers;
    for (int y = 0; y < a.height(); ++y)
        for (int x = 0; x < a.width(); ++x)
            for (int channel = 0; channel < 3; ++channel)
                if (!tolerance.allows(a.at(x, y)[channel], b.at(x, y)[channel])) {
                    outliers.push_back({x, y});
                    break;
                }
    return outliers;
}

Pixels findVisibleOutliers(const Image &a, const Image &b) {
    const std::vector<std::uint8_t> levelsA = toneMap(a, 0.0);
    const std::vector<std::uint8_t> levelsB = toneMap(b, 0.0);
    Pixels outliers;
    for (std::size_t i = 0; i < levelsA.size(); i += 3) {
        const auto isFar = [&](std::size_t k) {
            return std::abs(int{levelsA[i + k]} - int{levelsB[i + k]}) > 2;
        };
        const int pixel = static_cast<int>(i / 3);
        if (isFar(0) || isFar(1) || isFar(2))
            outliers.push_back({pixel % a.width(), pixel / a.width()});
    }
    return outliers;
}

} // namespace hyalite::core
