// `hyalite verify --minutes`: known results, computed again and again by all devices at once.
#pragma once

#include "host/cli/failure.h"
#include "host/cli/requested_file.h"
#include "host/cli/verify_subjects.h"

#include <CLI/CLI.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace hyalite::core {

struct SoakOptions {
    std::optional<double> minutes;
    std::optional<std::uint64_t> passes;
    std::optional<std::uint64_t> memoryMiB;
    std::vector<std::string> loads; ///< none: all
    std::string expect;             ///< a report

    [[nodiscard]] bool isWanted() const { return minutes || passes; }
};

void addSoakOptions(CLI::App &command, SoakOptions &options);

/// Throws Error{Usage} for unknown loads, and for options that need --minutes or --passes.
void requireSoak(const SoakOptions &options);

/// Runs, prints verdicts, and writes the files that there are. Throws Error of the stop's kind if a signal ends it,
/// after all is written.
[[nodiscard]] ExitCode runSoak(const std::vector<Subject> &subjects, const SoakOptions &options,
                               RequestedFile &junit, RequestedFile &report, bool isQuiet,
                               const std::string &commandLine);

} // namespace hyalite::core
