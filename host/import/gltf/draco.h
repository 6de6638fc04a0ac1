// KHR_draco_mesh_compression: primitives that Draco has compressed.
#pragma once

#include "host/import/gltf/primitive.h"

#include <cstdint>
#include <vector>

namespace hyalite::core::gltf {

struct DracoMesh {
    Attributes attributes;
    std::vector<std::uint32_t> indices; ///< three a triangle
};

/// Decodes the primitive whose extension object is `extension`. Throws Error{BadInput} for damaged data, and for counts
/// that differ from those of its accessors.
[[nodiscard]] DracoMesh decodeDraco(Buffers &buffers, const JsonObject &primitive,
                                    const JsonObject &extension);

} // namespace hyalite::core::gltf
