#include "host/gpu/scene_buffers.h"

#include "host/bvh/skip_list.h"

#include <span>
#include <utility>

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

BufferUse arrayUse(bool isSkipList) { return isSkipList ? BufferUse::Texels : BufferUse::Storage; }

struct Tree {
    Buffer nodes;
    layout::FrameRecord frame;
};

/// Uploads the tree, and adds to the frame constants what kernels need to know of skip lists. The lists on the host are
/// gone when this returns: they are the largest part of a large scene.
Tree uploadTree(Device &device, const PackedScene &scene, bool isSkipList) {
    if (!isSkipList)
        return {array(device, "the nodes", BufferUse::Storage, scene.nodes), scene.frame};
    const SkipList list = makeSkipList(scene);
    layout::FrameRecord frame = scene.frame;
    frame.gridMiddle = list.gridMiddle;
    frame.gridScale = list.gridScale;
    frame.skipListLength = list.length;
    return {array(device, "the skip lists", BufferUse::Texels, list.nodes), frame};
}

Buffer uploadFrame(Device &device, const layout::FrameRecord &frame) {
    return uploaded(device, "the frame constants", BufferUse::Uniform, std::as_bytes(std::span(&frame, 1)),
                    sizeof frame);
}

} // namespace

SceneBuffers::SceneBuffers(Device &device, const PackedScene &scene, bool isSkipList)
    : SceneBuffers(device, scene, isSkipList, uploadTree(device, scene, isSkipList)) {}

template <class Tree>
SceneBuffers::SceneBuffers(Device &device, const PackedScene &scene, bool isSkipList, Tree tree)
    : frame(uploadFrame(device, tree.frame)),
      spheres(uploaded(device, "the spheres", BufferUse::Uniform, bytesOf(scene.spheres),
                       sizeof(layout::SphereRecord) * layout::maxSphereCount)),
      sphereArray(array(device, "the spheres", arrayUse(isSkipList), scene.spheres)),
      lights(uploaded(device, "the lights", BufferUse::Uniform, bytesOf(scene.lights),
                      sizeof(layout::LightRecord) * layout::maxLightCount)),
      materials(array(device, "the materials", arrayUse(isSkipList), scene.materials)),
      nodes(std::move(tree.nodes)),
      triangles(array(device, "the triangles", arrayUse(isSkipList), scene.triangles)),
      normals(array(device, "the normals", arrayUse(isSkipList), scene.normals)),
      emitters(array(device, "the emitters", arrayUse(isSkipList), scene.emitters)) {}

} // namespace hyalite::gpu
