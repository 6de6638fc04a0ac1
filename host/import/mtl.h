// Material libraries of Wavefront OBJ files.
#pragma once

#include "host/import/texture_library.h"
#include "host/scene/scene.h"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hyalite {

/// Where the textures of material libraries come from, and go to.
struct MtlTextures {
    std::filesystem::path folder; ///< canonical: what does not lie in it or below is not read
    TextureLibrary &library;
    std::vector<std::string> &warnings; ///< what was passed over, though the picture would differ
};

/// Reads what an MTL file says of its materials, by name, in the order of the file; of two with one name the later is
/// left out. All of them are two-sided.
///
///     Kd, Pr, Pm, Ks, Ns  principled: base colour, roughness and metallic; without Pr the roughness whose highlight is as
///                         wide as that of the exponent Ns, and the mean of Ks as `specular`. Diffuse where all but Kd
///                         are 0 or left out
///     illum 3, 5          a metal of the colour Ks
///     illum 4, 6, 7, 9    glass of the refractive index Ni
///     d, Tr               glass for the share 1 - d, or Tr
///     Ke                  emission
///     map_Kd, map_Ke      textures of the base colour and of the emission, times Kd and Ke, or 1 where these are left out or,
///                         of Ke, 0
///     map_Pr, map_Pm      in place of roughness and metallic
///     map_d               opacity, by its alpha if it has that, cut out at a half
///     norm, map_Bump, bump  a normal map; -bm says how strong
///
/// Names are relative to the library's folder. -s and -o scale and move a texture; other options, textures that are not
/// there, of other formats, or for anything else, and height maps are passed over, with a warning. Fractions are cut off
/// at 0 and 1. Other statements are passed over. Throws Error{BadInput}, with
/// file and line, for what is no regular file, numbers that are missing or not finite, statements before the first
/// newmtl, and more materials than limits::materialCount; and for textures that are damaged, as TextureLibrary does.
[[nodiscard]] std::vector<Material> loadMtl(const std::filesystem::path &file, MtlTextures textures);

/// The file that `name`, relative to `base`, leads to, where it lies in `folder`, which is canonical, or below.
[[nodiscard]] std::optional<std::filesystem::path>
findWithin(const std::filesystem::path &folder, const std::filesystem::path &base, std::string_view name);

} // namespace hyalite
