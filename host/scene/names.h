// The words for settings, as scene files, command lines and reports use them: the one place.
#pragma once

#include "host/scene/camera_path.h"
#include "host/scene/scene.h"
#include "host/scene/settings.h"
#include "host/scene/shapes.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

namespace hyalite::core {

template <class Value> using Name = std::pair<std::string_view, Value>;

/// The words of a table whose rows have a name: the value that each stands for is a member of the row.
template <class Value, class Row, std::size_t count>
[[nodiscard]] constexpr auto namesOf(const std::array<Row, count> &table, Value Row::*value) {
    std::array<Name<Value>, count> names{};
    std::ranges::transform(table, names.begin(), [&](const Row &row) {
        return Name<Value>{row.name, row.*value};
    });
    return names;
}

inline constexpr auto materialNames = namesOf(materialTable, &MaterialRow::kind);
/// Those of pictures: the first rows.
inline constexpr auto integratorNames = [] {
    std::array<Name<Integrator>, pictureIntegratorCount> names{};
    std::ranges::copy_n(namesOf(integratorTable, &IntegratorRow::integrator).begin(), names.size(),
                        names.begin());
    return names;
}();
inline constexpr std::array<Name<CameraKind>, 3> cameraNames{{{"perspective", CameraKind::Perspective},
                                                              {"orthographic", CameraKind::Orthographic},
                                                              {"panorama", CameraKind::Panorama}}};
inline constexpr std::array<Name<KeyInterpolation>, 2> interpolationNames{
    {{"smooth", KeyInterpolation::Smooth}, {"linear", KeyInterpolation::Linear}}};
inline constexpr std::array<Name<LightKind>, 3> lightNames{
    {{"point", LightKind::Point}, {"spot", LightKind::Spot}, {"directional", LightKind::Directional}}};
inline constexpr std::array<Name<SpotFade>, 2> spotFadeNames{
    {{"smooth", SpotFade::Smooth}, {"square", SpotFade::Square}}};
inline constexpr std::array<Name<ShapeKind>, 4> shapeNames{{{"quad", ShapeKind::Quad},
                                                            {"box", ShapeKind::Box},
                                                            {"disk", ShapeKind::Disk},
                                                            {"cylinder", ShapeKind::Cylinder}}};
inline constexpr std::array<Name<TreeKind>, 3> treeNames{
    {{"midpoint", TreeKind::Midpoint}, {"sah", TreeKind::Sah}, {"none", TreeKind::None}}};
inline constexpr std::array<Name<SamplerKind>, 2> samplerNames{
    {{"sobol", SamplerKind::Sobol}, {"centre", SamplerKind::Centre}}};
inline constexpr std::array<Name<FilterKind>, 2> filterNames{
    {{"box", FilterKind::Box}, {"blackman-harris", FilterKind::BlackmanHarris}}};
inline constexpr std::array<Name<LightChoice>, 3> lightChoiceNames{
    {{"auto", LightChoice::Auto}, {"power", LightChoice::Power}, {"tree", LightChoice::Tree}}};

template <class Value, std::size_t count>
[[nodiscard]] constexpr std::string_view nameIn(const std::array<Name<Value>, count> &names, Value wanted) {
    for (const auto &[name, value] : names)
        if (value == wanted)
            return name;
    return {};
}

[[nodiscard]] constexpr std::string_view nameOf(Integrator integrator) { return rowOf(integrator).name; }
[[nodiscard]] constexpr std::string_view nameOf(TreeKind tree) { return nameIn(treeNames, tree); }
[[nodiscard]] constexpr std::string_view nameOf(SamplerKind sampler) { return nameIn(samplerNames, sampler); }
[[nodiscard]] constexpr std::string_view nameOf(FilterKind filter) { return nameIn(filterNames, filter); }
[[nodiscard]] constexpr std::string_view nameOf(LightChoice choice) {
    return nameIn(lightChoiceNames, choice);
}

} // namespace hyalite::core
