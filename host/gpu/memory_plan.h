// All memory that a render takes, known before any of it is allocated: buffers are made from these plans.
#pragma once

#include "host/gpu/buffer_plan.h"
#include "host/gpu/job.h"
#include "host/gpu/render_config.h"
#include "host/gpu/tile.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace hyalite::gpu {

/// A scene on a device.
struct ScenePlan {
    /// By binding. Skip lists may become smaller than their plan.
    std::array<BufferPlan, layout::sceneBufferCount> buffers;
    std::uint64_t hostBytes = 0; ///< that making skip lists takes
};

[[nodiscard]] ScenePlan planScene(const PackedScene &scene, bool isSkipList);

/// What waits between the dispatches of a kernel, or inside of one.
struct WaitingPlan {
    BufferPlan paths;
    BufferPlan pending;
    std::uint32_t pendingInRegisters = 0; ///< rays of a slot; 0: they are in the buffer, if any
};

/// A job's tiles and what else it has on the device.
struct JobPlan {
    std::uint32_t samplesAbreast = 1;
    std::uint32_t stackSize = 0; ///< subtrees that can wait for one ray
    bool isDirect = false; ///< dispatches end with whole samples, and a helper does those that are too long
    Tile largestTile;
    std::uint64_t mostHelperPixels = 0; ///< of a tile that the helper works on
    BufferPlan film;
    BufferPlan progress;
    BufferPlan stacks;
    BufferPlan trace;
    WaitingPlan waiting;
    WaitingPlan helperWaiting; ///< of 0 bytes unless isDirect
};

/// `config` is complete. Tiles are smaller than it says where slots would take more than a quarter of the device's
/// memory, or 256 MiB, or more than it allows in a buffer.
[[nodiscard]] JobPlan planJob(const Job &job, const RenderConfig &config, const DeviceInfo &device);

constexpr std::uint32_t traceCapacity = 1u << 17; // events of a job that is traced

/// What a render takes at most at once.
struct MemoryPlan {
    std::uint64_t deviceBytes = 0; ///< of the device, which is the host where it is software
    std::uint64_t hostBytes = 0;   ///< of the host beside that, without scene and film
};

/// `isStaged`: transfers go through buffers of the host. Throws Error{LimitExceeded}, with the largest buffers and what
/// to do, where a buffer is larger than the device allows, or the device has less memory, or the host less to spare.
/// Drivers would say so in the middle of a render, or take it from what keeps the system alive.
MemoryPlan requireMemory(const ScenePlan &scene, const JobPlan &job, bool isStaged, const DeviceInfo &device);

} // namespace hyalite::gpu
