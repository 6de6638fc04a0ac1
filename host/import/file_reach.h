// Which files a scene file may name, so that a scene from a stranger reads nothing but what came with it.
#pragma once

#include "host/base/json_reader.h"

#include <filesystem>
#include <span>
#include <vector>

namespace hyalite {

class FileReach {
  public:
    /// What lies in the scene file's own folder, in the asset folders and in `allowedPaths` (folders, or single files),
    /// at any depth, may be named.
    FileReach(const std::filesystem::path &sceneFile, std::span<const std::filesystem::path> allowedPaths);

    /// The path of the file that `node` names, relative to the scene file's folder. Throws Error{BadInput} where there
    /// is no such file, or where it lies out of reach once all symbolic links and `..` are followed. It opens nothing.
    [[nodiscard]] std::filesystem::path resolve(const JsonNode &node) const;

  private:
    std::filesystem::path folder_;
    std::vector<std::filesystem::path> reachable_; ///< canonical
};

} // namespace hyalite
