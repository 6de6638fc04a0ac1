// Identity of a render: everything that affects its samples, to decide whether two renders may share them.
#pragma once

#include "host/engine/backend.h"
#include "host/film/checkpoint.h"

namespace hyalite::core {

/// It includes the crop, but neither the samples per pixel, which may grow, nor, except for the cost, the tree; and
/// `layers`, unless they are null.
[[nodiscard]] RenderIdentity identityOf(const PreparedScene &scene, const Backend &backend,
                                        const std::vector<Integrator> *layers = nullptr);

} // namespace hyalite::core
