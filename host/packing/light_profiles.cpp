#include "host/packing/light_profiles.h"

#include "host/scene/limits.h"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

namespace hyalite::core {

namespace {

constexpr std::uint32_t noIndex = 0xFFFFFFFFu;
constexpr float tiniest = 1e-20f; ///< shares below it are 0: nothing that is made of others is subnormal

/// An interval of angles, and the indices of the values at its ends, or noIndex where it is dark.
struct AngleInterval {
    double low; ///< degrees
    double high;
    std::uint32_t first;
    std::uint32_t second;
};

std::vector<AngleInterval> intervalsOf(const std::vector<double> &angles) {
    std::vector<AngleInterval> intervals;
    for (std::uint32_t i = 0; i + 1 < angles.size(); ++i)
        intervals.push_back({angles[i], angles[i + 1], i, i + 1});
    return intervals;
}

/// With those that are dark, before and behind the profile.
std::vector<AngleInterval> gammaIntervals(const LightProfile &profile) {
    std::vector<AngleInterval> intervals;
    const double first = profile.gammas.front();
    const double last = profile.gammas.back();
    if (first > 0.0)
        intervals.push_back({0.0, first, noIndex, noIndex});
    for (const AngleInterval &interval : intervalsOf(profile.gammas))
        intervals.push_back(interval);
    if (last < limits::profileAngle.high)
        intervals.push_back({last, limits::profileAngle.high, noIndex, noIndex});
    return intervals;
}

std::vector<AngleInterval> planeIntervals(const LightProfile &profile) {
    return profile.planes.size() == 1 ? std::vector<AngleInterval>{{0.0, 360.0, 0, 0}}
                                      : intervalsOf(profile.planes);
}

layout::LookupRow rowOf(const AngleInterval &interval) {
    constexpr double all = 4294967296.0; // number of 32-bit values
    const double end = std::floor(interval.high / 360.0 * all);
    return {glm::vec3(static_cast<float>(interval.low / 360.0),
                      static_cast<float>(360.0 / (interval.high - interval.low)), 0.0f),
            static_cast<std::uint32_t>(std::min(end, all - 1.0))};
}

void appendTable(const LightProfile &profile, std::vector<layout::LookupRow> &rows) {
    const std::vector<AngleInterval> gammas = gammaIntervals(profile);
    const std::vector<AngleInterval> planes = planeIntervals(profile);
    rows.push_back({glm::vec3(0.0f), static_cast<std::uint32_t>(gammas.size() | planes.size() << 16u)});
    for (const std::vector<AngleInterval> *intervals : {&gammas, &planes})
        for (const AngleInterval &interval : *intervals)
            rows.push_back(rowOf(interval));
    const auto shareAt = [&](std::uint32_t plane, std::uint32_t gamma) {
        if (gamma == noIndex)
            return 0.0f;
        const float share = profile.shares[plane * profile.gammas.size() + gamma];
        return share < tiniest ? 0.0f : share;
    };
    for (const AngleInterval &plane : planes)
        for (const AngleInterval &gamma : gammas)
            rows.push_back({glm::vec3(shareAt(plane.first, gamma.first), shareAt(plane.first, gamma.second),
                                      shareAt(plane.second, gamma.first)),
                            std::bit_cast<std::uint32_t>(shareAt(plane.second, gamma.second))});
}

} // namespace

void packProfiles(const Scene &scene, PackedScene &packed) {
    if (packed.frame.lightProfiles != 0)
        packed.lookups.resize(packed.frame.lightProfiles);
    packed.frame.lightProfiles = 0;
    const auto count = static_cast<std::size_t>(
        std::ranges::count_if(scene.lights, [](const Light &light) { return light.profile.has_value(); }));
    if (count == 0)
        return;
    packed.frame.lightProfiles = static_cast<std::uint32_t>(packed.lookups.size());
    std::vector<layout::LookupRow> rows(count);
    std::map<std::uint32_t, std::uint32_t> tables; // by the index of the profile
    std::size_t index = 0;
    for (const Light &light : scene.lights) {
        if (!light.profile)
            continue;
        const auto [table, isNew] =
            tables.try_emplace(*light.profile, static_cast<std::uint32_t>(rows.size()));
        if (isNew)
            appendTable(scene.profiles[*light.profile], rows);
        const glm::dvec3 axis = glm::normalize(light.direction);
        const glm::dvec3 c0 = glm::normalize(light.c0);
        rows[index++] = {glm::vec3(glm::normalize(c0 - axis * glm::dot(c0, axis))), table->second};
    }
    packed.lookups.insert(packed.lookups.end(), rows.begin(), rows.end());
}

ProfiledLight profiledLight(const Scene &scene, const Light &light) {
    const LightProfile &profile = scene.profiles[light.profile.value()];
    const double outer = light.kind == LightKind::Spot ? light.angleDegrees : 180.0;
    const glm::dvec3 axis = glm::normalize(light.direction);
    const LitAngles lit = litAnglesOf(profile);
    ProfiledLight result;
    result.meanShare = meanShare(profile, outer);
    const bool isUp = lit.low >= 90.0;
    const double angle = isUp ? 180.0 - lit.low : std::min(lit.high, outer);
    result.axis = glm::vec3(isUp ? -axis : axis);
    result.cosine = static_cast<float>(std::cos(glm::radians(angle)));
    return result;
}

} // namespace hyalite::core
