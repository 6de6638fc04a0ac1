// Render settings, one row each. To add a setting: its member in RenderSettings (settings.h), its row here, and its
// use.
//
// Made from the rows: the reader of "settings" in scene files, command-line options, validation, the JSON of reports,
// the identity of checkpoints, and, by tests/scene/settings_table_test.cpp, the schema and the tables of documents.
#pragma once

#include "host/base/interval.h"
#include "host/scene/names.h"
#include "host/scene/settings.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

namespace hyalite::core {

/// A number in a range; `Number` decides whether it is a whole one.
template <class Number> struct NumberSetting {
    Number RenderSettings::*member;
    Interval allowed;
};

/// A share, which the command line has in percent: 2%.
struct ShareSetting : NumberSetting<double> {};

/// Yes or no.
struct FlagSetting {
    bool RenderSettings::*member;
};

/// One of a few words.
template <class Value> struct ChoiceSetting {
    Value RenderSettings::*member;
    std::span<const Name<Value>> names;
};

using SettingValue =
    std::variant<NumberSetting<int>, NumberSetting<double>, NumberSetting<std::uint32_t>, ShareSetting,
                 FlagSetting, ChoiceSetting<Integrator>, ChoiceSetting<TreeKind>, ChoiceSetting<SamplerKind>,
                 ChoiceSetting<FilterKind>, ChoiceSetting<LightChoice>>;

/// The effect of a setting. A checkpoint resumes only with the same samples; their count, the tree and the exposure may
/// differ.
enum class Changes {
    Samples,     ///< the bits of a sample
    SampleCount, ///< the number of samples
    Picture,     ///< how a PNG shows the film
    Time         ///< only the time of the render
};

struct Setting {
    std::string_view key;    ///< in scene files, reports and messages
    std::string_view option; ///< its word on the command line, without dashes
    SettingValue value;      ///< its default is that of the member
    Changes changes;
    std::string_view group; ///< of options, in help texts
    std::string_view help;
    std::span<const Integrator> integrators{}; ///< those that use it; empty: all
};

inline constexpr std::string_view imageGroup = "Image";
inline constexpr std::string_view tracingGroup = "Tracing";

inline constexpr std::array ambientOcclusionOnly{Integrator::AmbientOcclusion};
inline constexpr std::array pathOnly{Integrator::Path};
inline constexpr auto ofLight = integratorsThat<&IntegratorRow::showsLight>();
inline constexpr auto thatLookThrough = integratorsThat<&IntegratorRow::canLookThrough>();
inline constexpr auto severalBounces = integratorsThat<&IntegratorRow::followsPaths>();

/// In the order of reports and documents.
inline constexpr auto settingsTable = std::to_array<Setting>({
    {"integrator", "integrator", ChoiceSetting<Integrator>{&RenderSettings::integrator, integratorNames},
     Changes::Samples, tracingGroup, "what a sample estimates"},
    {"spp", "spp", NumberSetting<int>{&RenderSettings::samplesPerPixel, {1, 65536}}, Changes::SampleCount,
     imageGroup, "samples per pixel; with noise: at most, and by default 4096"},
    {"noise", "noise", ShareSetting{{&RenderSettings::noise, {0.0, 1.0}}}, Changes::SampleCount, imageGroup,
     "samples are added where they are needed until the estimated error of the picture is below it, in each "
     "block of 32x32 pixels, in proportion to its light; 2%: hardly visible, 10%: grainy; 0%: the same "
     "number "
     "of samples in each pixel",
     ofLight},
    {"maxDepth", "max-depth", NumberSetting<int>{&RenderSettings::maxDepth, {1, layout::maxPathDepth}},
     Changes::Samples, tracingGroup,
     "maximum number of path segments, the primary ray included; with whitted, glass splits paths in two, so "
     "each level may double the work",
     severalBounces},
    {"occlusionDistance", "ao-distance",
     NumberSetting<double>{&RenderSettings::occlusionDistance, {0.0, 1e15, false}}, Changes::Samples,
     tracingGroup, "occluders further away than this are ignored; by default none is", ambientOcclusionOnly},
    {"bvh", "bvh", ChoiceSetting<TreeKind>{&RenderSettings::tree, treeNames}, Changes::Time, tracingGroup,
     "how the tree over the triangles is built; none: every ray tests every triangle"},
    {"leafSize", "leaf-size", NumberSetting<int>{&RenderSettings::leafSize, {1, 64}}, Changes::Time,
     tracingGroup, "maximum number of triangles in a leaf of the tree, where they can be separated"},
    {"sampler", "sampler", ChoiceSetting<SamplerKind>{&RenderSettings::sampler, samplerNames},
     Changes::Samples, imageGroup,
     "centre: all samples at the pixel centre; sobol: spread evenly over the pixel, which smooths edges"},
    {"filter", "filter", ChoiceSetting<FilterKind>{&RenderSettings::filter, filterNames}, Changes::Samples,
     imageGroup,
     "reconstruction filter, with the sampler sobol. box: all samples of the pixel count the same; "
     "blackman-harris: weights fall off smoothly to 1.5 pixels from the centre, with less aliasing and "
     "moire"},
    {"seed", "seed", NumberSetting<std::uint32_t>{&RenderSettings::seed, {0, 4294967295.0}}, Changes::Samples,
     imageGroup, "seed of the random numbers: another seed gives other noise"},
    {"clamp", "clamp", NumberSetting<double>{&RenderSettings::radianceLimit, {0.0, 1e30}}, Changes::Samples,
     tracingGroup,
     "upper limit, per channel, on each contribution of indirect light: less noise, but a darker image; 0: "
     "no limit",
     pathOnly},
    {"lightChoice", "light-choice",
     ChoiceSetting<LightChoice>{&RenderSettings::lightChoice, lightChoiceNames}, Changes::Samples,
     tracingGroup,
     "how a shadow ray chooses its light. power: the brighter, the more often; tree: by power, distance and "
     "direction; "
     "auto: tree if there are more than 64 lights and emitting primitives, far apart",
     pathOnly},
    {"alpha", "alpha", FlagSetting{&RenderSettings::hasAlpha}, Changes::Samples, imageGroup,
     "the background and the environment are transparent, and still light the scene; shadow catchers are "
     "transparent but "
     "for their shadows",
     ofLight},
    {"alphaThroughGlass", "alpha-through-glass", FlagSetting{&RenderSettings::isClearGlassTransparent},
     Changes::Samples, imageGroup,
     "with alpha: the background is transparent through glass, too, of a roughness up to 0.1; otherwise "
     "glass shows it",
     ofLight},
    {"layersThrough", "layers-through", FlagSetting{&RenderSettings::areLayersThrough}, Changes::Samples,
     imageGroup,
     "layers and pictures of normals, depths and albedos look through mirrors, and through metal and glass "
     "of a roughness up to 0.1, as denoisers want them: means over the image's samples of what paths up to "
     "maxDepth meet first beyond",
     thatLookThrough},
    {"lightLayers", "light-layers", FlagSetting{&RenderSettings::hasLightLayers}, Changes::Samples,
     imageGroup,
     "layers of an EXR that add up to the picture: emission and background as they are seen, and diffuse, "
     "glossy and transmitted light, each direct and indirect",
     pathOnly},
    {"lightGroups", "light-groups", FlagSetting{&RenderSettings::hasLightGroups}, Changes::Samples,
     imageGroup,
     "layers of an EXR that add up to the picture: the light of each group that lights, materials and the "
     "environment name by `lightGroup`",
     pathOnly},
    {"denoise", "denoise", FlagSetting{&RenderSettings::isDenoised}, Changes::Picture, imageGroup,
     "the picture without most of its noise, as means of pixels that are alike in light, albedo, normal and "
     "depth; an EXR has the noisy colours and all data that this needs, too",
     ofLight},
    {"denoisingData", "denoising-data", FlagSetting{&RenderSettings::hasDenoisingData}, Changes::Picture,
     imageGroup,
     "all data that a denoiser needs as layers of an EXR, and no other picture: it can be denoised later",
     ofLight},
    {"exposure", "exposure", NumberSetting<double>{&RenderSettings::exposureStops, {-100.0, 100.0}},
     Changes::Picture, imageGroup,
     "in stops: radiance is multiplied by 2^NUMBER before the tone curve of a PNG"},
});

/// The range of a member that is a number.
template <class Number> [[nodiscard]] constexpr Interval rangeOf(Number RenderSettings::*member) {
    for (const Setting &setting : settingsTable)
        if (const auto *number = std::get_if<NumberSetting<Number>>(&setting.value))
            if (number->member == member)
                return number->allowed;
    if constexpr (std::is_same_v<Number, double>)
        for (const Setting &setting : settingsTable)
            if (const auto *share = std::get_if<ShareSetting>(&setting.value))
                if (share->member == member)
                    return share->allowed;
    throw "no such setting"; // a compile-time error, as this is a constant expression
}

/// The help text, with the integrators that use the setting.
[[nodiscard]] std::string helpText(const Setting &setting);

/// By keys, in the order of the table.
[[nodiscard]] nlohmann::ordered_json settingsToJson(const RenderSettings &settings);
/// The settings of what settingsToJson() gives. Throws for other JSON; values are not checked.
[[nodiscard]] RenderSettings settingsFromJson(const nlohmann::json &json);
[[nodiscard]] nlohmann::ordered_json settingToJson(const Setting &setting, const RenderSettings &settings);

/// A change to the settings of the scene file.
struct SettingChange {
    std::function<void(RenderSettings &)> apply;
    /// That of the command line, which must have an effect; null: there is none.
    const Setting *option = nullptr;
};
using SettingChanges = std::vector<SettingChange>;

} // namespace hyalite::core
