#include "host/gpu/scene_buffers.h"

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

} // namespace

SceneBuffers::SceneBuffers(Device &device, const PackedScene &scene, BufferUse arrays)
    : frame(uploaded(device, "the frame constants", BufferUse::Uniform,
                     std::as_bytes(std::span(&scene.frame, 1)), sizeof(layout::FrameRecord))),
      spheres(uploaded(device, "the spheres", BufferUse::Uniform, bytesOf(scene.spheres),
                       sizeof(layout::SphereRecord) * layout::maxSphereCount)),
      lights(uploaded(device, "the lights", BufferUse::Uniform, bytesOf(scene.lights),
                      sizeof(layout::LightRecord) * layout::maxLightCount)),
      materials(array(device, "the materials", arrays, scene.materials)),
      nodes(array(device, "the nodes", arrays, scene.nodes)),
      triangles(array(device, "the triangles", arrays, scene.triangles)),
      normals(array(device, "the normals", arrays, scene.normals)) {}

} // namespace hyalite::gpu
