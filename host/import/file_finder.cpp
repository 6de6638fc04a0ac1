#include "host/import/file_finder.h"

#include "host/base/letter_case.h"
#include "host/import/obj_lines.h"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>
#include <utility>

namespace hyalite::core {
namespace {

std::string_view trimmed(std::string_view name) {
    constexpr std::string_view around = " \t\"";
    name.remove_prefix(std::min(name.find_first_not_of(around), name.size()));
    return name.substr(0, name.find_last_not_of(around) + 1);
}

} // namespace

std::optional<std::filesystem::path> FileFinder::findExactly(const std::filesystem::path &file) const {
    std::error_code error;
    const std::filesystem::path absolute = std::filesystem::absolute(file, error);
    const std::filesystem::path canonical =
        error ? absolute : std::filesystem::weakly_canonical(absolute, error);
    const bool isInside =
        std::mismatch(folder_.begin(), folder_.end(), canonical.begin(), canonical.end()).first ==
        folder_.end();
    if (error || !isInside || !std::filesystem::is_regular_file(canonical, error))
        return std::nullopt;
    return canonical;
}

const FileFinder::Listing &FileFinder::listingOf(const std::filesystem::path &folder) {
    constexpr std::size_t maxEntries = 100'000;
    const auto [listing, isNew] = listings_.try_emplace(folder);
    if (!isNew)
        return listing->second;
    std::error_code error; // a folder that is missing or may not be read has no entries
    for (std::filesystem::directory_iterator entry(folder, error), end;
         !error && entry != end && listing->second.size() < maxEntries; entry.increment(error)) {
        const std::string name = entry->path().filename().string();
        const auto [place, isFirst] = listing->second.try_emplace(lowerCase(name), name);
        if (!isFirst) // two names that differ in case alone: the same one each time
            place->second = std::min(place->second, name);
    }
    return listing->second;
}

std::optional<std::filesystem::path> FileFinder::findInAnyCase(const std::filesystem::path &base,
                                                               const std::filesystem::path &name) {
    std::filesystem::path file = base;
    for (const std::filesystem::path &part : name) {
        std::error_code error;
        if (part == "." || part == ".." || std::filesystem::exists(file / part, error)) {
            file /= part;
            continue;
        }
        const std::filesystem::path canonical = std::filesystem::weakly_canonical(file, error);
        const bool isInside =
            std::mismatch(folder_.begin(), folder_.end(), canonical.begin(), canonical.end()).first ==
            folder_.end();
        if (error || !isInside)
            return std::nullopt;
        const Listing &listing = listingOf(canonical);
        const auto entry = listing.find(lowerCase(part.string()));
        if (entry == listing.end())
            return std::nullopt;
        file /= entry->second;
    }
    return findExactly(file);
}

std::filesystem::path folderOf(const std::filesystem::path &file) {
    std::error_code error;
    const std::filesystem::path folder = file.parent_path();
    return std::filesystem::weakly_canonical(folder.empty() ? "." : folder, error);
}

std::optional<std::filesystem::path> FileFinder::find(const std::filesystem::path &base,
                                                      std::string_view name) {
    const auto [known, isNew] = known_.try_emplace(base.string() + '\0' + std::string(name));
    std::optional<std::filesystem::path> &file = known->second;
    if (!isNew)
        return file;
    file = findExactly(base / name);
    if (file)
        return file;
    std::string slashed(trimmed(name));
    std::ranges::replace(slashed, '\\', '/');
    for (std::string_view rest = slashed; !file && !rest.empty();) {
        const std::filesystem::path part = std::filesystem::path(rest).relative_path();
        if (!part.empty())
            file = findInAnyCase(base, part);
        const std::size_t slash = rest.find_first_of("/:");
        rest = slash == std::string_view::npos ? std::string_view() : rest.substr(slash + 1);
    }
    if (file && renamedCount_++ == 0)
        firstRenamed_ = fmt::format("{}, which is {}", quoteInput(name),
                                    file->lexically_relative(folder_).generic_string());
    return file;
}

} // namespace hyalite::core
