#include "host/engine/prepare.h"

#include "host/base/error.h"
#include "host/bvh/bvh.h"
#include "host/bvh/tree_statistics.h"
#include "host/import/environment_file.h"
#include "host/import/load.h"
#include "host/import/neutral_environment.h"
#include "host/scene/contacts.h"
#include "host/scene/framing.h"
#include "host/scene/geometry_hash.h"
#include "host/scene/light_sources.h"
#include "host/scene/limits.h"
#include "host/scene/names.h"
#include "host/scene/validate.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <optional>
#include <string_view>
#include <utility>

namespace hyalite::core {

namespace {

glm::dvec3 toVector(const std::vector<double> &values) { return {values[0], values[1], values[2]}; }

/// The point to look at: that of the options or, if the camera of a bare mesh is moved, the centre of the mesh, because
/// no scene file gives a direction.
std::optional<glm::dvec3> chooseTarget(const SceneOptions &options, const LoadedScene &loaded,
                                       const std::optional<Bounds> &framed) {
    if (!options.lookAt.empty())
        return toVector(options.lookAt) - loaded.scene.origin;
    if (framed && !options.cameraPosition.empty())
        return framed->centre();
    return std::nullopt;
}

/// Up of a mesh without a camera: that of the options, of unit length, or +y.
glm::dvec3 chooseUp(const SceneOptions &options) {
    const glm::dvec3 up = options.up.empty() ? glm::dvec3(0.0) : toVector(options.up);
    const double length = glm::length(up);
    return limits::directionLength.contains(length) ? up / length : glm::dvec3(0.0, 1.0, 0.0);
}

/// Moves the camera. A new position keeps the direction; a new target keeps the position.
void moveCamera(const SceneOptions &options, const LoadedScene &loaded, const std::optional<Bounds> &framed,
                Camera &camera) {
    if (!options.cameraPosition.empty())
        camera.position = toVector(options.cameraPosition) - loaded.scene.origin;
    if (!options.up.empty())
        camera.up = toVector(options.up);
    if (!limits::directionLength.contains(glm::length(camera.up)))
        throw OverrideError("up", "found a vector without length; allowed: any other vector");
    if (const std::optional<glm::dvec3> target = chooseTarget(options, loaded, framed)) {
        camera.direction = *target - camera.position;
        if (!limits::directionLength.contains(glm::length(camera.direction)))
            throw OverrideError("look-at", "found the camera's own position; allowed: any other point");
    }
}

void overrideSettings(const SceneOptions &options, RenderSettings &settings) {
    const auto isGiven = [&](std::string_view key) {
        return std::ranges::any_of(options.settings, [&](const SettingChange &change) {
            return change.option != nullptr && change.option->key == key;
        });
    };
    RenderSettings changed = settings;
    for (const SettingChange &change : options.settings)
        change.apply(changed);
    if (changed.noise > 0.0 && isGiven("noise") && !isGiven("spp"))
        settings.samplesPerPixel = samplesForNoise; // the scene's own number is for renders without a noise
    for (const SettingChange &change : options.settings)
        change.apply(settings);
}

/// Throws for options that exclude each other.
Flattening flatteningOf(const SceneOptions &options, const RenderSettings &settings) {
    if (options.keepsInstances && options.isFlattened)
        throw OverrideError("keep-instances", "found beside flatten; allowed: one of the two");
    if (options.keepsInstances && settings.tree == TreeKind::None)
        throw OverrideError("keep-instances",
                            "found without a tree, where triangles are tested one by one, in one space; "
                            "allowed: with a tree");
    if (options.isFlattened || settings.tree == TreeKind::None)
        return Flattening::All;
    return options.keepsInstances ? Flattening::Needed : Flattening::Fitting;
}

/// Throws for an option that has no effect with these settings.
void requireEffect(const SceneOptions &options, const RenderSettings &settings) {
    const Integrator integrator = settings.integrator;
    if (settings.filter != FilterKind::Box && settings.sampler == SamplerKind::Centre)
        throw OverrideError("filter", fmt::format("found {} with all samples at the pixel's centre; allowed: "
                                                  "with the sampler sobol, or the filter box",
                                                  nameOf(settings.filter)));
    for (const SettingChange &change : options.settings) {
        const auto isUsedBy = [&](Integrator user) {
            const bool followsPaths = looksThrough(user, settings) && change.option->key == "maxDepth";
            return followsPaths ||
                   std::ranges::find(change.option->integrators, user) != change.option->integrators.end();
        };
        if (change.option == nullptr || change.option->integrators.empty() || isUsedBy(integrator) ||
            std::ranges::any_of(options.views, isUsedBy))
            continue;
        std::string users;
        for (const Integrator user : change.option->integrators)
            users += fmt::format("{}{}", users.empty() ? "" : ", ", nameOf(user));
        throw OverrideError(
            std::string(change.option->option),
            fmt::format("has no effect with the integrator {}; allowed: with {}", nameOf(integrator), users));
    }
}

/// The environment or the background of the options replaces both of the scene's.
void overrideEnvironment(const SceneOptions &options, LoadedScene &loaded) {
    Environment &environment = loaded.scene.environment;
    if (!options.background.empty()) {
        if (!options.environment.empty())
            throw OverrideError("background", "found beside an environment; allowed: one of the two");
        loaded.scene.background = glm::vec3(toVector(options.background));
        environment = {};
    }
    if (options.environment == neutralEnvironmentName) {
        environment = {.radiance = neutralEnvironment()};
    } else if (!options.environment.empty()) {
        EnvironmentImage image = readEnvironmentImage(options.environment);
        environment = {.radiance = std::move(image.radiance)};
        loaded.inputFiles.push_back(options.environment);
        std::ranges::move(image.warnings, std::back_inserter(loaded.warnings));
    }
    const bool isMissing = environment.radiance.pixels().empty();
    const auto require = [&](std::string_view option) {
        if (isMissing)
            throw OverrideError(
                std::string(option),
                "found a scene without an environment; allowed: with one, of the scene or of the options");
    };
    if (options.environmentScale) {
        require("environment-scale");
        environment.scale = static_cast<float>(*options.environmentScale);
    }
    if (options.environmentRotateDegrees) {
        require("environment-rotate");
        environment.rotateDegrees = *options.environmentRotateDegrees;
    }
}

/// The size of the image: of the options, or the scene's. A side that no option gives follows from the other one by the
/// scene's shape. Where the file gives only the shape, the longer side is that of the scene.
void overrideSize(const SceneOptions &options, const std::optional<double> &aspectRatio, Camera &camera) {
    const auto toPixels = [](double side) {
        return static_cast<int>(std::clamp(std::round(side), limits::imageSize.low, limits::imageSize.high));
    };
    if (!aspectRatio && !options.width && !options.height)
        return;
    const double ratio =
        aspectRatio.value_or(static_cast<double>(camera.width) / static_cast<double>(camera.height));
    const int width =
        toPixels(options.height ? *options.height * ratio : camera.width * std::min(ratio, 1.0));
    const int height =
        toPixels(options.width ? *options.width / ratio : camera.height / std::max(ratio, 1.0));
    camera.width = options.width.value_or(width);
    camera.height = options.height.value_or(height);
}

/// Throws for a property that only another kind of camera has.
void requireKind(CameraKind kind, const Camera &camera, std::string_view option, std::string_view lacking) {
    if (camera.kind != kind)
        throw OverrideError(
            std::string(option),
            fmt::format("found a camera of the type {}, which has no {}; allowed: with one of "
                        "the type {}",
                        nameIn(cameraNames, camera.kind), lacking, nameIn(cameraNames, kind)));
}

/// The size of the image, the field of view and the lens, or the view width.
void overrideLens(const SceneOptions &options, LoadedScene &loaded) {
    Camera &camera = loaded.scene.camera;
    overrideSize(options, loaded.aspectRatio, camera);
    if (options.fovDegrees)
        requireKind(CameraKind::Perspective, camera, "fov", "field of view");
    if (options.aperture)
        requireKind(CameraKind::Perspective, camera, "aperture", "lens");
    if (options.focusDistance)
        requireKind(CameraKind::Perspective, camera, "focus-distance", "lens");
    if (options.viewWidth)
        requireKind(CameraKind::Orthographic, camera, "view-width", "view width");
    if (loaded.verticalFovDegrees)
        camera.horizontalFovDegrees =
            horizontalFovDegrees(*loaded.verticalFovDegrees, camera.width, camera.height);
    camera.horizontalFovDegrees = options.fovDegrees.value_or(camera.horizontalFovDegrees);
    camera.aperture = options.aperture.value_or(camera.aperture);
    camera.focusDistance = options.focusDistance.value_or(camera.focusDistance);
    camera.viewWidth = options.viewWidth.value_or(camera.viewWidth);
}

/// Places the camera: that of the file, or one that sees all of what is framed, with lights where it has none.
void placeCamera(const SceneOptions &options, const std::optional<Bounds> &framed, LoadedScene &loaded) {
    overrideLens(options, loaded);
    Camera &camera = loaded.scene.camera;
    if (framed) {
        const Camera lens = camera;
        camera = frameCamera(*framed, lens.width, lens.height, lens.horizontalFovDegrees, chooseUp(options));
        camera.aperture = lens.aperture;
        camera.focusDistance = lens.focusDistance;
    }
    moveCamera(options, loaded, framed, camera);
    const bool isMoved = !options.up.empty() || !options.cameraPosition.empty();
    if (framed && loaded.isAutoLit && isMoved)
        loaded.scene.lights = frameLights(*framed, chooseUp(options), camera.position);
}

void applyOverrides(const SceneOptions &options, PreparedScene &prepared) {
    LoadedScene &loaded = prepared.loaded;
    Scene &scene = loaded.scene;
    RenderSettings &settings = loaded.settings;
    // A mesh without lights of its own is lit by an environment that is given.
    const bool isLitAround = loaded.autoFramed && loaded.isAutoLit && !options.environment.empty();
    if (isLitAround)
        settings.integrator = Integrator::Path;
    overrideSettings(options, settings);
    if (isLitAround && settings.integrator == Integrator::Path) { // others do not see its light
        scene.lights.clear();
        loaded.isAutoLit = false;
    }
    requireEffect(options, settings);
    overrideEnvironment(options, loaded);
    if (loaded.autoFramed) {
        prepared.framed = triangleBounds(scene, loaded.file.string());
        prepared.givenLights = scene.lights;
    }
    placeCamera(options, prepared.framed, loaded);
}

/// The override that decides the orientation of the camera, or empty.
std::string cameraOverride(const SceneOptions &options) {
    if (!options.up.empty())
        return "up";
    if (!options.lookAt.empty())
        return "look-at";
    return options.cameraPosition.empty() ? "" : "camera-position";
}

/// Validates by `validate`, of which the name of the source is told, and the settings. The scene was valid as loaded,
/// and each override is in range, so any failure is a conflict between them.
template <class Validate>
void validateWithOverrides(const SceneOptions &options, const LoadedScene &loaded, const Validate &validate) {
    const std::string name = cameraOverride(options);
    try {
        const std::string source =
            fmt::format("{} with {}", loaded.file.string(), name.empty() ? "these settings" : "this camera");
        validate(source);
        validateSettings(loaded.settings, loaded.scene, source);
    } catch (const Error &error) {
        if (name.empty())
            throw Error(ErrorKind::Usage, error.what());
        throw OverrideError(name, error.what());
    }
}

Crop chooseCrop(const std::vector<int> &wanted, const Camera &camera) {
    if (wanted.empty())
        return {0, camera.width, 0, camera.height};
    const Crop crop{wanted[0], wanted[1], wanted[2], wanted[3]};
    const bool isInside = 0 <= crop.x0 && crop.x0 < crop.x1 && crop.x1 <= camera.width && 0 <= crop.y0 &&
                          crop.y0 < crop.y1 && crop.y1 <= camera.height;
    if (!isInside)
        throw OverrideError(
            "crop",
            fmt::format("{},{},{},{} is empty or leaves the image of {}x{} pixels; allowed: x0,x1,y0,y1 "
                        "with 0 <= x0 < x1 <= {} and 0 <= y0 < y1 <= {}",
                        crop.x0, crop.x1, crop.y0, crop.y1, camera.width, camera.height, camera.width,
                        camera.height));
    return crop;
}

/// Makes the picture smaller. Pixels that the crop covers in part are in it.
void shrink(double share, Camera &camera, Crop &crop) {
    const auto toSide = [share](int side) {
        return std::max(1, static_cast<int>(std::lround(share * side)));
    };
    const auto shrinkRange = [](int from, int to, int &begin, int &end) {
        begin = std::min(begin * to / from, to - 1);
        end = std::clamp((end * to + from - 1) / from, begin + 1, to);
    };
    const int width = toSide(camera.width);
    const int height = toSide(camera.height);
    shrinkRange(camera.width, width, crop.x0, crop.x1);
    shrinkRange(camera.height, height, crop.y0, crop.y1);
    camera.width = width;
    camera.height = height;
}

/// Expected triangle tests of a line above which the tree is useless. Good meshes are far below: a sphere of eight
/// million triangles has 14.
constexpr double manyTrianglesTested = 1000.0;

void warnOfOverlaps(const Bvh &bvh, Observer &observer) {
    const BvhStatistics statistics = measureBvh(bvh);
    const bool hasTree = statistics.depth > 0; // without a tree, many tests are what the user asked for
    if (hasTree && statistics.trianglesTested > manyTrianglesTested)
        observer.warning(
            fmt::format("the boxes of the scene's {} triangles overlap so much that a ray tests about "
                        "{:.0f} of them: rendering will be slow",
                        statistics.triangleCount, statistics.trianglesTested));
}

/// Whether a triangle's material is one that `isMeant`, by its index.
template <class IsMeant> bool wears(const TriangleMesh &mesh, const IsMeant &isMeant) {
    return mesh.triangleMaterials.empty() ? isMeant(mesh.materialIndex)
                                          : std::ranges::any_of(mesh.triangleMaterials, isMeant);
}

/// Whether anything is of glass without roughness, through which no shadow ray goes.
bool hasSmoothGlass(const Scene &scene) {
    const auto isSmooth = [&](std::uint32_t index) {
        const Material &material = scene.materials[index];
        return material.kind == MaterialKind::Dielectric && material.roughness == 0.0f;
    };
    const auto wearsIt = [&](const TriangleMesh &mesh) { return wears(mesh, isSmooth); };
    return std::ranges::any_of(scene.spheres, isSmooth, &Sphere::materialIndex) ||
           std::ranges::any_of(scene.meshes, wearsIt) || std::ranges::any_of(scene.prototypes, wearsIt);
}

/// `path` meets a light without size by shadow rays only, and smooth glass bends light in one direction only.
void adviseOnLightsBehindGlass(const Scene &scene, Integrator integrator, Observer &observer) {
    if (integrator == Integrator::Path && !scene.lights.empty() && hasSmoothGlass(scene))
        observer.advice("path does not find the light of lights without size (point, spot, "
                        "directional) through smooth glass: its shadow is dark, and it focuses none of that "
                        "light. Give the light a size, as a sphere with emission, or use the integrator "
                        "whitted");
}

/// Drops what is packed, except for glass: where a camera moves, packCamera asks what is around it.
void dropSource(Scene &scene) {
    const auto isOfGlass = [&](std::uint32_t index) { return holdsMedium(scene.materials[index]); };
    for (std::vector<TriangleMesh> *meshes : {&scene.meshes, &scene.prototypes})
        for (TriangleMesh &mesh : *meshes)
            if (!wears(mesh, isOfGlass))
                mesh = {};
    scene.textures = {};
}

/// The shadows of catchers are part of alpha.
std::vector<Integrator> viewsOf(const SceneOptions &options, const LoadedScene &loaded) {
    std::vector<Integrator> views = options.views;
    const bool hasCatcher = std::ranges::find(loaded.scene.materials, MaterialKind::ShadowCatcher,
                                              &Material::kind) != loaded.scene.materials.end();
    if (hasCatcher && alphaKindOf(loaded.settings) != layout::alphaOfNothing &&
        std::ranges::find(views, Integrator::Shadow) == views.end())
        views.push_back(Integrator::Shadow);
    return views;
}

double secondsBetween(std::chrono::steady_clock::time_point a, std::chrono::steady_clock::time_point b) {
    return std::chrono::duration<double>(b - a).count();
}

} // namespace

void tellWarnings(const LoadedScene &loaded, Observer &observer) {
    for (const std::string &warning : loaded.warnings)
        observer.warning(warning);
    for (const MeshReport &report : loaded.meshReports)
        for (const std::string &warning : report.warnings)
            observer.warning(warning);
}

PreparedScene prepareScene(const SceneOptions &options, Source source, Observer &observer,
                           const std::function<void(const SceneOutline &)> &onOutline) {
    using Clock = std::chrono::steady_clock;
    PreparedScene prepared;
    const Clock::time_point start = Clock::now();
    {
        ObservedTask progress(observer, "load");
        const auto passOutline = [&](SceneOutline outline) {
            overrideSettings(options, outline.settings);
            if (onOutline)
                onOutline(outline);
        };
        LoadOptions load = options.load;
        load.events = {passOutline, [&](double share) {
                           progress.update(share);
                           if (const std::optional<Stop> stop = observer.wantsStop())
                               throw Error(stop->kind,
                                           fmt::format("stopped by {} while the scene was loaded", stop->by));
                       }};
        prepared.loaded =
            options.document ? loadScene(*options.document, load) : loadScene(options.scene, load);
        progress.update(1.0);
    }
    prepared.givenCamera = prepared.loaded.scene.camera;
    prepared.givenSettings = prepared.loaded.settings;
    applyOverrides(options, prepared);
    tellWarnings(prepared.loaded, observer);
    Scene &scene = prepared.loaded.scene;
    const RenderSettings &settings = prepared.loaded.settings;
    validateWithOverrides(options, prepared.loaded,
                          [&](const std::string &name) { validateScene(scene, name); });
    prepared.crop = chooseCrop(options.crop, scene.camera);
    if (options.sizeShare)
        shrink(*options.sizeShare, scene.camera, prepared.crop);
    prepared.sources = lightSourcesOf(scene);
    adviseOnLightsBehindGlass(scene, settings.integrator, observer);
    if (const std::optional<std::string> dark = diagnoseLight(scene, settings.integrator))
        observer.advice(*dark);
    const Clock::time_point loaded = Clock::now();
    const std::uint64_t geometry = geometryHash(scene);
    prepared.arrangement = arrangeInstances(scene, flatteningOf(options, settings));
    partContacts(scene);
    prepared.bvh = buildBvh(settings.tree, scene, settings.leafSize);
    warnOfOverlaps(prepared.bvh, observer);
    prepared.views = viewsOf(options, prepared.loaded);
    prepared.packed =
        packScene(scene, prepared.bvh, {.lightChoice = settings.lightChoice, .geometry = geometry});
    prepared.arraysHash = prepared.packed.arraysHash();
    if (source == Source::Dropped) {
        dropSource(scene);
        prepared.bvh = {};
    }
    prepared.loadSeconds = secondsBetween(start, loaded);
    prepared.buildSeconds = secondsBetween(loaded, Clock::now());
    return prepared;
}

bool isOtherView(const PreparedScene &prepared, const SceneOptions &options, const SceneOptions &others) {
    const auto isSame = [&](auto... members) { return ((options.*members == others.*members) && ...); };
    RenderSettings now = prepared.givenSettings;
    RenderSettings then = prepared.givenSettings;
    overrideSettings(options, now);
    overrideSettings(others, then);
    const bool hasSameTree = now.integrator == then.integrator && now.tree == then.tree &&
                             now.leafSize == then.leafSize && now.lightChoice == then.lightChoice;
    const bool hasSameLoad = options.load.allowedPaths == others.load.allowedPaths &&
                             options.load.camera == others.load.camera &&
                             options.load.gltfScene == others.load.gltfScene &&
                             options.load.timeSeconds == others.load.timeSeconds;
    return hasSameTree && hasSameLoad &&
           isSame(&SceneOptions::scene, &SceneOptions::document, &SceneOptions::background,
                  &SceneOptions::environment, &SceneOptions::environmentScale,
                  &SceneOptions::environmentRotateDegrees, &SceneOptions::isFlattened,
                  &SceneOptions::keepsInstances);
}

void changeView(PreparedScene &prepared, const SceneOptions &options) {
    LoadedScene &loaded = prepared.loaded;
    const Integrator integrator = loaded.settings.integrator; // that light of the options decides, too
    loaded.settings = prepared.givenSettings;
    loaded.settings.integrator = integrator;
    overrideSettings(options, loaded.settings);
    requireEffect(options, loaded.settings);
    const std::vector<Light> lights = loaded.scene.lights;
    loaded.scene.camera = prepared.givenCamera;
    if (prepared.framed && loaded.isAutoLit) // its lights follow the camera
        loaded.scene.lights = prepared.givenLights;
    placeCamera(options, prepared.framed, loaded);
    validateWithOverrides(options, loaded,
                          [&](const std::string &name) { validateCamera(loaded.scene.camera, name); });
    prepared.crop = chooseCrop(options.crop, loaded.scene.camera);
    if (options.sizeShare)
        shrink(*options.sizeShare, loaded.scene.camera, prepared.crop);
    prepared.views = viewsOf(options, loaded);
    packCamera(loaded.scene, prepared.packed);
    const auto haveSamePlaces = [](const Light &a, const Light &b) {
        return a.position == b.position && a.direction == b.direction;
    };
    if (!std::ranges::equal(lights, loaded.scene.lights, haveSamePlaces)) {
        packLights(loaded.scene, loaded.settings.lightChoice, prepared.packed);
        prepared.arraysHash = prepared.packed.arraysHash();
    }
}

Provenance provenanceOf(const PreparedScene &scene, const std::string &commandLine) {
    Provenance origin;
    origin.commandLine = commandLine;
    origin.scene = scene.loaded.file.string();
    origin.sceneHash = scene.contentHash();
    origin.triangleCount = scene.packed.triangles.size();
    origin.width = scene.crop.width();
    origin.height = scene.crop.height();
    origin.coordinateOrigin = scene.loaded.scene.origin;
    origin.settings = scene.loaded.settings;
    return origin;
}

} // namespace hyalite::core
