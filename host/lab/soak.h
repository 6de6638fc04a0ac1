// Soak: a device computes what is known, for minutes or days, and every result is compared: does it compute rightly,
// again and again, warm, and beside others?
#pragma once

#include "host/engine/open_backends.h"
#include "host/engine/time_limit.h"
#include "host/gpu/word_exercise.h"
#include "host/lab/loads.h"
#include "host/lab/sensors.h"
#include "host/lab/wrong_film.h"
#include "host/reference/divergence.h"

#include <glm/vec2.hpp>

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hyalite::core {

struct SoakRequest {
    TimeLimit limit{};
    std::uint64_t passes = 0; ///< of each load; 0: until the limit, which is then given
    /// Of an exercise of a device's memory; empty: gpu::exercisableBytes().
    std::optional<std::uint64_t> maxMemoryBytes{};
    std::vector<std::string> loads{}; ///< names; empty: all
};

// The loads that have no film, on devices only.
inline constexpr std::string_view memoryLoad = "memory";
inline constexpr std::string_view arithmeticLoad = "arithmetic";

/// Whether a fault comes again in ten further passes.
enum class Recurrence {
    Unknown,      ///< not tried, or not whole
    Transient,    ///< in none
    Intermittent, ///< in some
    Permanent,    ///< in all
    Data,         ///< in all, until the scene was uploaded anew: its data in the device's memory were damaged
};

/// What went wrong in a pass.
struct SoakFault {
    enum class Kind {
        Film,       ///< a film has other bits
        Comparison, ///< the device's comparison says so, but the film that was read back is right, or the reverse
        Rays,       ///< the film is right, but not the number of rays that the device counted for it
        Words,      ///< words of an exercise differ
        Device,     ///< a call failed
        Speed,      ///< slower than expected
    };
    Kind kind = Kind::Film;
    std::string load;
    std::uint64_t pass = 0;   ///< of the load, from 1
    std::string time;         ///< UTC: "2026-11-28T21:03:00Z"
    std::string text{};       ///< of a device or a speed: what failed
    std::size_t wrongCount{}; ///< pixels, or words

    // Of a film.
    glm::uvec2 pixel{0};                    ///< the first that differs, row by row
    std::optional<DispatchRecord> dispatch; ///< that rendered it
    std::vector<WrongFilmWord> words;       ///< of it
    std::vector<std::uint32_t> samples{};   ///< one of which is wrong; empty: not known
    std::optional<std::uint32_t> lane{};    ///< of its subgroup, of the first of these
    Recurrence recurrence = Recurrence::Unknown;
    int replays = 0;                        ///< further passes that were looked at
    int repeats = 0;                        ///< in which the same pixel was wrong
    std::optional<Divergence> divergence{}; ///< of a fault that comes again: the first step that differs

    // Of an exercise.
    std::vector<gpu::WrongMemory> memory{};
};

/// The passes of a load that ran one after the other, before the next load had its turn.
struct SoakSlice {
    double seconds = 0.0; ///< from the beginning of the soak to that of the slice
    std::uint64_t passes = 0;
    double medianSpeed = 0.0;
};

/// A load and what came of it.
struct SoakLoad {
    std::string name;
    std::string unit; ///< of its speed: "rays", "bytes", "rounds", each a second
    std::uint64_t passes = 0;
    std::uint64_t wrongPasses = 0;
    std::uint64_t readBacks = 0; ///< passes whose film was read back and compared by the host
    std::vector<float> speeds{}; ///< of each pass
    std::vector<SoakSlice> slices{};
    double workSeconds = 0.0;
    double checkSeconds = 0.0;
    std::string lack{}; ///< why it was not run; empty: it was

    /// Median of the passes, 0 without one.
    [[nodiscard]] double medianSpeed() const;
    /// Slices that were slower than 0.8 of the median: a device that throttles, or a neighbour that is busy.
    [[nodiscard]] std::size_t slowSlices() const;
};

struct SoakVerdict {
    std::string device;      ///< name, or "cpu"
    std::string description; ///< for people
    double seconds = 0.0;
    std::vector<SoakLoad> loads;
    std::vector<SoakFault> faults; ///< at most maxSoakFaults
    WrongPatterns patterns;        ///< over all wrong films and words
    std::vector<SensorRange> sensors;
    std::optional<std::string> stoppedBy{}; ///< "SIGINT"

    /// Whether something was compared, and nothing was wrong.
    [[nodiscard]] bool isSound() const;
    [[nodiscard]] std::uint64_t passes() const;
    [[nodiscard]] std::uint64_t wrongPasses() const;
    /// Share of the time that was spent on comparing.
    [[nodiscard]] double checkShare() const;
};

inline constexpr std::size_t maxSoakFaults = 1000;

struct SoakEvents {
    std::function<void(const SoakFault &)> onFault{};
    std::function<void(double)> onProgress{}; ///< the finished share, in [0, 1]
};

/// Renders the loads by a backend, and exercises memory and arithmetic of its device, in turns.
/// `device` is empty for the CPU twin. Faults do not throw. Throws as prepareLoad() does.
[[nodiscard]] SoakVerdict soak(Backend &backend, const std::optional<gpu::DeviceInfo> &device,
                               const Loads &loads, const SoakRequest &request, Observer &observer,
                               const SoakEvents &events);

} // namespace hyalite::core
