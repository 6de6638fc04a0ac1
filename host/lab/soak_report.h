// Reports of a soak: for people, for CI systems and as JSON; and the speeds of an earlier one.
#pragma once

#include "host/lab/soak.h"

#include <nlohmann/json.hpp>

#include <span>
#include <string>

namespace hyalite::core {

inline constexpr int soakReportVersion = 1;

/// "materials, pass 3: 1 pixel differs; tile (0, 0) of 96x64; pixel (5, 7), sample 2, lane 13: sum.red 3f800001, not
/// 3f800000 (bit 0); ..." in one line.
[[nodiscard]] std::string describe(const SoakFault &fault);

/// "sound: 8 loads, 412 passes in 1 min 00 s, 2.1 % of the time for checks" or "FAULTY: ...".
[[nodiscard]] std::string summaryOf(const SoakVerdict &verdict);

/// "12.3 M rays/s", or with bytes and rounds.
[[nodiscard]] std::string speedText(const SoakLoad &load);

/// JUnit XML: a test suite a device, a test case a load.
[[nodiscard]] std::string soakToJunit(std::span<const SoakVerdict> devices);

[[nodiscard]] nlohmann::ordered_json soakToJson(const Loads &loads, std::span<const SoakVerdict> devices,
                                                const std::string &commandLine);

/// The median speeds of a report.
struct ExpectedSpeed {
    std::string device;
    std::string load;
    double speed = 0.0;
};

/// Reads those of a file that soakToJson() wrote. Throws Error{BadInput}.
[[nodiscard]] std::vector<ExpectedSpeed> readExpectedSpeeds(const std::string &file);

/// Adds a fault for each load that is slower than 0.8 of what is expected. Throws Error{BadInput} if nothing is expected
/// of this device.
void judgeSpeeds(SoakVerdict &verdict, std::span<const ExpectedSpeed> expected);

} // namespace hyalite::core
