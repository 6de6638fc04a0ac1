#include "host/process/process.h"

#include "host/process/heap.h"
#include "host/process/lavapipe.h"

namespace hyalite::core {

void prepareProcess() {
    useOneHeap();
    keepFreedMemory();
}

void prepareDriver(const gpu::ProcessorUse &use) {
    reserveHeap();
    configureLavapipe(use);
}

} // namespace hyalite::core
