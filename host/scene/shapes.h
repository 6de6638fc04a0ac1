// Shapes as small meshes: what a scene is made of where no file is needed.
#pragma once

#include "host/scene/scene.h"

#include <glm/mat4x3.hpp>

namespace hyalite::core {

/// Quad and Disk lie in the plane z = 0 and face +z. Cylinder stands along z.
enum class ShapeKind { Quad, Box, Disk, Cylinder };

/// The shape around the origin, within [-1, 1] along each axis that it has. Faces are counter-clockwise seen from
/// outside. Quads and boxes are exact; a disk or a cylinder is a prism with `segments` (3 to 4096) corners on the unit
/// circle, whose side has smooth normals. A cylinder is closed by two disks. All have texture coordinates in [0, 1].
[[nodiscard]] TriangleMesh makeShape(ShapeKind kind, int segments);

/// The mesh under a map with a volume, computed in double and rounded to float once. Normals follow the inverse
/// transpose; where the map mirrors, faces are turned, so that outside stays outside.
[[nodiscard]] TriangleMesh transformed(TriangleMesh mesh, const glm::dmat4x3 &map);

} // namespace hyalite::core
