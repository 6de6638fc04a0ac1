// A render in stages, between which the first samples of its film are taken, and, for a noise, the samples that its pixels
// are to have.
#pragma once

#include "host/engine/backend.h"

namespace hyalite::core {

/// As Backend::render(), for a film that keeps first samples (first_samples.h): those of `begun` stay, and so do wanted
/// counts. The pixels have the bits of a render in one stage. Of an adaptive render (noise.h), pixels that have all samples
/// and no wanted count are those of others. A render that ends early leaves some pixels without first samples.
[[nodiscard]] BackendResult renderInStages(Backend &backend, const PackedScene &scene,
                                           const RenderSettings &settings, Film begun,
                                           const RenderHooks &hooks);

} // namespace hyalite::core
