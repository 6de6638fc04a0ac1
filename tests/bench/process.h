// `hyalite` as a process of its own: what a user waits for.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace hyalite::core::bench {

/// A folder that is gone, with all that is in it, when this object is.
class TemporaryFolder {
  public:
    /// Throws std::filesystem::filesystem_error.
    TemporaryFolder();
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder &) = delete;
    TemporaryFolder &operator=(const TemporaryFolder &) = delete;

    [[nodiscard]] const std::filesystem::path &path() const { return path_; }

  private:
    std::filesystem::path path_;
};

/// Runs the program without output and waits for it. `variables`, such as "NAME=value", are added to this process'
/// environment. Returns the seconds from start to end, or those of
/// the processor (race.h). Throws std::runtime_error where it fails.
double runHyalite(const std::vector<std::string> &arguments, const std::vector<std::string> &variables = {});

} // namespace hyalite::core::bench
