// Glass that touches other surfaces.
#pragma once

#include "host/scene/scene.h"

namespace hyalite::core {

/// Moves glass off the surfaces that it coincides with or nearly touches, so that it reaches into them, or stays behind
/// them: by 64 units of rounding (2^-24) of the largest coordinate there, where less than 32 are between them.
///
/// A ray that leaves a surface starts up to about 20 such units off it (offsetRayOrigin in
/// shaders/geometry/surface.glsl) and would miss another surface that is nearer: a path would then not know which glass
/// it is in, or leave through what its glass stands on. Where solids overlap instead, priorities decide
/// (shaders/bsdf/media.glsl). Of two solids of glass that of lower priority moves, or of equal ones the later; opaque
/// surfaces do not. Faces that look at each other come to overlap; of two that look the same way, that of higher
/// priority comes to be in front. What does not touch keeps its bits.
///
/// Instances that have to move become meshes. The scene is valid, and its instances are arranged.
void partContacts(Scene &scene);

} // namespace hyalite::core
