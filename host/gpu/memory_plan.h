// Memory plans: every buffer of a render and its size, before any is allocated. Buffers are made from them.
#pragma once

#include "host/gpu/buffer_plan.h"
#include "host/gpu/film_layout.h"
#include "host/gpu/job.h"
#include "host/gpu/render_config.h"
#include "host/gpu/tile.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace hyalite::core::gpu {

/// A scene on a device.
struct ScenePlan {
    /// By binding. Skip lists may become smaller than their plan; the tree of ray queries is estimated.
    std::array<BufferPlan, layout::sceneBufferCount> buffers;
    std::uint64_t hostBytes = 0; ///< needed while the kernel's tree is made
};

[[nodiscard]] ScenePlan planScene(const PackedScene &scene, const KernelRow &kernel);

/// Memory for unfinished paths and rays.
struct WaitingPlan {
    BufferPlan paths;
    BufferPlan pending;
    std::uint32_t pendingInRegisters = 0; ///< rays per slot; 0: the buffer holds them, if there are any
};

/// The tiles and buffers of a job.
struct JobPlan {
    std::uint32_t fewestSamples = 0; ///< minimum over the pixels of the film that the job begins with
    std::uint32_t samplesInFlight = 1;
    std::uint32_t stackSize = 0; ///< entries for each ray
    /// Dispatches end with whole samples; a resumable helper kernel does samples that are too long.
    bool isDirect = false;
    bool exchangesByBroadcast = false; ///< lanes do, not by shuffles
    bool regeneratesPaths = false; ///< the direct kernel's slots do not wait for the others of their pixel
    Tile largestTile;
    std::uint64_t maxHelperPixels = 0; ///< maximum size of a tile for the helper
    FilmLayout layout;
    BufferPlan film;  ///< gathered, with the positions of its pixels
    BufferPlan light; ///< the film's layers of light
    BufferPlan progress;
    BufferPlan stacks; ///< of the traversal, or the finished samples of slots that take them in turn
    BufferPlan trace;
    WaitingPlan waiting;
    WaitingPlan helperWaiting; ///< 0 bytes unless isDirect
};

/// `config` is complete. Tiles are made smaller than it says where their slots would take more than a quarter of the
/// device memory, more than 256 MiB, or more than the device allows in a buffer.
[[nodiscard]] JobPlan planJob(const Job &job, const RenderConfig &config, const DeviceInfo &device);

constexpr std::uint32_t traceCapacity = 1u << 17; // events of a traced job

/// Peak memory of a render.
struct MemoryPlan {
    std::uint64_t deviceBytes = 0; ///< on the device; for a software device that is host memory
    std::uint64_t hostBytes = 0;   ///< further host memory, without scene and film
};

/// `isStaged`: transfers go through staging buffers. `residentBytes` of the scene are on the device already. Throws
/// Error{LimitExceeded}, with the largest buffers and the remedy, if a buffer is larger than the device allows, or
/// device or host have too little memory. Drivers would fail in the middle of the render, or exhaust the memory of the
/// system.
MemoryPlan requireMemory(const ScenePlan &scene, const JobPlan &job, bool isStaged, const DeviceInfo &device,
                         std::uint64_t residentBytes = 0);

} // namespace hyalite::core::gpu
