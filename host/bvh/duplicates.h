// Duplicate triangles. No tree can separate them, so a ray that reaches one would test them all.
#pragma once

#include "host/bvh/bvh.h"

#include <vector>

namespace hyalite::core {

/// Removes all but the first of each set of identical triangles from `items`, which begins with the triangles of the
/// scene's meshes in order; other items may follow, and stay.
///
/// Triangles are identical if they have the same material and the same corners, bit for bit and in the same order. With
/// an opacity texture their texture coordinates must be equal too. A ray that hits one hits all at the same distance,
/// and the smallest index wins. Dropping the others therefore changes no hit. (As emitters, duplicates would be sampled
/// by shadow rays and add their light again.)
void dropDuplicates(const Scene &scene, std::vector<BuildTriangle> &items);

} // namespace hyalite::core
