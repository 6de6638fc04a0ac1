#include "host/gpu/scene_buffers.h"

#include "host/packing/skip_list.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <span>
#include <utility>

namespace hyalite::gpu {

namespace {

Buffer uploaded(Device &device, const BufferPlan &plan, std::span<const std::byte> bytes) {
    Buffer buffer(device, plan);
    buffer.upload(bytes);
    return buffer;
}

struct Tree {
    Buffer nodes;
    layout::FrameRecord constants{};               ///< of skip lists, or none
    std::vector<layout::InstanceRecord> instances; ///< likewise
};

/// Uploads the tree. The lists on the host, the largest part of a large scene, are freed when this returns.
Tree uploadTree(Device &device, const PackedScene &scene, const ScenePlan &plan, bool isSkipList) {
    const BufferPlan &planned = plan.buffers[layout::bindingNodes];
    if (!isSkipList)
        return {uploaded(device, planned, std::as_bytes(std::span(scene.nodes))), {}, {}};
    const SkipList list = makeSkipList(scene);
    layout::FrameRecord constants{};
    if (!list.trees.empty()) {
        constants.gridMiddle = list.trees.front().grid.middle;
        constants.gridScale = list.trees.front().grid.scale;
        constants.topListLength = list.trees.front().end;
    }
    constants.skipListLength = list.length;
    const std::span<const std::byte> bytes = std::as_bytes(std::span(list.nodes));
    BufferPlan nodes = planned;
    nodes.sizeBytes = bytes.size();
    assert(nodes.sizeBytes <= planned.sizeBytes);
    return {uploaded(device, nodes, bytes), constants, instancesOnGrids(scene, list)};
}

} // namespace

SceneBuffers::SceneBuffers(Device &device, const PackedScene &scene, const ScenePlan &plan, bool isSkipList) {
    Tree tree = uploadTree(device, scene, plan, isSkipList);
    std::array<std::span<const std::byte>, layout::sceneBufferCount> bytes;
    bytes[layout::bindingSphereConstants] = std::as_bytes(std::span(scene.loopSpheres));
    bytes[layout::bindingLightConstants] = std::as_bytes(
        std::span(scene.lights).first(std::min<std::size_t>(scene.lights.size(), layout::maxUniformLights)));
    bytes[layout::bindingPairConstants] = std::as_bytes(std::span(scene.trianglePairs));
    for (const SceneArray &array : scene.arrays())
        bytes[array.binding] = array.bytes;
    if (isSkipList)
        bytes[layout::bindingInstances] = std::as_bytes(std::span(tree.instances));
    for (std::size_t binding = 0; binding < plan.buffers.size(); ++binding)
        buffers.push_back(binding == layout::bindingNodes
                              ? std::move(tree.nodes)
                              : uploaded(device, plan.buffers[binding], bytes[binding]));
    ofTree_ = tree.constants;
}

void SceneBuffers::setFrame(const layout::FrameRecord &frame) {
    layout::FrameRecord record = frame;
    record.gridMiddle = ofTree_.gridMiddle;
    record.gridScale = ofTree_.gridScale;
    record.topListLength = ofTree_.topListLength;
    record.skipListLength = ofTree_.skipListLength;
    buffers[layout::bindingFrame].upload(std::as_bytes(std::span(&record, 1)));
}

} // namespace hyalite::gpu
