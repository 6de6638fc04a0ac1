#include "tests/bench/embree_paths.h"

#include "host/reference/scene_view.h"
#include "tests/bench/parallel.h"
#include "tests/fixtures/test_scene.h"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hyalite::core::bench {

namespace {

constexpr float pi = std::numbers::pi_v<float>;
constexpr int firstRoulette = 3; // segment behind which paths may end by chance

/// M. O'Neill, "PCG: A Family of Simple Fast Space-Efficient Statistically Good Algorithms for Random Number
/// Generation".
class Pcg32 {
  public:
    Pcg32(std::uint64_t seed, std::uint64_t stream) : step_(stream << 1u | 1u) {
        (void)next();
        state_ += seed;
        (void)next();
    }
    /// In [0, 1).
    float operator()() { return static_cast<float>(next() >> 8u) * 0x1p-24f; }

  private:
    std::uint32_t next() {
        const std::uint64_t old = state_;
        state_ = old * 6364136223846793005u + step_;
        const auto mixed = static_cast<std::uint32_t>(((old >> 18u) ^ old) >> 27u);
        const auto turn = static_cast<std::uint32_t>(old >> 59u);
        return (mixed >> turn) | (mixed << (-turn & 31u));
    }

    std::uint64_t state_ = 0;
    std::uint64_t step_;
};

/// The random numbers of a path, in pairs that begin with the place in the pixel.
class PathNumbers {
  public:
    PathNumbers(PathSamples samples, std::uint32_t seed, std::uint64_t stream)
        : samples_(samples), seed_(seed), random_(seed, stream) {}

    void begin(const glm::uvec2 &pixel, std::uint32_t sampleIndex) {
        pixel_ = pixel;
        sampleIndex_ = sampleIndex;
        pair_ = 0;
    }
    glm::vec2 next() {
        if (samples_ == PathSamples::Stratified)
            return reference::unitFloats<float>(
                reference::sampleBits(reference::pairKeys(pixel_, seed_, pair_++), sampleIndex_));
        const float first = random_();
        return {first, random_()};
    }

  private:
    PathSamples samples_;
    std::uint32_t seed_;
    Pcg32 random_;
    glm::uvec2 pixel_{0};
    std::uint32_t sampleIndex_ = 0;
    std::uint32_t pair_ = 0;
};

TriangleMesh joined(const std::vector<TriangleMesh> &meshes) {
    TriangleMesh all;
    for (const TriangleMesh &mesh : meshes) {
        const auto first = static_cast<std::uint32_t>(all.positions.size());
        all.positions.insert(all.positions.end(), mesh.positions.begin(), mesh.positions.end());
        for (MeshTriangle triangle : mesh.triangles) {
            triangle.positions += first;
            all.triangles.push_back(triangle);
        }
    }
    return all;
}

glm::vec3 cosineDirection(const glm::vec3 &normal, const glm::vec2 &u) {
    const float radius = std::sqrt(u.x);
    const float angle = 2.0f * pi * u.y;
    const glm::vec3 other = std::abs(normal.x) < 0.6f ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0);
    const glm::vec3 right = glm::normalize(glm::cross(other, normal));
    return radius * std::cos(angle) * right + radius * std::sin(angle) * glm::cross(normal, right) +
           std::sqrt(std::max(0.0f, 1.0f - u.x)) * normal;
}

float powerWeight(float density, float other) {
    return density * density / (density * density + other * other);
}

} // namespace

EmbreePaths::EmbreePaths(const TestScene &scene) : scene_(scene), embree_(joined(scene.meshes)) {
    float reach = 0.0f;
    for (const TriangleMesh &mesh : scene.meshes)
        for (const MeshTriangle &triangle : mesh.triangles) {
            const glm::vec3 a = mesh.positions[triangle.positions.x];
            const glm::vec3 side1 = mesh.positions[triangle.positions.y] - a;
            const glm::vec3 side2 = mesh.positions[triangle.positions.z] - a;
            const glm::vec3 normal = glm::cross(side1, side2);
            facets_.push_back({a, side1, side2, glm::normalize(normal), 0.5f * glm::length(normal),
                               &scene.materials[mesh.materialIndex]});
            reach = std::max(reach, glm::length(a));
        }
    least_ = 1e-5f * reach;
    for (unsigned i = 0; i < facets_.size(); ++i)
        if (facets_[i].material->emission != glm::vec3(0.0f)) {
            lights_.push_back(i);
            lightEnds_.push_back((lightEnds_.empty() ? 0.0f : lightEnds_.back()) + facets_[i].area);
        }
    embree_.commit();
}

/// Of one thread.
class EmbreePaths::Path {
  public:
    Path(const EmbreePaths &paths, PathNumbers &numbers)
        : all_(paths), numbers_(numbers), query_(paths.embree_) {}

