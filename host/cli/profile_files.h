// Output files of a profile.
#pragma once

#include "host/base/atomic_file.h"
#include "host/cli/options.h"
#include "host/image/image_file.h"
#include "host/lab/measurement.h"
#include "host/report/baseline_json.h"

#include <optional>
#include <string>
#include <vector>

namespace hyalite::core {

/// The requested paths; empty: not requested.
struct ProfilePaths {
    std::string output;
    std::string report;
    std::string csv;
    std::string trace;
    std::string html;
    std::string heatMap;
};

/// Adds their options.
[[nodiscard]] std::vector<NamedFile> namedFiles(const ProfilePaths &paths);

/// The files are opened before the work begins, so that one that cannot be written fails then. They appear at the end.
class ProfileFiles {
  public:
    /// Throws Error{Usage} for wrong extensions.
    explicit ProfileFiles(const ProfilePaths &paths);

    /// Throws Error{LimitExceeded} if an image of this size does not fit into a requested PNG.
    void requireSizes(int width, int height) const;
    [[nodiscard]] bool wantsHeatMap(const PreparedScene &scene) const;
    /// Writes the image, and adds the time of writing to the profile.
    void writeImage(Measurement &measurement);
    /// `comparison`: with a baseline, or null.
    void writeFigures(const Measurement &measurement, const BaselineVerdict *comparison);

  private:
    static void open(std::optional<AtomicFile> &file, const std::string &path);
    static void store(std::optional<AtomicFile> &file, const std::string &text);

    const ProfilePaths paths_;
    ImageFormat format_ = ImageFormat::Png;
    std::optional<AtomicFile> image_;
    std::optional<AtomicFile> report_;
    std::optional<AtomicFile> csv_;
    std::optional<AtomicFile> trace_;
    std::optional<AtomicFile> html_;
    std::optional<AtomicFile> heatMap_;
};

} // namespace hyalite::core
