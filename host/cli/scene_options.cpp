#include "host/cli/scene_options.h"

#include "host/cli/options.h"
#include "host/scene/limits.h"
#include "host/scene/settings_table.h"

#include <limits>
#include <string>
#include <string_view>
#include <variant>

namespace hyalite {

namespace {

/// The allowed range of a crop depends on the image.
constexpr Interval anyInteger{std::numeric_limits<int>::min(), std::numeric_limits<int>::max()};

template <class Number>
CLI::Option *addSetting(CLI::App &command, const Setting &setting, const NumberSetting<Number> &number,
                        SettingChanges &changes) {
    const auto take = [&changes, member = number.member](Number given) {
        changes.emplace_back([member, given](RenderSettings &settings) { settings.*member = given; });
    };
    return addNumberFor<Number>(command, std::string(setting.option), take, number.allowed,
                                helpText(setting));
}

template <class Value>
CLI::Option *addSetting(CLI::App &command, const Setting &setting, const ChoiceSetting<Value> &choice,
                        SettingChanges &changes) {
    const auto take = [&changes, member = choice.member](Value given) {
        changes.emplace_back([member, given](RenderSettings &settings) { settings.*member = given; });
    };
    return addChoiceFor<Value>(command, std::string(setting.option), take, choice.names, helpText(setting));
}

/// The options of one group.
void addSettings(CLI::App &command, std::string_view group, SettingChanges &changes) {
    for (const Setting &setting : settingsTable)
        if (setting.group == group)
            std::visit([&](const auto &value) { return addSetting(command, setting, value, changes); },
                       setting.value)
                ->group(std::string(group));
}

} // namespace

void addSceneOptions(CLI::App &command, SceneOptions &options) {
    command
        .add_option("scene", options.scene,
                    "a .json, .gltf or .glb scene, a .obj mesh, or the name of a shipped scene")
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
    addNumbers(command, "--up", options.up, limits::coordinate, point,
               "the direction that is up in the image")
        ->group(view);
    addNumber(command, "--fov", options.fovDegrees, limits::horizontalFovDegrees,
              "horizontal field of view in degrees")
        ->group(view);
    addNumbers(command, "--background", options.background, limits::radiance, "R,G,B",
               "radiance of rays that leave the scene, linear RGB")
        ->group(view);

    addFile(
        command, "--environment", options.environment, "FILE",
        "light from all around, in place of the scene's: .hdr, .exr, .pfm, .png or .jpg, by longitude and "
        "latitude")
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

} // namespace hyalite
