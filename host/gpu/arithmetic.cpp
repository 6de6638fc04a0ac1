#include "host/gpu/arithmetic.h"

#include "host/gpu/hard_inputs.h"
#include "host/gpu/kernel.h"
#include "shaders/embedded_kernels.h"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <vector>

namespace hyalite::gpu {

namespace {

constexpr std::uint32_t listedDrivers[] = {
    // It compiles / and sqrt to divps and sqrtps, which IEEE 754 defines. Checked: 2^18 random inputs, all sqrt
    // significands, hard inputs (tests/kernels).
    VK_DRIVER_ID_MESA_LLVMPIPE,
};

constexpr std::size_t checkedInputCount = 1024;
constexpr std::size_t checkWorkgroupSize = 64;

bool isSameFloat(float a, float b) {
    return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b);
}

} // namespace

bool isExactDivisionListed(std::uint32_t driverId) {
    for (const std::uint32_t listed : listedDrivers)
        if (driverId == listed)
            return true;
    return false;
}

std::string explainUnpromisedBits(const DeviceInfo &device) {
    if (!device.canRoundToNearestEven)
        return "the device does not offer rounding to nearest even";
    if (!device.canPreserveSignedZeroInfNan)
        return "the device does not promise to keep signed zeros, infinities and NaN";
    return {};
}

std::size_t countWrongResults(std::span<const HardInput> inputs, std::span<const float> results) {
    assert(results.size() == 2 * inputs.size());
    std::size_t wrongCount = 0;
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        wrongCount += isSameFloat(results[2 * i], inputs[i].numerator / inputs[i].denominator) ? 0u : 1u;
        wrongCount += isSameFloat(results[2 * i + 1], std::sqrt(inputs[i].square)) ? 0u : 1u;
    }
    return wrongCount;
}

std::size_t checkNativeArithmetic(Device &device) {
    const std::vector<HardInput> inputs = makeHardInputs(checkedInputCount);
    std::vector<float> results(2 * inputs.size());
    Buffer inputBuffer(device, "the inputs of the arithmetic check", BufferUse::Counters,
                       std::as_bytes(std::span(inputs)).size());
    inputBuffer.upload(std::as_bytes(std::span(inputs)));
    const Buffer resultBuffer(device, "the results of the arithmetic check", BufferUse::Counters,
                              std::as_bytes(std::span(results)).size());
    const std::array<const Buffer *, 2> buffers{&inputBuffer, &resultBuffer};
    Kernel kernel(device, "checkArithmetic", embeddedKernel("checkArithmetic"), {}, buffers);
    kernel.run({}, checkedInputCount / checkWorkgroupSize);
    resultBuffer.download(std::as_writable_bytes(std::span(results)));
    return countWrongResults(inputs, results);
}

ArithmeticChoice chooseArithmetic(Device &device, Arithmetic wanted) {
    if (wanted == Arithmetic::Native)
        return {true, "as asked"};
    if (wanted == Arithmetic::Own)
        return {false, "as asked"};
    if (!device.info().hasExactDivisionListed)
        return {false, "the driver is not known to round correctly"};
    const std::size_t wrongCount = checkNativeArithmetic(device);
    if (wrongCount > 0)
        return {false, fmt::format("{} of {} results of the start-up check are wrong", wrongCount,
                                   2 * checkedInputCount)};
    return {true, "the driver is known to round correctly, and passes the start-up check"};
}

} // namespace hyalite::gpu
