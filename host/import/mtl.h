// Material libraries of Wavefront OBJ files.
#pragma once

#include "host/import/file_finder.h"
#include "host/import/texture_library.h"
#include "host/scene/scene.h"

#include <filesystem>
#include <string>
#include <vector>

namespace hyalite {

/// Textures of material libraries: where to look for them, and where to put them.
struct MtlTextures {
    FileFinder &files;
    TextureLibrary &library;
    std::vector<std::string>
        &warnings; ///< statements that were ignored although they would change the picture
};

/// Reads the materials of an MTL file, by name, in the order of the file; of two with the same name the first counts.
/// All of them are two-sided.
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
///     map_d               opacity, by its alpha if it has that, cut out at a half; without it by the alpha of map_Kd
///     norm, map_Bump, bump  a normal map; -bm says how strong
///
/// Names are relative to the folder of the library; FileFinder also finds those of another computer. -s and -o scale
/// and move a texture. Other options, missing and damaged textures, other formats, other uses, and pictures as map_Bump
/// whose colours are no normals are ignored with a warning. Fractions are clamped to [0, 1]. Other statements are
/// ignored. Throws Error{BadInput}, with file and line, if it is not a regular file, for numbers that are missing or
/// not finite, statements before the first newmtl, and more materials than limits::materialCount; and
/// Error{LimitExceeded} as TextureLibrary does.
[[nodiscard]] std::vector<Material> loadMtl(const std::filesystem::path &file, MtlTextures textures);

} // namespace hyalite
