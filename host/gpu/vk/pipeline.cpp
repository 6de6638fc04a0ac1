#include "host/gpu/vk/pipeline.h"

#include "host/gpu/spirv/one_armed.h"
#include "host/gpu/spirv/renumber.h"
#include "host/gpu/spirv/specialise.h"
#include "host/gpu/vk/check.h"
#include "host/gpu/vk/float_controls.h"
#include "shaders/layout/layout.h"

#include <vector>

namespace hyalite::core::gpu {

VkDescriptorType descriptorTypeOf(BufferUse use) {
    switch (use) {
    case BufferUse::Uniform:
        return VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER;
    case BufferUse::Texels:
        return VK_DESCRIPTOR_TYPE_STORAGE_TEXEL_BUFFER;
    case BufferUse::TopLevel:
        return VK_DESCRIPTOR_TYPE_ACCELERATION_STRUCTURE_KHR;
    default:
        return VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    }
}

Pipeline::Pipeline(Device &device, std::string name, std::span<const std::uint32_t> spirv,
                   std::span<const std::uint32_t> constants, std::span<const BufferUse> bindings)
    : name_(std::move(name)) {
    makeLayouts(device, bindings);
    makePipeline(device, spirv, constants);
}

void Pipeline::makeLayouts(Device &device, std::span<const BufferUse> uses) {
    std::vector<VkDescriptorSetLayoutBinding> bindings;
    for (const BufferUse use : uses) {
        VkDescriptorSetLayoutBinding binding{};
        binding.binding = static_cast<std::uint32_t>(bindings.size());
        binding.descriptorType = descriptorTypeOf(use);
        binding.descriptorCount = 1;
        binding.stageFlags = VK_SHADER_STAGE_COMPUTE_BIT;
        bindings.push_back(binding);
    }
    VkDescriptorSetLayoutCreateInfo setInfo{};
    setInfo.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO;
    setInfo.bindingCount = static_cast<std::uint32_t>(bindings.size());
    setInfo.pBindings = bindings.data();
    VkDescriptorSetLayout setLayout = VK_NULL_HANDLE;
    check(vkCreateDescriptorSetLayout(device.get(), &setInfo, nullptr, &setLayout),
          "vkCreateDescriptorSetLayout for " + name_);
    setLayout_ = SetLayoutHandle(device.get(), setLayout);
    device.debugUtils().name(VK_OBJECT_TYPE_DESCRIPTOR_SET_LAYOUT, setLayout, "bindings of " + name_);

    const VkPushConstantRange pushRange{VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof(layout::DispatchConstants)};
    VkPipelineLayoutCreateInfo layoutInfo{};
    layoutInfo.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
    layoutInfo.setLayoutCount = 1;
    layoutInfo.pSetLayouts = &setLayout;
    layoutInfo.pushConstantRangeCount = 1;
    layoutInfo.pPushConstantRanges = &pushRange;
    VkPipelineLayout pipelineLayout = VK_NULL_HANDLE;
    check(vkCreatePipelineLayout(device.get(), &layoutInfo, nullptr, &pipelineLayout),
          "vkCreatePipelineLayout for " + name_);
    layout_ = PipelineLayoutHandle(device.get(), pipelineLayout);
    device.debugUtils().name(VK_OBJECT_TYPE_PIPELINE_LAYOUT, pipelineLayout, "layout of " + name_);
}

void Pipeline::makePipeline(Device &device, std::span<const std::uint32_t> spirv,
                            std::span<const std::uint32_t> constants) {
    const std::vector<std::uint32_t> words =
        addFloatControls(makeSelectionsOneArmed(renumber(specialise(spirv, constants))),
                         {device.info().canRoundToNearestEven, device.info().canPreserveSignedZeroInfNan});
    VkShaderModuleCreateInfo moduleInfo{};
    moduleInfo.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO;
    moduleInfo.codeSize = std::span(words).size_bytes();
    moduleInfo.pCode = words.data();
    VkShaderModule module = VK_NULL_HANDLE;
    check(vkCreateShaderModule(device.get(), &moduleInfo, nullptr, &module),
          "vkCreateShaderModule for " + name_);
    const ShaderModuleHandle moduleOwner(device.get(), module);
    device.debugUtils().name(VK_OBJECT_TYPE_SHADER_MODULE, module, name_);

    VkComputePipelineCreateInfo pipelineInfo{};
    pipelineInfo.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO;
    pipelineInfo.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
    pipelineInfo.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
    pipelineInfo.stage.module = module;
    pipelineInfo.stage.pName = "main";
    pipelineInfo.layout = layout_.get();
    VkPipeline pipeline = VK_NULL_HANDLE;
    check(vkCreateComputePipelines(device.get(), VK_NULL_HANDLE, 1, &pipelineInfo, nullptr, &pipeline),
          "vkCreateComputePipelines for " + name_);
    pipeline_ = PipelineHandle(device.get(), pipeline);
    device.debugUtils().name(VK_OBJECT_TYPE_PIPELINE, pipeline, name_);
}

} // namespace hyalite::core::gpu
