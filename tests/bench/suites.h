// The benchmarks, by what they measure. A name, TABLE/ROW/COLUMN, is the place of its figures (table.h).
#pragma once

namespace hyalite::bench {

void registerRays();       ///< rays a second of each kernel, of the reference and of Embree, on the same rays
void registerFrames();     ///< whole images, on the device and on the CPU
void registerStartUp();    ///< the smallest of images
void registerBuilding();   ///< trees, beside Embree's
void registerReading();    ///< OBJ files, beside tinyobjloader
void registerBruteForce(); ///< the tree against no tree

} // namespace hyalite::bench
