#include "host/import/profile_library.h"

#include "host/base/error.h"
#include "host/import/ies.h"
#include "host/scene/limits.h"

#include <fmt/format.h>

#include <iterator>
#include <system_error>

namespace hyalite::core {

std::uint32_t ProfileLibrary::load(const std::filesystem::path &file, std::vector<std::string> &warnings) {
    std::error_code none;
    const std::filesystem::path canonical = std::filesystem::weakly_canonical(file, none);
    if (const auto known = indices_.find(canonical.string()); known != indices_.end())
        return known->second;
    const std::uint32_t index = load(InputFile(file), warnings);
    indices_.emplace(canonical.string(), index);
    return index;
}

std::uint32_t ProfileLibrary::load(const InputFile &file, std::vector<std::string> &warnings) {
    const std::string name = file.path().string();
    if (const auto known = indices_.find(name); known != indices_.end())
        return known->second;
    IesFile read = readIes(file);
    valueCount_ += read.profile.shares.size();
    if (valueCount_ > limits::profileValueCount)
        throw Error(ErrorKind::LimitExceeded,
                    fmt::format("{}: all profiles of lights together have {} values; allowed: at most {}",
                                name, valueCount_, limits::profileValueCount));
    std::ranges::move(read.warnings, std::back_inserter(warnings));
    const auto index = static_cast<std::uint32_t>(profiles_.size());
    profiles_.push_back(std::move(read.profile));
    indices_.emplace(name, index);
    return index;
}

} // namespace hyalite::core
