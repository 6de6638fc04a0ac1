// --layers: views of primary hits, beside the colours of an EXR.
#pragma once

#include "host/jobs/layers.h"

#include <CLI/CLI.hpp>

#include <vector>

namespace hyalite::core {

/// Adds --layers, with views by their names. `views` must outlive the command; it receives each view once.
void addLayersOption(CLI::App &command, std::vector<Integrator> &views);

} // namespace hyalite::core
