// Parts of a picture, from several devices, make the picture of one render; and what keeps them from it is named.
#include "host/base/hash.h"
#include "host/image/image_file.h"
#include "tests/cli/command_line.h"
#include "tests/cli/exr_channels.h"

#include <algorithm>
#include <cstring>
#include <functional>
#include <span>

namespace hyalite::core::testing {
namespace {

const std::string smallPicture = " --width 80 --height 56 --spp 3";

/// Of the texts of a PNG.
std::vector<std::string> keywordsOf(const std::string &png) {
    std::vector<std::string> keywords;
    for (std::size_t at = png.find("iTXt"); at != std::string::npos; at = png.find("iTXt", at + 1))
        keywords.emplace_back(png.c_str() + at + 4);
    return keywords;
}

class Parts : public CommandLine {
  protected:
    void SetUp() override {
        CommandLine::SetUp();
        store("sheet.obj", wavySheetObj(6));
        store("sheet.json", wavySheetScene());
    }

    [[nodiscard]] static std::string fileOf(int index) { return "p" + std::to_string(index) + ".part"; }

    /// Renders part `index` of `count`.
    [[nodiscard]] Outcome renderPart(int index, int count,
                                     const std::string &options = " --device cpu") const {
        return run("render sheet.json" + smallPicture + options + " --part " + std::to_string(index) + "/" +
                   std::to_string(count) + " -o " + fileOf(index));
    }
    void renderParts(int count) const {
        for (int index = 1; index <= count; ++index)
            ASSERT_EQ(renderPart(index, count).exitCode, 0);
    }

    /// Changes a file of so many layers, and makes its hash fit. `change` gets its bytes, and where its origin and its
    /// pixels begin.
    void change(const std::string &name,
                const std::function<void(std::string &, std::size_t, std::size_t)> &change,
                std::size_t layerCount = 0) const {
        std::string bytes = load(name);
        constexpr std::size_t headBytes = 19 + 104;
        std::uint32_t identityBytes = 0;
        std::uint32_t originBytes = 0;
        std::memcpy(&identityBytes, bytes.data() + 19 + 4, sizeof identityBytes);
        std::memcpy(&originBytes, bytes.data() + 19 + 80, sizeof originBytes);
        const std::size_t pixelsBegin = headBytes + identityBytes + originBytes;
        change(bytes, headBytes + identityBytes, pixelsBegin);
        const auto all = std::as_bytes(std::span(bytes));
        std::uint64_t hash = hashBytes(all.first(headBytes));
        hash = hashBytes(all.subspan(headBytes, identityBytes), hash);
        hash = hashBytes(all.subspan(headBytes + identityBytes, originBytes), hash);
        const std::size_t filmBytes = (all.size() - pixelsBegin - sizeof hash) / (1 + layerCount);
        for (std::size_t film = 0; film <= layerCount; ++film)
            hash = hashBytes(all.subspan(pixelsBegin + film * filmBytes, filmBytes), hash);
        std::memcpy(bytes.data() + bytes.size() - sizeof hash, &hash, sizeof hash);
        store(name, bytes);
    }

