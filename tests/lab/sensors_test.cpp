// Temperatures and clocks of a machine that is made up.
#include "host/lab/sensors.h"

#include "tests/fixtures/temporary_folder.h"

#include <gtest/gtest.h>

#include <fstream>

namespace hyalite::core {
namespace {

TEST(Sensors, AreReadAsLinuxTellsThem) {
    const testing::TemporaryFolder folder;
    const auto store = [&](const std::string &name, const std::string &text) {
        const std::filesystem::path file = folder.path / name;
        std::filesystem::create_directories(file.parent_path());
        std::ofstream(file) << text << '\n';
    };
    EXPECT_TRUE(readSensors(folder.path).empty());
    store("sys/class/hwmon/hwmon1/name", "amdgpu");
    store("sys/class/hwmon/hwmon1/temp1_input", "61500");
    store("sys/class/hwmon/hwmon1/temp1_label", "edge");
    store("sys/class/hwmon/hwmon1/freq1_input", "2100000000");
    store("sys/class/hwmon/hwmon1/temp2_input", "nonsense");
    store("sys/class/thermal/thermal_zone0/type", "x86_pkg_temp");
    store("sys/class/thermal/thermal_zone0/temp", "48000");
    store("sys/devices/system/cpu/cpu0/cpufreq/scaling_cur_freq", "3000000");
    store("sys/devices/system/cpu/cpu1/cpufreq/scaling_cur_freq", "2000000");
    store("sys/class/drm/card0/gt_act_freq_mhz", "1150");
    std::vector<SensorRange> ranges;
    addReadings(ranges, readSensors(folder.path));
    store("sys/class/hwmon/hwmon1/temp1_input", "83000");
    addReadings(ranges, readSensors(folder.path));
    ASSERT_EQ(ranges.size(), 5u);
    EXPECT_EQ(ranges[0].name, "amdgpu freq1");
    EXPECT_EQ(ranges[0].max, 2100.0);
    EXPECT_EQ(ranges[1].name, "amdgpu edge");
    EXPECT_EQ(ranges[1].min, 61.5);
    EXPECT_EQ(ranges[1].max, 83.0);
    EXPECT_EQ(ranges[2].name, "x86_pkg_temp");
    EXPECT_EQ(ranges[3].max, 2500.0);
    EXPECT_EQ(ranges[4].name, "card0 clock");
}

} // namespace
} // namespace hyalite::core
