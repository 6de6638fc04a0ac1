#include "host/gpu/kernel.h"

#include "host/gpu/vk/check.h"

#include <fmt/format.h>

#include <vector>

namespace hyalite::core::gpu {

namespace {

/// Names the tile and samples of a dispatch, for labels and messages.
std::string describeTile(const layout::DispatchConstants &dispatch) {
    if (dispatch.tileWidth == 0)
        return {};
    return fmt::format(", tile ({}, {}), samples {} to {}{}", dispatch.cropX + dispatch.tileX,
                       dispatch.cropY + dispatch.tileY, dispatch.sampleBegin, dispatch.sampleEnd,
                       dispatch.isResumed != 0 ? ", resumed" : "");
}

/// In the order of the buffers.
std::vector<BufferUse> usesOf(std::span<const Buffer *const> buffers) {
    std::vector<BufferUse> uses;
    for (const Buffer *buffer : buffers)
        uses.push_back(buffer->use());
    return uses;
}

} // namespace

Kernel::Kernel(Device &device, std::shared_ptr<Pipeline> pipeline, std::span<const Buffer *const> buffers)
    : device_(device), pipeline_(std::move(pipeline)) {
    makeDescriptors(buffers);
}

Kernel::Kernel(Device &device, std::string name, std::span<const std::uint32_t> spirv,
               std::span<const std::uint32_t> constants, std::span<const Buffer *const> buffers)
    : Kernel(device, std::make_shared<Pipeline>(device, std::move(name), spirv, constants, usesOf(buffers)),
             buffers) {}

void Kernel::makeDescriptors(std::span<const Buffer *const> buffers) {
    std::vector<VkDescriptorPoolSize> sizes;
    for (const Buffer *buffer : buffers)
        sizes.push_back({descriptorTypeOf(buffer->use()), 1});
    VkDescriptorPoolCreateInfo poolInfo{};
    poolInfo.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO;
    poolInfo.maxSets = 1;
    poolInfo.poolSizeCount = static_cast<std::uint32_t>(sizes.size());
    poolInfo.pPoolSizes = sizes.data();
    VkDescriptorPool pool = VK_NULL_HANDLE;
    check(vkCreateDescriptorPool(device_.get(), &poolInfo, nullptr, &pool),
          "vkCreateDescriptorPool for " + pipeline_->name());
    descriptorPool_ = DescriptorPoolHandle(device_.get(), pool);
    device_.debugUtils().name(VK_OBJECT_TYPE_DESCRIPTOR_POOL, pool, "descriptors of " + pipeline_->name());

    const VkDescriptorSetLayout setLayout = pipeline_->setLayout();
    VkDescriptorSetAllocateInfo allocate{};
    allocate.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO;
    allocate.descriptorPool = pool;
    allocate.descriptorSetCount = 1;
    allocate.pSetLayouts = &setLayout;
    check(vkAllocateDescriptorSets(device_.get(), &allocate, &descriptorSet_),
          "vkAllocateDescriptorSets for " + pipeline_->name());
    device_.debugUtils().name(VK_OBJECT_TYPE_DESCRIPTOR_SET, descriptorSet_,
                              "buffers of " + pipeline_->name());

    std::vector<VkDescriptorBufferInfo> infos(buffers.size());
    std::vector<VkBufferView> views(buffers.size());
    VkAccelerationStructureKHR structure = VK_NULL_HANDLE;
    VkWriteDescriptorSetAccelerationStructureKHR structureInfo{};
    structureInfo.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET_ACCELERATION_STRUCTURE_KHR;
    structureInfo.accelerationStructureCount = 1;
    structureInfo.pAccelerationStructures = &structure; // a kernel has one at most
    std::vector<VkWriteDescriptorSet> writes(buffers.size());
    for (std::size_t i = 0; i < buffers.size(); ++i) {
        writes[i].sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
        writes[i].dstSet = descriptorSet_;
        writes[i].dstBinding = static_cast<std::uint32_t>(i);
        writes[i].descriptorCount = 1;
        writes[i].descriptorType = descriptorTypeOf(buffers[i]->use());
        if (buffers[i]->use() == BufferUse::Texels) {
            views[i] = buffers[i]->view();
            writes[i].pTexelBufferView = &views[i];
        } else if (buffers[i]->use() == BufferUse::TopLevel) {
            structure = buffers[i]->structure();
            writes[i].pNext = &structureInfo;
        } else {
            infos[i] = {buffers[i]->get(), 0, VK_WHOLE_SIZE};
            writes[i].pBufferInfo = &infos[i];
        }
    }
    vkUpdateDescriptorSets(device_.get(), static_cast<std::uint32_t>(writes.size()), writes.data(), 0,
                           nullptr);
}

void Kernel::record(VkCommandBuffer commands, const layout::DispatchConstants &constants,
                    std::uint32_t workgroupCount) const {
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline_->get());
    vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline_->layout(), 0, 1,
                            &descriptorSet_, 0, nullptr);
    vkCmdPushConstants(commands, pipeline_->layout(), VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof(constants),
                       &constants);
    vkCmdDispatch(commands, workgroupCount, 1, 1);
    VkMemoryBarrier barrier{};
    barrier.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER;
    barrier.srcAccessMask = VK_ACCESS_SHADER_WRITE_BIT;
    barrier.dstAccessMask = VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_SHADER_WRITE_BIT | VK_ACCESS_HOST_READ_BIT;
    vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT,
                         VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_HOST_BIT, 0, 1, &barrier, 0,
                         nullptr, 0, nullptr);
}

RunTimes Kernel::submit(const layout::DispatchConstants &constants,
                        const std::function<void(VkCommandBuffer)> &record) {
    Timestamps &timestamps = device_.timestamps();
    Stopwatch watch;
    device_.submit("kernel " + pipeline_->name() + describeTile(constants), [&](VkCommandBuffer commands) {
        timestamps.writeBegin(commands);
        record(commands);
        timestamps.writeEnd(commands);
    });
    const Span host = watch.lap();
    return {host, timestamps.read(host)};
}

RunTimes Kernel::run(const layout::DispatchConstants &constants, std::uint32_t workgroupCount) {
    const RunTimes times =
        submit(constants, [&](VkCommandBuffer commands) { record(commands, constants, workgroupCount); });
    pipeline_->setRun();
    return times;
}

RunTimes Kernel::run(const layout::DispatchConstants &constants, std::uint32_t workgroupCount,
                     const Kernel &next, std::uint32_t nextWorkgroupCount) {
    const RunTimes times = submit(constants, [&](VkCommandBuffer commands) {
        record(commands, constants, workgroupCount);
        next.record(commands, constants, nextWorkgroupCount);
    });
    pipeline_->setRun();
    next.pipeline_->setRun();
    return times;
}

} // namespace hyalite::core::gpu
