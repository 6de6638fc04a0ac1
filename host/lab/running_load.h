// A load of a soak, which is run for a while at a time, and what all loads of a device share.
#pragma once

#include "host/engine/observer.h"
#include "host/engine/time_limit.h"
#include "host/film/timeline.h"
#include "host/lab/soak.h"

#include <cstddef>
#include <cstdint>
#include <string>

namespace hyalite::core {

/// What all loads of a device share.
struct Soak {
    const SoakRequest &request;
    Observer &observer;
    const SoakEvents &events;
    SoakVerdict verdict;
    std::int64_t beginNanos = hostNanos();

    [[nodiscard]] double seconds() const { return Span{beginNanos, hostNanos()}.seconds(); }
    [[nodiscard]] bool isStopped() const { return observer.wantsStop().has_value(); }
    [[nodiscard]] bool isOver(const SoakLoad &load) const {
        return request.passes > 0 ? load.passes >= request.passes : request.limit.isReached();
    }
    /// Drops it where there are maxSoakFaults.
    void report(SoakFault fault);
};

/// A load that is run for a while at a time. Its verdict is by index, as others are added meanwhile.
class RunningLoad {
  public:
    RunningLoad(Soak &soak, std::string name, std::string unit);
    virtual ~RunningLoad() = default;
    RunningLoad(const RunningLoad &) = delete;
    RunningLoad &operator=(const RunningLoad &) = delete;

    /// Runs passes until the slice is over, at least one where the soak is not over. Faults of the device are told, and
    /// do not throw.
    void runFor(double seconds);
    /// Tells what it has not told yet, and that it made no pass.
    void finish();
    [[nodiscard]] bool isDone() const;
    [[nodiscard]] const SoakLoad &load() const { return soak_.verdict.loads[index_]; }
    [[nodiscard]] SoakLoad &load() { return soak_.verdict.loads[index_]; }

  protected:
    virtual void run(const TimeLimit &slice) = 0;
    virtual void tellOpenFaults() {}

    /// No slice follows.
    void giveUp();
    [[nodiscard]] SoakFault newFault(SoakFault::Kind kind) const;
    /// Whether another pass of this slice follows.
    [[nodiscard]] bool goesOn(const TimeLimit &slice) const {
        return !slice.isReached() && !soak_.isOver(load()) && !soak_.isStopped();
    }
    void countPass(double work, double workSeconds, double checkSeconds);

    Soak &soak_;

  private:
    std::size_t index_;
    int failures_ = 0;

    void runGuarded(const TimeLimit &slice);
};

} // namespace hyalite::core
