// The files of random scenes: images, skies and meshes.
#pragma once

#include "tests/random/random_draws.h"

#include <nlohmann/json.hpp>

#include <array>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace hyalite::core::testing {

/// A patch of a bumpy grid or a ball: positions, normals that need not be those of its faces, and coordinates.
struct Patch {
    nlohmann::json positions = nlohmann::json::array();
    nlohmann::json normals = nlohmann::json::array();
    nlohmann::json uvs = nlohmann::json::array();
    std::vector<std::array<int, 3>> triangles;
};

/// Draws files in the form of scene_document.h. Functions that add one return its name.
class FileDraws {
  public:
    explicit FileDraws(Draws &draws) : draws_(draws) {}

    [[nodiscard]] const nlohmann::json &files() const { return files_; }
    void add(const std::string &name, nlohmann::json file) { files_[name] = std::move(file); }

    /// An environment; a white one is 1 everywhere.
    std::string addSky(bool isWhite);
    /// A colour image, maybe with alpha, or a normal map.
    std::string addImage(bool isNormal);
    std::string addObj();
    /// The profile of a lamp, which depends on `index` alone.
    std::string addLamp(std::size_t index);
    [[nodiscard]] Patch patch();

  private:
    Draws &draws_;
    nlohmann::json files_ = nlohmann::json::object();
    int imageCount_ = 0;
};

/// A unit vector, or +z for 0.
[[nodiscard]] nlohmann::json unitOf(double x, double y, double z);

/// Adds a glTF file, with what scene files cannot say: second coordinates, tangents, colours, blending and culling.
std::string drawGlb(Draws &draws, FileDraws &files, bool mayEmit);

} // namespace hyalite::core::testing
