// The command line of `hyalite render` as a request.
#pragma once

#include "host/jobs/sequence.h"
#include "host/jobs/views.h"

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

namespace hyalite::core {

/// Adds the arguments of `render`. `request` and `isQuiet` must outlive `command`.
void addRenderOptions(CLI::App &command, RenderRequest &request, bool &isQuiet);

/// Adds --frames and what goes with it. `options` must outlive `command`.
void addSequenceOptions(CLI::App &command, SequenceOptions &options);

/// Adds the options of views, which belong to `render` alone. `options` must outlive `command`.
void addViewOptions(CLI::App &command, ViewOptions &options);

/// The request of a whole command line, the program first. Throws Error{BadInput} if it is none of `render`.
[[nodiscard]] RenderRequest readRenderRequest(const std::vector<std::string> &words);

} // namespace hyalite::core
