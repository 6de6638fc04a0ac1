#include "host/gpu/scene_buffers.h"

#include "host/packing/skip_list.h"

#include <cassert>
#include <span>
#include <utility>

namespace hyalite::gpu {

namespace {

template <class Record> std::span<const std::byte> bytesOf(const std::vector<Record> &records) {
    return std::as_bytes(std::span(records));
}

Buffer uploaded(Device &device, const BufferPlan &plan, std::span<const std::byte> bytes) {
    Buffer buffer(device, plan);
    buffer.upload(bytes);
    return buffer;
}

struct Tree {
    Buffer nodes;
    layout::FrameRecord frame;
};

/// Uploads the tree, and adds to the frame constants what kernels need to know of skip lists. The lists on the host are
/// gone when this returns: they are the largest part of a large scene.
Tree uploadTree(Device &device, const PackedScene &scene, const ScenePlan &plan, bool isSkipList) {
    if (!isSkipList)
        return {uploaded(device, plan.nodes, bytesOf(scene.nodes)), scene.frame};
    const SkipList list = makeSkipList(scene);
    layout::FrameRecord frame = scene.frame;
    frame.gridMiddle = list.gridMiddle;
    frame.gridScale = list.gridScale;
    frame.skipListLength = list.length;
    BufferPlan nodes = plan.nodes;
    nodes.sizeBytes = bytesOf(list.nodes).size();
    assert(nodes.sizeBytes <= plan.nodes.sizeBytes);
    return {uploaded(device, nodes, bytesOf(list.nodes)), frame};
}

} // namespace

SceneBuffers::SceneBuffers(Device &device, const PackedScene &scene, const ScenePlan &plan, bool isSkipList)
    : SceneBuffers(device, scene, plan, uploadTree(device, scene, plan, isSkipList)) {}

template <class Tree>
SceneBuffers::SceneBuffers(Device &device, const PackedScene &scene, const ScenePlan &plan, Tree tree)
    : frame(uploaded(device, plan.frame, std::as_bytes(std::span(&tree.frame, 1)))),
      spheres(uploaded(device, plan.spheres, bytesOf(scene.spheres))),
      sphereArray(uploaded(device, plan.sphereArray, bytesOf(scene.spheres))),
      lights(uploaded(device, plan.lights, bytesOf(scene.lights))),
      materials(uploaded(device, plan.materials, bytesOf(scene.materials))), nodes(std::move(tree.nodes)),
      triangles(uploaded(device, plan.triangles, bytesOf(scene.triangles))),
      normals(uploaded(device, plan.normals, bytesOf(scene.normals))),
      emitters(uploaded(device, plan.emitters, bytesOf(scene.emitters))),
      texels(uploaded(device, plan.texels, bytesOf(scene.texels))),
      textures(uploaded(device, plan.textures, bytesOf(scene.textures))) {}

} // namespace hyalite::gpu
