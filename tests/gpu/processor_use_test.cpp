#include "host/gpu/processor_use.h"

#include <gtest/gtest.h>
#include <vulkan/vulkan.h>

namespace hyalite::gpu {
namespace {

TEST(ProcessorUse, WideVectorsAreForLavapipeUpToMesa22) {
    DeviceInfo device;
    device.driverId = VK_DRIVER_ID_MESA_LLVMPIPE;
    for (const auto &[driver, isGain] : {std::pair{"llvmpipe Mesa 22.3.6 (LLVM 15.0.6)", true},
                                         {"llvmpipe Mesa 23.0.0 (LLVM 15.0.7)", false},
                                         {"llvmpipe Mesa 25.0.7-2~bpo12+1 (LLVM 15.0.6)", false},
                                         {"llvmpipe Mesa git-1234 (LLVM 22)", false},
                                         {"llvmpipe", false},
                                         {"llvmpipe Mesa ", false}}) {
        device.driver = driver;
        EXPECT_EQ(gainsFromWideVectors(device), isGain) << driver;
    }
    device.driver = "llvmpipe Mesa 22.3.6 (LLVM 15.0.6)";
    device.driverId = VK_DRIVER_ID_GOOGLE_SWIFTSHADER;
    EXPECT_FALSE(gainsFromWideVectors(device));
}

} // namespace
} // namespace hyalite::gpu
