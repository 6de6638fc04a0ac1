// Sensors: temperatures and clocks, as Linux tells them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace hyalite::core {

struct SensorReading {
    std::string name; ///< "amdgpu edge"
    std::string unit; ///< "C" or "MHz"
    double value = 0.0;
};

/// What /sys in `root` has of hardware monitors, thermal zones and clocks, in the order of their names; nothing on
/// systems that tell nothing, as virtual machines, and of drivers that do not, as NVIDIA's.
[[nodiscard]] std::vector<SensorReading> readSensors(const std::filesystem::path &root = "/");

/// The range of a sensor's readings.
struct SensorRange {
    std::string name;
    std::string unit;
    double min = 0.0;
    double max = 0.0;
};

/// Widens the ranges by readings, and adds those of new sensors.
void addReadings(std::vector<SensorRange> &ranges, const std::vector<SensorReading> &readings);

} // namespace hyalite::core
