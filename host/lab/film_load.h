// A load of a soak that renders a film again and again.
#pragma once

#include "host/engine/open_backends.h"
#include "host/lab/loads.h"
#include "host/lab/running_load.h"

#include <memory>

namespace hyalite::core {

/// `isLarge`: in its size for devices that compute on processors of their own. `loads`, `load` and `backend` must
/// outlive it.
[[nodiscard]] std::unique_ptr<RunningLoad> newFilmLoad(Soak &soak, const Loads &loads, const Load &load,
                                                       bool isLarge, Backend &backend);

} // namespace hyalite::core
