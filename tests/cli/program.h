// The program as a user runs it: a command line goes in; exit code, standard output and standard error come out.
//
// No shell is involved.
#pragma once

#include <filesystem>
#include <functional>
#include <iosfwd>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace hyalite::core::testing {

/// Where a stream of the program leads.
enum class Stream {
    Captured,
    Closed,
    FullDevice, ///< /dev/full: every write fails as on a full disk
    Terminal,   ///< captured, through a pseudo terminal of 80 columns
};

/// What surrounds a run of the program.
struct Surroundings {
    std::filesystem::path folder; ///< the working directory
    /// Added to this process' environment; without a value: removed from it.
    std::map<std::string, std::optional<std::string>> environment;
    std::filesystem::path input = "/dev/null"; ///< what standard input is, a path in the folder
    Stream output = Stream::Captured;
    Stream errors = Stream::Captured;
    double timeoutSeconds = 1200.0;   ///< after which the program is killed and the test fails
    std::string signalAfter;          ///< if set: `signal` is sent once, when standard error contains this
    std::function<bool()> signalWhen; ///< if set: `signal` is sent once, when this says so
    int signal = 0; ///< sent once and not before the program has said something, or as signalWhen says
    double signalAgainSeconds =
        0.0; ///< if not 0: `signal` is sent again and again, so long after the last time
    std::size_t fileSizeLimitBytes =
        0; ///< if not 0: larger files fail with EFBIG, standing in for a full disk
};

struct Outcome {
    int exitCode = -1; ///< 128 + N if signal N ended the program, as a shell reports it
    std::string output;
    std::string errors;
    double seconds = 0.0;
    std::size_t peakMemoryBytes = 0; ///< resident
};

/// All of it, for the message of a failing test.
std::ostream &operator<<(std::ostream &stream, const Outcome &outcome);

/// Runs HYALITE_PROGRAM and waits for it. A run that exceeds the timeout adds a test failure. Throws
/// std::runtime_error where no program can be started.
[[nodiscard]] Outcome runProgram(const std::vector<std::string> &arguments, const Surroundings &surroundings);

} // namespace hyalite::core::testing
