#include "tests/images/plain_paths.h"

#include "tests/fixtures/test_scene.h"
#include "tests/images/plain_bsdf.h"
#include "tests/images/plain_cameras.h"
#include "tests/images/plain_lights.h"
#include "tests/images/plain_media.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

namespace hyalite::core::testing {

namespace {

using namespace plain;

constexpr int chunkCount = 64; ///< of paths, each with a generator of its own

/// A scene made ready for paths.
struct World {
    World(const TestScene &plainScene, Search how)
        : scene(plainScene), search(how), shapes(shapesOf(plainScene)), substances(plainScene),
          emitters(plainScene, shapes) {}

    [[nodiscard]] std::optional<Hit> nearest(const Vec &origin, const Vec &direction, const Shape *left,
                                             Generator &generator) const {
        std::optional<Hit> best;
        for (const Shape &shape : shapes) {
            const std::optional<Hit> hit = intersect(shape, origin, direction, left);
            if (!hit || (best && hit->distance >= best->distance))
                continue;
            if (shape.isAlphaTested &&
                uniform(generator) >= substances.presence(shape.materialIndex, uvOf(*hit, Vec(0.0))))
                continue;
            if (shape.isCulled && glm::dot(direction, glm::cross(shape.corners[1] - shape.corners[0],
                                                                 shape.corners[2] - shape.corners[0])) > 0.0)
                continue;
            best = hit;
        }
        return best;
    }

    /// Shadow rays pass no glass.
    [[nodiscard]] bool isVisible(const Vec &origin, const Vec &direction, double distance, const Shape *left,
                                 Generator &generator) const {
        const std::optional<Hit> hit = nearest(origin, direction, left, generator);
        return !hit || hit->distance >= distance;
    }

    const TestScene &scene;
    Search search;
    std::vector<Shape> shapes;
    Substances substances;
    Emitters emitters;
};

/// Radiance that the point emits against `direction`.
Vec emitted(const Substance &substance, const SurfacePoint &point, const Vec &direction) {
    const bool isSeen = glm::dot(direction, point.geometricNormal) < 0.0 || substance.material->twoSided;
    return isSeen ? substance.emission : Vec(0.0);
}

/// Whether the material is a mirror or clear glass for what meets it.
bool isSmooth(const Substance &substance, bool isPassable, const std::optional<Crossing> &sides) {
    if (isPassable && sides->isNullInterface())
        return true;
    switch (substance.material->kind) {
    case MaterialKind::Mirror:
        return true;
    case MaterialKind::Dielectric:
    case MaterialKind::Conductor:
        return substance.roughness == 0.0;
    case MaterialKind::Diffuse:
    case MaterialKind::ShadowCatcher:
    case MaterialKind::Principled:
    case MaterialKind::Gltf:
        break;
    }
    return false;
}

// Wavelengths, in micrometres, that colours stand for: tents around their centres.
constexpr double shortest = 0.395;
constexpr double longest = 0.675;
constexpr int waveCount = 14; // few enough to integrate the energy of rough glass for each

double tent(double wavelength, double centre, double reach) {
    return std::max(0.0, 1.0 - std::abs(wavelength - centre) / reach) / reach;
}

double wavelengthOf(int wave) { return shortest + (longest - shortest) * (wave + 0.5) / waveCount; }

/// What even light of all waves has of each channel at one.
Vec colourOf(int wave) {
    const auto density = [](int of) {
        const double wavelength = wavelengthOf(of);
        const double red = 0.92 * tent(wavelength, 0.61, 0.065) + 0.08 * tent(wavelength, 0.425, 0.03);
        return Vec(red, tent(wavelength, 0.543, 0.065), tent(wavelength, 0.455, 0.06));
    };
    Vec sum(0.0);
    for (int other = 0; other < waveCount; ++other)
        sum += density(other);
    return density(wave) / sum * double{waveCount};
}

/// One path from the eye.
class Path {
  public:
    Path(const World &world, Generator &generator, const Ray &ray)
        : world_(world), generator_(generator), origin_(ray.origin), direction_(ray.direction),
          media_(world.scene) {
        const auto disperses = [](const Material &material) { return material.dispersion > 0.0f; };
        if (std::ranges::none_of(world.scene.materials, disperses))
            return;
        const int wave = static_cast<int>(uniform(generator) * waveCount);
        media_.setWavelength(wavelengthOf(wave));
        throughput_ = colourOf(wave);
    }

    [[nodiscard]] Vec follow() {
        for (int segment = 1; advance(segment); ++segment) {
        }
        return radiance_;
    }

