// IES files: every symmetry, edition and layout that the standard allows, and files that are damaged or hostile.
#include "host/import/ies.h"

#include "host/base/error.h"
#include "host/import/profile_library.h"
#include "host/scene/limits.h"
#include "tests/fixtures/temporary_folder.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstddef>
#include <fstream>
#include <limits>
#include <span>
#include <string>
#include <vector>

namespace hyalite::core {
namespace {

IesFile iesOf(const std::string &text) {
    return readIes(InputFile("lamp.ies", std::as_bytes(std::span(text))));
}

/// The message with which a text is refused; empty where it is read.
std::string iesRefusal(const std::string &text) {
    try {
        static_cast<void>(iesOf(text));
    } catch (const Error &error) {
        EXPECT_EQ(error.kind, ErrorKind::BadInput);
        return error.what();
    }
    return {};
}

std::string listed(const std::vector<double> &numbers) {
    std::string text;
    for (const double number : numbers)
        text += fmt::format("{} ", number);
    return text + '\n';
}

/// A file of these planes, whose values at gamma 0 and 90 count up from 1.
std::string ofPlanes(const std::vector<double> &planes) {
    std::vector<double> values;
    for (std::size_t i = 0; i < 2 * planes.size(); ++i)
        values.push_back(static_cast<double>(i) + 1.0);
    return fmt::format("IESNA:LM-63-2002\nTILT=NONE\n1 1000 1 2 {} 1 2 0 0 0\n1 1 50\n0 90\n",
                       planes.size()) +
           listed(planes) + listed(values);
}

/// The values at gamma 90, in the file's numbers.
std::vector<double> valuesOf(const LightProfile &profile) {
    std::vector<double> values;
    for (std::size_t i = 1; i < profile.shares.size(); i += 2)
        values.push_back(std::round(static_cast<double>(profile.shares[i]) * profile.candela * 1e3) / 1e3);
    return values;
}

const std::string tiltNone = "TILT=NONE\n";

TEST(Ies, ReadsAnglesAndIntensities) {
    const LightProfile profile =
        iesOf("IESNA:LM-63-1995\n[TEST] 12\n[MANUFAC] ours, TILT is none\nTILT=NONE\n"
              "2 1250.5 2 3 1 1 1 0.1,0.2 0.3\n0.5 1.0 60\n0 30 90\n0\n10, 40 20\n")
            .profile;
    EXPECT_EQ(profile.name, "lamp.ies");
    EXPECT_EQ(profile.gammas, (std::vector<double>{0, 30, 90}));
    EXPECT_EQ(profile.planes, (std::vector<double>{0}));
    EXPECT_EQ(profile.shares, (std::vector<float>{0.25f, 1.0f, 0.5f}));
    EXPECT_EQ(profile.candela, 40.0) << "multiplier 2, ballast 0.5";
}

TEST(Ies, LinesMayEndAnywhereAndInAnyWay) {
    const std::vector<float> shares = iesOf(ofPlanes({0, 90})).profile.shares;
    for (const char *ending : {"\r\n", "\r", "\n"}) {
        std::string text = "\xEF\xBB\xBFIESNA91";
        text += ending;
        text += "  TILT = NONE ";
        for (const char *word : {"1", "1000", "+1.0", "2",   "2", "1",     "2",  "0", "0", "0", "1",
                                 "1", "50",   "0",    "9e1", "0", ".9E+2", "1.", "2", "3", "4", "\x1a"}) {
            text += ending;
            text += word;
        }
        const IesFile file = iesOf(text);
        EXPECT_EQ(file.profile.shares, shares);
        EXPECT_TRUE(file.warnings.empty());
    }
}

TEST(Ies, SymmetriesAreThoseOfTheLastAngle) {
    struct Row {
        std::vector<double> planes;
        std::vector<double> around;
        std::vector<double> values;
    };
    const Row rows[] = {
        {{0}, {0}, {2}},
        {{0, 90}, {0, 90, 180, 270, 360}, {2, 4, 2, 4, 2}},
        {{0, 45, 90}, {0, 45, 90, 135, 180, 225, 270, 315, 360}, {2, 4, 6, 4, 2, 4, 6, 4, 2}},
        {{0, 120, 180}, {0, 120, 180, 240, 360}, {2, 4, 6, 4, 2}},
        {{0, 100, 360}, {0, 100, 360}, {2, 4, 6}},
        {{0, 90, 180, 270}, {0, 90, 180, 270, 360}, {2, 4, 6, 8, 2}},
        {{90, 180, 270}, {0, 90, 180, 270, 360}, {4, 2, 4, 6, 4}},
        {{90, 120, 180, 240, 270}, {0, 60, 90, 120, 180, 240, 270, 300, 360}, {6, 4, 2, 4, 6, 8, 10, 8, 6}},
        {{90, 170, 200, 270},
         {0, 10, 90, 170, 180, 200, 270, 340, 360},
         {4.667, 4, 2, 4, 4.667, 6, 8, 6, 4.667}},
        {{0.001, 89.995}, {0, 90, 180, 270, 360}, {2, 4, 2, 4, 2}},
    };
    for (const Row &row : rows) {
        const LightProfile profile = iesOf(ofPlanes(row.planes)).profile;
        EXPECT_EQ(profile.planes, row.around) << listed(row.planes);
        EXPECT_EQ(valuesOf(profile), row.values) << listed(row.planes);
    }
}

TEST(Ies, TheLampFactorCountsInOldFilesAlone) {
    const std::string rest = "\nTILT=NONE\n1 1 1 2 1 1 2 0 0 0\n1 0.5 50\n0 90\n0\n100 50\n";
    for (const char *name : {"IESNA91", "IESNA:LM-63-1986", "a lamp of 1986"}) {
        const bool isOld = !std::string(name).starts_with("IESNA:");
        EXPECT_EQ(iesOf(name + rest).profile.candela, isOld ? 50.0 : 100.0) << name;
    }
    EXPECT_EQ(iesOf("IESNA:LM-63-2002" + rest).profile.candela, 100.0);
    EXPECT_EQ(iesOf("IES:LM-63-2019" + rest).profile.candela, 100.0);
}

TEST(Ies, TiltIsPassedOverWithAWarning) {
    const std::string rest = "1 1 1 2 1 1 2 0 0 0\n1 1 50\n0 90\n0\n100 50\n";
    EXPECT_TRUE(iesOf("TILT=NONE\n" + rest).warnings.empty());
    for (const char *tilt : {"TILT=INCLUDE\n1\n3\n0 45 90\n1 0.9 0.8\n", "TILT=lamp.tlt\n"}) {
        const IesFile file = iesOf(tilt + rest);
        ASSERT_EQ(file.warnings.size(), 1u);
        EXPECT_NE(file.warnings[0].find("lamp.ies: TILT"), std::string::npos) << file.warnings[0];
        EXPECT_EQ(file.profile.candela, 100.0);
    }
}

TEST(Ies, NegativeValuesCountAsZero) {
    const IesFile file = iesOf(tiltNone + "1 1 1 2 1 1 2 0 0 0\n1 1 50\n0 90\n0\n100 -5\n7 8\n");
    EXPECT_EQ(file.profile.shares, (std::vector<float>{1.0f, 0.0f}));
    ASSERT_EQ(file.warnings.size(), 2u);
    EXPECT_NE(file.warnings[0].find("1 of 2 candela values are negative"), std::string::npos);
    EXPECT_NE(file.warnings[1].find("passed over"), std::string::npos);
}

TEST(Ies, OtherTypesAreRefusedByName) {
    EXPECT_EQ(iesRefusal(tiltNone + "1 1 1 2 1 2 2 0 0 0"),
              "lamp.ies:2: photometric type: found 2, type B; allowed: 1, type C");
    EXPECT_EQ(iesRefusal(tiltNone + "1 1 1 2 1\n3 2 0 0 0"),
              "lamp.ies:3: photometric type: found 3, type A; allowed: 1, type C");
}

TEST(Ies, FaultsAreToldWithTheirLine) {
    const std::string head = tiltNone + "1 1 1 2 1 1 2 0 0 0\n1 1 50\n";
    const std::pair<std::string, std::string> rows[] = {
        {"", "it is empty"},
        {"IESNA91\nno such line\n", "it has no line TILT="},
        {tiltNone, "lamp.ies:2: the file ends before its number and lumens"},
        {tiltNone + "1 1 zero", "lamp.ies:2: candela multiplier: found \"zero\"; allowed: a finite number"},
        {tiltNone + "1 1 nan", "allowed: a finite number"},
        {tiltNone + "1 1 inf", "allowed: a finite number"},
        {tiltNone + "1 1 1e999", "allowed: a finite number"},
        {tiltNone + "1 1 1x", "allowed: a finite number"},
        {tiltNone + "1 1 0", "candela multiplier: found \"0\"; allowed: more than 0"},
        {tiltNone + "1 1 -2", "candela multiplier: found \"-2\""},
        {tiltNone + "1 1 1 1 1", "number of vertical angles: found \"1\""},
        {tiltNone + "1 1 1 2.5 1", "allowed: whole numbers"},
        {tiltNone + "1 1 1 8193 1", "number of vertical angles: found \"8193\""},
        {tiltNone + "1 1 1 2 99999", "number of horizontal angles: found \"99999\""},
        {tiltNone + "1 1 1 8000 8000 1 2 0 0 0 1 1 50 0 1", "more than the rest of the file holds"},
        {head + "0 0\n0\n1 1", "lamp.ies:4: vertical angle: found 0 after 0; allowed: angles that ascend"},
        {head + "90 0\n0\n1 1", "allowed: angles that ascend"},
        {head + "0 181\n0\n1 1", "vertical angle: found \"181\"; allowed: from 0 to 180"},
        {head + "-90 90\n0\n1 1", "vertical angle: found \"-90\""},
        {head + "0 90\n0\n1", "lamp.ies:6: the file ends before its candela value"},
        {head + "0 90\n0\n1 nan", "lamp.ies:6: candela value: found \"nan\""},
        {head + "0 90\n0\n1 1e31", "candela value: found \"1e31\""},
        {head + "0 90\n0\n0 0", "found 0 candela at most; allowed: more than 0"},
        {"TILT=INCLUDE\n1\n99999\n", "number of angles of TILT"},
        {"TILT=INCLUDE\n1\n3\n0 1", "the file ends before its angles of TILT"},
        {ofPlanes({0, 45}), "horizontal angles: found those from 0 to 45; allowed: 0, 0 to 90"},
        {ofPlanes({90, 180}), "horizontal angles: found those from 90 to 180"},
        {ofPlanes({0, 361}), "horizontal angle: found \"361\""},
        {ofPlanes({0, 90, 90}), "horizontal angle: found 90 after 90"},
    };
    for (const auto &[text, part] : rows)
        EXPECT_NE(iesRefusal(text).find(part), std::string::npos) << text << "\n" << iesRefusal(text);
}

TEST(Ies, EveryShorterFileIsRefused) {
    const std::string text = ofPlanes({0, 45, 90});
    for (std::size_t length = 0; length < text.size() - 3; ++length) {
        const std::string found = iesRefusal(text.substr(0, length));
        EXPECT_TRUE(found.starts_with("lamp.ies:")) << length << found;
    }
}

TEST(Ies, ProfilesOfASceneAreReadOnceAndBounded) {
    const testing::TemporaryFolder temporary;
    const std::filesystem::path file = temporary.path / "a.ies";
    std::ofstream(file) << tiltNone << "1 1 1 2 1 1 2 0 0 0\n1 1 50\n0 90\n0\n100 -5\n";
    ProfileLibrary library;
    std::vector<std::string> warnings;
    EXPECT_EQ(library.load(file, warnings), 0u);
    EXPECT_EQ(library.load(temporary.path / "." / "a.ies", warnings), 0u);
    EXPECT_EQ(warnings.size(), 1u);
    EXPECT_EQ(library.give().size(), 1u);

    // Quarters of 1200 planes become four times as many, which are too many for 1500 angles each.
    const auto ofCounts = [](int gammaCount, int planeCount) {
        std::string text = tiltNone + fmt::format("1 1 1 {} {} 1 2 0 0 0 1 1 50\n", gammaCount, planeCount);
        for (int i = 0; i < gammaCount; ++i)
            text += fmt::format("{} ", 90.0 * i / (gammaCount - 1));
        for (int i = 0; i < planeCount; ++i)
            text += fmt::format("{} ", 90.0 * i / (planeCount - 1));
        for (int i = 0; i < gammaCount * planeCount; ++i)
            text += "1 ";
        return text;
    };
    EXPECT_NE(iesRefusal(ofCounts(1500, 1200)).find("candela values all around; allowed: at most 4194304"),
              std::string::npos);
    const std::string large = ofCounts(1500, 600);
    ProfileLibrary full;
    EXPECT_EQ(full.load(InputFile("a", std::as_bytes(std::span(large))), warnings), 0u);
    EXPECT_THROW(static_cast<void>(full.load(InputFile("b", std::as_bytes(std::span(large))), warnings)),
                 Error);
}

} // namespace
} // namespace hyalite::core
