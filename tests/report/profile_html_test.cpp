#include "host/base/markup.h"
#include "host/report/profile_html.h"
#include "tests/fixtures/profile_fixture.h"

#include <gtest/gtest.h>

#include <regex>
#include <set>
#include <vector>

namespace hyalite {
namespace {

using testing::handMadeProfile;

std::string encoded(std::string_view text) { return base64(std::as_bytes(std::span(text))); }

std::string pageOf(const Profile &profile) {
    const std::array<std::byte, 4> png{std::byte{0x89}, std::byte{'P'}, std::byte{'N'}, std::byte{'G'}};
    return profileHtml(profile, png);
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

TEST(ProfileHtml, IsWellFormedAndNeedsNothingElse) {
    const std::string page = pageOf(handMadeProfile({1.0, 1.5, 2.0}));
    expectWellFormed(page);
    EXPECT_TRUE(page.starts_with("<!DOCTYPE html>"));
    EXPECT_NE(page.find("src=\"data:image/png;base64,iVBORw==\""), std::string::npos);
    for (const char *outside : {"http:", "https:", "<script", "<link", "url(", "@import"})
        EXPECT_EQ(page.find(outside), std::string::npos) << outside;
}

TEST(ProfileHtml, HasTheFiguresAndWhereTheyComeFrom) {
    const Profile profile = handMadeProfile({1.0, 1.5, 2.0});
    const std::string page = pageOf(profile);
    for (const char *part : {"<td>upload</td>", "<td>dispatches</td>", "<td>write</td>", "<td>a</td>",
                             "<td>b</td>", "60.0 %", "hyalite profile a.json", "the device", "the driver 1.0",
                             "a clock", "hyalite " HYALITE_VERSION, "12 triangles"})
        EXPECT_NE(page.find(part), std::string::npos) << part;
}

TEST(ProfileHtml, HasTheHeatMapAndTheHistogramWhereWorkWasCounted) {
    Profile profile = handMadeProfile({1.0});
    EXPECT_EQ(pageOf(profile).find("tests per sample"), std::string::npos);
    profile.work = WorkCounts{10, 20, 30, 4};
    profile.workHistogram = {{1.0, 2.0, 75}, {2.0, 4.0, 25}};
    const std::array<std::byte, 3> image{std::byte{1}, std::byte{2}, std::byte{3}};
    const std::array<std::byte, 3> heatMap{std::byte{'f'}, std::byte{'o'}, std::byte{'o'}};
    const std::string page = profileHtml(profile, image, heatMap);
    expectWellFormed(page);
    for (const char *part : {"base64,Zm9v\"", "1 to 2</td><td>75</td><td>75.0 %", "2 to 4</td><td>25</td>",
                             "width:33.3%", "deepest stack 4"})
        EXPECT_NE(page.find(part), std::string::npos) << part;
}

TEST(ProfileHtml, NamesMayHoldAnything) {
    Profile profile = handMadeProfile({1.0});
    profile.origin.commandLine = "hyalite profile '<b>&\"c\"</b>.json'";
    profile.device.name = "</title><img>\x1b\xff";
    profile.frames.back().timeline.stages[0].name = "\"><p>";
    const std::string page = pageOf(profile);
    expectWellFormed(page);
    EXPECT_NE(page.find("'&lt;b&gt;&amp;&quot;c&quot;&lt;/b&gt;.json'"), std::string::npos);
    EXPECT_EQ(page.find('\x1b'), std::string::npos);
    EXPECT_EQ(page.find('\xff'), std::string::npos);
    EXPECT_EQ(markupText("a < b & c > \"d\""), "a &lt; b &amp; c &gt; &quot;d&quot;");
}

} // namespace
} // namespace hyalite
