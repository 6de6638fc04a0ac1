// Clips of sequences: their frames are the pictures that a sequence of PNGs has, and what is finished is kept.
#include "tests/cli/command_line.h"
#include "tests/fixtures/clip_fixture.h"
#include "tests/fixtures/gltf_fixture.h"

#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>

namespace hyalite::core::testing {
namespace {

const std::string smallClip = " --width 24 --height 16 --spp 2 --device cpu";

struct Clips : CommandLine {
    [[nodiscard]] DecodedClip decoded(const std::string &name) const {
        return name.ends_with("apng") ? decodeApngClip(load(name), folder) : decodeWebpClip(load(name));
    }
    /// The frames of the clip are the pictures frame.0.png and so on.
    void expectFrames(const DecodedClip &clip, int count) const {
        ASSERT_EQ(clip.frames.size(), static_cast<std::size_t>(count));
        for (int frame = 0; frame < count; ++frame)
            EXPECT_TRUE(clip.frames[static_cast<std::size_t>(frame)].rgba ==
                        decodeStill(folder / ("frame." + std::to_string(frame) + ".png")).rgba)
                << frame;
    }
};

TEST_F(Clips, HaveThePicturesOfTheirSequence) {
    store("clear.json", R"({"camera": {"position": [0, 0, 55]}, "settings": {"alpha": true},
                            "materials": {"m": {"type": "diffuse"}}, "background": 0.5,
                            "spheres": [{"centre": [9, 0, 0], "radius": 10, "material": "m"}]})");
    for (const std::string line :
         {"render spheres --tone agx", "render cornell --denoise", "render clear.json",
          "render spheres --integrator cost", "render cat --crop 3,20,2,14"}) {
        ASSERT_EQ(run(line + " --turntable 3 -o frame.#.png --quiet" + smallClip).exitCode, 0);
        for (const std::string name : {"clip.webp", "clip.apng"}) {
            const Outcome outcome = run(line + " --turntable 3 -o " + name + " --quiet" + smallClip);
            EXPECT_EQ(outcome.exitCode, 0) << outcome;
            EXPECT_EQ(outcome.errors, "");
            const DecodedClip clip = decoded(name);
            expectFrames(clip, 3);
            EXPECT_TRUE(clip.playsForEver);
        }
    }
}

TEST_F(Clips, TellOfTheirOriginAndTime) {
    const std::string line = "render spheres --turntable 4 --fps 50 --report r.#.json -o ";
    const Outcome outcome = run(line + "turn.apng" + smallClip);
    ASSERT_EQ(outcome.exitCode, 0) << outcome;
    EXPECT_TRUE(contains(outcome.output, "turn.apng, frame 3: 24x16, 2 spp")) << outcome;
    EXPECT_TRUE(contains(outcome.output, "turn.apng: 4 frames, 50 a second\n")) << outcome;
    DecodedClip clip = decoded("turn.apng");
    EXPECT_DOUBLE_EQ(clip.frames.at(2).seconds, 0.02);
    EXPECT_EQ(clip.texts.at("frames"), "0..3");
    EXPECT_EQ(clip.texts.at("framesPerSecond"), "50");
    EXPECT_TRUE(contains(clip.texts.at("commandLine"), "--turntable 4 --fps 50"));
    EXPECT_FALSE(clip.texts.contains("sceneHash")) << "frames differ in it";
    EXPECT_EQ(nlohmann::json::parse(load("r.3.json")).at("output"), "turn.apng");
    ASSERT_EQ(run(line + "turn.webp" + smallClip).exitCode, 0);
    EXPECT_TRUE(contains(decoded("turn.webp").texts.at("XMP"),
                         "<hyalite:pixels>" + clip.texts.at("pixels") + "</hyalite:pixels>"));
    EXPECT_EQ(entries(), (std::set<std::string>{"r.0.json", "r.1.json", "r.2.json", "r.3.json", "turn.apng",
                                                "turn.webp"}));
}

TEST_F(Clips, PlayAnimationsAtTheirRate) {
    GltfMaker maker = oneTriangle();
    const std::size_t input = maker.addScalars({0, 1});
    const std::size_t output = maker.addVec3({0, 0, 5, 1, 0, 5});
    maker.json["animations"] = {
        {{"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}}}},
         {"samplers", {{{"input", input}, {"output", output}}}}}};
    store("mesh.glb", maker.glb());
    ASSERT_EQ(run("render mesh.glb --frames 0..2 --fps 2 -o frame.#.png" + smallClip).exitCode, 0);
    ASSERT_EQ(run("render mesh.glb --frames 0..2 --fps 2 -o clip.webp" + smallClip).exitCode, 0);
    const DecodedClip clip = decoded("clip.webp");
    expectFrames(clip, 3);
    EXPECT_DOUBLE_EQ(clip.frames.at(1).seconds, 0.5);
}

TEST_F(Clips, ThatAreStoppedHaveTheirFinishedFrames) {
    const std::string line = "render spheres --turntable 200 --width 64 --height 64 --device cpu -o ";
    Surroundings surroundings;
    surroundings.signal = SIGINT;
    surroundings.signalWhen = [this] { return std::filesystem::exists(folder / "r.3.json"); };
    const Outcome stopped = runIn(surroundings, line + "turn.webp --spp 16 --report r.#.json");
    EXPECT_EQ(stopped.exitCode, 130) << stopped;
    const std::size_t count = decoded("turn.webp").frames.size();
    EXPECT_GE(count, 4u);
    EXPECT_TRUE(
        contains(stopped.errors, "turn.webp: the clip has " + std::to_string(count) + " of 200 frames"))
        << stopped;
    const std::string range = "0.." + std::to_string(count - 1) + " of 0..199";
    EXPECT_TRUE(
        contains(decoded("turn.webp").texts.at("XMP"), "<hyalite:frames>" + range + "</hyalite:frames>"));

    store("turn.apng", "before");
    const Outcome none = run(line + "turn.apng --spp 4096 --time-limit 0.2");
    EXPECT_EQ(none.exitCode, 0) << none;
    EXPECT_TRUE(contains(none.errors, "frame 0 is left out")) << none;
    EXPECT_TRUE(contains(none.errors, "turn.apng: none of 200 frames is finished, and nothing is written"))
        << none;
    EXPECT_EQ(load("turn.apng"), "before");
}

TEST_F(Clips, ThatCannotBeWrittenLeaveNothing) {
    expectFailure("render spheres --turntable 2 -o missing/turn.webp" + smallClip, 7, {"missing/turn.webp"});
    Surroundings surroundings;
    surroundings.fileSizeLimitBytes = 4096;
    for (const std::string name : {"turn.webp", "turn.apng"}) {
        const Outcome full =
            runIn(surroundings, "render cornell --turntable 30 --quiet -o " + name + smallClip);
        EXPECT_EQ(full.exitCode, 7) << full;
        EXPECT_EQ(entries(), std::set<std::string>{}) << full;
    }
}

TEST_F(Clips, HaveReasons) {
    const std::string line = "render spheres --turntable 3 -o ";
    expectFailure("render spheres -o turn.webp", 2,
                  {"'turn.webp': .webp and .apng hold a sequence of frames"});
    expectFailure(line + "turn.#.webp", 2, {"'turn.#.webp'", "whose name has no #"});
    expectFailure(line + "turn.png", 2, {"one run of #", ".webp and .apng without # have all frames"});
    expectFailure(line + "turn.webp --part 1/2", 2,
                  {"--part: turn.webp, the clip, has all frames", "frame.####.png"});
    expectFailure(line + "turn.webp --resume", 2, {"--resume: turn.webp, the clip, begins anew"});
    expectFailure(line + "turn.webp --checkpoint a.#", 2, {"--checkpoint: turn.webp, the clip, begins anew"});
    expectFailure(line + "turn.webp --motion", 2, {"--motion is for .exr files"});
    expectFailure(line + "turn.webp --half", 2, {"--half is for .exr files"});
    expectFailure(line + "turn.webp --report r.json", 2, {"--report: found r.json"});
    expectFailure(line + "turn.webp --fps 0", 2, {"--fps: found \"0\""});
    expectFailure(line + "turn.#.png --fps 3", 2, {"--fps: found --turntable", "allowed: for a clip"});
    expectFailure(line + "turn.webp --width 16384 --height 1", 5, {"a side of 16384 x 1 pixels"});
    expectFailure("render spheres --views top,left -o turn.webp", 2, {"'turn.webp'"});
}

// The line of the guide.
TEST_F(Clips, FfmpegMakesAVideoOfFrames) {
    if (std::system("command -v ffmpeg >/dev/null 2>&1") != 0)
        GTEST_SKIP() << "there is no ffmpeg";
    ASSERT_EQ(run("render spheres --turntable 3 -o turn.####.png --width 31 --height 15 --spp 1").exitCode,
              0);
    const std::string line = "cd '" + folder.string() +
                             "' && ffmpeg -loglevel error -framerate 24 -i turn.%04d.png -vf "
                             "pad='ceil(iw/2)*2:ceil(ih/2)*2' -pix_fmt yuv420p turn.mp4";
    EXPECT_EQ(std::system(line.c_str()), 0) << line;
    EXPECT_TRUE(contains(load("turn.mp4").substr(0, 64), "ftyp"));
    // A reader of another house: of an animated WebP it has none.
    ASSERT_EQ(run("render spheres --turntable 3 --width 31 --height 15 --spp 1 -o turn.apng").exitCode, 0);
    for (const std::string pictures : {"turn.apng", "turn.%04d.png"})
        ASSERT_EQ(std::system(("cd '" + folder.string() + "' && ffmpeg -loglevel error -i " + pictures +
                               " -pix_fmt rgb24 -f rawvideo " + pictures.substr(5, 2) + ".raw")
                                  .c_str()),
                  0);
    EXPECT_EQ(load("ap.raw").size(), std::size_t{3} * 3 * 31 * 15);
    EXPECT_TRUE(load("ap.raw") == load("%0.raw"));
}

} // namespace
} // namespace hyalite::core::testing
