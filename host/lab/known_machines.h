// Known machines: speeds that were measured before, shipped with the program, to compare others with.
#pragma once

#include "host/lab/speed.h"

#include <string>
#include <vector>

namespace hyalite::core {

struct KnownMachine {
    std::string machine; ///< processors and system
    std::string device;
    std::string driver;
    std::string date;    ///< YYYY-MM-DD
    std::string program; ///< version
    std::string command; ///< that measured it
    std::vector<SpeedFigure> speed;
};

/// Reads known-machines.json of the first asset folder that has one. Throws Error{BadInput}.
[[nodiscard]] std::vector<KnownMachine> readKnownMachines();

} // namespace hyalite::core
