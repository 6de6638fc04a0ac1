// One mesh in Embree, Intel's ray tracing kernels (www.embree.org), in its robust mode. Versions 3 and 4.
#pragma once

#include "host/scene/scene.h"

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <glm/vec3.hpp>

#include <algorithm>
#include <limits>
#include <optional>
#include <stdexcept>

namespace hyalite::core::testing {

class EmbreeScene {
  public:
    struct Hit {
        std::uint32_t triangle;
        float t;
        glm::vec3 normal; ///< geometric, of any length
    };

    explicit EmbreeScene(const TriangleMesh &mesh) : device_(rtcNewDevice(nullptr)) {
        if (device_ == nullptr)
            throw std::runtime_error("rtcNewDevice failed");
        scene_ = rtcNewScene(device_);
        rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
        const RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
        auto *positions = static_cast<glm::vec3 *>(
            rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(glm::vec3),
                                    mesh.positions.size()));
        auto *triangles = static_cast<glm::uvec3 *>(rtcSetNewGeometryBuffer(
            geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof(glm::uvec3), mesh.triangles.size()));
        if (positions == nullptr || triangles == nullptr)
            throw std::runtime_error("rtcSetNewGeometryBuffer failed");
        std::copy(mesh.positions.begin(), mesh.positions.end(), positions);
        std::transform(mesh.triangles.begin(), mesh.triangles.end(), triangles,
                       [](const MeshTriangle &triangle) { return triangle.positions; });
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(scene_, geometry);
        rtcReleaseGeometry(geometry);
        rtcCommitScene(scene_);
        if (rtcGetDeviceError(device_) != RTC_ERROR_NONE)
            throw std::runtime_error("Embree could not build the scene");
    }
    ~EmbreeScene() {
        rtcReleaseScene(scene_);
        rtcReleaseDevice(device_);
    }
    EmbreeScene(const EmbreeScene &) = delete;
    EmbreeScene &operator=(const EmbreeScene &) = delete;

    [[nodiscard]] std::optional<Hit> closestHit(const glm::vec3 &origin, const glm::vec3 &direction) const {
        RTCRayHit query{};
        query.ray = makeRay(origin, direction, std::numeric_limits<float>::infinity());
        query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
#if RTC_VERSION_MAJOR >= 4
        rtcIntersect1(scene_, &query);
#else
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        rtcIntersect1(scene_, &context, &query);
#endif
        if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID)
            return {};
        return Hit{query.hit.primID, query.ray.tfar, {query.hit.Ng_x, query.hit.Ng_y, query.hit.Ng_z}};
    }

    [[nodiscard]] bool isOccluded(const glm::vec3 &origin, const glm::vec3 &direction, float length) const {
        RTCRay ray = makeRay(origin, direction, length);
#if RTC_VERSION_MAJOR >= 4
        rtcOccluded1(scene_, &ray);
#else
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        rtcOccluded1(scene_, &context, &ray);
#endif
        return ray.tfar < 0.0f;
    }

  private:
    static RTCRay makeRay(const glm::vec3 &origin, const glm::vec3 &direction, float length) {
        RTCRay ray{};
        ray.org_x = origin.x;
        ray.org_y = origin.y;
        ray.org_z = origin.z;
        ray.dir_x = direction.x;
        ray.dir_y = direction.y;
        ray.dir_z = direction.z;
        ray.tfar = length;
        ray.mask = 0xFFFFFFFFu;
        return ray;
    }

    RTCDevice device_;
    RTCScene scene_ = nullptr;
};

} // namespace hyalite::core::testing
