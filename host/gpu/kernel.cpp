#include "host/gpu/kernel.h"

#include "host/gpu/check.h"
#include "host/gpu/float_controls.h"

#include <fmt/format.h>

#include <vector>

namespace hyalite::gpu {

namespace {

VkDescriptorType descriptorType(const Buffer &buffer) {
    switch (buffer.use()) {
    case BufferUse::Uniform:
        return VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER;
    case BufferUse::Texels:
        return VK_DESCRIPTOR_TYPE_STORAGE_TEXEL_BUFFER;
    default:
        return VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    }
}

/// Which part of the image a dispatch works on, for labels and messages.
std::string describeTile(const layout::DispatchConstants &dispatch) {
    if (dispatch.tileWidth == 0)
        return {};
    return fmt::format(", tile ({}, {}), samples {} to {}{}", dispatch.cropX + dispatch.tileX,
                       dispatch.cropY + dispatch.tileY, dispatch.sampleBegin, dispatch.sampleEnd,
                       dispatch.isResumed != 0 ? ", resumed" : "");
}

} // namespace

Kernel::Kernel(Device &device, std::string name, std::span<const std::uint32_t> spirv,
               std::span<const std::uint32_t> constants, std::span<const Buffer *const> buffers)
    : device_(device), name_(std::move(name)) {
    makeLayouts(buffers);
    makePipeline(spirv, constants);
    makeDescriptors(buffers);
}

void Kernel::makeLayouts(std::span<const Buffer *const> buffers) {
    std::vector<VkDescriptorSetLayoutBinding> bindings;
    for (const Buffer *buffer : buffers) {
        VkDescriptorSetLayoutBinding binding{};
        binding.binding = static_cast<std::uint32_t>(bindings.size());
        binding.descriptorType = descriptorType(*buffer);
        binding.descriptorCount = 1;
        binding.stageFlags = VK_SHADER_STAGE_COMPUTE_BIT;
        bindings.push_back(binding);
    }
    VkDescriptorSetLayoutCreateInfo setInfo{};
    setInfo.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO;
    setInfo.bindingCount = static_cast<std::uint32_t>(bindings.size());
    setInfo.pBindings = bindings.data();
    VkDescriptorSetLayout setLayout = VK_NULL_HANDLE;
    check(vkCreateDescriptorSetLayout(device_.get(), &setInfo, nullptr, &setLayout),
          "vkCreateDescriptorSetLayout for " + name_);
    setLayout_ = SetLayoutHandle(device_.get(), setLayout);
    device_.debugUtils().name(VK_OBJECT_TYPE_DESCRIPTOR_SET_LAYOUT, setLayout, "bindings of " + name_);

    const VkPushConstantRange pushRange{VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof(layout::DispatchConstants)};
    VkPipelineLayoutCreateInfo layoutInfo{};
    layoutInfo.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
    layoutInfo.setLayoutCount = 1;
    layoutInfo.pSetLayouts = &setLayout;
    layoutInfo.pushConstantRangeCount = 1;
    layoutInfo.pPushConstantRanges = &pushRange;
    VkPipelineLayout pipelineLayout = VK_NULL_HANDLE;
    check(vkCreatePipelineLayout(device_.get(), &layoutInfo, nullptr, &pipelineLayout),
          "vkCreatePipelineLayout for " + name_);
    pipelineLayout_ = PipelineLayoutHandle(device_.get(), pipelineLayout);
    device_.debugUtils().name(VK_OBJECT_TYPE_PIPELINE_LAYOUT, pipelineLayout, "layout of " + name_);
}

void Kernel::makePipeline(std::span<const std::uint32_t> spirv, std::span<const std::uint32_t> constants) {
    const std::vector<std::uint32_t> words = addFloatControls(
        spirv, {device_.info().canRoundToNearestEven, device_.info().canPreserveSignedZeroInfNan});
    VkShaderModuleCreateInfo moduleInfo{};
    moduleInfo.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO;
    moduleInfo.codeSize = std::span(words).size_bytes();
    moduleInfo.pCode = words.data();
    VkShaderModule module = VK_NULL_HANDLE;
    check(vkCreateShaderModule(device_.get(), &moduleInfo, nullptr, &module),
          "vkCreateShaderModule for " + name_);
    const ShaderModuleHandle moduleOwner(device_.get(), module);
    device_.debugUtils().name(VK_OBJECT_TYPE_SHADER_MODULE, module, name_);

    std::vector<VkSpecializationMapEntry> entries;
    for (std::uint32_t id = 0; id < constants.size(); ++id)
        entries.push_back({id, id * std::uint32_t{sizeof(std::uint32_t)}, sizeof(std::uint32_t)});
    VkSpecializationInfo specialization{};
    specialization.mapEntryCount = static_cast<std::uint32_t>(entries.size());
    specialization.pMapEntries = entries.data();
    specialization.dataSize = constants.size_bytes();
    specialization.pData = constants.data();
    VkComputePipelineCreateInfo pipelineInfo{};
    pipelineInfo.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO;
    pipelineInfo.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
    pipelineInfo.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
    pipelineInfo.stage.module = module;
    pipelineInfo.stage.pName = "main";
    pipelineInfo.stage.pSpecializationInfo = &specialization;
    pipelineInfo.layout = pipelineLayout_.get();
    VkPipeline pipeline = VK_NULL_HANDLE;
    check(vkCreateComputePipelines(device_.get(), VK_NULL_HANDLE, 1, &pipelineInfo, nullptr, &pipeline),
          "vkCreateComputePipelines for " + name_);
    pipeline_ = PipelineHandle(device_.get(), pipeline);
    device_.debugUtils().name(VK_OBJECT_TYPE_PIPELINE, pipeline, name_);
}

void Kernel::makeDescriptors(std::span<const Buffer *const> buffers) {
    std::vector<VkDescriptorPoolSize> sizes;
    for (const Buffer *buffer : buffers)
        sizes.push_back({descriptorType(*buffer), 1});
    VkDescriptorPoolCreateInfo poolInfo{};
    poolInfo.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO;
    poolInfo.maxSets = 1;
    poolInfo.poolSizeCount = static_cast<std::uint32_t>(sizes.size());
    poolInfo.pPoolSizes = sizes.data();
    VkDescriptorPool pool = VK_NULL_HANDLE;
    check(vkCreateDescriptorPool(device_.get(), &poolInfo, nullptr, &pool),
          "vkCreateDescriptorPool for " + name_);
    descriptorPool_ = DescriptorPoolHandle(device_.get(), pool);
    device_.debugUtils().name(VK_OBJECT_TYPE_DESCRIPTOR_POOL, pool, "descriptors of " + name_);

    const VkDescriptorSetLayout setLayout = setLayout_.get();
    VkDescriptorSetAllocateInfo allocate{};
    allocate.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO;
    allocate.descriptorPool = pool;
    allocate.descriptorSetCount = 1;
    allocate.pSetLayouts = &setLayout;
    check(vkAllocateDescriptorSets(device_.get(), &allocate, &descriptorSet_),
          "vkAllocateDescriptorSets for " + name_);
    device_.debugUtils().name(VK_OBJECT_TYPE_DESCRIPTOR_SET, descriptorSet_, "buffers of " + name_);

    std::vector<VkDescriptorBufferInfo> infos(buffers.size());
    std::vector<VkBufferView> views(buffers.size());
    std::vector<VkWriteDescriptorSet> writes(buffers.size());
    for (std::size_t i = 0; i < buffers.size(); ++i) {
        writes[i].sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
        writes[i].dstSet = descriptorSet_;
        writes[i].dstBinding = static_cast<std::uint32_t>(i);
        writes[i].descriptorCount = 1;
        writes[i].descriptorType = descriptorType(*buffers[i]);
        if (buffers[i]->use() == BufferUse::Texels) {
            views[i] = buffers[i]->view();
            writes[i].pTexelBufferView = &views[i];
        } else {
            infos[i] = {buffers[i]->get(), 0, VK_WHOLE_SIZE};
            writes[i].pBufferInfo = &infos[i];
        }
    }
    vkUpdateDescriptorSets(device_.get(), static_cast<std::uint32_t>(writes.size()), writes.data(), 0,
                           nullptr);
}

RunTimes Kernel::run(const layout::DispatchConstants &constants, std::uint32_t workgroupCount) {
    Timestamps &timestamps = device_.timestamps();
    Stopwatch watch;
    device_.submit("kernel " + name_ + describeTile(constants), [&](VkCommandBuffer commands) {
        vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline_.get());
        vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipelineLayout_.get(), 0, 1,
                                &descriptorSet_, 0, nullptr);
        vkCmdPushConstants(commands, pipelineLayout_.get(), VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof(constants),
                           &constants);
        timestamps.writeBegin(commands);
        vkCmdDispatch(commands, workgroupCount, 1, 1);
        timestamps.writeEnd(commands);
        VkMemoryBarrier barrier{};
        barrier.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER;
        barrier.srcAccessMask = VK_ACCESS_SHADER_WRITE_BIT;
        barrier.dstAccessMask =
            VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_SHADER_WRITE_BIT | VK_ACCESS_HOST_READ_BIT;
        vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT,
                             VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_HOST_BIT, 0, 1,
                             &barrier, 0, nullptr, 0, nullptr);
    });
    const Span host = watch.lap();
    return {host, timestamps.read(host)};
}

} // namespace hyalite::gpu
