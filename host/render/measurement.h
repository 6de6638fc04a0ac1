// Measurement of renders, stage by stage, for a profile.
#pragma once

#include "host/film/film_file.h"
#include "host/render/opening.h"
#include "host/render/prepare.h"
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
    bool isUnverified = false;
    bool isQuiet = false; ///< no progress
};

/// Call the stages once each, in the order of their declarations; the counts are optional.
class Measurement {
  public:
    Measurement(const MeasurementRequest &request, const std::string &commandLine);

    void prepareScene();
    void openDevice();
    /// Renders a first frame and compares it with the CPU twin's, unless the request skips that or the device is the
    /// CPU twin. Returns the reason not to measure, or nothing.
    [[nodiscard]] std::optional<std::string> verify();
    /// Renders the warm-ups and the repeats.
    void measure();
    /// Counts the work of a traversal with a stack, whichever kernel is measured.
    void countWork();
    /// Renders once more and counts the work of the measured kernel's traversal, if it has one.
    void countKernelWork();

    [[nodiscard]] const PreparedScene &scene() const { return scene_; }
    [[nodiscard]] const Backend &device() const { return *backend_; }
    [[nodiscard]] const Film &film() const { return *film_; } ///< of the last repeat
    /// Result of countWork(): boxes and triangles tested, in false colours.
    [[nodiscard]] const std::optional<Drawing> &heatMap() const { return heatMap_; }
    [[nodiscard]] const Profile &profile() const { return profile_; }
    [[nodiscard]] Profile &profile() { return profile_; }

  private:
    [[nodiscard]] bool isVerifiable() const { return !isReference(request_.device); }
    [[nodiscard]] Film renderFrame(const std::string &label, bool isMeasured);

    const MeasurementRequest request_;
    Stopwatch watch_;
    PreparedScene scene_;
    std::unique_ptr<Backend> backend_;
    std::optional<Film> film_;
    std::optional<Drawing> heatMap_;
    Profile profile_;
};

} // namespace hyalite
