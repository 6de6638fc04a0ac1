// `hyalite render` of a frame, again and again.
#pragma once

#include "host/image/image.h"
#include "tests/bench/process.h"
#include "tests/bench/target.h"

#include <benchmark/benchmark.h>

#include <filesystem>
#include <string>
#include <vector>

namespace hyalite::core::bench {

struct Frame {
    std::string name;
    std::string scene; ///< as `hyalite render` takes it
    std::vector<std::string> options{};
};

/// Renders one frame on one target, to a file that is overwritten. Mesa keeps compiled kernels in a folder of this
/// object's own, empty at first: the key of its cache leaves out the width of lavapipe's vectors, which differs among
/// frames and drivers.
class Rendering {
  public:
    Rendering(const Frame &frame, const Target &target);

    /// Returns the seconds of all dispatches, or of the reference renderer; of the processor's only those of the whole
    /// process are known.
    double run();
    /// The next run compiles kernels anew.
    void forgetKernels();

    // Of the last run. The files themselves say which device made them.
    [[nodiscard]] double processSeconds() const { return processSeconds_; } ///< from start to end
    [[nodiscard]] Image picture() const;
    [[nodiscard]] double rayCount() const;
    [[nodiscard]] std::string driver() const; ///< name and version, from the driver

  private:
    [[nodiscard]] std::filesystem::path image() const { return folder_.path() / "image.png"; }
    [[nodiscard]] std::filesystem::path report() const { return folder_.path() / "report.json"; }
    [[nodiscard]] std::filesystem::path kernels() const { return folder_.path() / "kernels"; }

    TemporaryFolder folder_;
    std::vector<std::string> arguments_;
    std::vector<std::string> environment_;
    double processSeconds_ = 0.0;
};

/// Runs both. Where their pictures differ, `state` fails.
[[nodiscard]] bool haveEqualPictures(Rendering &rendering, Rendering &reference, benchmark::State &state);

} // namespace hyalite::core::bench
