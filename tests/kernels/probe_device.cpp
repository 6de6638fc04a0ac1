#include "tests/kernels/probe_device.h"

#include "probeKernel.h"
#include "tests/fixtures/test_device.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>

namespace hyalite::core::testing {

namespace {

constexpr std::uint32_t workgroupSize = 64;

std::string describe(const std::uint32_t *words, std::size_t count) {
    std::string text;
    for (std::size_t i = 0; i < count; ++i)
        text += fmt::format(" {:08x} ({:.9g})", words[i], std::bit_cast<float>(words[i]));
    return text;
}

} // namespace

gpu::Device &probeDevice() {
    static gpu::Device device(testing::testDevice());
    return device;
}

Probe::Probe(std::uint32_t function, std::size_t inputWords, std::size_t outputWords,
             gpu::Arithmetic arithmetic, const ProbeScene &scene)
    : outputWords_(outputWords) {
    for (std::uint32_t binding = 0; binding < probeBindingCount; ++binding) {
        gpu::BufferUse use = gpu::BufferUse::Storage;
        std::size_t sizeBytes = 256; // of the scene's buffers, which nothing reads
        if (binding < layout::uniformBufferCount) {
            use = gpu::BufferUse::Uniform;
            sizeBytes = sizeof(layout::SphereRecord) * layout::maxUnrolledSpheres;
        } else if (binding == bindingProbeInputs) {
            sizeBytes = probeInputCount * inputWords * sizeof(std::uint32_t);
        } else if (binding == bindingProbeOutputs) {
            sizeBytes = probeInputCount * outputWords * sizeof(std::uint32_t);
        } else if (binding == layout::bindingLookups) {
            sizeBytes = std::max(sizeBytes, std::span(scene.lookups).size_bytes());
        } else if (binding == layout::bindingTextures) {
            sizeBytes = std::max(sizeBytes, std::span(scene.textures).size_bytes());
        }
        buffers_.push_back(
            std::make_unique<gpu::Buffer>(probeDevice(), fmt::format("binding {}", binding), use, sizeBytes));
    }
    if (!scene.lookups.empty())
        buffers_[layout::bindingLookups]->upload(std::as_bytes(std::span(scene.lookups)));
    if (!scene.textures.empty())
        buffers_[layout::bindingTextures]->upload(std::as_bytes(std::span(scene.textures)));
    buffers_[layout::bindingFrame]->upload(std::as_bytes(std::span(&scene.frame, 1)));

    std::array<std::uint32_t, probeConstantCount> constants{};
    constants[layout::constantWorkgroupSize] = workgroupSize;
    constants[layout::constantHasTriangles] = 1;
    constants[layout::constantSampler] = scene.samplerKind;
    constants[layout::constantExactDivision] = arithmetic == gpu::Arithmetic::Native;
    constants[layout::constantScattering] = scene.scattering;
    constants[layout::constantTexturing] = scene.texturing;
    constants[layout::constantCamera] = scene.camera;
    constants[constantProbedFunction] = function;
    constants[constantInputWords] = static_cast<std::uint32_t>(inputWords);
    constants[constantOutputWords] = static_cast<std::uint32_t>(outputWords);
    std::vector<const gpu::Buffer *> bound;
    for (const std::unique_ptr<gpu::Buffer> &buffer : buffers_)
        bound.push_back(buffer.get());
    kernel_ = std::make_unique<gpu::Kernel>(probeDevice(), "probe", probeKernel, constants, bound);
}

std::vector<std::uint32_t> Probe::run(const std::vector<std::uint32_t> &inputs) {
    buffers_[bindingProbeInputs]->upload(std::as_bytes(std::span(inputs)));
    kernel_->run({}, probeInputCount / workgroupSize);
    std::vector<std::uint32_t> outputs(probeInputCount * outputWords_);
    buffers_[bindingProbeOutputs]->download(std::as_writable_bytes(std::span(outputs)));
    return outputs;
}

bool isDivisionNative() {
    static const bool isNative = gpu::chooseArithmetic(probeDevice().info(), gpu::checkDevice(probeDevice()),
                                                       gpu::Arithmetic::Automatic)
                                     .isNative;
    return isNative;
}

void expectTwin(std::uint32_t function, const TwinCall &call, const ProbeScene &scene) {
    Draw draw;
    Words input;
    Words expected;
    std::vector<std::uint32_t> inputs;
    std::vector<Words::Word> wanted;
    for (std::size_t i = 0; i < probeInputCount; ++i) {
        input.clear();
        expected.clear();
        call(draw, input, expected);
        for (const Words::Word &word : input.get())
            inputs.push_back(word.bits);
        wanted.insert(wanted.end(), expected.get().begin(), expected.get().end());
    }
    const std::size_t inputWords = input.get().size();
    const std::size_t outputWords = expected.get().size();
    ASSERT_EQ(inputs.size(), probeInputCount * inputWords);
    ASSERT_EQ(wanted.size(), probeInputCount * outputWords);

    for (const gpu::Arithmetic arithmetic : {gpu::Arithmetic::Native, gpu::Arithmetic::Own}) {
        if (arithmetic == gpu::Arithmetic::Native && !isDivisionNative())
            continue;
        Probe probe(function, inputWords, outputWords, arithmetic, scene);
        const std::vector<std::uint32_t> results = probe.run(inputs);
        std::size_t wrongCount = 0;
        std::string first;
        for (std::size_t i = 0; i < results.size(); ++i) {
            if (isSame(wanted[i], results[i]))
                continue;
            if (wrongCount++ > 0)
                continue;
            const std::size_t at = i / outputWords;
            first = fmt::format("input {} of seed {}:{}\nword {}: the host has{}, the device{}", at,
                                Draw::seed, describe(&inputs[at * inputWords], inputWords), i % outputWords,
                                describe(&wanted[i].bits, 1), describe(&results[i], 1));
        }
        EXPECT_EQ(wrongCount, 0u) << (arithmetic == gpu::Arithmetic::Native ? "native" : "own")
                                  << " / and sqrt\n"
                                  << first;
    }
}

} // namespace hyalite::core::testing
