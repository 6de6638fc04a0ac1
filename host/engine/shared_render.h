// One picture by several renderers, tile by tile.
#pragma once

#include "host/engine/backend.h"

#include <memory>
#include <optional>
#include <vector>

namespace hyalite::core {

/// One of several renderers.
struct Member {
    std::unique_ptr<Backend> backend;
    std::optional<Error> failure{};    ///< why it is left out
    std::vector<Integrator> checked{}; ///< by a spot check: their bits are the CPU's

    [[nodiscard]] bool isLeftOut() const { return failure.has_value(); }
};

/// Renders by all members that are not left out, as Backend::render() does. Those that fail are left out from then on.
/// So are those whose bits are not the CPU's, in a spot check before a member's first tile by each integrator.
[[nodiscard]] BackendResult renderShared(std::vector<Member> &members, const PackedScene &scene,
                                         const RenderSettings &settings, Film begun,
                                         const RenderHooks &hooks);

} // namespace hyalite::core
