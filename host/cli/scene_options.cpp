#include "host/cli/scene_options.h"

#include "host/error.h"
#include "host/scene/framing.h"
#include "host/scene/limits.h"
#include "host/scene/load.h"
#include "host/scene/names.h"
#include "host/scene/validate.h"

#include <fmt/format.h>

#include <chrono>
#include <map>

namespace hyalite {

namespace {

/// For CLI11: from the words of scene files to values.
template <class Value, std::size_t count>
CLI::CheckedTransformer choiceOf(const std::array<Name<Value>, count> &names) {
    std::map<std::string, Value> choices;
    for (const auto &[name, value] : names)
        choices.emplace(name, value);
    return CLI::CheckedTransformer(choices);
}

glm::dvec3 toVector(const std::vector<double> &values) { return {values[0], values[1], values[2]}; }

/// An option of three numbers: `--up 0,1,0`.
void addVectorOption(CLI::App &command, const char *name, std::vector<double> &values, const char *help) {
    command.add_option(name, values, help)->delimiter(',')->expected(3)->type_name("X,Y,Z");
}

/// Ranges of single values are those of scene files: validateScene checks them after the overrides.
void applyOverrides(const SceneOptions &options, LoadedScene &loaded) {
    Scene &scene = loaded.scene;
    RenderSettings &settings = scene.settings;
    settings.samplesPerPixel = options.samplesPerPixel.value_or(settings.samplesPerPixel);
    settings.maxDepth = options.maxDepth.value_or(settings.maxDepth);
    settings.tree = options.tree.value_or(settings.tree);
    settings.leafSize = options.leafSize.value_or(settings.leafSize);
    settings.sampler = options.sampler.value_or(settings.sampler);
    settings.seed = options.seed.value_or(settings.seed);
    settings.exposureStops = options.exposureStops.value_or(settings.exposureStops);

    Camera &camera = scene.camera;
    const int width = options.width.value_or(camera.width);
    const int height = options.height.value_or(camera.height);
    const double fov = options.fovDegrees.value_or(camera.horizontalFovDegrees);
    const bool isValidFrame = limits::imageSize.contains(static_cast<double>(width)) &&
                              limits::imageSize.contains(static_cast<double>(height)) &&
                              limits::horizontalFovDegrees.contains(fov);
    if (loaded.autoFramed && isValidFrame)
        camera = frameCamera(triangleBounds(scene.meshes.front()), width, height, fov);
    camera.width = width;
    camera.height = height;
    camera.horizontalFovDegrees = fov;
    // A camera that is moved keeps its direction; one that is told where to look keeps its position.
    if (!options.cameraPosition.empty())
        camera.position = toVector(options.cameraPosition);
    if (!options.lookAt.empty())
        camera.direction = toVector(options.lookAt) - camera.position;
    if (!options.up.empty())
        camera.up = toVector(options.up);
    if (!options.background.empty())
        scene.background = glm::vec3(toVector(options.background));
}

Crop chooseCrop(const std::vector<int> &wanted, const Camera &camera) {
    if (wanted.empty())
        return {0, camera.width, 0, camera.height};
    const Crop crop{wanted[0], wanted[1], wanted[2], wanted[3]};
    const bool isInside = 0 <= crop.x0 && crop.x0 < crop.x1 && crop.x1 <= camera.width && 0 <= crop.y0 &&
                          crop.y0 < crop.y1 && crop.y1 <= camera.height;
    if (!isInside)
        throw Error(
            ExitCode::Usage,
            fmt::format("--crop {},{},{},{} is empty or leaves the image of {}x{} pixels: give x0,x1,y0,y1 "
                        "with 0 <= x0 < x1 <= {} and 0 <= y0 < y1 <= {}",
                        crop.x0, crop.x1, crop.y0, crop.y1, camera.width, camera.height, camera.width,
                        camera.height));
    return crop;
}

double secondsBetween(std::chrono::steady_clock::time_point a, std::chrono::steady_clock::time_point b) {
    return std::chrono::duration<double>(b - a).count();
}

} // namespace

void addSceneOptions(CLI::App &command, SceneOptions &options) {
    command.add_option("scene", options.scene, "a .json scene, a .obj mesh, or the name of a shipped scene")
        ->required()
        ->type_name("SCENE");
    const char *image = "Image";
    command.add_option("--width", options.width, "pixels")->group(image);
    command.add_option("--height", options.height, "pixels")->group(image);
    command
        .add_option("--crop", options.crop, "render only these pixels, half open; the output has that size")
        ->delimiter(',')
        ->expected(4)
        ->type_name("X0,X1,Y0,Y1")
        ->group(image);
    command.add_option("--spp", options.samplesPerPixel, "samples per pixel")->group(image);
    command
        .add_option("--sampler", options.sampler,
                    "centre: all samples at the pixel's centre; sobol: antialiased")
        ->transform(choiceOf(samplerNames))
        ->type_name("centre|sobol")
        ->group(image);
    command.add_option("--seed", options.seed, "of the sample pattern")->group(image);
    command.add_option("--exposure", options.exposureStops, "stops: brighten a PNG by 2^EXPOSURE")
        ->group(image);

    const char *view = "Camera and light";
    addVectorOption(command, "--camera-position", options.cameraPosition, "world space");
    addVectorOption(command, "--look-at", options.lookAt, "the point to look at, world space");
    addVectorOption(command, "--up", options.up, "the direction that is up in the image");
    command.add_option("--fov", options.fovDegrees, "horizontal field of view in degrees")->group(view);
    command
        .add_option("--background", options.background, "radiance of rays that leave the scene, linear RGB")
        ->delimiter(',')
        ->expected(3)
        ->type_name("R,G,B");
    for (const char *name : {"--camera-position", "--look-at", "--up", "--background"})
        command.get_option(name)->group(view);

    const char *tracing = "Tracing";
    command.add_option("--max-depth", options.maxDepth, "segments of a path, the primary ray included")
        ->group(tracing);
    command.add_option("--bvh", options.tree, "how the tree is built; none: every ray tests every triangle")
        ->transform(choiceOf(treeNames))
        ->type_name("midpoint|sah|none")
        ->group(tracing);
    command.add_option("--leaf-size", options.leafSize, "most triangles in a leaf")->group(tracing);
}

PreparedScene prepareScene(const SceneOptions &options) {
    using Clock = std::chrono::steady_clock;
    PreparedScene prepared;
    const Clock::time_point start = Clock::now();
    prepared.loaded = loadScene(options.scene);
    applyOverrides(options, prepared.loaded);
    const Scene &scene = prepared.loaded.scene;
    validateScene(scene, "the command line");
    prepared.crop = chooseCrop(options.crop, scene.camera);
    const Clock::time_point loaded = Clock::now();
    prepared.bvh = buildBvh(scene.settings.tree, buildTriangles(scene), scene.settings.leafSize);
    prepared.packed = packScene(scene, prepared.bvh);
    prepared.loadSeconds = secondsBetween(start, loaded);
    prepared.buildSeconds = secondsBetween(loaded, Clock::now());
    return prepared;
}

} // namespace hyalite
