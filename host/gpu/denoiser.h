// The denoiser on a device: the passes of shaders/post over the tiles of a picture.
#pragma once

#include "host/film/noisy_picture.h"
#include "host/gpu/pipeline_cache.h"
#include "host/gpu/vk/device.h"

namespace hyalite::core::gpu {

/// The picture without most of its noise, as reference::denoise() makes it. `isDivisionExact`: the device's own division
/// is used. Throws Error{LimitExceeded} if the device lacks the texel buffers or the memory for a tile, and DeviceFault.
[[nodiscard]] Image denoise(Device &device, PipelineCache &pipelines, bool isDivisionExact,
                            const NoisyPicture &picture);

} // namespace hyalite::core::gpu
