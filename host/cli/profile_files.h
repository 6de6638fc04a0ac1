// The files that a profile is written to.
#pragma once

#include "host/base/atomic_file.h"
#include "host/cli/options.h"
#include "host/image/image_file.h"
#include "host/render/measurement.h"

#include <optional>
#include <string>
#include <vector>

namespace hyalite {

/// The path of each that was asked for; else empty.
struct ProfilePaths {
    std::string output;
    std::string report;
    std::string csv;
    std::string trace;
    std::string html;
    std::string heatMap;
};

/// With their options.
[[nodiscard]] std::vector<NamedFile> namedFiles(const ProfilePaths &paths);

/// Opened before the work begins, so that one that cannot be written is known then; they appear when all is done.
class ProfileFiles {
  public:
    /// Throws Error{Usage} for endings that do not fit.
    explicit ProfileFiles(const ProfilePaths &paths);

    /// Throws Error{LimitExceeded} where an image of this size does not fit into a PNG that is wanted.
    void requireSizes(int width, int height) const;
    [[nodiscard]] bool wantsHeatMap(const PreparedScene &scene) const;
    /// Writes the image, and how long that took into the profile.
    void writeImage(Measurement &measurement);
    void writeFigures(const Measurement &measurement);

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

} // namespace hyalite
