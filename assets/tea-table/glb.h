// A binary glTF file in the making: its buffer, and the JSON that describes it.
#pragma once

#include "assets/tea-table/mesh.h"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace tea_table {

/// Triangles of one material, an index into the file's "materials".
struct Primitive {
    int material;
    Mesh mesh;
};

class Glb {
  public:
    /// Returns the index of the new mesh. Numbers are rounded to 2^-20 m, and those of normals and texture coordinates
    /// to 2^-16: no machine's rounding errors reach so far.
    int addMesh(std::string_view name, const std::vector<Primitive> &primitives);

    /// Returns the index of the new texture, which repeats.
    int addTexture(std::string_view name, std::string_view png);

    /// Returns the index of an accessor of vectors, for EXT_mesh_gpu_instancing.
    int addVectors(const std::vector<Vec> &vectors);

    /// Writes the file. `rest` is JSON: the members of the top object that are not made here, each with a comma behind
    /// it. Whether it could.
    [[nodiscard]] bool write(const std::filesystem::path &file, std::string_view rest) const;

  private:
    int addView(std::string_view bytes, int target);
    int addAccessor(std::string_view bytes, int target, std::size_t count, int componentType,
                    std::string_view type, std::string_view more);
    int addFloats(const std::vector<float> &values, std::size_t width, int target, bool hasBounds);

    std::string buffer_;
    std::vector<std::string> views_;
    std::vector<std::string> accessors_;
    std::vector<std::string> meshes_;
    std::vector<std::string> images_;
    std::vector<std::string> textures_;
};

} // namespace tea_table
