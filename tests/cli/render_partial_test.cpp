// Pictures that are there before the render is over: whole files, of which each replaces the one before.
#include "host/image/image_file.h"
#include "tests/cli/command_line.h"

#include <gtest/gtest.h>

#include <csignal>
#include <string>

#include <sys/stat.h>

namespace hyalite::core::testing {
namespace {

namespace fs = std::filesystem;

class RenderPartial : public CommandLine {
  protected:
    /// Sends `signal` when the file has been replaced `count` times.
    [[nodiscard]] Surroundings signalledAfter(const std::string &name, int count, int signal) const {
        const auto fileNumber = [path = folder / name]() -> std::uint64_t {
            struct stat status {};
            return stat(path.c_str(), &status) == 0 ? status.st_ino : 0;
        };
        Surroundings surroundings;
        surroundings.signal = signal;
        surroundings.signalWhen = [fileNumber, count, seen = 0, last = fileNumber()]() mutable {
            const std::uint64_t now = fileNumber();
            seen += now != last && now != 0 ? 1 : 0;
            last = now;
            return seen >= count;
        };
        return surroundings;
    }
};

/// Hours of work.
const std::string endlessPartial = " --width 256 --height 256 --spp 65536 --partial 1e-3";

TEST_F(RenderPartial, TheOutputIsWholeWheneverTheRenderIsKilled) {
    for (const std::string &device : {std::string("cpu"), softwareDevice()})
        for (const char *name : {"a.png", "a.pfm"})
            for (const int count : {1, 4}) {
                store(name, "old");
                const Outcome outcome =
                    runIn(signalledAfter(name, count, SIGKILL),
                          "render spheres -o " + std::string(name) + " --device " + device + endlessPartial);
                EXPECT_EQ(outcome.exitCode, 128 + SIGKILL) << outcome;
                EXPECT_EQ(entries(), std::set<std::string>{name});
                const Image image = readImage(folder / name).image;
                EXPECT_EQ(image.width(), 256);
                EXPECT_GT(litPixelCount(image), 0);
                fs::remove(folder / name);
            }
}

TEST_F(RenderPartial, TheLastPictureIsThatOfARenderWithoutThem) {
    for (const std::string &device : {std::string("cpu"), softwareDevice()}) {
        const std::string line = "spheres --width 96 --height 64 --spp 64 --device " + device;
        const std::string wanted = renderPfm(line);
        EXPECT_EQ(renderPfm(line + " --partial 1e-3 --checkpoint c --checkpoint-interval 1e-3"), wanted)
            << device;
        EXPECT_EQ(renderPfm(line + " --partial 1e6"), wanted) << device;
    }
}

TEST_F(RenderPartial, OneThatCannotBeWrittenStopsNoRender) {
    Surroundings full = signalledAfter("nonesuch", 1, SIGKILL);
    full.fileSizeLimitBytes = 4096;
    store("a.pfm", "old");
    const Outcome outcome =
        runIn(full, "render spheres -o a.pfm --device cpu --width 64 --height 64 --spp 200 "
                    "--partial 1e-3");
    EXPECT_EQ(outcome.exitCode, 7) << outcome;
    EXPECT_TRUE(contains(outcome.errors, "the render goes on")) << outcome;
    EXPECT_EQ(outcome.errors.find("the render goes on"), outcome.errors.rfind("the render goes on"))
        << "said once\n"
        << outcome;
    EXPECT_EQ(load("a.pfm"), "old");
    EXPECT_EQ(entries(), std::set<std::string>{"a.pfm"});
}

TEST_F(RenderPartial, IntervalsArePositive) {
    for (const char *interval : {"0", "-1", "nan", "x"})
        expectFailure("render spheres -o a.png --partial " + std::string(interval), 2, {"--partial"});
    EXPECT_EQ(entries(), std::set<std::string>{});
}

} // namespace
} // namespace hyalite::core::testing
