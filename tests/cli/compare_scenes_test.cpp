// `compare` of several scenes: an index with a page of each.
#include "host/image/png.h"
#include "tests/cli/command_line.h"

#include <regex>

namespace hyalite::core::testing {
namespace {

struct CompareScenes : CommandLine {
    [[nodiscard]] int countOf(const std::string &text, const std::string &part) const {
        int count = 0;
        for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
            ++count;
        return count;
    }
};

const std::string ofSeveral = " --device cpu --against cpu-double --spp 1 --width 16 --height 12 ";

TEST_F(CompareScenes, HaveAnIndexAndAPageEach) {
    store("a & b.json", squareScene());
    store("square.obj", squareObj());
    const Outcome outcome =
        run("compare spheres 'a & b.json' cat --html all.html --junit all.xml" + ofSeveral);
    EXPECT_EQ(outcome.exitCode, 0) << outcome;
    EXPECT_TRUE(contains(outcome.output, "3 of 3 scenes passed")) << outcome;
    const std::string index = load("all.html");
    EXPECT_EQ(countOf(index, "<li class=\"passed\">"), 3);
    EXPECT_EQ(countOf(index, "data:image/png;base64,"), 6);
    EXPECT_EQ(countOf(index, "a &amp; b.json"), 1);
    const std::regex link("href=\"\\./([^\"]+)\"");
    std::vector<std::string> links;
    for (std::sregex_iterator match(index.begin(), index.end(), link), end; match != end; ++match)
        links.push_back((*match)[1]);
    EXPECT_EQ(links,
              (std::vector<std::string>{"all-1-spheres.html", "all-2-a%20%26%20b.html", "all-3-cat.html"}));
    for (const char *page : {"all-1-spheres.html", "all-2-a & b.html", "all-3-cat.html"})
        EXPECT_TRUE(contains(load(page), "id=\"report\"")) << page;
    EXPECT_EQ(countOf(load("all.xml"), "<testcase "), 3);
}

TEST_F(CompareScenes, GoOnAfterOneThatCannotBeRead) {
    store("broken.json", "{\"spheres\": 3}");
    const Outcome outcome =
        run("compare spheres broken.json cat --quiet --html all.html --junit all.xml" + ofSeveral);
    EXPECT_EQ(outcome.exitCode, 3) << outcome;
    EXPECT_TRUE(contains(outcome.errors, "broken.json: /spheres")) << outcome;
    for (const char *line : {"scene        spheres\n", "scene        cat\n", "2 of 3 scenes passed\n"})
        EXPECT_TRUE(contains(outcome.output, line)) << line << outcome;
    const std::string index = load("all.html");
    EXPECT_LT(index.find("broken.json"), index.find("spheres.json")) << "what failed comes first";
    EXPECT_EQ(countOf(index, "<li class=\"failed\">"), 1);
    EXPECT_EQ(countOf(load("all.xml"), "<failure "), 1);
    EXPECT_EQ(entries().count("all-2-broken.html"), 0u);
}

TEST_F(CompareScenes, OneThatCannotBeReadIsACaseThatFails) {
    store("broken.json", "{\"spheres\": 3}");
    const Outcome outcome = run("compare broken.json --junit one.xml");
    EXPECT_EQ(outcome.exitCode, 3) << outcome;
    EXPECT_TRUE(contains(outcome.errors, "broken.json: /spheres")) << outcome;
    EXPECT_EQ(countOf(load("one.xml"), "<testcase "), 1);
    EXPECT_EQ(countOf(load("one.xml"), "<failure "), 1);
}

TEST_F(CompareScenes, HaveNoFilesOfOneScene) {
    const std::string line = "compare spheres cat" + ofSeveral;
    expectFailure(line + "--diff a.png", 2, {"--diff", "2 scenes"});
    expectFailure(line + "--report a.json", 2, {"--report", "2 scenes"});
    expectFailure(line + "--html -", 2, {"--html", "several scenes"});
    expectFailure("compare spheres cat --statistical", 2, {"--statistical", "2 scenes"});
    expectFailure(line + "--tolerance x", 2, {"--tolerance"});
}

} // namespace
} // namespace hyalite::core::testing
