// Speed of a renderer: rays a second, on the scene of each trial.
#pragma once

#include "host/engine/open_backends.h"
#include "host/lab/trials.h"

#include <string>
#include <vector>

namespace hyalite::core {

struct SpeedFigure {
    std::string scene;
    double megaraysPerSecond = 0.0; ///< of the fastest of a few renders that take a while
};

/// Renders the scenes with a device as openBackend() takes it, as `render` would; those that are begun before the limit is
/// reached. Throws what opening and rendering throw.
[[nodiscard]] std::vector<SpeedFigure> measureSpeed(const std::string &device, const TimeLimit &limit,
                                                    Observer &observer);

} // namespace hyalite::core
