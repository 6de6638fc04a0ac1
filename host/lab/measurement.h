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

namespace hyalite::core {

/// A request for a measurement.
struct MeasurementRequest {
    SceneOptions scene;
    std::string device = "auto";
    int threadCount = 0; ///< 0: all
    DeviceOptions deviceOptions;
    int warmupCount = 1;
    int repeatCount = 5;
    std::optional<double> timeLimitSeconds; ///< for all renders together
    bool isCounting = false; ///< renders twice more: counts the work of the rays, and of the measured kernel
    bool isCharging = false; ///< finds out which objects and materials the rays work for, on the CPU
    bool isUnverified = false;
};

/// A scene and the device that renders it.
struct MeasurementSubject {
    PreparedScene scene;
    std::unique_ptr<Backend> device;
    Profile profile; ///< what they are, and the times of preparing them
};

/// Loads the scene and opens the device.
[[nodiscard]] MeasurementSubject prepareMeasurement(const MeasurementRequest &request,
                                                    const std::string &commandLine, Observer &observer);

struct Measurement {
    Profile profile;                  ///< the subject's, with the frames and the counts
    std::optional<std::string> fault; ///< how the device differs from the CPU twin; nothing was measured then
    Film film{Crop{}};                ///< of a measured frame
    std::optional<Drawing> heatMap;   ///< boxes and triangles tested, in false colours
    /// By PathStage, the boxes and triangles tested, in false colours; empty unless rays were charged,
    /// and tested something.
    std::vector<Drawing> stagePictures{};
    bool isCut = false; ///< the time limit left out what a baseline is compared with
};

/// Renders a first frame and compares it with the CPU twin's, unless the request skips that or the device is the CPU
/// twin; then the warm-ups and the repeats, and what the request or a heat map counts.
///
/// The time limit begins here, and leaves half of the time to the counts, if there are any. If it leaves no repeat, the
/// frame that is finished most is measured. Of a render that it stops remains what it has finished; the profile says
/// so.
[[nodiscard]] Measurement measure(const MeasurementSubject &subject, const MeasurementRequest &request,
                                  bool wantsHeatMap, Observer &observer);

} // namespace hyalite::core
