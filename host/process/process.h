// Calls by which a program that renders sets up its own process: two, which are worth a third of the time on lavapipe.
#pragma once

#include "host/gpu/processor_use.h"

namespace hyalite::core {

/// Whose process it is.
enum class ProcessOwner {
    Program, ///< of ours: large arrays are in huge pages (operator_new.cpp), which are soon cleared, and given back
    Library, ///< in a program of others: they are kept for the next render
};

/// The allocator's settings. Call it first in main, before there are other threads.
void prepareProcess(ProcessOwner owner = ProcessOwner::Program);

/// Settings for the driver that is about to be loaded, and room for its compiler: what Observer::beforeDriver() is for.
/// Sets environment variables: no other thread may read the environment meanwhile.
void prepareDriver(const gpu::ProcessorUse &use);

} // namespace hyalite::core
