#include "host/gpu/arithmetic.h"

#include <fmt/format.h>
#include <vulkan/vulkan.h>

namespace hyalite::core::gpu {

namespace {

constexpr std::uint32_t listedDrivers[] = {
    // It compiles / and sqrt to divps and sqrtps, which IEEE 754 defines. Checked: 2^18 random inputs, all sqrt
    // significands, hard inputs (tests/kernels).
    VK_DRIVER_ID_MESA_LLVMPIPE,
};

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

BitGuarantee guaranteeOf(const DeviceInfo &device, const StartupCheck &check) {
    if (device.areBitsPromised())
        return {};
    const std::string lack = explainUnpromisedBits(device);
    if (check.wrong.others > 0)
        return {BitDegree::None, fmt::format("{}, and {} of {} results of the start-up check are wrong", lack,
                                             check.wrong.others, check.otherCount)};
    return {BitDegree::Measured, fmt::format("{}, but the start-up check finds no wrong result", lack)};
}

std::string describe(const BitGuarantee &bits) {
    switch (bits.degree) {
    case BitDegree::Promised:
        return "promised";
    case BitDegree::Measured:
        return "measured: " + bits.reason;
    case BitDegree::None:
        break;
    }
    return "none: " + bits.reason;
}

ArithmeticChoice chooseArithmetic(const DeviceInfo &device, const StartupCheck &check, Arithmetic wanted) {
    if (wanted == Arithmetic::Native)
        return {true, "as asked"};
    if (wanted == Arithmetic::Own)
        return {false, "as asked"};
    if (!device.hasExactDivisionListed)
        return {false, "the driver is not known to round correctly"};
    if (check.wrong.divisions > 0)
        return {false, fmt::format("{} of {} results of the start-up check are wrong", check.wrong.divisions,
                                   check.divisionCount)};
    return {true, "the driver is known to round correctly, and passes the start-up check"};
}

} // namespace hyalite::core::gpu
