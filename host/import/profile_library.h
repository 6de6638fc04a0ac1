// Profile library of a scene: each file with the profile of a lamp is read once.
#pragma once

#include "host/base/input_file.h"
#include "host/scene/light_profile.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace hyalite::core {

class ProfileLibrary {
  public:
    /// The index of the file's profile. Warnings are added the first time. Throws Error{BadInput} as readIes() does, and
    /// Error{LimitExceeded} if all profiles together have more values than limits::profileValueCount.
    [[nodiscard]] std::uint32_t load(const std::filesystem::path &file, std::vector<std::string> &warnings);

    /// The same for a file inside another one, whose name is its own alone.
    [[nodiscard]] std::uint32_t load(const InputFile &file, std::vector<std::string> &warnings);

    [[nodiscard]] const LightProfile &at(std::uint32_t index) const { return profiles_[index]; }

    [[nodiscard]] std::vector<LightProfile> give() { return std::move(profiles_); }

  private:
    std::vector<LightProfile> profiles_;
    std::map<std::string, std::uint32_t> indices_; ///< by canonical path, or name
    std::size_t valueCount_ = 0;                   ///< of all profiles
};

} // namespace hyalite::core
