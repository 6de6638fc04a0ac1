// PLY meshes: text, and binary of either byte order.
#pragma once

#include "host/import/obj.h"

#include <filesystem>

namespace hyalite::core {

/// Loads the faces of a PLY file as one mesh. Elements, properties and their types may come in any order; what is not
/// named here is passed over:
///
///     element vertex     x y z; nx ny nz; s t, u v, texture_u texture_v or texture_s texture_t; and as a colour red green
///                        blue, r g b or diffuse_red diffuse_green diffuse_blue: whole numbers are sRGB, of which the
///                        largest of their type is white, floats are linear. Alpha is left out
///     element face       a list vertex_indices or vertex_index: polygons of up to 65,536 corners, which may be concave
///                        (triangulate.h); a list texcoord of two numbers a corner goes before the vertices' own; a
///                        colour, where vertices have none; and texnumber, which texture of the header is meant
///     element tristrips  a list vertex_indices or vertex_index: strips of triangles, -1 between two
///
/// Comments "TextureFile NAME" of the header name pictures in or below the folder of the mesh, which are read if
/// `textures` is given: then the mesh has a material for each, and colours of vertices are left out. What is not used
/// is one warning a kind. A file that ends within its faces, or has fewer rows than it announces, is read as far as it
/// goes, with a warning.
///
/// Text has a row a line. The transform is as for loadObj. The file has at most 4 GiB; memory stays below 64 MiB + 64
/// times its size.
///
/// Throws Error{BadInput}, with file and line or byte, if the file is not regular or cannot be read, for a header that
/// is wrong or announces more vertices than the file can hold, for indices out of range, numbers that are not finite
/// floats and coordinates beyond 1e15 after the transform; and if there is no triangle at all, as in a point cloud.
[[nodiscard]] ObjMesh loadPly(const std::filesystem::path &file, const MeshTransform &transform = {},
                              const OnReading &onReading = {}, TextureLibrary *textures = nullptr);

/// The same as one mesh of a file.
[[nodiscard]] MeshFile readPlyMeshes(const std::filesystem::path &file, const MeshOptions &options);

} // namespace hyalite::core
