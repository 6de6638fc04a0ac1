#include "tests/bench/embree.h"

#include "tests/bench/parallel.h"

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>

namespace hyalite::core::bench {

namespace {

constexpr std::size_t packetSize = 8;
constexpr std::size_t raysAtOnce = 1024; // whole packets

/// What both versions of the library call differently.
struct Query {
#if RTC_VERSION_MAJOR >= 4
    RTCRayQueryContext context;
    RTCIntersectArguments intersect;
    RTCOccludedArguments occluded;

    explicit Query(RTCRayQueryFlags flags) {
        rtcInitRayQueryContext(&context);
        rtcInitIntersectArguments(&intersect);
        rtcInitOccludedArguments(&occluded);
        intersect.context = &context;
        intersect.flags = flags;
        occluded.context = &context;
        occluded.flags = flags;
    }
    void hit(RTCScene scene, RTCRayHit &ray) { rtcIntersect1(scene, &ray, &intersect); }
    void hit(const int *valid, RTCScene scene, RTCRayHit8 &ray) {
        rtcIntersect8(valid, scene, &ray, &intersect);
    }
    void occlude(RTCScene scene, RTCRay &ray) { rtcOccluded1(scene, &ray, &occluded); }
    void occlude(const int *valid, RTCScene scene, RTCRay8 &ray) {
        rtcOccluded8(valid, scene, &ray, &occluded);
    }
    static constexpr RTCRayQueryFlags coherent = RTC_RAY_QUERY_FLAG_COHERENT;
    static constexpr RTCRayQueryFlags incoherent = RTC_RAY_QUERY_FLAG_INCOHERENT;
#else
    RTCIntersectContext context;

    explicit Query(RTCIntersectContextFlags flags) {
        rtcInitIntersectContext(&context);
        context.flags = flags;
    }
    void hit(RTCScene scene, RTCRayHit &ray) { rtcIntersect1(scene, &context, &ray); }
    void hit(const int *valid, RTCScene scene, RTCRayHit8 &ray) {
        rtcIntersect8(valid, scene, &context, &ray);
    }
    void occlude(RTCScene scene, RTCRay &ray) { rtcOccluded1(scene, &context, &ray); }
    void occlude(const int *valid, RTCScene scene, RTCRay8 &ray) {
        rtcOccluded8(valid, scene, &context, &ray);
    }
    static constexpr RTCIntersectContextFlags coherent = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    static constexpr RTCIntersectContextFlags incoherent = RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
#endif
};

float lengthFor(const layout::RayRecord &ray) {
    return ray.maxDistance == std::numeric_limits<float>::max() ? std::numeric_limits<float>::infinity()
                                                                : ray.maxDistance;
}

RTCRay rayFor(const layout::RayRecord &ray) {
    RTCRay result{};
    result.org_x = ray.origin.x;
    result.org_y = ray.origin.y;
    result.org_z = ray.origin.z;
    result.dir_x = ray.direction.x;
    result.dir_y = ray.direction.y;
    result.dir_z = ray.direction.z;
    result.tfar = lengthFor(ray);
    result.mask = 0xFFFFFFFFu;
    return result;
}

RTCRay8 packetFor(std::span<const layout::RayRecord> rays) {
    RTCRay8 result{};
    for (std::size_t i = 0; i < rays.size(); ++i) {
        result.org_x[i] = rays[i].origin.x;
        result.org_y[i] = rays[i].origin.y;
        result.org_z[i] = rays[i].origin.z;
        result.dir_x[i] = rays[i].direction.x;
        result.dir_y[i] = rays[i].direction.y;
        result.dir_z[i] = rays[i].direction.z;
        result.tfar[i] = lengthFor(rays[i]);
        result.mask[i] = 0xFFFFFFFFu;
    }
    return result;
}

constexpr layout::HitRecord nothing{layout::noPrimitive, 0.0f, 0.0f, 0.0f};

layout::HitRecord anyHit(float tfar) {
    return tfar < 0.0f ? layout::HitRecord{layout::hitAnything, 0.0f, 0.0f, 0.0f} : nothing;
}

layout::HitRecord nearestHit(unsigned geometry, unsigned triangle, float t, float u, float v) {
    return geometry == RTC_INVALID_GEOMETRY_ID
               ? nothing
               : layout::HitRecord{triangle + layout::minFirstTriangleId, t, u, v};
}

} // namespace

const char *embreeVersion() { return RTC_VERSION_STRING; }

struct EmbreeScene::State {
    RTCDevice device = nullptr;
    RTCScene scene = nullptr;
    RTCGeometry geometry = nullptr;