    /// Changes a bit of the pixel with this index, as a machine that computes wrongly does.
    void lie(const std::string &name, std::size_t pixel) const {
        change(name, [&](std::string &bytes, std::size_t, std::size_t pixelsBegin) {
            char &byte = bytes[pixelsBegin + 32 * pixel];
            byte = static_cast<char>(byte ^ 1);
        });
    }
};

TEST_F(Parts, OfSeveralDevicesMakeEveryLayerOfOneRender) {
    const std::string layers = " --layers albedo,normal,depth,id,crypto-object,crypto-material,instance-id";
    ASSERT_EQ(run("render sheet.json -o whole.exr --device cpu" + smallPicture + layers).exitCode, 0);
    for (int index = 1; index <= 5; ++index) {
        const std::string device = index % 2 == 0 ? "cpu" : softwareDevice();
        const Outcome outcome = renderPart(index, 5, layers + " --device " + device);
        ASSERT_EQ(outcome.exitCode, 0) << outcome;
        EXPECT_TRUE(contains(outcome.output, "part " + std::to_string(index) + " of 5 of 80x56")) << outcome;
    }
    const Outcome merged = run("merge p4.part p1.part p5.part p2.part p3.part -o merged.exr");
    ASSERT_EQ(merged.exitCode, 0) << merged;
    EXPECT_TRUE(contains(merged.output, "merged.exr: 80x56, 3 spp, 5 of 5 parts, made by 2 makers"))
        << merged;
    EXPECT_TRUE(areSame(channelsOf(folder / "whole.exr"), channelsOf(folder / "merged.exr")));
    EXPECT_EQ(layerAttributesOf(folder / "whole.exr"), layerAttributesOf(folder / "merged.exr"));
    EXPECT_EQ(layerAttributesOf(folder / "whole.exr").size(), 9u);
    ASSERT_EQ(run("render sheet.json -o whole.png --quiet --exposure 1 --device cpu" + smallPicture).exitCode,
              0);
}

TEST_F(Parts, ThatAreFinishedSaySoAndThatAreStoppedGoOn) {
    const Outcome stopped = renderPart(1, 2, " --device cpu --time-limit 1e-6");
    EXPECT_EQ(stopped.exitCode, 0) << stopped;
    EXPECT_TRUE(contains(stopped.errors, "stopped by the time limit")) << stopped;
    ASSERT_EQ(renderPart(2, 2).exitCode, 0);
    const std::string refusal =
        expectFailure("merge p1.part p2.part -o a.pfm", 3,
                      {"1 of 2 parts are missing", "'p1.part' is not finished", "--part 1/2"});
    EXPECT_FALSE(entries().contains("a.pfm"));
    ASSERT_EQ(renderPart(1, 2).exitCode, 0);
    const std::string before = load("p1.part");
    const Outcome again = renderPart(1, 2);
    EXPECT_EQ(again.exitCode, 0);
    EXPECT_EQ(again.output, "p1.part: part 1 of 2 is finished\n");
    EXPECT_EQ(load("p1.part"), before);
    EXPECT_EQ(run("merge p1.part p2.part -o a.pfm").exitCode, 0);
    EXPECT_EQ(load("a.pfm"), renderPfm("sheet.json --device cpu" + smallPicture));
    for (const std::string &name : entries())
        EXPECT_FALSE(name.ends_with(".1") || name.ends_with(".lock")) << name;
}

TEST_F(Parts, WithMattesGoOn) {
    const std::string layers = " --layers crypto-object,crypto-asset,object-id";
    ASSERT_EQ(run("render sheet.json -o whole.exr --device cpu" + smallPicture + layers).exitCode, 0);
    ASSERT_EQ(renderPart(1, 2, layers + " --device cpu").exitCode, 0);
    ASSERT_EQ(renderPart(2, 2, layers + atOnce + " --device " + softwareDevice()).exitCode, 0);
    const Outcome rest = renderPart(2, 2, layers + " --device " + softwareDevice());
    ASSERT_EQ(rest.exitCode, 0) << rest;
    ASSERT_EQ(run("merge p1.part p2.part -o merged.exr").exitCode, 0);
    EXPECT_TRUE(areSame(channelsOf(folder / "whole.exr"), channelsOf(folder / "merged.exr")));
}

// Their samples are as many as those of the picture, and their depths are no planes'.
TEST_F(Parts, MakeLayersThatLookThroughOfOneRender) {
    const std::string layers = " --layers albedo,normal,depth,id --layers-through --integrator path";
    ASSERT_EQ(run("render spheres -o whole.exr --device cpu" + smallPicture + layers).exitCode, 0);
    ASSERT_EQ(
        run("render spheres -o plain.exr --device cpu --integrator path --layers albedo,normal,depth,id" +
            smallPicture)
            .exitCode,
        0);
    const auto part = [&](int index, const std::string &options) {
        const std::string number = std::to_string(index);
        return run("render spheres" + smallPicture + layers + options + " --part " + number + "/2 -o p" +
                   number + ".part");
    };
    ASSERT_EQ(part(1, " --device cpu --time-limit 1e-6").exitCode, 0);
    const Outcome unfinished = run("merge p1.part -o merged.exr");
    EXPECT_TRUE(contains(unfinished.errors, "'p1.part' is not finished")) << unfinished;
    ASSERT_EQ(part(1, " --device cpu").exitCode, 0);
    ASSERT_EQ(part(2, " --device " + softwareDevice()).exitCode, 0);
    ASSERT_EQ(run("merge p1.part p2.part -o merged.exr").exitCode, 0);
    EXPECT_TRUE(areSame(channelsOf(folder / "whole.exr"), channelsOf(folder / "merged.exr")));
    EXPECT_FALSE(areSame(channelsOf(folder / "whole.exr"), channelsOf(folder / "plain.exr")));
    const Outcome foreign = run("render spheres" + smallPicture +
                                " --layers albedo,normal,depth,id --integrator path --part 1/2 -o p1.part");
    EXPECT_TRUE(contains(foreign.errors, "layersThrough")) << foreign;
}

// What a part says of its layers is as trustworthy as its maker.
TEST_F(Parts, WithNumbersThatHaveNoNameAreRefused) {
    ASSERT_EQ(renderPart(1, 1, " --device cpu --layers crypto-object").exitCode, 0);
    const auto rename = [](std::string &bytes, std::size_t, std::size_t pixelsBegin) {
        bytes[pixelsBegin + (bytes.size() - 8 - pixelsBegin) / 2] = 4; // of three things
    };
    change("p1.part", rename, 1);
    expectFailure("merge p1.part -o a.exr", 3,
                  {"p1.part", "layer crypto-object has a number without a name"});
}

TEST_F(Parts, ThatAreMissingDamagedOrForeignAreNamedWithTheirCommand) {
    renderParts(3);
    expectFailure("merge p1.part p3.part -o a.pfm", 3,
                  {"1 of 3 parts are missing", "render sheet.json", "--part 2/3 -o p2.part", "--partial"});
    const std::string whole = load("p2.part");
    store("p2.part", whole.substr(0, whole.size() - 1));
    expectFailure("merge p1.part p2.part p3.part -o a.pfm", 3,
                  {"p2.part", "damaged", "--part 2/3 -o p2.part"});
    const Outcome partial = run("merge p1.part p2.part p3.part --partial -o a.pfm");
    EXPECT_EQ(partial.exitCode, 0) << partial;
    EXPECT_TRUE(contains(partial.errors, "1 of 3 parts are missing, and black")) << partial;
    EXPECT_TRUE(contains(partial.output, "2 of 3 parts")) << partial;
    const Outcome anew = renderPart(2, 3);
    EXPECT_EQ(anew.exitCode, 0) << anew;
    EXPECT_TRUE(contains(anew.errors, "damaged") && contains(anew.errors, "starting from the beginning"))
        << anew;
    EXPECT_EQ(load("p2.part"), whole);
    ASSERT_EQ(run("render sheet.json --seed 7 --device cpu --part 2/3 -o other.part" + smallPicture).exitCode,
              0);
    expectFailure("merge p1.part other.part p3.part -o a.pfm", 3,
                  {"not of one picture", "'other.part' belongs to another picture than 'p1.part'",
                   "seed: 0 there, 7 here"});
    store("text.part", "text");
    expectFailure("merge text.part -o a.pfm", 3, {"no part to merge", "text.part", "not a checkpoint"});
    expectFailure("merge nowhere.part -o a.pfm", 3, {"nowhere.part"});
    EXPECT_EQ(load("a.pfm").substr(0, 2), "PF") << "what there was stays";
}

TEST_F(Parts, ThatComeTwiceAreComparedBitForBit) {
    renderParts(2);
    store("copy.part", load("p2.part"));
    EXPECT_EQ(run("merge p1.part p2.part copy.part -o a.pfm").exitCode, 0);
    lie("copy.part", 5);
    const Outcome outcome = run("merge p1.part p2.part copy.part -o b.pfm");
    EXPECT_EQ(outcome.exitCode, 1) << outcome;
    for (const std::string part : {"part 2 of 2 differs in the tile at", "first at the pixel",
                                   "'p2.part', made by", "'copy.part', made by", "b.pfm is not written"})
        EXPECT_TRUE(contains(outcome.output, part)) << part << '\n' << outcome;
    EXPECT_FALSE(entries().contains("b.pfm"));
}

TEST_F(Parts, ThatLieAreNamedByAnAudit) {
    renderParts(2);
    const Outcome honest = run("merge p1.part p2.part -o a.pfm --audit 100% --device cpu");
    EXPECT_EQ(honest.exitCode, 0) << honest;
    EXPECT_TRUE(contains(honest.output, "audit: 0 of ")) << honest;
    lie("p2.part", 100);
    EXPECT_EQ(run("merge p1.part p2.part -o a.pfm").exitCode, 0) << "without an audit nobody knows";
    const Outcome caught = run("merge p1.part p2.part -o b.pfm --audit 100 --device cpu");
    EXPECT_EQ(caught.exitCode, 1) << caught;
    EXPECT_TRUE(
        contains(caught.output, "part 2 of 2 has other pixels than this machine computes, 1 of the tile at"))
        << caught;
    EXPECT_TRUE(contains(caught.output, "'p2.part', made by")) << caught;
    EXPECT_FALSE(contains(caught.output, "part 1 of 2")) << caught;
    EXPECT_FALSE(entries().contains("b.pfm"));
    // Of all shares and seeds, some draw the tile and some do not.
    std::set<int> codes;
    for (int seed = 0; seed < 12; ++seed)
        codes.insert(run("merge p1.part p2.part -o c.pfm --audit 30% --device cpu --audit-seed " +
                         std::to_string(seed))
                         .exitCode);
    EXPECT_EQ(codes, (std::set<int>{0, 1}));
    std::filesystem::remove(folder / "sheet.obj");
    expectFailure("merge p1.part p2.part -o c.pfm --audit 1 --device cpu", 3, {"sheet.obj"});
}

TEST_F(Parts, AreToldOfInCleanText) {
    renderParts(1);
    change("p1.part", [](std::string &bytes, std::size_t originBegin, std::size_t) {
        bytes.at(originBegin + 1) = '\x7f'; // of a name in the JSON, so that the message of its reader has it
    });
    const std::string refusal = expectFailure("merge p1.part -o a.pfm", 3, {"'p1.part'", "how it was made"});
    EXPECT_FALSE(contains(refusal, "\x7f")) << refusal;
}

TEST_F(Parts, NameNoAttributesOfTheirOwn) {
    renderParts(1);
    const std::string whole = load("p1.part");
    const std::string known = "\"triangles\":";
    for (const std::string name : {"\"tiles\"    :", "\"\"         :", "\"triangle\" :"}) {
        store("p1.part", whole);
        change("p1.part", [&](std::string &bytes, std::size_t originBegin, std::size_t) {
            bytes.replace(bytes.find(known, originBegin), known.size(), name);
        });
        expectFailure("merge p1.part -o a.exr", 3, {"p1.part", "what no render says"});
    }
    store("p1.part", whole);
    EXPECT_EQ(run("merge p1.part -o a.png").exitCode, 0);
    for (const std::string &keyword : keywordsOf(load("a.png")))
        EXPECT_LE(keyword.size(), 79u) << keyword;
}

TEST_F(Parts, AreAuditedWithFilesOfTheirUserAlone) {
    std::filesystem::create_directory(folder / "here");
    for (const char *file : {"sheet.obj", "sheet.json"})
        std::filesystem::copy(folder / file, folder / "here");
    for (const std::string scene : {"../sheet.json", "link.json"}) {
        std::filesystem::remove(folder / "here/link.json");
        std::filesystem::create_symlink("../sheet.json", folder / "here/link.json");
        const auto runInside = [&](const std::string &command) {
            Surroundings inside;
            inside.folder = folder / "here";
            return runProgram(splitWords(command), inside);
        };
        const std::string line = " --device cpu" + smallPicture;
        ASSERT_EQ(runInside("render " + scene + line + " --part 1/1 -o p.part").exitCode, 0);
        const std::string audit = "merge p.part -o a.pfm --audit 100 --device cpu";
        const Outcome refused = runInside(audit);
        EXPECT_EQ(refused.exitCode, 3) << refused;
        EXPECT_TRUE(contains(refused.errors, "'" + scene + "'") && contains(refused.errors, "--allow-path"))
            << refused;
        EXPECT_EQ(runInside(audit + " --allow-path ..").exitCode, 0);
        std::filesystem::remove(folder / "here/p.part");
    }
}

TEST_F(Parts, RefuseWhatIsNotForThem) {
    const std::string line = "render sheet.json --device cpu" + smallPicture;
    for (const std::string word : {"0/3", "4/3", "1", "a/b", "1/", "/3", "1/65537", "-1/3", "1/3/3"})
        expectFailure(line + " -o a.part --part " + word, 2, {"--part", word, "I/N"});
    expectFailure(line + " -o a.exr --part 1/3", 2, {"a.exr", ".part"});
    expectFailure(line + " -o a.part --part 1/3 --resume", 2, {"--part", "--checkpoint"});
    expectFailure(line + " -o a.part --part 1/3 --tone filmic", 2, {});
    expectFailure("render sheet.json --device cpu-double -o a.part --part 1/3", 2, {"cpu-double"});
    expectFailure(line + " -o a.part --part 1/300", 2, {"1/300", "80 x 56", "at most 70 parts"});
    ASSERT_EQ(renderPart(1, 3).exitCode, 0);
    const std::string other =
        expectFailure(line + " -o p1.part --part 2/3", 3,
                      {"another render", "part: 1/3 there, 2/3 here", "remove p1.part"});
    EXPECT_FALSE(contains(other, "--resume")) << other;
    expectFailure("merge p1.part -o p1.part", 2, {});
    expectFailure("merge p1.part -o a.pfm --audit 0", 2, {"--audit"});
    expectFailure("merge p1.part -o a.pfm --audit-seed 3", 2, {"--audit"});
    expectFailure("merge p1.part -o nowhere/a.pfm", 7, {"nowhere"});
}

} // namespace
} // namespace hyalite::core::testing
