#include "host/jobs/diagnosis.h"

#include "host/reference/closest_hit.h"
#include "host/scene/light_sources.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace hyalite::core {

namespace {

using Ray = reference::Ray<float>;

/// The hits of a grid of primary rays.
struct Sight {
    int rayCount = 0;
    int hitCount = 0;
    int backCount = 0; ///< hits of surfaces from behind that are black there
    /// Points on the surfaces that are hit, each with the normal on the side of the eye and the primitive that it lies
    /// on.
    std::vector<Ray> points;
};

bool isBlackBehind(const layout::MaterialRecord &material) {
    const std::uint32_t kind = layout::kindOf(material);
    return !layout::isTwoSided(material) &&
           (kind == layout::materialDiffuse || kind == layout::materialPrincipled);
}

Sight lookAround(const PackedScene &packed, const Crop &crop) {
    constexpr int side = 16;
    const reference::SceneView<float> view(packed, layout::samplerCentre);
    Sight sight;
    for (int i = 0; i < side * side; ++i) {
        const glm::uvec2 pixel(crop.x0 + (i % side * 2 + 1) * crop.width() / (2 * side),
                               crop.y0 + (i / side * 2 + 1) * crop.height() / (2 * side));
        const auto primary = reference::primaryRay(view, pixel, 0);
        const Ray ray{primary.origin, primary.direction};
        const reference::Hit<float> hit = reference::closestHit(packed, ray);
        ++sight.rayCount;
        if (hit.primitive == layout::noPrimitive)
            continue;
        ++sight.hitCount;
        std::uint32_t materialIndex = 0;
        const auto surface = reference::hitSurface(view, hit, ray.origin, ray.direction, materialIndex);
        const bool isBack = glm::dot(surface.geometricNormal, ray.direction) > 0.0f;
        sight.backCount += isBack && isBlackBehind(packed.materials[materialIndex]);
        const glm::vec3 normal = isBack ? -surface.geometricNormal : surface.geometricNormal;
        sight.points.push_back({surface.position, normal, hit.primitive});
    }
    return sight;
}

/// Whether surfaces stand between the light and every point. Glass counts as a surface.
bool isHidden(const PackedScene &packed, const Light &light, const std::vector<Ray> &points) {
    return std::ranges::all_of(points, [&](const Ray &point) {
        const glm::dvec3 way = light.kind == LightKind::Directional
                                   ? -light.direction
                                   : light.position - glm::dvec3(point.origin);
        const double length = glm::length(way);
        if (!(length > 0.0))
            return false;
        if (glm::dot(glm::dvec3(point.direction), way) <= 0.0)
            return true; // behind the surface itself, as a light inside a ball is
        const Ray shadow{point.origin, glm::vec3(way / length), point.excluded};
        const reference::Hit<float> hit = reference::closestHit(packed, shadow);
        const bool isBefore = light.kind == LightKind::Directional || double{hit.distance} < length * 0.9999;
        return hit.primitive != layout::noPrimitive && isBefore;
    });
}

std::string reasonOfBlack(const PreparedScene &prepared) {
    const Scene &scene = prepared.loaded.scene;
    const LightSources &sources = prepared.sources;
    const Sight sight = lookAround(prepared.packed, prepared.crop);
    if (sight.hitCount == 0)
        return "no surface is in view, and the background is black; move the camera, or point it at "
               "something";
    if (sight.backCount == sight.hitCount)
        return "all surfaces in view are seen from behind, where they are black: the camera may be inside an "
               "object, or faces may be wound the wrong way; move the camera, or write \"twoSided\": true";
    const bool isHiddenAll = std::ranges::all_of(
        scene.lights, [&](const Light &light) { return isHidden(prepared.packed, light, sight.points); });
    if (!scene.lights.empty() && isHiddenAll && !sources.hasEmitters)
        return "surfaces stand between each light and all that is in view: a light may be inside an object";
    if (sources.hasEmitters && !sources.hasEnvironment)
        return "the light of the emitters does not get to what is in view: they may face away, as an "
               "emission "
               "shines on the side of the normal alone, or touch another surface; turn them around, or write "
               "\"twoSided\": true";
    return "what is in view is black itself, or gets too little light";
}

} // namespace

std::optional<std::string> diagnosePicture(const PreparedScene &scene, const Film &film,
                                           const RayCounts &rays) {
    constexpr double toleratedShare = 0.01;
    std::size_t wrongCount = 0;
    bool isBlack = true;
    for (const layout::FilmPixel &pixel : film.pixels) {
        const float sum = pixel.sum.x + pixel.sum.y + pixel.sum.z;
        wrongCount += std::isfinite(sum) ? 0u : 1u;
        isBlack = isBlack && pixel.sum == glm::vec3(0.0f) && pixel.transparency == 0.0f;
    }
    const double share = static_cast<double>(wrongCount) / static_cast<double>(film.pixels.size());
    if (share > toleratedShare)
        return fmt::format(
            "{:.0f} % of the pixels are not finite numbers: the light is too bright for floats; lower the "
            "powers of lights, or move them away from surfaces",
            share * 100.0);
    const Integrator integrator = scene.loaded.settings.integrator;
    const bool isKnown = // and was said before the render
        diagnoseLight(scene.loaded.scene, integrator).has_value();
    if (isBlack && rowOf(integrator).showsLight && !isKnown)
        return "the picture is black: " + reasonOfBlack(scene);
    const bool mayMeetNothing = rays.total() == rays.primary && !isKnown && hasSurfaces(scene.loaded.scene);
    if (mayMeetNothing && lookAround(scene.packed, scene.crop).hitCount == 0)
        return "no primary ray met anything: the picture shows what is around the scene alone; move the "
               "camera, or point it at something";
    return std::nullopt;
}

std::optional<std::string> diagnoseExposure(const Film &film, double exposureStops) {
    constexpr double farBeyondWhite = 8.0; // a white background is 1
    constexpr double wanted = 0.5;
    std::vector<double> darkest; // channel of each pixel, as it is shown
    darkest.reserve(film.pixels.size());
    for (const layout::FilmPixel &pixel : film.pixels) {
        const glm::vec3 mean = meanOf(pixel);
        darkest.push_back(std::min({mean.x, mean.y, mean.z}) * std::exp2(exposureStops));
    }
    const auto middle = darkest.begin() + static_cast<std::ptrdiff_t>(darkest.size() / 2);
    std::nth_element(darkest.begin(), middle, darkest.end());
    if (!std::isfinite(*middle) || *middle < farBeyondWhite)
        return std::nullopt;
    return fmt::format("most of the picture is far brighter than white: an exposure of {:.1f} shows it",
                       exposureStops + std::log2(wanted / *middle));
}

} // namespace hyalite::core
