#include "host/cli/scene_options.h"

#include "host/cli/options.h"
#include "host/scene/limits.h"
#include "host/scene/names.h"

#include <limits>

namespace hyalite {

namespace {

/// What a crop allows depends on the image.
constexpr Interval anyInteger{std::numeric_limits<int>::min(), std::numeric_limits<int>::max()};

} // namespace

void addSceneOptions(CLI::App &command, SceneOptions &options) {
    command.add_option("scene", options.scene, "a .json scene, a .obj mesh, or the name of a shipped scene")
        ->required()
        ->type_name("SCENE");
    addFolders(
        command, "--allow-path", options.allowedPaths,
        "a scene file may name files in this folder, too, not only in its own and in the assets; repeatable");
    const char *image = "Image";
    addNumber(command, "--width", options.width, limits::imageSize, "pixels")->group(image);
    addNumber(command, "--height", options.height, limits::imageSize, "pixels")->group(image);
    addNumbers(command, "--crop", options.crop, anyInteger, "X0,X1,Y0,Y1",
               "render only these pixels, half open; the output has that size")
        ->group(image);
    addNumber(command, "--spp", options.samplesPerPixel, limits::samplesPerPixel, "samples per pixel")
        ->group(image);
    addChoice(command, "--sampler", options.sampler, samplerNames,
              "centre: all samples at the pixel's centre; sobol: antialiased")
        ->group(image);
    addChoice(
        command, "--filter", options.filter, filterNames,
        "of pixels, for sobol. box: what lies in the pixel; blackman-harris: smooth, out to 1.5 pixels from "
        "its centre, which shows fewer steps and less moire")
        ->group(image);
    addNumber(command, "--seed", options.seed, limits::seed, "of the sample pattern")->group(image);
    addNumber(command, "--exposure", options.exposureStops, limits::exposureStops,
              "stops: brighten a PNG by 2^NUMBER")
        ->group(image);

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

    const char *tracing = "Tracing";
    addChoice(
        command, "--integrator", options.integrator, integratorNames,
        "whitted: direct light, mirrors and both branches at glass; path: light on all its ways; ao: "
        "ambient occlusion; normal, depth, albedo, id, uv: views of what is seen first; cost: how many boxes "
        "and triangles the rays of whitted test, as a PNG in false colours, or as a PFM of nodes, boxes "
        "and triangles")
        ->group(tracing);
    addNumber(command, "--ao-distance", options.occlusionDistance, limits::occlusionDistance,
              "for ao: what is further away hides no sky; default: everything hides it")
        ->group(tracing);
    addNumber(
        command, "--max-depth", options.maxDepth, limits::maxDepth,
        "segments of a path, the primary ray included; glass splits paths in two, so that each level may "
        "double the work")
        ->group(tracing);
    addNumber(command, "--clamp", options.radianceLimit, limits::radianceLimit,
              "for path: most that a path may add, a channel, behind its first segment: less noise, and less "
              "light; 0: no limit")
        ->group(tracing);
    addChoice(command, "--bvh", options.tree, treeNames,
              "how the tree is built; none: every ray tests every triangle")
        ->group(tracing);
    addNumber(command, "--leaf-size", options.leafSize, limits::leafSize, "most triangles in a leaf")
        ->group(tracing);
}

} // namespace hyalite
