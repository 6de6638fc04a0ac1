// The things on the tea table, each around its own origin, which stands on the table.
#pragma once

#include "assets/tea-table/mesh.h"

namespace tea_table {

/// A round cloth that hangs down in folds.
Mesh cloth();

// A teapot: what is painted of it, and what is only glazed.
Mesh potBody();
Mesh potSpoutAndHandle();

Mesh saucer();

/// A tea glass, and the tea that fits into it with a gap of a fifth of a millimetre.
Mesh teaGlass();
Mesh tea();

Mesh sugarBowl();

/// A plate on a foot. Its top is at cakeStandHeight.
inline constexpr double cakeStandHeight = 0.042;
Mesh cakeStand();

/// A dome of thin glass, open below.
Mesh bellJar();

/// A disc of that radius.
Mesh doily(double radius);

Mesh pearl();

/// Half-side sugarHalf, around its middle.
inline constexpr double sugarHalf = 0.0075;
Mesh sugarCube();

/// Two shells and their filling, coloured at the vertices.
inline constexpr double macaronHeight = 0.023;
Mesh macaron(const Vec &shellColour, const Vec &fillingColour);

/// Two sheets that cross.
Mesh steamPlume();

} // namespace tea_table
