// The benchmarks, by what they measure. Their names are the places of their figures in the tables (table.h).
#pragma once

namespace hyalite::bench {

/// Rays a second of each kernel, of the reference and of Embree, on the same rays.
void registerRays();

} // namespace hyalite::bench
