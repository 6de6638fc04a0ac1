// File access of scene files: a scene from a stranger reads only files that came with it.
#pragma once

#include "host/base/json_reader.h"

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace hyalite::core {

class FileAccess {
  public:
    /// A scene may name files in its own folder, in the asset folders and in `allowedPaths` (folders or single files),
    /// at any depth.
    FileAccess(const std::filesystem::path &sceneFile, std::span<const std::filesystem::path> allowedPaths);

    /// The path of the file that `node` names, relative to the folder of the scene file. Throws Error{BadInput} if
    /// there is no such file, or if it is out of reach after symbolic links and `..` are resolved. It opens nothing.
    [[nodiscard]] std::filesystem::path resolve(const JsonNode &node) const;

    /// The same for a name that the node's text stands for.
    [[nodiscard]] std::filesystem::path resolve(const JsonNode &node, const std::string &name) const;

    /// Whether a file is within reach after symbolic links and `..` are resolved; it need not exist.
    [[nodiscard]] bool allows(const std::filesystem::path &file) const;

    /// The same access for names in a file that the scene names: relative to the folder of that file.
    [[nodiscard]] FileAccess from(const std::filesystem::path &file) const;

  private:
    std::filesystem::path folder_;
    std::vector<std::filesystem::path> reachable_; ///< canonical
};

} // namespace hyalite::core
