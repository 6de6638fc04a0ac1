#include "host/import/file_access.h"

#include "host/base/clean_text.h"
#include "host/base/error.h"
#include "host/base/json_document.h"
#include "host/base/standard_stream.h"
#include "host/import/assets.h"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>

namespace hyalite::core {
namespace {

constexpr std::size_t maxShownPathBytes = 1000;

std::string shown(const std::filesystem::path &path) { return excerpt(path.string(), maxShownPathBytes); }

/// Both canonical. A path lies within itself.
bool isWithin(const std::filesystem::path &path, const std::filesystem::path &folder) {
    return std::mismatch(folder.begin(), folder.end(), path.begin(), path.end()).first == folder.end();
}

} // namespace

FileAccess::FileAccess(const std::filesystem::path &sceneFile,
                       std::span<const std::filesystem::path> allowedPaths, const SceneArrays *arrays)
    : folder_(sceneFile.parent_path()), arrays_(arrays) {
    const auto add = [&](const std::filesystem::path &path) {
        std::error_code error; // a missing folder has no files
        const std::filesystem::path canonical = std::filesystem::canonical(path, error);
        if (!error)
            reachable_.push_back(canonical);
    };
    add(folder_.empty() ? "." : folder_);
    std::ranges::for_each(assetFolders(), add);
    std::ranges::for_each(allowedPaths, add);
}

FileAccess FileAccess::from(const std::filesystem::path &file) const {
    FileAccess access = *this;
    access.folder_ = file.parent_path();
    access.arrays_ = nullptr;
    return access;
}

bool FileAccess::allows(const std::filesystem::path &file) const {
    std::error_code error;
    const std::filesystem::path canonical =
        std::filesystem::weakly_canonical(std::filesystem::absolute(file), error);
    return !error &&
           std::ranges::any_of(reachable_, [&](const auto &folder) { return isWithin(canonical, folder); });
}

std::filesystem::path FileAccess::resolve(const JsonNode &node) const { return resolve(node, node.text()); }

std::filesystem::path FileAccess::resolve(const JsonNode &node, const std::string &name) const {
    if (name.empty())
        node.fail("found an empty name; allowed: that of a file");
    std::filesystem::path file = folder_ / name;
    if (isStandardStream(file))
        file = "./" / file; // a file of that name
    std::error_code error;
    const std::filesystem::path absolute = std::filesystem::absolute(file, error);
    if (error)
        node.fail(fmt::format("{}: {}", shown(file), error.message()));
    const std::filesystem::path canonical = std::filesystem::weakly_canonical(absolute, error);
    if (error)
        node.fail(fmt::format("{}: {}", shown(file), error.message()));
    if (!allows(canonical))
        node.fail(
            fmt::format("{} leads to {}; allowed: files in the scene's folder {} and in the shipped assets",
                        shown(file), shown(canonical), shown(reachable_.front())),
            Remedy::AllowPath);
    if (!std::filesystem::exists(canonical, error))
        node.fail(fmt::format("{}: there is no such file", shown(file)));
    return file;
}

} // namespace hyalite::core
