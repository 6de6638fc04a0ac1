// The text of a source file, for tests of how the house is built.
#pragma once

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace hyalite::core::testing {

[[nodiscard]] inline std::string textOf(const std::filesystem::path &file) {
    std::ifstream stream(file);
    std::ostringstream text;
    text << stream.rdbuf();
    return text.str();
}

} // namespace hyalite::core::testing
