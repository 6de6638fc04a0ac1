// The cat's head.
#pragma once

#include "assets/cat/implicit.h"

namespace hyalite::cat {

// Adds the head to `field`, in a frame whose x axis is the line of sight, y up through the skull, and z to the
// cat's right; the origin is the middle of the skull.
void addHead(Field &field, const Frame &head);

} // namespace hyalite::cat
