// One picture by several renderers, tile by tile.
#pragma once

#include "host/render/backend.h"

#include <memory>
#include <optional>
#include <vector>

namespace hyalite {

/// One of several renderers.
struct Member {
    std::unique_ptr<Backend> backend;
    std::optional<Error> failure{}; ///< why it is left out

    [[nodiscard]] bool isLeftOut() const { return failure.has_value(); }
};

/// Renders by all members that are not left out, as Backend::render() does. Those that fail are left out from then on.
[[nodiscard]] BackendResult renderShared(std::vector<Member> &members, const PreparedScene &scene,
                                         const std::function<void(double)> &onProgress,
                                         const std::function<bool()> &shouldStop, Continuation continuation);

} // namespace hyalite