    glm::vec3 follow(glm::vec3 origin, glm::vec3 direction) {
        glm::vec3 radiance(0.0f);
        glm::vec3 throughput(1.0f);
        float density = 0.0f; // of the bounce, by solid angle; 0: the primary ray
        for (int segment = 1;; ++segment) {
            const std::optional<EmbreeQuery::Hit> hit = query_.nearest(origin, direction, all_.least_);
            if (!hit)
                return radiance + throughput * all_.scene_.background;
            const Facet &facet = all_.facets_[hit->triangle];
            const float cosine = -glm::dot(direction, facet.normal);
            if (cosine <= 0.0f && !facet.material->twoSided)
                return radiance;
            if (facet.material->emission != glm::vec3(0.0f)) {
                const float byLights =
                    hit->distance * hit->distance / (std::abs(cosine) * all_.lightEnds_.back());
                radiance += throughput * facet.material->emission *
                            (density > 0.0f ? powerWeight(density, byLights) : 1.0f);
            }
            if (segment == all_.scene_.settings.maxDepth)
                return radiance;
            const glm::vec3 normal = cosine > 0.0f ? facet.normal : -facet.normal;
            origin += hit->distance * direction;
            throughput *= facet.material->albedo;
            const glm::vec2 choice = numbers_.next(); // a light, and whether the path goes on
            radiance += throughput * lightFrom(origin, normal, choice.x, numbers_.next());
            if (segment >= firstRoulette) {
                const float survival = std::min(0.95f, std::max({throughput.x, throughput.y, throughput.z}));
                if (choice.y >= survival)
                    return radiance;
                throughput /= survival;
            }
            direction = cosineDirection(normal, numbers_.next());
            density = std::max(glm::dot(direction, normal), 0.0f) / pi;
            if (density == 0.0f)
                return radiance;
        }
    }

  private:
    /// What a surface of albedo 1 sends back of one point of the lights.
    glm::vec3 lightFrom(const glm::vec3 &origin, const glm::vec3 &normal, float choice, const glm::vec2 &u) {
        const float area = all_.lightEnds_.back();
        const auto end = std::upper_bound(all_.lightEnds_.begin(), all_.lightEnds_.end() - 1, area * choice);
        const Facet &light =
            all_.facets_[all_.lights_[static_cast<std::size_t>(end - all_.lightEnds_.begin())]];
        const float fold = std::sqrt(u.x);
        const float v = u.y * fold;
        const glm::vec3 towards = light.corner + (1.0f - fold) * light.side1 + v * light.side2 - origin;
        const float distance = glm::length(towards);
        const glm::vec3 direction = towards / distance;
        const float cosine = glm::dot(direction, normal);
        float atLight = -glm::dot(direction, light.normal);
        if (light.material->twoSided)
            atLight = std::abs(atLight);
        if (cosine <= 0.0f || atLight <= 0.0f ||
            query_.isOccluded(origin, direction, all_.least_, distance * (1.0f - 1e-4f)))
            return glm::vec3(0.0f);
        const float density = distance * distance / (atLight * area);
        return light.material->emission * (cosine / pi / density * powerWeight(density, cosine / pi));
    }

    const EmbreePaths &all_;
    PathNumbers &numbers_;
    EmbreeQuery query_;
};

Image EmbreePaths::render(int samplesPerPixel, std::uint32_t seed, PathSamples samples) const {
    const Camera &camera = scene_.camera;
    const glm::vec3 forward = glm::normalize(glm::vec3(camera.direction));
    const glm::vec3 right = glm::normalize(glm::cross(forward, glm::vec3(camera.up)));
    const glm::vec3 up = glm::cross(right, forward);
    const auto width = static_cast<std::size_t>(camera.width);
    const auto height = static_cast<std::size_t>(camera.height);
    const float halfWidth = 0.5f * static_cast<float>(width);
    const float halfHeight = 0.5f * static_cast<float>(height);
    const float pixel =
        std::tan(static_cast<float>(glm::radians(camera.horizontalFovDegrees)) / 2.0f) / halfWidth;
    Image image(camera.width, camera.height);
    inChunks(height, 4, [&](std::size_t begin, std::size_t end) {
        PathNumbers numbers(samples, seed, begin);
        Path path(*this, numbers);
        for (std::size_t y = begin; y < end; ++y)
            for (std::size_t x = 0; x < width; ++x) {
                glm::vec3 sum(0.0f);
                for (int i = 0; i < samplesPerPixel; ++i) {
                    numbers.begin({x, y}, static_cast<std::uint32_t>(i));
                    const glm::vec2 offset = numbers.next();
                    const float across = static_cast<float>(x) + offset.x - halfWidth;
                    const float down = static_cast<float>(y) + offset.y - halfHeight;
                    sum += path.follow(glm::vec3(camera.position),
                                       glm::normalize(forward + pixel * across * right - pixel * down * up));
                }
                image.pixels()[y * width + x] = sum / static_cast<float>(samplesPerPixel);
            }
    });
    return image;
}

} // namespace hyalite::core::bench
