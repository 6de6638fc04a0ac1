// The scene that `hyalite new` writes: small, and with words at each of its parts.
#pragma once

#include <string_view>

namespace hyalite::core {

inline constexpr std::string_view firstScene = R"({
  "description": "A floor, three objects, a lamp and a sky. Distances are in metres, +y is up. Every object of this file may have a description, which is passed over. All keys: assets/README.md of Hyalite.",
  "camera": {
    "description": "At head height, looking at the objects. focusDistance and aperture make a lens of it.",
    "position": [0.5, 2.2, 8.4],
    "target": [0.05, 0.8, 0],
    "horizontalFov": 36,
    "width": 640,
    "height": 400
  },
  "background": [0.24, 0.38, 0.64],
  "materials": {
    "floor": {
      "description": "Matt. Colours are linear red, green and blue, from 0 to 1.",
      "type": "diffuse", "albedo": [0.42, 0.36, 0.3]
    },
    "glass": { "type": "dielectric", "index": 1.5 },
    "gold": { "type": "conductor", "metal": "gold", "roughness": 0.25 },
    "lacquer": {
      "description": "Red under a clear coat.",
      "type": "principled", "baseColour": [0.55, 0.05, 0.04], "roughness": 0.5, "clearcoat": 1
    },
    "lamp": {
      "description": "Whatever has an emission is a light. It shines on the side of its face.",
      "type": "diffuse", "albedo": 0.8, "emission": [32, 27, 21]
    }
  },
  "spheres": [
    { "centre": [-1.35, 0.75, 0], "radius": 0.75, "material": "gold" },
    { "centre": [0.3, 0.6, 1.1], "radius": 0.6, "material": "glass" }
  ],
  "shapes": [
    {
      "description": "The floor: a square from -1 to 1 that faces +z, made larger and turned to face up.",
      "type": "quad", "material": "floor",
      "transform": [ { "scale": 20 }, { "rotateDegrees": [-90, 0, 0] } ]
    },
    {
      "description": "A box of side 1.3, turned a little.",
      "type": "box", "material": "lacquer",
      "transform": [ { "scale": 0.65 }, { "rotateDegrees": [0, 30, 0] }, { "translate": [1.5, 0.65, -0.5] } ]
    },
    {
      "description": "The lamp: a square that faces down, above and to the left.",
      "type": "quad", "material": "lamp",
      "transform": [ { "scale": 0.8 }, { "rotateDegrees": [90, 0, 0] }, { "rotateDegrees": [0, 0, -25] },
                     { "translate": [-1.8, 4, 1.5] } ]
    }
  ],
  "settings": {
    "description": "path follows light on all its ways. More samples (spp) are less noise, and take longer.",
    "integrator": "path",
    "spp": 128,
    "clamp": 4
  }
}
)";

} // namespace hyalite::core
