// Cryptomattes: mattes of objects, materials and assets in an EXR, which compositors pick by name.
//
// J. Friedman and A. C. Jones, "Fully automatic ID mattes with support for motion blur and transparency", SIGGRAPH 2015
// posters, and the Cryptomatte specification, version 1.2.0 (https://github.com/Psyop/Cryptomatte).
#pragma once

#include "host/film/view_film.h"
#include "host/image/picture.h"

#include <cstdint>
#include <string_view>
#include <vector>

namespace hyalite::core {

/// Ranks of a pixel: two a layer.
inline constexpr int matteRankCount = 6;

/// The id of a name: its MurmurHash3, with bit 23 flipped where the float of these bits would be subnormal, infinite or
/// not a number.
[[nodiscard]] std::uint32_t matteIdOf(std::string_view name);

/// The layers NAME00, NAME01 and NAME02 of a tally, whose channels r and b are ids, as floats of their bits, and g and
/// a the share of the samples that show them: the largest share first, of equal ones the smaller id. Without an id both
/// are 0. Names of one id have one share. `film` must outlive the layers.
[[nodiscard]] std::vector<Layer> matteLayers(const ViewFilm &film);

/// The attributes cryptomatte/KEY/name, hash, conversion and manifest, which has the ids of all names as JSON.
[[nodiscard]] std::vector<Attribute> matteAttributes(const ViewFilm &film);

} // namespace hyalite::core
