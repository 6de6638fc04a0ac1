#include "host/gpu/scene_buffers.h"

#include "host/base/error.h"
#include "host/gpu/vk/ray_query.h"
#include "host/packing/primitive_boxes.h"
#include "host/packing/wide_tree.h"

#include <fmt/format.h>

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

/// Frees its memory, which assigning {} would keep.
template <class Vector> void release(Vector &vector) { vector = Vector(); }

void requireQueryBoxes(std::uint64_t count, const DeviceInfo &device) {
    if (count > device.maxQueryBoxes)
        throw Error(
            ErrorKind::LimitExceeded,
            fmt::format("ray queries need {} boxes, one for each primitive of each instance; {} allows {}",
                        count, device.name, device.maxQueryBoxes));
}

} // namespace

SceneBuffers::SceneBuffers(Device &device, const PackedScene &scene, const ScenePlan &plan,
                           const KernelRow &kernel)
    : lists_(kernel.tree == KernelTree::SkipLists ? makeSkipList(scene) : SkipList{}) {
    WideTree wide;
    PrimitiveBoxes primitives;
    std::span<const std::byte> treeBytes = std::as_bytes(std::span(scene.nodes));
    std::span<const std::byte> instances = std::as_bytes(std::span(scene.instances));
    if (kernel.tree == KernelTree::SkipLists) {
        treeBytes = std::as_bytes(std::span(lists_.nodes));
        instances = std::as_bytes(std::span(lists_.instances));
    } else if (kernel.tree == KernelTree::WideNodes) {
        wide = makeWideTree(scene);
        treeBytes = std::as_bytes(std::span(wide.nodes));
        instances = std::as_bytes(std::span(wide.instances));
    } else if (kernel.tree == KernelTree::PrimitiveBoxes) {
        requireQueryBoxes(countPrimitiveBoxes(scene), device.info());
        primitives = makePrimitiveBoxes(scene);
        ownTriangles_ = primitives.counts.front();
        instances = std::as_bytes(std::span(primitives.instances));
    }
    const auto makeTree = [&] {
        BufferPlan treePlan = plan.buffers[layout::bindingNodes];
        assert(treeBytes.size() <= treePlan.sizeBytes);
        treePlan.sizeBytes = treeBytes.size();
        return uploaded(device, treePlan, treeBytes);
    };
    const auto makeQueryTree = [&] {
        QueryTree tree = buildQueryTree(device, primitives.boxes, primitives.counts);
        boxes_.emplace(std::move(tree.bottom));
        return std::move(tree.top);
    };
    Buffer tree = kernel.tree == KernelTree::PrimitiveBoxes ? makeQueryTree() : makeTree();
    // The largest part of a large scene: before the other buffers take memory.
    release(lists_.nodes);
    release(wide.nodes);
    release(primitives.boxes);

    std::array<std::span<const std::byte>, layout::sceneBufferCount> bytes;
    bytes[layout::bindingSphereConstants] = std::as_bytes(std::span(scene.loopSpheres));
    bytes[layout::bindingLightConstants] = std::as_bytes(
        std::span(scene.lights).first(std::min<std::size_t>(scene.lights.size(), layout::maxUniformLights)));
    bytes[layout::bindingPairConstants] = std::as_bytes(std::span(scene.trianglePairs));
    for (const SceneArray &array : scene.arrays())
        bytes[array.binding] = array.bytes;
    bytes[layout::bindingInstances] = instances;
    for (std::size_t binding = 0; binding < plan.buffers.size(); ++binding)
        if (binding != layout::bindingNodes)
            buffers.push_back(uploaded(device, plan.buffers[binding], bytes[binding]));
    buffers.insert(buffers.begin() + layout::bindingNodes, std::move(tree));
    release(lists_.instances);
}

void SceneBuffers::setFrame(const layout::FrameRecord &frame) {
    layout::FrameRecord record = frame;
    lists_.describe(record);
    if (boxes_)
        record.topListLength = ownTriangles_;
    buffers[layout::bindingFrame].upload(std::as_bytes(std::span(&record, 1)));
}

} // namespace hyalite::core::gpu
