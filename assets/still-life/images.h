// The images of the still life: what its things wear.
#pragma once

#include "assets/still-life/picture.h"

namespace still_life {

// Planks, which repeat both ways.
Picture woodColour();
Picture woodRoughness();
Picture woodNormals();

// An invented planet by longitude and latitude: its sea is smooth, its land is not.
Picture globeColour();
Picture globeRoughness();

// Of a paper lantern what it shines with: blossoms on a branch before the light, and its ribs.
Picture lanternLight();

// A pot of fired clay with a painted band, and the marks of the potter's fingers.
Picture potColour();
Picture potNormals();

// A leaf, whose tip is at the top; around it nothing.
Picture leaf();

} // namespace still_life
