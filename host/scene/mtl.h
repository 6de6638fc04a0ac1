// Material libraries of Wavefront OBJ files.
#pragma once

#include "host/scene/scene.h"

#include <filesystem>
#include <vector>

namespace hyalite {

/// Reads what an MTL file says of its materials, by name, in the order of the file; of two with one name the later is left
/// out. All of them are two-sided.
///
///     Kd, Pr, Pm, Ks, Ns  principled: base colour, roughness and metallic; without Pr the roughness whose highlight is as
///                         wide as that of the exponent Ns, and the mean of Ks as `specular`. Diffuse where all but Kd
///                         are 0 or left out
///     illum 3, 5          a metal of the colour Ks
///     illum 4, 6, 7, 9    glass of the refractive index Ni
///     d, Tr               glass for the share 1 - d, or Tr
///     Ke                  emission
///
/// Fractions are cut off at 0 and 1. Other statements, textures among them, are passed over. Throws Error{BadInput}, with
/// file and line, for what is no regular file, numbers that are missing or not finite, statements before the first
/// newmtl, and more materials than limits::materialCount.
[[nodiscard]] std::vector<Material> loadMtl(const std::filesystem::path &file);

} // namespace hyalite
