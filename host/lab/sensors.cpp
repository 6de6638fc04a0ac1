#include "host/lab/sensors.h"

#include "host/lab/system_files.h"

#include <algorithm>
#include <charconv>
#include <optional>
#include <string_view>

namespace hyalite::core {

namespace fs = std::filesystem;

namespace {

std::optional<double> numberIn(const fs::path &file) {
    const std::string text = firstLineOf(file);
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc() && end != text.data() ? std::optional(value) : std::nullopt;
}

/// Of temp1_input in millidegrees, freq1_input in hertz.
void readMonitor(const fs::path &folder, std::vector<SensorReading> &readings) {
    constexpr std::string_view ending = "_input";
    for (const fs::path &file : filesIn(folder)) {
        const std::string name = file.filename().string();
        const bool isTemperature = name.starts_with("temp");
        if (!name.ends_with(ending) || (!isTemperature && !name.starts_with("freq")))
            continue;
        const std::string sensor = name.substr(0, name.size() - ending.size());
        const std::string label = firstLineOf(folder / (sensor + "_label"));
        if (const std::optional<double> value = numberIn(file))
            readings.push_back({firstLineOf(folder / "name") + " " + (label.empty() ? sensor : label),
                                isTemperature ? "C" : "MHz", *value / (isTemperature ? 1e3 : 1e6)});
    }
}

} // namespace

std::vector<SensorReading> readSensors(const fs::path &root) {
    std::vector<SensorReading> readings;
    for (const fs::path &monitor : filesIn(root / "sys/class/hwmon"))
        readMonitor(monitor, readings);
    for (const fs::path &zone : filesIn(root / "sys/class/thermal"))
        if (const std::optional<double> value = numberIn(zone / "temp"))
            readings.push_back({firstLineOf(zone / "type"), "C", *value / 1e3});
    double clocks = 0.0;
    int processors = 0;
    for (const fs::path &processor : filesIn(root / "sys/devices/system/cpu"))
        if (const std::optional<double> kilohertz = numberIn(processor / "cpufreq/scaling_cur_freq")) {
            clocks += *kilohertz / 1e3;
            ++processors;
        }
    if (processors > 0)
        readings.push_back({"processors, mean", "MHz", clocks / processors});
    for (const fs::path &card : filesIn(root / "sys/class/drm"))
        if (const std::optional<double> clock = numberIn(card / "gt_act_freq_mhz"))
            readings.push_back({card.filename().string() + " clock", "MHz", *clock});
    return readings;
}

void addReadings(std::vector<SensorRange> &ranges, const std::vector<SensorReading> &readings) {
    for (const SensorReading &reading : readings) {
        const auto known = std::ranges::find(ranges, reading.name, &SensorRange::name);
        if (known == ranges.end()) {
            ranges.push_back({reading.name, reading.unit, reading.value, reading.value});
            continue;
        }
        known->min = std::min(known->min, reading.value);
        known->max = std::max(known->max, reading.value);
    }
}

} // namespace hyalite::core
