// Comparison of a profile with an older one, the baseline: times and work counts.
//
// Times jitter, so the comparison allows for noise. The noise of one side is half the interquartile range of its frames
// divided by the median; the noise of the ratio of medians is the root of the sum of both squares. A kernel has
// regressed if its ratio exceeds 1 + the limit by more than the noise. Work counts do not jitter: a count has regressed
// if it grew by more than the limit.
#pragma once

#include "host/report/profile.h"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace hyalite::core {

/// The parts of a profile that are compared.
struct ProfileFigures {
    struct Times {
        std::string name;
        std::vector<double> frameMillis; ///< of each measured frame, not empty
    };
    struct Count {
        std::string name;
        std::uint64_t count = 0;
    };

    std::string device; ///< name and driver
    std::string scene;  ///< its file, for people
    std::string job;    ///< what was rendered, by content; only equal jobs are compared
    std::vector<Times> kernels;
    std::vector<Times> stages; ///< those of frames, and those of the host
    Times frame{"frame", {}};
    std::vector<Count> work;
    nlohmann::json report; ///< all figures, for pages
};

[[nodiscard]] ProfileFigures figuresOf(const Profile &profile);

/// Reads the JSON of a profile. Throws Error{BadInput} naming the file and the key that is missing or wrong, or another
/// version than profileVersion (profile_json.h).
[[nodiscard]] ProfileFigures readFigures(const std::filesystem::path &file);

/// How a time differs. It has changed if the ratio is off 1 by more than three times the noise: of two runs of 5 frames
/// that do not differ, 3 in 100 do so by chance (of 3 frames 9, of 10 frames none; normal jitter).
enum class Change { Unknown, None, Faster, Slower };
inline constexpr double noisesOfChange = 3.0;

struct TimeChange {
    std::string name;
    double oldMillis = 0.0; ///< median of the frames
    double newMillis = 0.0;
    double ratio = 1.0;          ///< new / old
    std::optional<double> noise; ///< of the ratio, relative; empty if a side has a single frame
    bool isRegression = false;

    [[nodiscard]] Change change() const;
};

struct CountChange {
    std::string name;
    std::uint64_t oldCount = 0;
    std::uint64_t newCount = 0;
    bool isRegression = false;
};

/// The reasons why a comparison may fail.
enum class Gate { All, Times, Work };

struct BaselineComparison {
    std::vector<TimeChange> kernels;
    std::vector<TimeChange> stages;     ///< of both sides, not gated: for pages
    TimeChange frame;                   ///< not a regression by itself: it includes compilers and caches
    std::vector<CountChange> work;      ///< differing counts
    std::size_t comparedCounts = 0;     ///< including equal ones
    std::vector<std::string> unmatched; ///< kernels and counts of one side only
    bool isSameDevice = true;
    bool isPassed = true;
};

/// Throws Error{BadInput} if the two did not render the same. Only the request in `profile` matters; it need not be
/// finished.
void requireSameJob(const ProfileFigures &baseline, const Profile &profile);

/// Both are of the same job. `maxRegression` is relative: 0.05 is 5 %. Times of another device are compared but never
/// fail.
[[nodiscard]] BaselineComparison compareWithBaseline(const ProfileFigures &baseline,
                                                     const ProfileFigures &now, double maxRegression,
                                                     Gate gate);

/// A table for people, with a line feed at the end.
[[nodiscard]] std::string comparisonTable(const BaselineComparison &comparison, double maxRegression,
                                          Gate gate);

} // namespace hyalite::core
