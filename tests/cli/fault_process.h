// Commands under the fault layer: calls that fail, devices that can do less, and what is left afterwards.
#pragma once

#include "tests/cli/command_line.h"

#include <nlohmann/json.hpp>

#include <map>
#include <string>
#include <vector>

namespace hyalite::core::testing {

/// Environment of a program that runs under the layer: where it is, and that it is wanted.
extern const std::map<std::string, std::string> layerEnvironment;

/// What the fault layer counted.
struct Tally {
    std::map<std::string, long> calls; ///< by function
    std::vector<std::string> faults;   ///< the functions whose calls failed, in their order
    std::map<std::string, long> alive; ///< objects that were never destroyed, by the function that made them
};

[[nodiscard]] Tally parseTally(const std::string &text);

/// A test whose commands run under the layer.
class FaultyDevice : public CommandLine {
  protected:
    void SetUp() override;
    void TearDown() override;

    /// The program in a process of its own, as a user starts it. Its tally is in `lastTally`.
    [[nodiscard]] Outcome runFaulty(const std::string &line, const std::string &faults,
                                    const std::string &fakes = {}, bool isValidated = false);
    /// The command in this process: many of them are fast. Names of files are as they are given, from the root.
    [[nodiscard]] Outcome runHere(const std::string &line, const std::string &faults,
                                  const std::string &fakes = {});

    /// The report that a command wrote into the folder, as r.json.
    [[nodiscard]] nlohmann::json report() const { return nlohmann::json::parse(load("r.json")); }
    /// Of a file in the folder, for runHere().
    [[nodiscard]] std::string path(const std::string &name) const { return (folder / name).string(); }

    Tally lastTally;
};

/// "OUT_OF_HOST_MEMORY" is exit code 5, and so on.
[[nodiscard]] int exitCodeOf(const std::string &result);

} // namespace hyalite::core::testing
