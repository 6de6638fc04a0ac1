#include "host/engine/scene_options.h"

#include "host/scene/limits.h"
#include "host/scene/settings_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <concepts>
#include <limits>
#include <optional>
#include <utility>

namespace hyalite::core {

std::string textOf(const OptionValue &value) {
    if (const bool *flag = std::get_if<bool>(&value))
        return *flag ? "true" : "false";
    if (const double *number = std::get_if<double>(&value))
        return fmt::format("{}", *number);
    if (const auto *numbers = std::get_if<std::vector<double>>(&value))
        return fmt::format("{}", fmt::join(*numbers, ","));
    return std::get<std::string>(value);
}

namespace {

/// The allowed range of a crop depends on the image.
constexpr Interval anyInteger{std::numeric_limits<int>::min(), std::numeric_limits<int>::max()};

/// The member of the options, or of how they load, that a row sets.
template <auto member> auto &of(SceneOptions &options) { return options.*member; }
template <auto member> auto &ofLoad(SceneOptions &options) { return options.load.*member; }

using Whole = NumberOption<int>;
using Number = NumberOption<double>;
using Point = NumbersOption<double>;

constexpr auto table = std::to_array<SceneOption>({
    {"width", imageGroup, "N", Whole{of<&SceneOptions::width>, limits::imageSize}, "pixels"},
    {"height", imageGroup, "N", Whole{of<&SceneOptions::height>, limits::imageSize}, "pixels"},
    {"scale", imageGroup, "PERCENT%", PercentOption{of<&SceneOptions::sizeShare>},
     "a preview: makes width and height, of the scene or of these options, smaller, each at least one pixel. "
     "A crop still counts the pixels of the whole size"},
    {"crop", imageGroup, "X0,X1,Y0,Y1", NumbersOption<int>{of<&SceneOptions::crop>, anyInteger, 4},
     "render only pixels X0 <= x < X1, Y0 <= y < Y1; the output has that size"},
    {"camera-position", viewGroup, "X,Y,Z", Point{of<&SceneOptions::cameraPosition>, limits::coordinate, 3},
     "world space"},
    {"look-at", viewGroup, "X,Y,Z", Point{of<&SceneOptions::lookAt>, limits::coordinate, 3},
     "the point to look at, world space"},
    {"up", viewGroup, "X,Y,Z", Point{of<&SceneOptions::up>, limits::coordinate, 3, true},
     "the direction that is up in the image: three numbers, or x, y, z, -x, -y or -z; a bare mesh is "
     "framed and lit as standing so"},
    {"fov", viewGroup, "NUMBER", Number{of<&SceneOptions::fovDegrees>, limits::horizontalFovDegrees},
     "horizontal field of view in degrees"},
    {"aperture", viewGroup, "NUMBER", Number{of<&SceneOptions::aperture>, limits::aperture},
     "diameter of the lens, in the scene's units: what is out of focus blurs; 0: a pinhole"},
    {"focus-distance", viewGroup, "NUMBER", Number{of<&SceneOptions::focusDistance>, limits::focusDistance},
     "how far away it is sharp, along the view direction"},
    {"view-width", viewGroup, "NUMBER", Number{of<&SceneOptions::viewWidth>, limits::viewWidth},
     "what the image's width shows by an orthographic camera, in the scene's units"},
    {"background", viewGroup, "R,G,B", Point{of<&SceneOptions::background>, limits::radiance, 3},
     "radiance of rays that leave the scene, linear RGB, instead of the scene's environment"},
    {"environment", viewGroup, "FILE", TextOption{of<&SceneOptions::environment>, "the name of a file", true},
     "light from all around, instead of the scene's: .hdr, .exr, .pfm, .png or .jpg, by longitude and "
     "latitude; or neutral, the studio that lights glTF files without lights"},
    {"environment-scale", viewGroup, "NUMBER",
     Number{of<&SceneOptions::environmentScale>, limits::environmentScale}, "factor on the environment"},
    {"environment-rotate", viewGroup, "NUMBER",
     Number{of<&SceneOptions::environmentRotateDegrees>, limits::rotateDegrees},
     "degrees by which it is turned about +y"},
    {"camera", viewGroup, "NAME", TextOption{ofLoad<&LoadOptions::camera>, "a name"},
     "glTF: the camera of this name or index"},
    {"gltf-scene", viewGroup, "NAME", TextOption{ofLoad<&LoadOptions::gltfScene>, "a name"},
     "glTF: the scene of this name or index"},
    {"time", viewGroup, "NUMBER", Number{ofLoad<&LoadOptions::timeSeconds>, limits::timeSeconds},
     "glTF: seconds into its animations; without it, the pose of rest"},
    {"flatten", tracingGroup, "", FlagOption{of<&SceneOptions::isFlattened>},
     "make every instance a mesh of its own, not only those for which there is memory: the same picture"},
    {"keep-instances", tracingGroup, "", FlagOption{of<&SceneOptions::keepsInstances>},
     "keep each mesh once, however many places it has: the same picture, slower, with less memory"},
});

struct Axis {
    std::string_view word;
    std::array<double, 3> direction;
};
constexpr std::array<Axis, 6> axes{{{"x", {1, 0, 0}},
                                    {"y", {0, 1, 0}},
                                    {"z", {0, 0, 1}},
                                    {"-x", {-1, 0, 0}},
                                    {"-y", {0, -1, 0}},
                                    {"-z", {0, 0, -1}}}};

[[noreturn]] void refuse(std::string_view name, const OptionValue &found, std::string_view allowed) {
    throw OverrideError(std::string(name), refusalText(textOf(found), allowed));
}

/// The number, if the value is one that is allowed.
template <class Number>
Number numberOf(std::string_view name, const OptionValue &whole, double value, const Interval &allowed) {
    if (!allowed.contains(value) || (std::integral<Number> && value != std::floor(value)))
        refuse(name, whole, (std::integral<Number> ? "a whole number " : "a number ") + allowed.text());
    return static_cast<Number>(value);
}

template <class Number>
Number numberOf(std::string_view name, const OptionValue &value, const Interval &allowed) {
    const double *number = std::get_if<double>(&value);
    return numberOf<Number>(name, value, number != nullptr ? *number : std::nan(""), allowed);
}

bool flagOf(std::string_view name, const OptionValue &value) {
    const bool *flag = std::get_if<bool>(&value);
    if (flag == nullptr)
        refuse(name, value, "true or false");
    return *flag;
}

/// The number before the sign, if the value is a percentage.
std::optional<double> percentOf(const OptionValue &value) {
    const auto *text = std::get_if<std::string>(&value);
    if (text == nullptr || !text->ends_with('%'))
        return std::nullopt;
    const char *end = text->data() + text->size() - 1;
    double percent = 0.0;
    return std::from_chars(text->data(), end, percent).ptr == end ? std::optional(percent) : std::nullopt;
}

/// Sets one option, by the kind of its row.
struct Setter {
    SceneOptions &options;
    std::string_view name;
    const OptionValue &value;

