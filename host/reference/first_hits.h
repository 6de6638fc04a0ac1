// First hits of a picture: which primitive each pixel shows.
#pragma once

#include "host/image/crop.h"
#include "host/packing/packed_scene.h"

#include <cstdint>
#include <functional>
#include <span>

namespace hyalite::core::reference {

/// The primitives of a row of the crop, from left to right; layout::noPrimitive where there is none.
using VisitRow = std::function<void(int y, std::span<const std::uint32_t> primitives)>;

/// Traces the primary ray through the centre of each pixel, of a lens through its centre, on all threads. One of them
/// at a time visits a row; rows come in any order.
void visitFirstHits(const PackedScene &scene, const Crop &crop, const VisitRow &visit);

} // namespace hyalite::core::reference
