#include "host/process/process.h"

#include "host/process/heap.h"
#include "host/process/lavapipe.h"

namespace hyalite::core {

void prepareProcess(ProcessOwner owner) {
    useOneHeap();
    keepFreedMemory(owner == ProcessOwner::Program ? 4 << 20 : 32 << 20);
}

void prepareDriver(const gpu::ProcessorUse &use) {
    reserveHeap();
    configureLavapipe(use);
}

} // namespace hyalite::core
