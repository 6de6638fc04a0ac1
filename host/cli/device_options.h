// --device, --threads, --kernel and --max-dispatch-ms, for all commands that open a renderer.
#pragma once

#include "host/engine/open_backends.h"

#include <CLI/CLI.hpp>

#include <string>

namespace hyalite::core {

/// Adds --device, which may be repeated. `devices` must outlive the command.
CLI::Option *addDevicesOption(CLI::App &command, RendererNames &devices, const std::string &help);

/// Adds --threads, for openBackend. `threadCount` must outlive the command.
void addThreadsOption(CLI::App &command, int &threadCount);

/// Adds --kernel and --max-dispatch-ms, for openBackend. `options` must outlive the command.
void addDeviceOptions(CLI::App &command, DeviceOptions &options);

/// The word of a kernel, or if that is gone, of the one in its place; then a note says so.
[[nodiscard]] std::string presentKernelWord(const std::string &word);

} // namespace hyalite::core
