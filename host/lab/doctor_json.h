// An examination as JSON. The keys are listed in host/cli/README.md.
#pragma once

#include "host/lab/doctor.h"

#include <nlohmann/json.hpp>

#include <string>

namespace hyalite::core {

/// Of the document. A new key leaves it; one that changes or goes raises it.
inline constexpr int doctorVersion = 1;

[[nodiscard]] nlohmann::ordered_json examinationToJson(const Examination &examination,
                                                       const std::string &commandLine);

} // namespace hyalite::core
