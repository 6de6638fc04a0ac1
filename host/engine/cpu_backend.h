// The CPU twin as a backend, in single or double precision.
#pragma once

#include "host/engine/backend.h"
#include "host/reference/renderer.h"

#include <memory>

namespace hyalite::core {

/// `threadCount` 0: all threads.
[[nodiscard]] std::unique_ptr<Backend> makeCpuBackend(reference::Precision precision, int threadCount);

} // namespace hyalite::core
