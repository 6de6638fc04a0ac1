#include "tests/kernels/probe_device.h"

#include "probeKernel.h"
#include "tests/fixtures/test_device.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <map>

namespace hyalite::core::testing {

namespace {

constexpr std::uint32_t workgroupSize = 64;

using SceneBuffers = std::vector<std::unique_ptr<gpu::Buffer>>; // by their bindings

SceneBuffers makeBuffers(const PackedScene *packed) {
    std::vector<std::span<const std::byte>> contents(bindingCount);
    if (packed != nullptr) {
        contents[layout::bindingFrame] = std::as_bytes(std::span(&packed->frame, 1));
        for (const SceneArray &array : packed->arrays())
            contents[array.binding] = array.bytes;
    }
    SceneBuffers buffers;
    for (std::uint32_t binding = 0; binding < bindingCount; ++binding) {
        const bool isUniform = binding < layout::uniformBufferCount;
        constexpr std::size_t uniformBytes = sizeof(layout::TrianglePair) * layout::maxListedTriangles;
        const std::size_t leastBytes = isUniform ? uniformBytes : 256;
        buffers.push_back(
            std::make_unique<gpu::Buffer>(probeDevice(), fmt::format("binding {}", binding),
                                          isUniform ? gpu::BufferUse::Uniform : gpu::BufferUse::Storage,
                                          std::max(leastBytes, contents[binding].size())));
        if (!contents[binding].empty())
            buffers.back()->upload(contents[binding]);
    }
    return buffers;
}

/// Those of a scene are shared.
const SceneBuffers &buffersOf(const PackedScene *packed) {
    static std::map<const PackedScene *, SceneBuffers> made;
    const auto [place, isNew] = made.try_emplace(packed);
    if (isNew)
        place->second = makeBuffers(packed);
    return place->second;
}

void setConstants(const leaves::SceneView<float> &scene, std::vector<std::uint32_t> &constants) {
    constants[layout::constantSphereCount] = scene.sphereCount;
    constants[layout::constantHasTriangles] = scene.hasTriangles;
    constants[layout::constantHasNormals] = scene.hasNormals;
    constants[layout::constantHasInstances] = scene.hasInstances;
    constants[layout::constantTreeSpheres] = scene.treeSpheres;
    constants[layout::constantSampler] = scene.samplerKind;
    constants[layout::constantEmitterCount] = scene.emitterCount;
    constants[layout::constantHasLightTree] = scene.hasLightTree;
    constants[layout::constantInfiniteEmitters] = scene.infiniteEmitterCount;
    constants[layout::constantHasEmission] = scene.hasEmission;
    constants[layout::constantScattering] = scene.scattering;
    constants[layout::constantLighting] = scene.lighting;
    constants[layout::constantCamera] = scene.camera;
    constants[layout::constantTexturing] = scene.texturing;
    constants[layout::constantAnyHit] = scene.anyHit;
    constants[layout::constantPlaceCount] = scene.placeCount;
}

} // namespace

std::string describeWords(const std::uint32_t *words, std::size_t count) {
    std::string text;
    for (std::size_t i = 0; i < count; ++i)
        text += fmt::format(" {:08x} ({:.9g})", words[i], std::bit_cast<float>(words[i]));
    return text;
}

gpu::Device &probeDevice() {
    static gpu::Device device(testing::testDevice());
    return device;
}

Probe::Probe(std::uint32_t function, std::size_t inputWords, std::size_t outputWords,
             gpu::Arithmetic arithmetic, const leaves::SceneView<float> *scene, std::size_t inputCount)
    : inputCount_(inputCount), outputWords_(outputWords),
      inputs_(probeDevice(), "inputs", gpu::BufferUse::Storage,
              inputCount * inputWords * sizeof(std::uint32_t)),
      outputs_(probeDevice(), "outputs", gpu::BufferUse::Storage,
               inputCount * outputWords * sizeof(std::uint32_t)) {
    std::vector<std::uint32_t> constants(probeConstantCount);
    if (scene != nullptr)
        setConstants(*scene, constants);
    constants[layout::constantWorkgroupSize] = workgroupSize;
    constants[layout::constantExactDivision] = arithmetic == gpu::Arithmetic::Native;
    constants[constantProbedFunction] = function;
    constants[constantInputWords] = static_cast<std::uint32_t>(inputWords);
    constants[constantOutputWords] = static_cast<std::uint32_t>(outputWords);
    std::vector<const gpu::Buffer *> bound;
    for (const std::unique_ptr<gpu::Buffer> &buffer : buffersOf(scene != nullptr ? &scene->packed : nullptr))
        bound.push_back(buffer.get());
    bound.push_back(&inputs_);
    bound.push_back(&outputs_);
    kernel_ = std::make_unique<gpu::Kernel>(probeDevice(), "probe", probeKernel, constants, bound);
}

std::vector<std::uint32_t> Probe::run(const std::vector<std::uint32_t> &inputs) {
    if (!inputs.empty())
        inputs_.upload(std::as_bytes(std::span(inputs)));
    kernel_->run({}, static_cast<std::uint32_t>(inputCount_ / workgroupSize));
    std::vector<std::uint32_t> outputs(inputCount_ * outputWords_);
    outputs_.download(std::as_writable_bytes(std::span(outputs)));
    return outputs;
}

bool isDivisionNative() {
    static const bool isNative = gpu::chooseArithmetic(probeDevice().info(), gpu::checkDevice(probeDevice()),
                                                       gpu::Arithmetic::Automatic)
                                     .isNative;
    return isNative;
}

} // namespace hyalite::core::testing
