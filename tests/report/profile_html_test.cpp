#include "host/base/markup.h"
#include "host/report/baseline_json.h"
#include "host/report/figure_text.h"
#include "host/report/page.h"
#include "host/report/profile_html.h"
#include "host/report/profile_json.h"
#include "tests/fixtures/node_fixture.h"
#include "tests/fixtures/page_fixture.h"
#include "tests/fixtures/profile_fixture.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <regex>
#include <set>
#include <vector>

namespace hyalite::core {
namespace {

using testing::handMadeProfile;
using testing::reportInPage;

std::span<const std::byte> bytesOf(std::string_view text) { return std::as_bytes(std::span(text)); }
std::string encoded(std::string_view text) { return base64(bytesOf(text)); }

/// With a value wherever a report can have one.
Profile fullProfile() {
    Profile profile = handMadeProfile({1.0, 1.6, 2.0}); // no figure is a half, which C++ rounds to even
    profile.origin.coordinateOrigin = {1.0, 2.0, 3.0};
    profile.device.kernel = "skip-list";
    profile.timeLimitSeconds = 60.0;
    profile.leftOut = {"two repeats"};
    profile.frames.back().finishedShare = 0.25;
    profile.work = WorkCounts{10, 20, 30, 4};
    profile.kernelWork = KernelWork{"skip-list", {50, 60, 70, 0}, {80, 900, 32}};
    WorkLedger ledger;
    ledger.charge(PathStage::Primary, 0, 0, {2, 10, 1});
    ledger.charge(PathStage::Further, 1, 1, {5, 20, 3});
    ledger.charge(PathStage::Shadow, 2, 1, {7, 50, 5});
    ledger.shading.lobes[static_cast<std::size_t>(Lobe::Diffuse)] = 30;
    ledger.shading.lobes[static_cast<std::size_t>(Lobe::Glossy)] = 10;
    ledger.shading.filmSamples = 16;
    profile.charges = chargesOf(ledger, 3, {"teapot", "floor"}, {"clay"});
    profile.workHistogram = {{1.0, 2.0, 75}, {2.0, 4.0, 25}};
    return profile;
}

std::string pageOf(const Profile &profile) { return profileHtml(profile, bytesOf("\x89PNG")); }
StagePictures stagePngs() {
    StagePictures pngs;
    for (std::size_t stage = 0; stage < pngs.size(); ++stage)
        pngs[stage] = {static_cast<std::byte>('0' + stage)};
    return pngs;
}
std::string fullPage() { return profileHtml(fullProfile(), bytesOf("\x89PNG"), bytesOf("foo"), stagePngs()); }

/// What tests/report/page_script.js prints about a page.
std::string runScript(const std::string &page, const std::string &mode = "") {
    return testing::printedByNode("report/page_script.js", page, mode);
}

/// Expects every element to be closed where it should be.
void expectWellFormed(const std::string &page) {
    const std::set<std::string> empty{"meta", "img"};
    const std::regex tag("<(/?)([a-z0-9]+)[^>]*>");
    std::vector<std::string> open;
    for (std::sregex_iterator it(page.begin(), page.end(), tag), end; it != end; ++it) {
        const std::string name = (*it)[2];
        if (empty.contains(name))
            continue;
        if ((*it)[1].length() == 0) {
            open.push_back(name);
            continue;
        }
        ASSERT_FALSE(open.empty()) << name;
        EXPECT_EQ(open.back(), name);
        open.pop_back();
    }
    EXPECT_TRUE(open.empty()) << open.back();
}

/// The cells of a row of times, by the functions that the table in the terminal is made with.
std::string timesRow(const StageSummary &stage) {
    std::string html = "<tr>";
    for (const std::string &text :
         {stage.name, std::to_string(stage.launchCount), millisText(stage.medianFrameMillis()),
          stage.isInFrame ? shareText(stage.share) : "–", millisText(stage.launch.min),
          millisText(stage.launch.median), millisText(stage.launch.p95), millisText(stage.launch.max),
          stage.firstMillis ? millisText(*stage.firstMillis) : "–"})
        html += fmt::format("<td>{}</td>", text);
    return html + "</tr>";
}

TEST(Base64, HasTheVectorsOfRfc4648) {
    EXPECT_EQ(encoded(""), "");
    EXPECT_EQ(encoded("f"), "Zg==");
    EXPECT_EQ(encoded("fo"), "Zm8=");
    EXPECT_EQ(encoded("foo"), "Zm9v");
    EXPECT_EQ(encoded("foob"), "Zm9vYg==");
    EXPECT_EQ(encoded("fooba"), "Zm9vYmE=");
    EXPECT_EQ(encoded("foobar"), "Zm9vYmFy");
    EXPECT_EQ(encoded("\xff\xfe\xfd"), "//79");
}

TEST(ProfileHtml, HoldsTheReportAndNeedsNothingElse) {
    const std::string page = fullPage();
    nlohmann::json report = profileToJson(fullProfile());
    report["picture"] = "iVBORw==";
    report["heatMap"] = "Zm9v";
    report["stagePictures"] = {{"primary", "MA=="}, {"further", "MQ=="}, {"shadow", "Mg=="}};
    EXPECT_EQ(reportInPage(page), report);
    EXPECT_TRUE(page.starts_with("<!DOCTYPE html>"));
    EXPECT_TRUE(page.ends_with("</html>\n"));
    for (const char *outside :
         {"http:", "https:", "<link", "url(", "import", "fetch", "XMLHttp", "src=\"/", "script src"})
        EXPECT_EQ(page.find(outside), std::string::npos) << outside;
    expectWellFormed(std::regex_replace(page, std::regex("<script>[^]*</script>"), ""));
    expectWellFormed(runScript(page));
}

TEST(ProfileHtml, ShowsEveryFigureOfTheReport) {
    // Times of single frames stand in the report alone, as do the version of its form and the stack of a kernel, which
    // may have none. `verification` and `timeLimit` say the rest in words.
    const std::regex others("profileVersion|(stages\\.\\d+\\.|kernels\\.\\d+\\.|)frameMillis\\.\\d+|"
                            "work\\.skip-list\\.deepestStack|isVerified|finishedShare|"
                            "(kernels\\.\\d+|frame)\\.isInFrame");
    std::istringstream paths(runScript(fullPage(), "unshown"));
    std::size_t count = 0;
    for (std::string path; std::getline(paths, path); ++count)
        EXPECT_TRUE(std::regex_match(path, others)) << path;
    EXPECT_EQ(count, 24u); // that the report was looked through
}

/// Of a kernel "a" that has become twice as fast, with as many rays less of a kind.
BaselineVerdict verdictOn(const Profile &old, const Profile &now) {
    return {compareWithBaseline(figuresOf(old), figuresOf(now), 0.05, Gate::All), profileToJson(old), 0.05,
            Gate::All};
}

TEST(ProfileHtml, ShowsTwoProfilesAndWhatHasChanged) {
    Profile old = handMadeProfile({1.96, 1.98, 2.0, 2.02, 2.04});
    old.device.name = "the other device";
    old.origin.commandLine = "hyalite profile before.json";
    old.frames.back().timeline.dispatches[0].rays.shadow += 50;
    const Profile now = handMadeProfile({0.98, 0.99, 1.0, 1.01, 1.02});
    const BaselineVerdict verdict = verdictOn(old, now);
    const std::string page = profileHtml(now, bytesOf("\x89PNG"), {}, {}, &verdict);
    EXPECT_EQ(reportInPage(page).at("baseline"), profileToJson(old));
    EXPECT_EQ(reportInPage(page).at("comparison"), comparisonToJson(verdict));
    const std::string markup = runScript(page);
    expectWellFormed(markup.substr(markup.find('\n')));
    for (const char *part :
         {"Before: the other device", "After: the device", "hyalite profile before.json",
          "Before, a frame: 130.0 ms", "After, a frame: 70.0 ms", "kernel a is faster, 0.500 of before",
          "dispatches is faster, 0.512 of before", "2 of 6 counts differ",
          "No regression by the limit of 5.0 %", "The devices or drivers are two",
          "<td>kernel a</td><td>80.0</td><td>40.0</td><td>0.500</td><td>1.4 %</td><td>faster</td>",
          "<td>upload</td><td>5.000</td><td>5.000</td><td>1.000</td><td>0.0 %</td><td>within the noise</td>",
          "<td>rays.shadow</td><td>6050</td><td>6000</td><td>0.992</td><td></td><td>less work</td>"})
        EXPECT_NE(markup.find(part), std::string::npos) << part << markup;
    const std::regex others("(profileVersion|baseline\\..*|comparison\\.(stages|kernels|frame).*isRegression|"
                            "(stages\\.\\d+\\.|kernels\\.\\d+\\.|)frameMillis\\.\\d+|isVerified|"
                            "comparison\\.(frame|stages\\.\\d+)\\.isRegression|"
                            "comparison\\.are.*|(kernels\\.\\d+|frame)\\.isInFrame)");
    std::istringstream paths(runScript(page, "unshown"));
    for (std::string path; std::getline(paths, path);)
        EXPECT_TRUE(std::regex_match(path, others)) << path;
}

TEST(ProfileHtml, NamesTheDearestObjects) {
    const std::string markup = runScript(fullPage());
    for (const char *part :
         {"<b>floor</b> with 61.8 %", "<b>teapot</b> with 25.8 %", "of the box and triangle tests",
          "primary rays\n12.4 %", "nothing: rays that leave the scene", "first 3 samples of each pixel",
          "base64,Mg==\"",
          "<tr><td>floor</td><td>0</td><td>0</td><td>7</td><td>50</td><td>5</td><td>61.8 %</td>"})
        EXPECT_NE(markup.find(part), std::string::npos) << part << markup;
}

TEST(ProfileHtml, NamesARegression) {
    const BaselineVerdict verdict = verdictOn(handMadeProfile({1.0, 1.0}), handMadeProfile({1.5, 1.5}));
    const std::string markup =
        runScript(profileHtml(handMadeProfile({1.5, 1.5}), bytesOf("\x89PNG"), {}, {}, &verdict));
    for (const char *part : {"A REGRESSION by the limit", "slower, REGRESSION", "All 6 counts are equal",
                             "<tr class=\"changed\">"})
        EXPECT_NE(markup.find(part), std::string::npos) << part << markup;
    EXPECT_EQ(markup.find("devices or drivers are two"), std::string::npos);
}

TEST(ProfileHtml, ABaselineOfFewFiguresIsShownToo) {
    const Profile now = handMadeProfile({1.0});
    BaselineVerdict verdict = verdictOn(now, now);
    verdict.baseline = {{"device", nullptr}};
    const std::string markup = runScript(profileHtml(now, bytesOf("\x89PNG"), {}, {}, &verdict));
    EXPECT_NE(markup.find("Before: –"), std::string::npos) << markup;
    EXPECT_NE(markup.find("<td>unknown</td>"), std::string::npos) << "a single frame has no noise";
    for (const char *part : {"undefined", "NaN", "null"})
        EXPECT_EQ(markup.find(part), std::string::npos) << part;
}

TEST(ProfileHtml, HasTheTimesThatTheTableHas) {
    const Profile profile = fullProfile();
    const std::string markup = runScript(pageOf(profile));
    std::vector<StageSummary> rows = summariseStages(profile);
    for (const KernelSummary &kernel : summariseKernels(profile))
        rows.push_back(kernel.times);
    rows.push_back(summariseFrame(profile));
    for (const StageSummary &stage : rows)
        EXPECT_NE(markup.find(timesRow(stage)), std::string::npos) << timesRow(stage) << markup;
}

TEST(ProfileHtml, HasTheFiguresAndWhereTheyComeFrom) {
    const std::string markup = runScript(fullPage());
    for (const char *part :
         {"a.json on the device\n<h1>a.json on the device</h1>", "64 by 48 pixels, 4 samples per pixel",
          "the driver 1.0", "hyalite profile a.json", "hyalite " HYALITE_VERSION,
          "a.json, 12 triangles, 345 bytes", "<dd>1, 2, 3</dd>",
          "<b>106.0 ms</b><span>a frame, median of 3</span>", "<b>10.0 k rays</b>", "<b>2.4 KiB</b>",
          "<b>3 dispatches</b>", "base64,iVBORw==\"", "base64,Zm9v\"", "1 to 2</td><td>75</td><td>75.0 %",
          "2 to 4</td><td>25</td>", "width:33.333", "10 inner nodes, 20 boxes, 30 triangles, deepest stack 4",
          "time limit of 60 s: two repeats", "900 slots\nor 35.2 % of them busy"})
        EXPECT_NE(markup.find(part), std::string::npos) << part << markup;
}

TEST(ProfileHtml, DoesNotShowWhatIsNotAvailable) {
    Profile profile = handMadeProfile({1.0});
    for (Frame &frame : profile.frames) {
        for (DispatchRecord &dispatch : frame.timeline.dispatches)
            dispatch.times = {};
        for (StageRecord &stage : frame.timeline.stages)
            stage.deviceBytes = 0;
    }
    const std::string markup = runScript(pageOf(profile));
    EXPECT_NE(markup.find("<b>–</b><span>while kernels run"), std::string::npos) << markup;
    for (const char *part : {"buffers on the device", "tests per sample", "Where the rays have work",
                             "SPIR-V", "Origin", "time limit", "undefined", "NaN", "Infinity"})
        EXPECT_EQ(markup.find(part), std::string::npos) << part;
}

TEST(ProfileHtml, NamesMayHoldAnything) {
    Profile profile = handMadeProfile({1.0});
    profile.origin.commandLine = "hyalite profile '</script><!--<script>&\"c\"</b>.json'";
    profile.device.name = "</title><img>\x1b\u202e\xff";
    profile.frames.back().timeline.stages[0].name = "\"><p>";
    const std::string page = pageOf(profile);
    EXPECT_EQ(reportInPage(page).at("commandLine"), profile.origin.commandLine);
    const std::string markup = runScript(page);
    expectWellFormed(markup.substr(markup.find('\n')));
    EXPECT_NE(markup.find("'&#60;/script&#62;&#60;!--&#60;script&#62;&#38;&#34;c&#34;&#60;/b&#62;.json'"),
              std::string::npos);
    EXPECT_NE(markup.find("&#60;/title&#62;&#60;img&#62;\ufffd\ufffd\ufffd</h1>"), std::string::npos)
        << markup;
    EXPECT_EQ(markupText("a < b & c > \"d\""), "a &lt; b &amp; c &gt; &quot;d&quot;");
}

} // namespace
} // namespace hyalite::core
