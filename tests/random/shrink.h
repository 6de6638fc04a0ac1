// Shrinking: the smallest document that still has a property.
#pragma once

#include <nlohmann/json.hpp>

#include <functional>

namespace hyalite::core::testing {

/// Removes members and elements, the large ones first, and makes numbers 0 or 1, as long as `isFaulty` holds: until no
/// single change is left, or the time is over. (Zeller and Hildebrandt, "Simplifying and isolating failure-inducing
/// input", IEEE Trans. Softw. Eng. 28, 2002.)
[[nodiscard]] nlohmann::json shrunk(nlohmann::json document,
                                    const std::function<bool(const nlohmann::json &)> &isFaulty,
                                    double maxSeconds);

} // namespace hyalite::core::testing
