#include "host/gpu/scene_buffers.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <span>
#include <utility>

namespace hyalite::core::gpu {

namespace {

Buffer uploaded(Device &device, const BufferPlan &plan, std::span<const std::byte> bytes) {
    Buffer buffer(device, plan);
    buffer.upload(bytes);
    return buffer;
}

} // namespace

SceneBuffers::SceneBuffers(Device &device, const PackedScene &scene, const ScenePlan &plan,
                           const KernelRow &kernel)
    : lists_(kernel.tree == KernelTree::SkipLists ? makeSkipList(scene) : SkipList{}) {
    const bool isSkipList = kernel.tree == KernelTree::SkipLists;
    const auto treeBytes =
        isSkipList ? std::as_bytes(std::span(lists_.nodes)) : std::as_bytes(std::span(scene.nodes));
    BufferPlan treePlan = plan.buffers[layout::bindingNodes];
    assert(treeBytes.size() <= treePlan.sizeBytes);
    treePlan.sizeBytes = treeBytes.size();
    Buffer tree = uploaded(device, treePlan, treeBytes);
    lists_.nodes = {}; // the largest part of a large scene: before the other buffers take memory

    std::array<std::span<const std::byte>, layout::sceneBufferCount> bytes;
    bytes[layout::bindingSphereConstants] = std::as_bytes(std::span(scene.loopSpheres));
    bytes[layout::bindingLightConstants] = std::as_bytes(
        std::span(scene.lights).first(std::min<std::size_t>(scene.lights.size(), layout::maxUniformLights)));
    bytes[layout::bindingPairConstants] = std::as_bytes(std::span(scene.trianglePairs));
    for (const SceneArray &array : scene.arrays())
        bytes[array.binding] = array.bytes;
    if (isSkipList)
        bytes[layout::bindingInstances] = std::as_bytes(std::span(lists_.instances));
    for (std::size_t binding = 0; binding < plan.buffers.size(); ++binding)
        if (binding != layout::bindingNodes)
            buffers.push_back(uploaded(device, plan.buffers[binding], bytes[binding]));
    buffers.insert(buffers.begin() + layout::bindingNodes, std::move(tree));
    lists_.instances = {};
}

void SceneBuffers::setFrame(const layout::FrameRecord &frame) {
    layout::FrameRecord record = frame;
    lists_.describe(record);
    buffers[layout::bindingFrame].upload(std::as_bytes(std::span(&record, 1)));
}

} // namespace hyalite::core::gpu
