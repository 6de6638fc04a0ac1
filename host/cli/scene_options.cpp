#include "host/cli/scene_options.h"

#include "host/cli/options.h"
#include "host/scene/limits.h"
#include "host/scene/settings_table.h"

#include <algorithm>
#include <array>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace hyalite::core {

namespace {

/// The allowed range of a crop depends on the image.
constexpr Interval anyInteger{std::numeric_limits<int>::min(), std::numeric_limits<int>::max()};

std::string optionOf(const Setting &setting) { return fmt::format("--{}", setting.option); }

template <class Number>
CLI::Option *addSetting(CLI::App &command, const Setting &setting, const NumberSetting<Number> &number,
                        SettingChanges &changes) {
    const auto take = [&changes, &setting, member = number.member](Number given) {
        changes.push_back(
            {[member, given](RenderSettings &settings) { settings.*member = given; }, &setting});
    };
    return addNumberFor<Number>(command, optionOf(setting), take, number.allowed, helpText(setting));
}

template <class Value>
CLI::Option *addSetting(CLI::App &command, const Setting &setting, const ChoiceSetting<Value> &choice,
                        SettingChanges &changes) {
    const auto take = [&changes, &setting, member = choice.member](Value given) {
        changes.push_back(
            {[member, given](RenderSettings &settings) { settings.*member = given; }, &setting});
    };
    return addChoiceFor<Value>(command, optionOf(setting), take, choice.names, helpText(setting));
}

/// The options of one group.
void addSettings(CLI::App &command, std::string_view group, SettingChanges &changes) {
    for (const Setting &setting : settingsTable)
        if (setting.group == group)
            std::visit([&](const auto &value) { return addSetting(command, setting, value, changes); },
                       setting.value)
                ->group(std::string(group));
}

/// --up: three numbers, or the word of an axis.
CLI::Option *addUp(CLI::App &command, std::vector<double> &up) {
    static constexpr std::array<std::pair<std::string_view, std::array<double, 3>>, 6> axes{
        {{"x", {1, 0, 0}},
         {"y", {0, 1, 0}},
         {"z", {0, 0, 1}},
         {"-x", {-1, 0, 0}},
         {"-y", {0, -1, 0}},
         {"-z", {0, 0, -1}}}};
    const auto read = [&up](const CLI::results_t &words) {
        const auto axis = std::ranges::find(axes, words.front(), [](const auto &row) { return row.first; });
        if (words.size() == 1 && axis != axes.end()) {
            up.assign(axis->second.begin(), axis->second.end());
            return true;
        }
        if (words.size() == 6)
            throw Error(ErrorKind::Usage, "--up is given twice");
        if (words.size() != 3)
            refuseValue("--up", fmt::format("{}", fmt::join(words, ",")),
                        "three numbers, or x, y, z, -x, -y or -z");
        for (const std::string &word : words)
            up.push_back(readNumber("--up", word, limits::coordinate));
        return true;
    };
    return command
        .add_option(
            "--up", CLI::callback_t(read),
            "the direction that is up in the image: three numbers, or x, y, z, -x, -y or -z; a bare mesh is "
            "framed and lit as standing so")
        ->delimiter(',')
        ->allow_extra_args(false)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
        ->type_name("X,Y,Z");
}

} // namespace

void addSceneOptions(CLI::App &command, SceneOptions &options) {
    command
        .add_option("scene", options.scene,
                    "a .json, .gltf or .glb scene, a .obj, .ply or .stl mesh, "
                    "the name of a shipped scene, or - for standard input")
        ->required()
        ->type_name("SCENE");
    addPaths(command, "--allow-path", options.load.allowedPaths,
             "also let a scene file read this file, or files in this folder; repeatable");
    const std::string image(imageGroup);
    addNumber(command, "--width", options.width, limits::imageSize, "pixels")->group(image);
    addNumber(command, "--height", options.height, limits::imageSize, "pixels")->group(image);
    addNumbers(command, "--crop", options.crop, anyInteger, "X0,X1,Y0,Y1",
               "render only pixels X0 <= x < X1, Y0 <= y < Y1; the output has that size")
        ->group(image);
    addSettings(command, imageGroup, options.settings);

    const char *view = "Camera and light";
    const char *point = "X,Y,Z";
    addNumbers(command, "--camera-position", options.cameraPosition, limits::coordinate, point, "world space")
        ->group(view);
    addNumbers(command, "--look-at", options.lookAt, limits::coordinate, point,
               "the point to look at, world space")
        ->group(view);
    addUp(command, options.up)->group(view);
    addNumber(command, "--fov", options.fovDegrees, limits::horizontalFovDegrees,
              "horizontal field of view in degrees")
        ->group(view);
    addNumbers(command, "--background", options.background, limits::radiance, "R,G,B",
               "radiance of rays that leave the scene, linear RGB, instead of the scene's environment")
        ->group(view);

    addFile(command, "--environment", options.environment, "FILE",
            "light from all around, instead of the scene's: .hdr, .exr, .pfm, .png or .jpg, by longitude and "
            "latitude; or neutral, the studio that lights glTF files without lights")
        ->group(view);
    addNumber(command, "--environment-scale", options.environmentScale, limits::environmentScale,
              "factor on the environment")
        ->group(view);
    addNumber(command, "--environment-rotate", options.environmentRotateDegrees, limits::rotateDegrees,
              "degrees by which it is turned about +y")
        ->group(view);
    addText(command, "--camera", options.load.camera, "NAME", "glTF: the camera of this name or index")
        ->group(view);
    addText(command, "--gltf-scene", options.load.gltfScene, "NAME", "glTF: the scene of this name or index")
        ->group(view);
    addNumber(command, "--time", options.load.timeSeconds, limits::timeSeconds,
              "glTF: seconds into its animations; without it, the pose of rest")
        ->group(view);

    addSettings(command, tracingGroup, options.settings);
    command
        .add_flag("--flatten", options.isFlattened,
                  "make every instance a mesh of its own: the same picture, with more memory")
        ->group(std::string(tracingGroup));
}

} // namespace hyalite::core