  private:
    /// Follows one segment; whether the path goes on.
    bool advance(int segment) {
        const std::optional<Hit> hit = world_.nearest(origin_, direction_, left_, generator_);
        throughput_ *= media_.transmittance(hit ? hit->distance : std::numeric_limits<double>::infinity());
        if (!hit) {
            radiance_ += throughput_ * surroundings(world_.scene, direction_);
            return false;
        }
        SurfacePoint point = pointAt(*hit, origin_, direction_);
        const std::uint32_t materialIndex = hit->shape->materialIndex;
        world_.substances.bendNormal(materialIndex, direction_, point);
        const Substance substance = world_.substances.at(materialIndex, point.uv);
        if (seesEmitters_)
            radiance_ += throughput_ * emitted(substance, point, direction_);
        if (segment == world_.scene.settings.maxDepth)
            return false;

        const bool isBehind = glm::dot(direction_, point.geometricNormal) > 0.0;
        const bool isPassable = holdsMedium(*substance.material);
        std::optional<Crossing> sides;
        if (isPassable)
            sides = crossing(media_, materialIndex, !isBehind);
        origin_ = point.position;
        left_ = hit->shape;
        if (isSmooth(substance, isPassable, sides)) {
            seesEmitters_ = true;
            return isPassable ? passGlass(point, *sides, isBehind) : reflect(point, substance);
        }
        const bool isThinGlass = substance.material->isThin && substance.material->transmission > 0.0f;
        const bool isLeaf = substance.material->diffuseTransmission > 0.0f;
        if (isBehind && !isPassable && !isThinGlass && !isLeaf && !substance.material->twoSided &&
            !substance.material->reflectsBehind && substance.material->kind != MaterialKind::Conductor)
            return false; // black from behind
        if (isBehind) {
            point.normal = -point.normal;
            point.geometricNormal = -point.geometricNormal;
        }
        seesEmitters_ = world_.search == Search::ByScattering;
        return scatter(point, substance, Bsdf(substance, sides ? sides->indexRatio() : 1.0, isBehind), sides);
    }

    bool reflect(const SurfacePoint &point, const Substance &substance) {
        const double cosine = glm::dot(direction_, point.normal);
        const Material &material = *substance.material;
        if (material.kind == MaterialKind::Conductor)
            for (glm::length_t i = 0; i < 3; ++i)
                throughput_[i] *= conductorFresnel(std::abs(cosine), material.conductorIndex[i],
                                                   material.conductorExtinction[i]);
        direction_ = glm::normalize(direction_ - 2.0 * cosine * point.normal);
        return true;
    }

    /// One of reflection and refraction, as often as its share says. Radiance goes with the square of the index.
    bool passGlass(const SurfacePoint &point, const Crossing &sides, bool isBehind) {
        const double ratio = sides.indexRatio();
        media_ = sides.beyond;
        if (sides.isNullInterface())
            return true;
        Vec normal = isBehind ? -point.normal : point.normal;
        if (glm::dot(direction_, normal) >= 0.0)
            normal = isBehind ? -point.geometricNormal : point.geometricNormal;
        const double cosine = -glm::dot(direction_, normal);
        if (uniform(generator_) < dielectricFresnel(cosine, ratio)) {
            media_ = sides.before;
            direction_ = glm::normalize(direction_ + 2.0 * cosine * normal);
            return true;
        }
        const double beyond = std::sqrt(1.0 - ratio * ratio * (1.0 - cosine * cosine));
        direction_ = glm::normalize(ratio * direction_ + (ratio * cosine - beyond) * normal);
        throughput_ *= ratio * ratio;
        return true;
    }

