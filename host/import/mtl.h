// Material libraries of Wavefront OBJ files.
#pragma once

#include "host/import/file_finder.h"
#include "host/import/losses.h"
#include "host/import/texture_library.h"
#include "host/scene/scene.h"

#include <filesystem>
#include <vector>

namespace hyalite::core {

/// Textures of material libraries: where to look for them, and where to put them.
struct MtlTextures {
    FileFinder &files;
    TextureLibrary &library;
    Losses &losses; ///< what is left out although it would change the picture
};

/// Reads the materials of an MTL file, by name, in the order of the file; of two with the same name the first counts.
/// All of them are two-sided.
///
///     Kd, Pr, Pm, Ks, Ns  principled: base colour, roughness and metallic; without Pr the roughness whose highlight is as
///                         wide as that of the exponent Ns. With Pr, Pm or their maps Ks is not used; without them its mean
///                         is `specular`. Diffuse where all but Kd are 0 or left out
///     Pc, Pcr             a clear coat
///     d, Tr               glass for the share 1 - d, or Tr where there is no d; a Tr of 1 is opaque
///     illum 3, 5          a metal of the colour Ks       } if the material has no look: no Kd but black, no map_Kd,
///     illum 4, 6, 7, 9    glass of the refractive index Ni } nothing physical, no d of 1, and, beside a black Kd, an Ni above 1
///     Ke                  emission
///     map_Kd, map_Ke      textures of the base colour and of the emission, times Kd and Ke, or 1 where these are left out or 0
///     map_Pr, map_Pm      instead of roughness and metallic
///     map_d               opacity, by its alpha if it has that, cut out at a half; without it by the alpha of map_Kd
///     norm, map_Bump, bump  a normal map; -bm says how strong
///
/// README.md says what programs write. Keywords may be in any letter case. Names are relative to the folder of the
/// library; FileFinder also finds those of another computer. -s and -o scale and move a texture. Fractions are clamped
/// to [0, 1]. Statements that cannot be read or are not used, other options, missing and damaged textures, other
/// formats, other uses, and pictures as map_Bump whose colours are no normals are left out, as `losses` say. Throws
/// Error{BadInput} if it is not a regular file, and for more materials than limits::materialCount; and
/// Error{LimitExceeded} as TextureLibrary does.
[[nodiscard]] std::vector<Material> loadMtl(const std::filesystem::path &file, MtlTextures textures);

} // namespace hyalite::core
