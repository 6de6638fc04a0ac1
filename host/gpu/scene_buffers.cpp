#include "host/gpu/scene_buffers.h"

#include <memory>
#include <span>

namespace hyalite::gpu {

namespace {

template <class Record> std::span<const std::byte> bytesOf(const std::vector<Record> &records) {
    return std::as_bytes(std::span(records));
}

Buffer uploaded(Device &device, const char *name, BufferUse use, std::span<const std::byte> bytes,
                std::size_t sizeBytes) {
    Buffer buffer(device, name, use, sizeBytes);
    buffer.upload(bytes);
    return buffer;
}

template <class Record>
Buffer array(Device &device, const char *name, BufferUse use, const std::vector<Record> &records) {
    return uploaded(device, name, use, bytesOf(records), bytesOf(records).size());
}

/// The frame constants, with what kernels need to know of the skip lists.
layout::FrameRecord frameWith(const SkipList *list, layout::FrameRecord frame) {
    if (list != nullptr) {
        frame.gridOrigin = list->gridOrigin;
        frame.gridScale = list->gridScale;
        frame.skipListLength = list->length;
    }
    return frame;
}

/// Eight lists, or two where eight would outgrow caches and memory.
std::uint32_t fitSkipOrders(const PackedScene &scene) {
    constexpr std::size_t mostBytes = std::size_t{64} << 20;
    return 8 * 2 * sizeof(layout::SkipNode) * scene.nodes.size() <= mostBytes ? 8 : 2;
}

BufferUse arrayUse(const SkipList *list) { return list != nullptr ? BufferUse::Texels : BufferUse::Storage; }

} // namespace

SceneBuffers::SceneBuffers(Device &device, const PackedScene &scene, bool isSkipList)
    : SceneBuffers(device, scene,
                   isSkipList ? std::make_unique<SkipList>(makeSkipList(scene, fitSkipOrders(scene))).get()
                              : nullptr) {}

SceneBuffers::SceneBuffers(Device &device, const PackedScene &scene, const SkipList *list)
    : frame(device, "the frame constants", BufferUse::Uniform, sizeof(layout::FrameRecord)),
      spheres(uploaded(device, "the spheres", BufferUse::Uniform, bytesOf(scene.spheres),
                       sizeof(layout::SphereRecord) * layout::maxSphereCount)),
      sphereArray(array(device, "the spheres", arrayUse(list), scene.spheres)),
      lights(uploaded(device, "the lights", BufferUse::Uniform, bytesOf(scene.lights),
                      sizeof(layout::LightRecord) * layout::maxLightCount)),
      materials(array(device, "the materials", arrayUse(list), scene.materials)),
      nodes(list != nullptr ? array(device, "the skip lists", arrayUse(list), list->nodes)
                            : array(device, "the nodes", arrayUse(list), scene.nodes)),
      triangles(array(device, "the triangles", arrayUse(list), scene.triangles)),
      normals(array(device, "the normals", arrayUse(list), scene.normals)),
      skipOrders(list != nullptr ? list->orderCount : 0) {
    const layout::FrameRecord record = frameWith(list, scene.frame);
    frame.upload(std::as_bytes(std::span(&record, 1)));
}

} // namespace hyalite::gpu
