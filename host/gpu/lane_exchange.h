// Lane exchange: how the lanes of a subgroup pass values to each other fastest, which no driver says of itself.
#pragma once

namespace hyalite::core::gpu {

class Device;
struct DeviceInfo;

/// Whether areBroadcastsFaster() is a question for the device: software with subgroups of 16 lanes, as the start-up
/// check finds them.
[[nodiscard]] bool mayGainFromBroadcasts(const DeviceInfo &device);

/// Whether each lane gets the values of others sooner by broadcasts of all 16 lanes, of which it selects some, than by
/// shuffles. A small kernel does both and is timed, in 15 ms, or 60 where the driver has no kernels cached. Lavapipe
/// compiles a shuffle of 16 lanes to an instruction up to Mesa 22, and to a loop over the lanes in Mesa 25
/// (tests/bench/README.md). Throws as Kernel does.
[[nodiscard]] bool areBroadcastsFaster(Device &device);

} // namespace hyalite::core::gpu
