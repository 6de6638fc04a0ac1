// File finder: the files that mesh files name, whose names often come from another computer.
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace hyalite::core {

/// The folder of a file, canonical.
[[nodiscard]] std::filesystem::path folderOf(const std::filesystem::path &file);

/// Finds files inside one folder alone. Lists each folder once, so that thousands of lost names cost little.
class FileFinder {
  public:
    /// `folder` is canonical.
    explicit FileFinder(std::filesystem::path folder) : folder_(std::move(folder)) {}

    [[nodiscard]] const std::filesystem::path &folder() const { return folder_; }

    /// The file `name`, relative to `base`, if it is inside the folder. Where there is none: the same with slashes for
    /// backslashes and in any letter case; then without its first folder, its first two, and so on, so that
    /// C:\models\textures\wood.png is found as textures/wood.png or wood.png. Blanks and quotes around a name do not
    /// count.
    [[nodiscard]] std::optional<std::filesystem::path> find(const std::filesystem::path &base,
                                                            std::string_view name);

    /// How many names were found as others, and the first of them: "C:\models\Wood.png", which is wood.png.
    [[nodiscard]] std::size_t renamedCount() const { return renamedCount_; }
    [[nodiscard]] const std::string &firstRenamed() const { return firstRenamed_; }

  private:
    /// Entries of a folder by their names in lower case.
    using Listing = std::map<std::string, std::string, std::less<>>;

    [[nodiscard]] std::optional<std::filesystem::path> findExactly(const std::filesystem::path &file) const;
    [[nodiscard]] std::optional<std::filesystem::path> findInAnyCase(const std::filesystem::path &base,
                                                                     const std::filesystem::path &name);
    [[nodiscard]] const Listing &listingOf(const std::filesystem::path &folder);

    std::filesystem::path folder_;
    std::map<std::filesystem::path, Listing> listings_;
    std::map<std::string, std::optional<std::filesystem::path>, std::less<>> known_; ///< base, zero, name
    std::size_t renamedCount_ = 0;
    std::string firstRenamed_;
};

} // namespace hyalite::core
