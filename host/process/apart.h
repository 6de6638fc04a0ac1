// Work in a process of its own, as settings of a driver can be made once a process, and a driver may crash.
#pragma once

#include <nlohmann/json.hpp>

#include <functional>

namespace hyalite::core {

/// Runs `work` in a process of its own and returns its result, of at most 64 KiB as text. Throws the Error that it
/// throws, and Error{DeviceLost} if a signal ended it. The calling process has no other thread.
[[nodiscard]] nlohmann::json inOwnProcess(const std::function<nlohmann::json()> &work);

} // namespace hyalite::core
