// JSON text, as all commands write it.
#pragma once

#include <nlohmann/json.hpp>

#include <string>

namespace hyalite::core {

/// Indented, with a line feed at the end. Bytes that are not UTF-8, as in file names, become U+FFFD.
[[nodiscard]] inline std::string jsonText(const nlohmann::ordered_json &json) {
    return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

} // namespace hyalite::core
