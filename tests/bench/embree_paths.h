// A path tracer as a C++ programmer writes it on Embree's calls for one ray, with all threads: next-event estimation
// and bounces by the cosine of their angle, weighted by the power heuristic, and Russian roulette. It shares no code
// with ours, but, if told, our samples.
#pragma once

#include "host/image/image.h"
#include "host/scene/scene.h"
#include "tests/bench/embree.h"
#include "tests/fixtures/test_scene.h"

#include <cstdint>
#include <vector>

namespace hyalite::core::bench {

/// Where a path's random numbers come from. Independent: a generator for each thread. Stratified: the renderers' own.
enum class PathSamples { Independent, Stratified };

class EmbreePaths {
  public:
    /// `scene`, which outlives this, has triangles of diffuse materials without normals of their own, some of which
    /// emit, and a pinhole.
    explicit EmbreePaths(const TestScene &scene);

    /// The mean of the samples of each pixel, of paths of at most settings.maxDepth segments.
    [[nodiscard]] Image render(int samplesPerPixel, std::uint32_t seed, PathSamples samples) const;

  private:
    struct Facet {
        glm::vec3 corner;
        glm::vec3 side1;
        glm::vec3 side2;
        glm::vec3 normal; ///< unit length
        float area;
        const Material *material;
    };
    class Path;

    const TestScene &scene_;
    std::vector<Facet> facets_;
    std::vector<unsigned> lights_; ///< facets that shine
    std::vector<float> lightEnds_; ///< where each ends on a line as long as their areas together
    float least_ = 0.0f;           ///< what is nearer is where a ray begins
    EmbreeScene embree_;
};

} // namespace hyalite::core::bench
