// A mesh in Embree, Intel's ray tracing kernels (www.embree.org), versions 3 and 4, and rays as it takes them: what
// our speed is measured against.
//
// The scene is built at medium quality, the default, and without RTC_SCENE_FLAG_ROBUST: Embree at its fastest.
#pragma once

#include "host/scene/scene.h"
#include "tests/bench/ray_sets.h"

#include <memory>
#include <optional>

namespace hyalite::core::bench {

/// "3.13.5"
[[nodiscard]] const char *embreeVersion();

class EmbreeScene {
  public:
    /// Copies the mesh; commit() builds the tree, on so many threads, or all of them for 0. Throws std::runtime_error
    /// where Embree fails.
    explicit EmbreeScene(const TriangleMesh &mesh, unsigned buildThreads = 0);
    ~EmbreeScene();

    /// Builds the tree, anew each time. Throws std::runtime_error.
    void commit();

  private:
    friend class EmbreeQuery;
    friend class EmbreeRays;
    struct State;
    std::unique_ptr<State> state_;
};

/// rtcIntersect1 and rtcOccluded1, for programs that follow paths. Each thread has its own.
class EmbreeQuery {
  public:
    /// `scene` is committed, and outlives this.
    explicit EmbreeQuery(const EmbreeScene &scene);
    ~EmbreeQuery();

    struct Hit {
        unsigned triangle = 0; ///< in the order of the mesh
        float distance = 0.0f;
    };
    /// What the ray meets first, beyond `least`.
    [[nodiscard]] std::optional<Hit> nearest(const glm::vec3 &origin, const glm::vec3 &direction,
                                             float least);
    [[nodiscard]] bool isOccluded(const glm::vec3 &origin, const glm::vec3 &direction, float least,
                                  float most);

  private:
    struct State;
    std::unique_ptr<State> state_;
};

/// The rays of a set, kept as Embree takes them: one by one, or by eights.
class EmbreeRays {
  public:
    /// `scene` is committed; both outlive this.
    EmbreeRays(const EmbreeScene &scene, const RaySet &set);
    ~EmbreeRays();

    /// rtcIntersect1 or rtcOccluded1 on all rays and all threads. Hits are written as ours are, but u and v are
    /// Embree's: weights of the second and third vertex.
    void traceOneByOne(std::span<layout::HitRecord> hits) const;
    /// rtcIntersect8 or rtcOccluded8, told whether the rays are coherent.
    void traceByEights(std::span<layout::HitRecord> hits) const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace hyalite::core::bench
