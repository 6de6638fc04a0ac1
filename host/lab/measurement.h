// Measurement of renders, stage by stage, for a profile.
#pragma once

#include "host/engine/open_backends.h"
#include "host/engine/prepare.h"
#include "host/engine/time_limit.h"
#include "host/film/film_file.h"
#include "host/report/profile.h"

#include <memory>
#include <optional>
#include <string>

namespace hyalite {

/// A request for a measurement.
struct MeasurementRequest {
    SceneOptions scene;
    std::string device = "auto";
    int threadCount = 0; ///< 0: all
    DeviceOptions deviceOptions;
    int warmupCount = 1;
    int repeatCount = 5;
    std::optional<double> timeLimitSeconds; ///< for all renders together
    bool isCounting = false;                ///< all that countWork() and countKernelWork() count
    bool isUnverified = false;
};

/// Call the stages once each, in the order of their declarations; the counts are optional.
///
/// A time limit leaves half of the time to the counts, if there are any. Of a render that it stops remains what it has
/// finished; the profile says so.
class Measurement {
  public:
    /// `observer` must outlive it.
    Measurement(const MeasurementRequest &request, const std::string &commandLine, Observer &observer);

    void prepareScene();
    void openDevice();
    /// From here on the time counts. `isCounting`: there will be counts.
    void startTime(bool isCounting);
    /// Renders a first frame and compares it with the CPU twin's, unless the request skips that or the device is the
    /// CPU twin. Returns the reason not to measure, or nothing.
    [[nodiscard]] std::optional<std::string> verify();
    /// Renders the warm-ups and the repeats. If the time limit leaves none, the frame that is finished most is measured.
    void measure();
    /// Counts the work of the rays of the integrator, in a traversal with a stack, whichever kernel is measured.
    void countWork();
    /// Renders once more and counts the work of the measured kernel's traversal, if it has one.
    void countKernelWork();

    [[nodiscard]] const PreparedScene &scene() const { return scene_; }
    [[nodiscard]] const Backend &device() const { return *backend_; }
    [[nodiscard]] const Film &film() const { return *film_; } ///< of a measured frame
    /// Whether the time limit left out what a baseline is compared with.
    [[nodiscard]] bool isCut() const { return isCountCut_ || measuredShare(profile_) < 1.0; }
    /// Result of countWork(): boxes and triangles tested, in false colours.
    [[nodiscard]] const std::optional<Drawing> &heatMap() const { return heatMap_; }
    [[nodiscard]] const Profile &profile() const { return profile_; }
    [[nodiscard]] Profile &profile() { return profile_; }

  private:
    [[nodiscard]] bool isVerifiable() const { return !isReference(request_.device); }
    /// Returns whether the frame is finished.
    bool renderFrame(const std::string &label, bool isMeasured);
    [[nodiscard]] BackendResult render(Backend &backend, const RenderSettings &settings,
                                       const RenderTask &task) const;
    [[nodiscard]] double finishedShare(const Film &film) const;
    /// Notes a count that the time limit cut.
    void cutCount(const char *what, double share);

    const MeasurementRequest request_;
    Observer &observer_;
    Stopwatch watch_;
    PreparedScene scene_;
    std::unique_ptr<Backend> backend_;
    TimeLimit limit_;          ///< of all renders
    TimeLimit measuring_;      ///< of those before the counts
    std::optional<Film> film_; ///< of the frame that is finished most
    double filmShare_ = 0.0;
    bool isCountCut_ = false;
    std::optional<Drawing> heatMap_;
    Profile profile_;
};

} // namespace hyalite
