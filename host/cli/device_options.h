// --threads, --kernel and --max-dispatch-ms, for all commands that open a renderer.
#pragma once

#include "host/engine/open_backends.h"

#include <CLI/CLI.hpp>

namespace hyalite::core {

/// Adds --threads, for openBackend. `threadCount` must outlive the command.
void addThreadsOption(CLI::App &command, int &threadCount);

/// Adds --kernel and --max-dispatch-ms, for openBackend. `options` must outlive the command.
void addDeviceOptions(CLI::App &command, DeviceOptions &options);

} // namespace hyalite::core
