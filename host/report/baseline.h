// A profile against an older one: is anything slower, and is anything more work?
//
// Times jitter, so they are judged with their noise: each side's noise is half the distance between the quartiles of
// its frames, as a share of the median, and the noise of the ratio of the two medians is the root of the sum of their
// squares. A kernel is a regression where its ratio is above 1 + the limit by more than the noise. Work counts do not
// jitter: a count is a regression where it has grown by more than the limit.
#pragma once

#include "host/report/profile.h"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace hyalite {

/// What of a profile can be held against an older one.
struct ProfileFigures {
    struct Times {
        std::string name;
        std::vector<double> frameMillis; ///< of each measured frame, not empty
    };
    struct Count {
        std::string name;
        std::uint64_t count = 0;
    };

    std::string device; ///< its name and driver
    std::string job;    ///< what was rendered: times and counts of other jobs say nothing
    std::vector<Times> kernels;
    Times frame{"frame", {}};
    std::vector<Count> work;
};

[[nodiscard]] ProfileFigures figuresOf(const Profile &profile);

/// Of a file that --report has written. Throws Error{BadInput} naming the file and the key that is missing or wrong.
[[nodiscard]] ProfileFigures readFigures(const std::filesystem::path &file);

struct TimeChange {
    std::string name;
    double oldMillis = 0.0; ///< median of the frames
    double newMillis = 0.0;
    double ratio = 1.0;          ///< new / old
    std::optional<double> noise; ///< of the ratio, relative; nothing where a side has a single frame
    bool isRegression = false;
};

struct CountChange {
    std::string name;
    std::uint64_t oldCount = 0;
    std::uint64_t newCount = 0;
    bool isRegression = false;
};

/// What may fail a comparison.
enum class Gate { All, Times, Work };

struct BaselineComparison {
    std::vector<TimeChange> kernels;
    TimeChange frame;                   ///< is no regression by itself: compilers and caches are a part of it
    std::vector<CountChange> work;      ///< those that differ
    std::size_t comparedCounts = 0;     ///< of work, equal ones too
    std::vector<std::string> unmatched; ///< kernels and counts that only one side has
    bool isSameDevice = true;
    bool isPassed = true;
};

/// Throws Error{BadInput} where the two have not rendered the same. Of `profile`, which need not be finished, only what
/// was asked for matters.
void requireSameJob(const ProfileFigures &baseline, const Profile &profile);

/// Both are of the same job. `maxRegression` is a share, 0.05 for 5 %. Times of another device are compared, but fail
/// nothing.
[[nodiscard]] BaselineComparison compareWithBaseline(const ProfileFigures &baseline,
                                                     const ProfileFigures &now, double maxRegression,
                                                     Gate gate);

/// As a table for people, with a line feed at the end.
[[nodiscard]] std::string comparisonTable(const BaselineComparison &comparison, double maxRegression,
                                          Gate gate);

} // namespace hyalite
