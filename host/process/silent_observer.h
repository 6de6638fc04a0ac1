// The observer of programs that say nothing: it makes the settings of drivers.
#pragma once

#include "host/engine/observer.h"
#include "host/process/process.h"

namespace hyalite::core {

class SilentObserver : public Observer {
  public:
    void beforeDriver(const gpu::ProcessorUse &use) override { prepareDriver(use); }
};

} // namespace hyalite::core
