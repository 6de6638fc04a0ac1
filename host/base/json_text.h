// JSON as every command writes it.
#pragma once

#include <nlohmann/json.hpp>

#include <string>

namespace hyalite {

/// Indented, with a line feed at the end. File names need not be UTF-8, but JSON is: other bytes become U+FFFD.
[[nodiscard]] inline std::string jsonText(const nlohmann::ordered_json &json) {
    return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

} // namespace hyalite
