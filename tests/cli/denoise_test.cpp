// `render --denoise`, `denoise` and `merge --denoise`: one picture by three ways, and where there is none.
#include "tests/cli/command_line.h"
#include "tests/cli/exr_channels.h"

#include <OpenEXR/ImfStringAttribute.h>

#include <algorithm>
#include <set>
#include <string>

namespace hyalite::core::testing {
namespace {

using Channels = std::map<std::string, std::vector<float>>;

const std::string denoisedSize = " --width 48 --height 40 --spp 6 --quiet";
const std::string onCpu = denoisedSize + " --device cpu";

std::string attributeText(const std::filesystem::path &exr, const char *name) {
    const Imf::InputFile file(exr.c_str());
    const auto *text = file.header().findTypedAttribute<Imf::StringAttribute>(name);
    return text != nullptr ? text->value() : "none";
}

struct Denoised : CommandLine {
    [[nodiscard]] Channels channels(const std::string &name) const { return channelsOf(folder / name); }
    void expectRun(const std::string &line) const {
        const Outcome outcome = run(line);
        EXPECT_EQ(outcome.exitCode, 0) << line << outcome;
        EXPECT_EQ(outcome.errors, "") << line;
    }
};

TEST_F(Denoised, PicturesKeepTheirSamplesAndAllData) {
    expectRun("render cornell -o plain.exr --layers albedo,depth" + onCpu);
    expectRun("render cornell -o clean.exr --layers albedo,depth --denoise" + onCpu);
    expectRun("render cornell -o data.exr --layers albedo,depth --denoising-data" + onCpu);
    const Channels plain = channels("plain.exr");
    const Channels clean = channels("clean.exr");
    const Channels data = channels("data.exr");
    for (const auto &[name, values] : plain) {
        EXPECT_EQ(data.at(name), values) << name;
        const bool isColour = name == "R" || name == "G" || name == "B";
        EXPECT_EQ(clean.at(isColour ? "noisy." + name : name), values) << name;
    }
    std::set<std::string> added;
    for (const auto &[name, values] : data)
        if (!plain.contains(name))
            added.insert(name);
    EXPECT_EQ(added,
              (std::set<std::string>{"denoising_albedo.B", "denoising_albedo.G", "denoising_albedo.R",
                                     "denoising_depth.Y", "denoising_first.B", "denoising_first.G",
                                     "denoising_first.R", "denoising_first_samples.Y", "denoising_normal.X",
                                     "denoising_normal.Y", "denoising_normal.Z"}));
    EXPECT_EQ(clean.size(), data.size() + 3);
    EXPECT_TRUE(std::ranges::all_of(data.at("denoising_first_samples.Y"), [](float n) { return n == 4.0f; }));
    expectRun("render cornell -o first.exr --width 48 --height 40 --spp 4 --quiet --device cpu");
    EXPECT_EQ(data.at("denoising_first.G"), channels("first.exr").at("G"));
    EXPECT_EQ(attributeText(folder / "clean.exr", "denoised"), "hyalite denoiser 3");
    EXPECT_EQ(attributeText(folder / "data.exr", "denoised"), "none");
}

// The user's own layers do not look through, and the denoiser's do, on half as many samples, at most eight, of a seed
// of their own.
TEST_F(Denoised, DataLookThrough) {
    const std::string mirrors =
        "render spheres --integrator path --width 32 --height 24 --quiet --device cpu";
    expectRun(mirrors + " -o data.exr --spp 20 --layers normal,albedo --denoising-data");
    expectRun(mirrors +
              " -o through.exr --spp 8 --layers normal,albedo,depth --layers-through --seed 2654435769");
    const Channels data = channels("data.exr");
    const Channels through = channels("through.exr");
    EXPECT_EQ(data.at("denoising_normal.X"), through.at("normal.X"));
    EXPECT_EQ(data.at("denoising_albedo.G"), through.at("albedo.G"));
    EXPECT_EQ(data.at("denoising_depth.Y"), through.at("Z"));
    EXPECT_NE(data.at("normal.X"), through.at("normal.X"));
}

TEST_F(Denoised, FilesHaveThePictureOfTheRender) {
    const std::string line = "render spheres --integrator path --alpha --crop 5,40,3,33" + onCpu;
    expectRun(line + " -o clean.exr --denoise");
    expectRun(line + " -o data.exr --denoising-data");
    expectRun("denoise data.exr a.exr --quiet");
    expectRun("denoise clean.exr b.exr --quiet --device cpu");
    EXPECT_TRUE(areSame(channels("a.exr"), channels("clean.exr")));
    EXPECT_TRUE(areSame(channels("b.exr"), channels("clean.exr")));
    for (const char *name : {"pixels", "denoised", "sceneHash", "settings.spp", "device.name"})
        EXPECT_EQ(attributeText(folder / "a.exr", name), attributeText(folder / "clean.exr", name)) << name;
    const Outcome diff = run("diff a.exr clean.exr");
    EXPECT_EQ(diff.exitCode, 0) << diff;
    expectRun(line + " -o clean.half.exr --half --denoise");
    expectRun(line + " -o data.half.exr --half --denoising-data");
    expectRun("denoise data.half.exr c.exr --quiet");
    EXPECT_TRUE(areSame(channels("c.exr"), channels("clean.half.exr")));
    EXPECT_EQ(attributeText(folder / "c.exr", "pixels"), attributeText(folder / "clean.half.exr", "pixels"));
    expectRun("denoise data.exr a.png --tone agx --exposure 1 --quiet");
    expectRun("tonemap clean.exr b.png --tone agx --exposure 1");
    EXPECT_EQ(run("diff a.png b.png").exitCode, 0);
    EXPECT_TRUE(contains(load("a.png"), "hyalite denoiser 3"));
}

TEST_F(Denoised, PicturesHaveTheSameBitsOnAnyDevice) {
    expectRun("render cornell -o cpu.exr --denoise --device cpu" + denoisedSize);
    for (const std::string &device : {softwareDevice(), std::string("all")}) {
        expectRun("render cornell -o device.exr --denoise --device " + device + denoisedSize);
        EXPECT_TRUE(areSame(channels("cpu.exr"), channels("device.exr"))) << device;
        expectRun("denoise cpu.exr again.exr --quiet --device " + device);
        EXPECT_TRUE(areSame(channels("cpu.exr"), channels("again.exr"))) << device;
    }
}

TEST_F(Denoised, PartsMakeThePictureOfOneRender) {
    expectRun("render cornell -o whole.exr --layers normal --denoise --device cpu" + denoisedSize);
    const auto renderParts = [&](const std::string &options) {
        for (const std::string part : {"1", "2", "3"})
            expectRun("render cornell --layers normal --part " + part + "/3 -o " + part + ".part" + options +
                      denoisedSize);
    };
    renderParts(" --denoise");
    expectRun("merge 1.part 2.part 3.part -o merged.exr --quiet --audit 50%");
    EXPECT_TRUE(areSame(channels("whole.exr"), channels("merged.exr")));
    EXPECT_EQ(attributeText(folder / "merged.exr", "denoised"), "hyalite denoiser 3");
    const Outcome partial = run("merge 1.part 2.part -o partial.exr --partial --quiet");
    EXPECT_EQ(partial.exitCode, 0) << partial;
    EXPECT_TRUE(contains(partial.errors, "stays noisy: it lacks parts")) << partial;
    std::filesystem::remove(folder / "1.part");
    std::filesystem::remove(folder / "2.part");
    std::filesystem::remove(folder / "3.part");
    renderParts(" --denoising-data");
    expectRun("merge 1.part 2.part 3.part -o noisy.exr --quiet");
    EXPECT_EQ(channels("noisy.exr").at("G"), channels("whole.exr").at("noisy.G"));
    expectRun("merge 1.part 2.part 3.part -o merged.exr --quiet --denoise");
    EXPECT_TRUE(areSame(channels("whole.exr"), channels("merged.exr")));
    expectRun("render cornell --part 1/1 -o plain.part" + denoisedSize);
    expectFailure("merge plain.part -o a.exr --denoise", 2,
                  {"--denoise: the parts have none", "--denoising-data"});
}

TEST_F(Denoised, ResumedPicturesAreThoseOfOneRender) {
    const std::string line =
        "render cornell --denoise --width 48 --height 40 --quiet --device cpu --checkpoint c";
    expectRun("render cornell -o whole.exr --denoise" + onCpu);
    expectRun(line + " --spp 2 -o a.exr");
    expectRun(line + " --spp 6 -o a.exr --resume");
    EXPECT_TRUE(areSame(channels("whole.exr"), channels("a.exr")));
    const Outcome less = run(line + " --spp 5 -o b.exr --resume");
    EXPECT_EQ(less.exitCode, 3) << less; // as of any checkpoint with more samples
    const Outcome other =
        run("render cornell --width 48 --height 40 --spp 6 -o b.exr --checkpoint c --resume");
    EXPECT_EQ(other.exitCode, 3) << other;
    EXPECT_TRUE(contains(other.errors, "denoising data: true there, false here")) << other;
}

TEST_F(Denoised, PicturesThatEndEarlyStayNoisy) {
    const std::string line =
        "render cornell --denoise --width 64 --height 64 --spp 65536 --device cpu -o a.exr --checkpoint c";
    const Outcome stopped = run(line + " --time-limit 0.5");
    EXPECT_EQ(stopped.exitCode, 0) << stopped;
    EXPECT_TRUE(contains(stopped.errors, "the picture stays noisy")) << stopped;
    EXPECT_FALSE(channels("a.exr").contains("noisy.R"));
    EXPECT_EQ(attributeText(folder / "a.exr", "denoised"), "none");
    expectFailure("denoise a.exr b.exr", 3, {"cannot denoise 'a.exr'", "Finish its render"});
    const std::vector<float> counts = channels("a.exr").at("samples.Y");
    const auto most = static_cast<int>(*std::max_element(counts.begin(), counts.end()));
    ASSERT_GT(most, 3);
    const Outcome fewer =
        run("render cornell --denoise --width 64 --height 64 -o a.exr --checkpoint c --resume --spp " +
            std::to_string(most));
    EXPECT_EQ(fewer.exitCode, 2) << fewer;
    EXPECT_TRUE(contains(fewer.errors, "--spp: found " + std::to_string(most))) << fewer;
}

TEST_F(Denoised, PicturesAreRefusedWithAWayOut) {
    expectFailure("render cornell -o a.png --denoise --spp 1", 2, {"denoise", "1 sample", "spp 2 or more"});
    expectFailure("render cornell -o a.png --denoise --integrator ao", 2,
                  {"--denoise: has no effect with the integrator ao", "whitted, path"});
    expectRun("render cornell -o plain.exr" + onCpu);
    expectFailure("denoise plain.exr a.exr", 3,
                  {"cannot denoise 'plain.exr'", "denoising_first.R", "--denoising-data"});
    expectRun("render cornell -o data.exr --denoising-data" + onCpu);
    expectFailure("denoise data.exr data.exr", 2, {"overwrite"});
    expectFailure("denoise data.exr a.pfm --exposure 1", 2, {"--exposure is for .png files"});
    expectFailure("denoise data.exr a.exr --tone agx", 2, {"--tone is for .png files"});
    expectFailure("denoise missing.exr a.exr", 3, {"missing.exr"});
    expectRun("render cornell -o a.pfm" + onCpu);
    expectFailure("denoise a.pfm b.pfm", 3, {"not an OpenEXR file"});
    const Outcome flat = run("render cornell -o a.png --denoising-data" + onCpu);
    EXPECT_EQ(flat.exitCode, 0) << flat;
    EXPECT_TRUE(contains(flat.errors, "none of the denoiser's data")) << flat;
}

TEST_F(Denoised, ReportsSequencesAndSheetsSaySo) {
    const nlohmann::json report = renderReport("cornell --denoise --width 48 --height 40 --spp 6");
    EXPECT_EQ(report.at("denoised"), "hyalite denoiser 3");
    EXPECT_EQ(report.at("settings").at("denoise"), true);
    expectRun("render cornell --turntable 8 --frames 0..1 -o '#.exr' --denoise" + onCpu);
    EXPECT_EQ(attributeText(folder / "1.exr", "denoised"), "hyalite denoiser 3");
    expectRun("render cornell --views front,left -o sheet.png --denoise" + onCpu);
    store("scene.json", R"({"settings": {"integrator": "path", "denoise": true}})");
    expectRun("render scene.json -o own.exr" + onCpu);
    EXPECT_EQ(attributeText(folder / "own.exr", "denoised"), "hyalite denoiser 3");
}

} // namespace
} // namespace hyalite::core::testing
