// The benchmarks, by what they measure. A name, TABLE/ROW/COLUMN, is the place of its figures (table.h).
#pragma once

namespace hyalite::core::bench {

class Context;

// The context outlives the runs of the benchmarks.

void registerRays(
    Context &context); ///< rays a second of each kernel, of the reference and of Embree, on the same rays
void registerFrames(Context &context);     ///< whole images, on each device and on the CPU
void registerSizes(Context &context);      ///< time a ray by triangles, instances and lamps
void registerNoise(Context &context);      ///< of paths at equal time, beside a path tracer on Embree
void registerFarm(Context &context);       ///< pictures that renderers share
void registerStartUp(Context &context);    ///< the smallest of images
void registerBuilding(Context &context);   ///< trees, beside Embree's
void registerReading();                    ///< OBJ files, beside tinyobjloader
void registerBruteForce(Context &context); ///< the tree against no tree

} // namespace hyalite::core::bench
