// Several renderers as one: they share each picture, tile by tile.
#pragma once

#include "host/engine/backend.h"

#include <memory>
#include <vector>

namespace hyalite::core {

/// Renders each picture by all members at once. Each takes tiles from one queue, as large as it renders in two seconds
/// at most, and smaller ones towards the end, so that all end together. The bits are those of any member.
///
/// A member that fails is left out from then on, and its tile is given to another; if none is left, the render ends as
/// that of a failing device does. A member that renders a few pixels to other bits than the CPU fails, too
/// (spot_check.h). While a render runs, its snapshots have finished tiles; a render that is stopped has what each
/// member has finished.
///
/// At least one member; all with the same precision(), which is not empty.
[[nodiscard]] std::unique_ptr<Backend> shareBackends(std::vector<std::unique_ptr<Backend>> members);

} // namespace hyalite::core
