// Files by which Linux tells about a machine: one value each, in folders of many.
#pragma once

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <system_error>
#include <vector>

namespace hyalite::core {

/// Empty if the file cannot be read.
[[nodiscard]] inline std::string firstLineOf(const std::filesystem::path &file) {
    std::ifstream stream(file);
    std::string line;
    std::getline(stream, line);
    return line;
}

/// The files of a folder, sorted; none if it cannot be read.
[[nodiscard]] inline std::vector<std::filesystem::path> filesIn(const std::filesystem::path &folder) {
    std::vector<std::filesystem::path> files;
    std::error_code error;
    for (std::filesystem::directory_iterator entry(folder, error), end; !error && entry != end;
         entry.increment(error))
        files.push_back(entry->path());
    std::ranges::sort(files);
    return files;
}

} // namespace hyalite::core