    template <class Number> void operator()(const NumberOption<Number> &row) const {
        row.member(options) = numberOf<Number>(name, value, row.allowed);
    }
    template <class Number> void operator()(const NumbersOption<Number> &row) const {
        std::vector<double> given;
        if (const auto *numbers = std::get_if<std::vector<double>>(&value))
            given = *numbers;
        else if (const auto *word = std::get_if<std::string>(&value); word != nullptr && row.isAxis)
            given = axisOf(*word);
        if (given.size() != row.count)
            refuse(name, value,
                   fmt::format("{} numbers{}", row.count, row.isAxis ? ", or x, y, z, -x, -y or -z" : ""));
        std::vector<Number> &member = row.member(options);
        member.clear();
        for (const double number : given)
            member.push_back(numberOf<Number>(name, value, number, row.allowed));
    }
    void operator()(const TextOption &row) const {
        const auto *text = std::get_if<std::string>(&value);
        if (text == nullptr || text->empty())
            refuse(name, value, row.allowed);
        row.member(options) = *text;
    }
    void operator()(const PercentOption &row) const {
        const std::optional<double> percent = percentOf(value);
        if (!percent || !PercentOption::allowed.contains(*percent))
            refuse(name, value, "a percentage, as 25%");
        row.member(options) = *percent / 100.0;
    }
    void operator()(const FlagOption &row) const { row.member(options) = flagOf(name, value); }
};

/// The change that a setting's value is.
struct SettingReader {
    const Setting &setting;
    const OptionValue &value;

    template <class Number> SettingChange operator()(const NumberSetting<Number> &row) const {
        return changeTo(numberOf<Number>(setting.option, value, row.allowed), row.member, setting);
    }
    /// A percentage, or the share itself.
    SettingChange operator()(const ShareSetting &row) const {
        const std::optional<double> percent = percentOf(value);
        return changeTo(
            numberOf<double>(setting.option, percent ? OptionValue(*percent / 100.0) : value, row.allowed),
            row.member, setting);
    }
    SettingChange operator()(const FlagSetting &row) const {
        return changeTo(flagOf(setting.option, value), row.member, setting);
    }
    template <class Value> SettingChange operator()(const ChoiceSetting<Value> &row) const {
        return changeTo(chosenFrom(row.names, textOf(value), setting.option), row.member, setting);
    }
};

} // namespace

std::span<const SceneOption> sceneOptions() { return table; }

std::vector<double> axisOf(std::string_view word) {
    const auto axis = std::ranges::find(axes, word, &Axis::word);
    return axis != axes.end() ? std::vector<double>(axis->direction.begin(), axis->direction.end())
                              : std::vector<double>();
}

void setSceneOption(SceneOptions &options, std::string_view name, const OptionValue &value) {
    if (const auto row = std::ranges::find(table, name, &SceneOption::name); row != table.end()) {
        std::visit(Setter{options, name, value}, row->value);
        return;
    }
    const auto setting = std::ranges::find(settingsTable, name, &Setting::option);
    if (setting == settingsTable.end()) {
        const std::vector<std::string_view> names = sceneOptionNames();
        throw OverrideError(std::string(name), fmt::format("is no setting{}", suggestion(name, names)));
    }
    options.settings.push_back(std::visit(SettingReader{*setting, value}, setting->value));
}

bool namesFile(std::string_view name) {
    const auto row = std::ranges::find(table, name, &SceneOption::name);
    const auto *text = row != table.end() ? std::get_if<TextOption>(&row->value) : nullptr;
    return text != nullptr && text->isFile;
}

std::vector<std::string_view> sceneOptionNames() {
    std::vector<std::string_view> names;
    names.reserve(table.size() + settingsTable.size());
    for (const SceneOption &option : table)
        names.push_back(option.name);
    for (const Setting &setting : settingsTable)
        names.push_back(setting.option);
    return names;
}

} // namespace hyalite::core
