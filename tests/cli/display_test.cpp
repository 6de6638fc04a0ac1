// `--display`: what a viewer gets is the picture of the file.
#include "host/base/input_file.h"
#include "host/image/pfm.h"
#include "tests/cli/command_line.h"
#include "tests/fixtures/tev_fixture.h"

#include <string>

namespace hyalite::core::testing {
namespace {

struct DisplayOption : CommandLine {
    [[nodiscard]] std::vector<glm::vec3> pixelsOf(const std::string &name) const {
        return readPfm(InputFile(folder / name)).pixels();
    }
    void expectShown(const std::string &line, const std::string &name) const {
        TevFixture tev;
        const Outcome outcome = run(line + " --quiet --display " + tev.address());
        tev.stop();
        EXPECT_EQ(outcome.exitCode, 0) << line << outcome;
        EXPECT_EQ(outcome.errors, "") << line;
        EXPECT_EQ(tev.faults(), std::vector<std::string>());
        ASSERT_EQ(tev.images().count(name), 1u) << line;
        EXPECT_EQ(tev.images().at(name).pixels, pixelsOf(name)) << line;
    }
};

const std::string displayed = " --width 96 --height 70 --spp 4 --device cpu";

TEST_F(DisplayOption, ShowsThePictureThatIsWritten) {
    for (const std::string more : {"", " --denoise", " --crop 10,80,20,60"})
        expectShown("render cornell -o a.pfm" + displayed + more, "a.pfm");
}

TEST_F(DisplayOption, ShowsMergedPartsAndFrames) {
    for (const std::string part : {"1", "2"}) {
        const std::string line = "render cornell --denoising-data -o " + part + ".part --part " + part + "/2";
        EXPECT_EQ(run(line + displayed).exitCode, 0) << line;
    }
    expectShown("merge 1.part 2.part -o m.pfm", "m.pfm");
    expectShown("merge 1.part 2.part -o d.pfm --denoise", "d.pfm");
    expectShown("render spheres -o f.#.pfm --turntable 2" + displayed, "f.1.pfm");
}

TEST_F(DisplayOption, ThatDoesNotAnswerFailsBeforeTheWork) {
    const std::string line = "render cornell -o a.pfm --display ";
    expectFailure(line + "127.0.0.1:1", 7, {"127.0.0.1:1", "refused", "a viewer such as tev"});
    expectFailure(line + "a:b", 2, {"a:b", "HOST:PORT"});
    EXPECT_FALSE(std::filesystem::exists(folder / "a.pfm"));
}

TEST_F(DisplayOption, ThatIsGoneCostsNoPicture) {
    TevFixture tev;
    tev.hangUpAfter(1);
    const Outcome outcome = run(
        "render cornell -o a.pfm --width 256 --height 256 --spp 4 --device cpu --display " + tev.address());
    EXPECT_EQ(outcome.exitCode, 0) << outcome;
    EXPECT_EQ(pixelsOf("a.pfm").size(), 256u * 256u);
}

} // namespace
} // namespace hyalite::core::testing
