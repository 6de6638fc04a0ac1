// EXT_meshopt_compression: buffer views that meshoptimizer has compressed.
#pragma once

#include "host/base/json_reader.h"

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace hyalite::core::gltf {

/// The contents of a view whose extension object is `extension`. `allow` is told the size before memory is taken.
/// Throws Error{BadInput} for data that is damaged, or too short for as many elements.
[[nodiscard]] std::vector<std::byte> decompressMeshopt(const JsonObject &extension,
                                                       std::span<const std::byte> packed,
                                                       const std::function<void(std::size_t)> &allow);

} // namespace hyalite::core::gltf
