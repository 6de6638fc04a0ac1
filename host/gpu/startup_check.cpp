#include "host/gpu/startup_check.h"

#include "host/gpu/hard_inputs.h"
#include "host/gpu/kernel.h"
#include "shaders/embedded_kernels.h"

#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <vector>

namespace hyalite::core::gpu {

namespace {

constexpr std::size_t inputCount = 1024;
constexpr std::uint32_t groupSize = 64;
constexpr std::size_t divisionsPerInput = 2;
constexpr std::size_t othersPerInput = 6;

std::size_t differs(float a, float b) {
    return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b) ? 0 : 1;
}

std::uint32_t comparisonsOf(const layout::HardInput &input) {
    const float sum = input.addend + input.otherAddend;
    std::uint32_t comparisons = layout::areZerosEqual | layout::isZeroNotLess;
    comparisons |= input.addend < input.otherAddend ? layout::isLess : 0u;
    comparisons |= input.addend <= input.otherAddend ? layout::isAtMost : 0u;
    comparisons |= input.addend == input.otherAddend ? layout::isEqual : 0u;
    comparisons |= sum > input.addend ? layout::isSumGreater : 0u;
    return comparisons;
}

} // namespace

WrongResults countWrongResults(std::span<const layout::HardInput> inputs,
                               std::span<const layout::CheckResult> results) {
    assert(results.size() == inputs.size());
    WrongResults wrong;
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        const layout::HardInput &input = inputs[i];
        const layout::CheckResult &result = results[i];
        wrong.divisions += differs(result.quotient, input.numerator / input.denominator);
        wrong.divisions += differs(result.root, std::sqrt(input.square));
        wrong.others += differs(result.sum, input.addend + input.otherAddend);
        wrong.others += differs(result.difference, input.addend - input.otherAddend);
        wrong.others += differs(result.product, input.factor * input.otherFactor);
        wrong.others += differs(result.rounded, static_cast<float>(input.integer));
        wrong.others += result.truncated == static_cast<std::int32_t>(input.numerator) ? 0 : 1;
        wrong.others += result.comparisons == comparisonsOf(input) ? 0 : 1;
    }
    return wrong;
}

std::uint32_t countConsecutiveLanes(std::span<const layout::CheckResult> results,
                                    std::uint32_t workgroupSize) {
    assert(results.size() % workgroupSize == 0);
    std::uint32_t lanes = workgroupSize;
    for (std::uint32_t i = 0; i < results.size(); ++i)
        for (;; lanes /= 2) {
            const layout::CheckResult &first = results[i / lanes * lanes];
            if (results[i].subgroup == first.subgroup && first.lane % lanes == 0 &&
                results[i].lane == first.lane + i % lanes)
                break;
        }
    return lanes;
}

StartupCheck checkDevice(Device &device) {
    const std::vector<layout::HardInput> inputs = makeHardInputs(inputCount);
    std::vector<layout::CheckResult> results(inputCount);
    Buffer inputBuffer(device, "the inputs of the start-up check", BufferUse::Counters,
                       std::as_bytes(std::span(inputs)).size());
    inputBuffer.upload(std::as_bytes(std::span(inputs)));
    const Buffer resultBuffer(device, "the results of the start-up check", BufferUse::Counters,
                              std::as_bytes(std::span(results)).size());
    const std::array<const Buffer *, 2> buffers{&inputBuffer, &resultBuffer};
    Kernel kernel(device, "startupCheck", embeddedKernel("startupCheck"), {}, buffers);
    kernel.run({}, inputCount / groupSize);
    resultBuffer.download(std::as_writable_bytes(std::span(results)));
    return {inputCount * divisionsPerInput, inputCount * othersPerInput, countWrongResults(inputs, results),
            countConsecutiveLanes(results, groupSize)};
}

} // namespace hyalite::core::gpu
