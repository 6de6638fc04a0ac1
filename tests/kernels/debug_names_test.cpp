// Other tools speak our words: a message of the validation layer names our buffers.
#include "host/base/error.h"
#include "host/gpu/vk/buffer.h"
#include "tests/fixtures/test_device.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

namespace hyalite::core {
namespace {

TEST(DebugNames, StandInMessagesOfTheValidationLayer) {
    setenv("HYALITE_VALIDATION", "1", 1);
    gpu::Device device(testing::testDevice());
    const gpu::Buffer buffer(device, "the buffer of the test", gpu::BufferUse::Storage, 64);
    try {
        device.submit("a fill beyond the end", [&](VkCommandBuffer commands) {
            vkCmdFillBuffer(commands, buffer.get(), 128, VK_WHOLE_SIZE, 0);
            device.instance().throwOnValidationMessage(); // before a driver that believes us runs it
        });
        FAIL() << "the validation layer had nothing to say";
    } catch (const Error &error) {
        const std::string message = error.what();
        EXPECT_NE(message.find("the buffer of the test"), std::string::npos) << message;
    }
}

} // namespace
} // namespace hyalite::core
