// File access of scene files: a scene from a stranger reads only files that came with it.
#pragma once

#include "host/base/json_reader.h"
#include "host/import/scene_document.h"

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace hyalite::core {

class FileAccess {
  public:
    /// A scene may name files in its own folder, in the asset folders and in `allowedPaths` (folders or single files),
    /// at any depth. `arrays`, which must outlive this, are what its names stand for first; null: there are none.
    FileAccess(const std::filesystem::path &sceneFile, std::span<const std::filesystem::path> allowedPaths,
               const SceneArrays *arrays = nullptr);

    /// The arrays of this name, or null: `kind` is &SceneArrays::meshes and the like.
    template <class Arrays>
    [[nodiscard]] const Arrays *find(std::map<std::string, std::shared_ptr<const Arrays>> SceneArrays::*kind,
                                     const std::string &name) const {
        if (arrays_ == nullptr)
            return nullptr;
        const auto found = (arrays_->*kind).find(name);
        return found != (arrays_->*kind).end() ? found->second.get() : nullptr;
    }

    /// The path of the file that `node` names, relative to the folder of the scene file. Throws Error{BadInput} if
    /// there is no such file, or if it is out of reach after symbolic links and `..` are resolved. It opens nothing.
    [[nodiscard]] std::filesystem::path resolve(const JsonNode &node) const;

    /// The same for a name that the node's text stands for.
    [[nodiscard]] std::filesystem::path resolve(const JsonNode &node, const std::string &name) const;

    /// Whether a file is within reach after symbolic links and `..` are resolved; it need not exist.
    [[nodiscard]] bool allows(const std::filesystem::path &file) const;

    /// The same access for names in a file that the scene names: relative to the folder of that file, to files alone.
    [[nodiscard]] FileAccess from(const std::filesystem::path &file) const;

  private:
    std::filesystem::path folder_;
    std::vector<std::filesystem::path> reachable_; ///< canonical
    const SceneArrays *arrays_;
};

} // namespace hyalite::core
