// Settings of software drivers, which compute on the processors. They are made before the driver is loaded.
#pragma once

#include "host/gpu/vk/device_list.h"
#include "host/scene/scene.h"

#include <memory>
#include <vector>

namespace hyalite::gpu {

struct ProcessorUse {
    int threadCount = 0;      ///< 0: all
    bool hasTriangles = true; ///< whether the scenes have any
    Integrator integrator = Integrator::Path;
    int maxDepth = 1; ///< segments of a path
};

/// Whether the processor has vectors of 512 bits.
[[nodiscard]] bool hasWideVectors();

/// Sets environment variables that lavapipe reads when its driver is loaded (https://docs.mesa3d.org/envvars.html): the
/// number of threads and, unless the user has set it, the vector width. 512-bit vectors take three quarters of the time
/// in scenes without triangles, where kernels compute and rarely read, and 0.65 to 0.9 in other scenes, of paths, too
/// (tests/bench/README.md). The rays that glass splits off at great depth lose: 16 lanes idle more than 8, and take
/// twice the time if the glass is a mesh. Do not call this while other threads read the environment.
void tellLavapipe(const ProcessorUse &use);

/// Whether the device is a lavapipe on which 512-bit vectors are known to be faster. They are up to Mesa 22. Mesa 25 was
/// found to shuffle the 16 lanes in a loop, which takes longer than the wider vectors save.
[[nodiscard]] bool gainsFromWideVectors(const DeviceInfo &device);

/// All devices, and an instance that keeps their drivers loaded: the loader unloads them with the last instance.
struct LoadedDevices {
    std::shared_ptr<Instance> instance;
    std::vector<DeviceInfo> devices;
};

/// Lists the devices as listDevices() does. If tellLavapipe() chose 512 bits and the driver does not gain from them, it
/// is loaded again with 256. Throws as listDevices() does.
[[nodiscard]] LoadedDevices loadDevices();

} // namespace hyalite::gpu