    /// Normals are on the side that the path comes from.
    bool scatter(const SurfacePoint &point, const Substance &substance, const Bsdf &bsdf,
                 const std::optional<Crossing> &sides) {
        // A shading normal that faces away is that of nothing visible, except for Lambert's law, which has no viewer.
        const bool isLambertian = substance.material->kind == MaterialKind::Diffuse ||
                                  substance.material->kind == MaterialKind::ShadowCatcher;
        const bool isFacing = isLambertian || glm::dot(direction_, point.normal) < 0.0;
        const Frame frame(isFacing ? point.normal : point.geometricNormal);
        const Vec view = frame.toLocal(-direction_);
        // The BSDF for a direction; 0 where the shading normal has it on the other side than the surface.
        const auto evaluate = [&](const Vec &direction) {
            const Vec light = frame.toLocal(direction);
            const bool isBeyond = glm::dot(direction, point.geometricNormal) <= 0.0;
            return isBeyond == (light.z <= 0.0) ? bsdf.evaluate(view, light) : Vec(0.0);
        };
        const auto mediaTowards = [&](const Vec &direction) {
            if (!sides)
                return media_;
            return glm::dot(direction, point.geometricNormal) <= 0.0 ? sides->beyond : sides->before;
        };
        for (const Light &light : world_.scene.lights) {
            const Arrival arrival = arrivalFrom(world_.scene, light, point.position);
            const Vec lit = evaluate(arrival.direction) * arrival.irradiance;
            if (lit != Vec(0.0) &&
                world_.isVisible(point.position, arrival.direction, arrival.distance, left_, generator_))
                radiance_ +=
                    throughput_ * mediaTowards(arrival.direction).transmittance(arrival.distance) * lit;
        }
        if (world_.search == Search::ByAiming && world_.emitters.area() > 0.0)
            aim(point, evaluate, mediaTowards);
        const std::optional<Vec> drawn = bsdf.sample(view, generator_);
        if (!drawn)
            return false;
        const Vec direction = glm::normalize(frame.toWorld(*drawn));
        const Vec value = evaluate(direction);
        if (value == Vec(0.0))
            return false;
        throughput_ *= value / bsdf.density(view, *drawn);
        media_ = mediaTowards(direction);
        direction_ = direction;
        return true;
    }

    /// Adds the light of one point of all emitters.
    template <class Evaluate, class MediaTowards>
    void aim(const SurfacePoint &point, const Evaluate &evaluate, const MediaTowards &mediaTowards) {
        const Emitters::Choice choice = world_.emitters.choose(generator_);
        const double distance = glm::length(choice.position - point.position);
        const Vec direction = (choice.position - point.position) / distance;
        const Vec value = evaluate(direction);
        if (!(distance > 0.0) || value == Vec(0.0))
            return;
        const std::optional<Hit> hit = world_.nearest(point.position, direction, left_, generator_);
        if (!hit || hit->shape != choice.shape || std::abs(hit->distance - distance) > 1e-6 * distance)
            return;
        const SurfacePoint at = pointAt(*hit, point.position, direction);
        const Vec emission = emitted(world_.substances.at(choice.shape->materialIndex, at.uv), at, direction);
        const double solidAngle = std::abs(glm::dot(direction, at.geometricNormal)) * world_.emitters.area() /
                                  (distance * distance);
        radiance_ +=
            throughput_ * mediaTowards(direction).transmittance(distance) * value * emission * solidAngle;
    }

    const World &world_;
    Generator &generator_;
    Vec origin_;
    Vec direction_; ///< unit length
    Media media_;
    const Shape *left_ = nullptr;
    Vec radiance_{0.0};
    Vec throughput_{1.0};
    bool seesEmitters_ = true; ///< what the path meets next was not aimed at
};

} // namespace

Estimate estimatePlainly(const TestScene &scene, int x0, int x1, int y0, int y1, int pathCount,
                         std::uint64_t seed, Search search) {
    const World world(scene, search);
    std::vector<Vec> sums(chunkCount, Vec(0.0));
    std::vector<Vec> squares(chunkCount, Vec(0.0));
    const int perChunk = pathCount / chunkCount;
#pragma omp parallel for schedule(dynamic)
    for (int chunk = 0; chunk < chunkCount; ++chunk) {
        std::seed_seq seeds{static_cast<std::uint64_t>(chunk), seed};
        Generator generator(seeds);
        for (int i = 0; i < perChunk; ++i) {
            const Vec2 offset = randomOffset(scene.settings.filter, generator);
            const double x = std::floor(x0 + (x1 - x0) * uniform(generator)) + 0.5 + offset.x;
            const double y = std::floor(y0 + (y1 - y0) * uniform(generator)) + 0.5 + offset.y;
            const Vec radiance = Path(world, generator, primaryRay(scene.camera, x, y, generator)).follow();
            sums[static_cast<std::size_t>(chunk)] += radiance;
            squares[static_cast<std::size_t>(chunk)] += radiance * radiance;
        }
    }
    Vec sum(0.0);
    Vec square(0.0);
    for (std::size_t chunk = 0; chunk < chunkCount; ++chunk) {
        sum += sums[chunk];
        square += squares[chunk];
    }
    const double count = static_cast<double>(perChunk) * chunkCount;
    Estimate estimate;
    estimate.mean = sum / count;
    estimate.variance = (square / count - estimate.mean * estimate.mean) / (count - 1.0);
    return estimate;
}

} // namespace hyalite::core::testing
