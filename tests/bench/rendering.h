// `hyalite render` of a frame, again and again.
#pragma once

#include "host/image/image.h"
#include "tests/bench/process.h"

#include <filesystem>
#include <string>
#include <vector>

namespace hyalite::bench {

struct Frame {
    std::string name;
    std::string scene; ///< as `hyalite render` takes it
    std::vector<std::string> options{};
};

/// What `hyalite` is given to render a frame.
[[nodiscard]] std::vector<std::string> argumentsOf(const Frame &frame, const std::string &deviceName,
                                                   const std::filesystem::path &image);

/// Renders one frame on one device, to a file that is overwritten.
class Rendering {
  public:
    Rendering(const Frame &frame, const std::string &deviceName);

    /// Returns the seconds of all dispatches, or of the reference renderer; of the processor's only those of the whole
    /// process are known. Keeps these.
    double run();

    /// Of the last run. The files themselves say which device made them.
    [[nodiscard]] Image picture() const;
    [[nodiscard]] double rayCount() const;
    [[nodiscard]] const std::vector<double> &processSeconds() const { return processSeconds_; }

  private:
    [[nodiscard]] std::filesystem::path image() const { return folder_.path() / "image.png"; }
    [[nodiscard]] std::filesystem::path report() const { return folder_.path() / "report.json"; }

    TemporaryFolder folder_;
    std::vector<std::string> arguments_;
    std::vector<double> processSeconds_;
};

} // namespace hyalite::bench