    explicit State(const std::string &settings) : device(rtcNewDevice(settings.c_str())) {}
    ~State() {
        if (geometry != nullptr)
            rtcReleaseGeometry(geometry);
        if (scene != nullptr)
            rtcReleaseScene(scene);
        if (device != nullptr)
            rtcReleaseDevice(device);
    }
    State(const State &) = delete;
    State &operator=(const State &) = delete;
};

EmbreeScene::EmbreeScene(const TriangleMesh &mesh, unsigned buildThreads)
    : state_(std::make_unique<State>("threads=" + std::to_string(buildThreads))) {
    if (state_->device == nullptr)
        throw std::runtime_error("rtcNewDevice failed");
    state_->scene = rtcNewScene(state_->device);
    rtcSetSceneFlags(state_->scene, RTC_SCENE_FLAG_NONE);
    rtcSetSceneBuildQuality(state_->scene, RTC_BUILD_QUALITY_MEDIUM);
    state_->geometry = rtcNewGeometry(state_->device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto *positions = static_cast<glm::vec3 *>(
        rtcSetNewGeometryBuffer(state_->geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                sizeof(glm::vec3), mesh.positions.size()));
    auto *triangles = static_cast<glm::uvec3 *>(
        rtcSetNewGeometryBuffer(state_->geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                sizeof(glm::uvec3), mesh.triangles.size()));
    if (positions == nullptr || triangles == nullptr)
        throw std::runtime_error("rtcSetNewGeometryBuffer failed");
    std::copy(mesh.positions.begin(), mesh.positions.end(), positions);
    std::transform(mesh.triangles.begin(), mesh.triangles.end(), triangles,
                   [](const MeshTriangle &triangle) { return triangle.positions; });
    rtcAttachGeometry(state_->scene, state_->geometry);
}

EmbreeScene::~EmbreeScene() = default;

void EmbreeScene::commit() {
    rtcCommitGeometry(state_->geometry); // marks it as new, or nothing would be built again
    rtcCommitScene(state_->scene);
    if (rtcGetDeviceError(state_->device) != RTC_ERROR_NONE)
        throw std::runtime_error("Embree could not build the scene");
}

struct EmbreeQuery::State {
    RTCScene scene;
    Query query{Query::incoherent};
};

EmbreeQuery::EmbreeQuery(const EmbreeScene &scene)
    : state_(std::make_unique<State>(State{scene.state_->scene})) {}

EmbreeQuery::~EmbreeQuery() = default;

std::optional<EmbreeQuery::Hit> EmbreeQuery::nearest(const glm::vec3 &origin, const glm::vec3 &direction,
                                                     float least) {
    RTCRayHit ray;
    ray.ray = rayFor({origin, std::numeric_limits<float>::max(), direction, 0});
    ray.ray.tnear = least;
    ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    state_->query.hit(state_->scene, ray);
    if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID)
        return std::nullopt;
    return Hit{ray.hit.primID, ray.ray.tfar};
}

bool EmbreeQuery::isOccluded(const glm::vec3 &origin, const glm::vec3 &direction, float least, float most) {
    RTCRay ray = rayFor({origin, most, direction, 0});
    ray.tnear = least;
    state_->query.occlude(state_->scene, ray);
    return ray.tfar < 0.0f;
}

struct EmbreeRays::State {
    RTCScene scene = nullptr;
    bool isAnyHit = false;
    bool isCoherent = false;
    std::vector<RTCRay> rays;
    std::vector<RTCRay8> packets; ///< of the same rays; the last one may not be full
};

EmbreeRays::EmbreeRays(const EmbreeScene &scene, const RaySet &set) : state_(std::make_unique<State>()) {
    state_->scene = scene.state_->scene;
    state_->isAnyHit = set.goal == gpu::RayGoal::AnyHit;
    state_->isCoherent = set.isCoherent;
    const std::span<const layout::RayRecord> rays(set.rays);
    std::transform(rays.begin(), rays.end(), std::back_inserter(state_->rays), rayFor);
    for (std::size_t begin = 0; begin < rays.size(); begin += packetSize)
        state_->packets.push_back(packetFor(rays.subspan(begin, std::min(packetSize, rays.size() - begin))));
}

EmbreeRays::~EmbreeRays() = default;

void EmbreeRays::traceOneByOne(std::span<layout::HitRecord> hits) const {
    inChunks(state_->rays.size(), raysAtOnce, [&](std::size_t begin, std::size_t end) {
        Query query(state_->isCoherent ? Query::coherent : Query::incoherent);
        for (std::size_t i = begin; i < end; ++i) {
            if (state_->isAnyHit) {
                RTCRay ray = state_->rays[i];
                query.occlude(state_->scene, ray);
                hits[i] = anyHit(ray.tfar);
            } else {
                RTCRayHit ray;
                ray.ray = state_->rays[i];
                ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
                query.hit(state_->scene, ray);
                hits[i] = nearestHit(ray.hit.geomID, ray.hit.primID, ray.ray.tfar, ray.hit.u, ray.hit.v);
            }
        }
    });
}

void EmbreeRays::traceByEights(std::span<layout::HitRecord> hits) const {
    inChunks(state_->rays.size(), raysAtOnce, [&](std::size_t begin, std::size_t end) {
        Query query(state_->isCoherent ? Query::coherent : Query::incoherent);
        alignas(32) int valid[packetSize];
        for (std::size_t first = begin; first < end; first += packetSize) {
            const std::size_t count = std::min(packetSize, end - first);
            for (std::size_t i = 0; i < packetSize; ++i)
                valid[i] = i < count ? -1 : 0;
            if (state_->isAnyHit) {
                RTCRay8 ray = state_->packets[first / packetSize];
                query.occlude(valid, state_->scene, ray);
                for (std::size_t i = 0; i < count; ++i)
                    hits[first + i] = anyHit(ray.tfar[i]);
            } else {
                RTCRayHit8 ray;
                ray.ray = state_->packets[first / packetSize];
                std::fill_n(ray.hit.geomID, packetSize, RTC_INVALID_GEOMETRY_ID);
                query.hit(valid, state_->scene, ray);
                for (std::size_t i = 0; i < count; ++i)
                    hits[first + i] = nearestHit(ray.hit.geomID[i], ray.hit.primID[i], ray.ray.tfar[i],
                                                 ray.hit.u[i], ray.hit.v[i]);
            }
        }
    });
}

} // namespace hyalite::core::bench
