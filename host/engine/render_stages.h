// A render in two stages, between which the first samples of its film are taken.
#pragma once

#include "host/engine/backend.h"

namespace hyalite::core {

/// As Backend::render(), for a film that keeps first samples (first_samples.h): those of `begun` stay. The pixels have
/// the bits of a render in one stage. A render that ends early leaves some pixels without first samples.
[[nodiscard]] BackendResult renderInStages(Backend &backend, const PackedScene &scene,
                                           const RenderSettings &settings, Film begun,
                                           const RenderHooks &hooks);

} // namespace hyalite::core
