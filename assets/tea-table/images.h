// The textures of the tea table.
#pragma once

#include "assets/still-life/picture.h"

namespace tea_table {

// Linen with a wide check, and its threads; both repeat.
still_life::Picture clothColour();
still_life::Picture clothNormals();

// Blossoms and leaves on a vine around the pot, between two lines.
still_life::Picture potColour();

// Lace, and holes where its alpha is 0: rings of `laceScallopCount` scallops and of eyelets, 1 across.
inline constexpr int laceScallopCount = 28;
inline constexpr double laceScallopRadius = 0.44; // of their middles
still_life::Picture lace();

// Grains of sugar.
still_life::Picture sugarNormals();

// Steam, denser in the middle of its lower half.
still_life::Picture steam();

} // namespace tea_table
