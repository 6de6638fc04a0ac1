// The cat's legs and paws.
#pragma once

#include "assets/cat/implicit.h"

namespace hyalite::cat {

// Adds all four legs to `field`, which holds the trunk already, and cuts the soles flat.
void addLegs(Field &field);

} // namespace hyalite::cat
