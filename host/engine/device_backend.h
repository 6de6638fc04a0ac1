// A Vulkan device as a backend.
#pragma once

#include "host/engine/backend.h"
#include "host/gpu/render_config.h"

#include <memory>

namespace hyalite::core {

/// Opens the device. The observer gets notes on what is kept of it. Throws as gpu::Renderer does.
[[nodiscard]] std::unique_ptr<Backend> makeDeviceBackend(const gpu::DeviceInfo &device,
                                                         const gpu::RenderConfig &config,
                                                         Observer &observer = nobody());

} // namespace hyalite::core
