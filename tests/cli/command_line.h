// What the tests of commands share: a folder of their own in which commands run as they are typed, and small scenes.
#pragma once

#include "host/gpu/kernels.h"
#include "host/image/image.h"
#include "tests/cli/program.h"
#include "tests/cli/words.h"
#include "tests/fixtures/temporary_folder.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <set>
#include <string>
#include <vector>

namespace hyalite::core::testing {

/// Too short for any work, and so the render ends with the least that it can do.
inline const std::string atOnce = " --time-limit 1e-6";

/// A test with an empty folder, which is the working directory of the commands and vanishes afterwards.
class CommandLine : public ::testing::Test {
  protected:
    void SetUp() override;

    /// `run("render spheres -o a.png")` runs the program in the folder.
    [[nodiscard]] Outcome run(const std::string &line) const;
    /// As run(), in other surroundings; their folder is this one.
    [[nodiscard]] Outcome runIn(Surroundings surroundings, const std::string &line) const;

    /// Expects the exit code and, where one is wanted, that standard error contains all the parts and standard
    /// output nothing. Returns what was printed there.
    std::string expectFailure(const std::string &line, int exitCode,
                              const std::vector<std::string> &parts = {}) const;

    /// The bytes of the PFM that `render LINE --quiet -o …` writes; expects success and silence.
    [[nodiscard]] std::string renderPfm(const std::string &line) const;
    /// The same as an image.
    [[nodiscard]] Image renderImage(const std::string &line) const;
    /// The JSON report of `render LINE`.
    [[nodiscard]] nlohmann::json renderReport(const std::string &line) const;

    void store(const std::string &name, const std::string &text) const;
    [[nodiscard]] std::string load(const std::string &name) const;
    /// The names in the folder, hidden ones too, except for that of the program's cache.
    [[nodiscard]] std::set<std::string> entries() const;

    const TemporaryFolder temporary_;
    const std::filesystem::path &folder = temporary_.path;
};

[[nodiscard]] bool contains(const std::string &text, const std::string &part);

/// The Vulkan devices in the list of `devices --json`, in surroundings as they are.
[[nodiscard]] nlohmann::json listDevices();
/// The index of a software device: the one that is sure to round as the reference renderer does.
[[nodiscard]] std::string softwareDevice();
/// Whether that device can run the kernel; null: any.
[[nodiscard]] bool hasKernel(const gpu::KernelRow *kernel);

/// A wavy sheet of 2 n^2 triangles over [-1, 1]^2, seen best from +z. Its facets shadow and hide each other.
[[nodiscard]] std::string wavySheetObj(int n);
/// A scene of it, "sheet.obj", with a mirror ball, a glass ball and a light.
[[nodiscard]] std::string wavySheetScene();

/// A square of side 2 in the plane z = 0, around the origin, and nothing else: it is grey, the background black.
[[nodiscard]] std::string squareObj();
[[nodiscard]] std::string squareScene();
/// How many pixels are not black.
[[nodiscard]] int litPixelCount(const Image &image);

} // namespace hyalite::core::testing
