// Reports of a verification.
#pragma once

#include "host/lab/verify.h"

#include <nlohmann/json.hpp>

#include <span>
#include <string>

namespace hyalite::core {

/// JUnit XML, as CI systems read it: a test suite a device, a test case a film and kernel.
[[nodiscard]] std::string verificationToJunit(std::span<const DeviceVerdict> devices);

[[nodiscard]] nlohmann::ordered_json verificationToJson(const ShippedFilms &shipped,
                                                        std::span<const DeviceVerdict> devices,
                                                        const std::string &commandLine);

/// "12 of 1536 pixels differ, the first ..." in one line.
[[nodiscard]] std::string describe(const FilmDifference &difference);

/// "lights, path".
[[nodiscard]] std::string nameOf(const ShippedFilm &film);

} // namespace hyalite::core
