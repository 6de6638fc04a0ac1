// STL meshes: text and binary.
#pragma once

#include "host/import/obj.h"

#include <filesystem>
#include <span>

namespace hyalite::core {

/// Whether a file without a name is one: text that begins with "solid", or as long as the number of triangles says that
/// a binary file announces.
[[nodiscard]] bool isStl(std::span<const char> bytes);

/// Loads all triangles of all solids of an STL file as one mesh. Vertices with the same coordinates, as floats, become
/// one. The normal of a triangle follows from its winding, counter-clockwise seen from outside; that of the file, which
/// often is 0 or wrong, is passed over; colours, in the two bytes after a triangle or as a statement, are left out with
/// a warning. Blanks of any kind separate words. A file is binary if its
/// size is that of the number of triangles which it announces, or if it does not begin with "solid": binary ones may
/// begin so, too. One that announces more triangles than it holds, or none, is read as far as it goes, with a warning.
///
/// The transform is as for loadObj. The file has at most 4 GiB; memory stays below 64 MiB + 64 times its size.
///
/// Throws Error{BadInput}, with file and line or byte, if the file is not regular or cannot be read, if it holds none
/// of the triangles that it announces, for numbers that are not finite floats and coordinates beyond 1e15 after the
/// transform; and if there is no triangle at all.
[[nodiscard]] ObjMesh loadStl(const std::filesystem::path &file, const MeshTransform &transform = {},
                              const OnReading &onReading = {});

/// The same as one mesh of a file.
[[nodiscard]] MeshFile readStlMeshes(const std::filesystem::path &file, const MeshOptions &options);

} // namespace hyalite::core
