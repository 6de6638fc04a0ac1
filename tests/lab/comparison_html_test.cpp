// The page of a comparison: its JSON has the bits of both pictures, and its script computes as the program does.
#include "host/lab/comparison_html.h"

#include "host/image/comparison_json.h"
#include "host/image/tone_map.h"
#include "host/image/ulp_histogram.h"
#include "tests/fixtures/node_fixture.h"
#include "tests/fixtures/page_fixture.h"
#include "tests/fixtures/synthetic_picture.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <sstream>
#include <utility>

namespace hyalite::core {
namespace {

using Json = nlohmann::json;
using testing::reportInPage;

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr float notANumber = std::numeric_limits<float>::quiet_NaN();

/// Decodes base64 by the definition, apart from the program's code.
std::vector<std::uint8_t> decoded(const std::string &text) {
    const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::vector<std::uint8_t> bytes;
    std::uint32_t bits = 0;
    int count = 0;
    for (const char letter : text) {
        if (letter == '=')
            break;
        bits = bits << 6 | static_cast<std::uint32_t>(digits.find(letter));
        count += 6;
        if (count >= 8)
            bytes.push_back(static_cast<std::uint8_t>(bits >> (count -= 8)));
    }
    return bytes;
}

std::vector<float> floatsIn(const Json &text) {
    const std::vector<std::uint8_t> bytes = decoded(text.get<std::string>());
    std::vector<float> values(bytes.size() / sizeof(float));
    std::memcpy(values.data(), bytes.data(), bytes.size());
    return values;
}

bool areSameBits(const std::vector<float> &a, const std::vector<float> &b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

std::vector<float> valuesOf(const Image &image) {
    std::vector<float> values;
    for (const glm::vec3 &pixel : image.pixels())
        values.insert(values.end(), {pixel.x, pixel.y, pixel.z});
    return values;
}

/// Two pictures with values of all kinds.
struct Pair {
    Pair() : a(linearPicture(40, 24, 0)), b(a) {
        b.at(3, 5).x = std::nextafter(b.at(3, 5).x, 2.0f);
        b.at(9, 7) = {0.25f, -1.0f, 100.0f};
        a.at(0, 1) = {notANumber, infinity, -0.0f};
        b.at(0, 1) = {notANumber, -infinity, 0.0f};
        a.at(39, 23) = {1e-40f, 3e38f, 1.0f};
    }
    Image a;
    Image b;
};

ComparisonPage pageOf(const Pair &pair, const ImageComparison &comparison) {
    nlohmann::ordered_json report = comparisonToJson(comparison, pair.a, pair.b);
    return {.title = "a and b",
            .verdict = "NOT equal",
            .first = {"first", "cpu", pair.a},
            .second = {"second", "device", pair.b},
            .comparison = comparison,
            .report = std::move(report)};
}

ImageComparison comparisonOf(const Pair &pair) { return compareImages(pair.a, pair.b, Encoding::Linear); }

/// Of each pixel, by all tone curves.
std::vector<std::vector<std::int64_t>> numbersByScript(const std::string &page, double stops) {
    std::string words = fmt::format("{}", stops);
    for (const auto &[name, curve] : toneCurveNames)
        words += fmt::format(" {}", name);
    std::vector<std::vector<std::int64_t>> rows;
    std::istringstream lines(testing::printedByNode("lab/page_numbers.js", page, words));
    for (std::string line; std::getline(lines, line);) {
        std::istringstream numbers(line);
        rows.emplace_back();
        for (std::int64_t number = 0; numbers >> number;)
            rows.back().push_back(number);
    }
    return rows;
}

void expectParts(const std::string &text, const std::vector<std::string> &parts) {
    for (const std::string &part : parts)
        EXPECT_NE(text.find(part), std::string::npos) << part << '\n' << text;
}

TEST(ComparisonHtml, HoldsTheBitsOfBothPictures) {
    const Pair pair;
    const ImageComparison comparison = comparisonOf(pair);
    const Json page = reportInPage(comparisonHtml(pageOf(pair, comparison))).at("page");
    EXPECT_EQ(page.at("window"), Json({0, 40, 0, 24}));
    EXPECT_EQ(page.at("channels"), 3);
    EXPECT_TRUE(areSameBits(floatsIn(page.at("pictures").at(0).at("pixels")), valuesOf(pair.a)));
    EXPECT_TRUE(areSameBits(floatsIn(page.at("pictures").at(1).at("pixels")), valuesOf(pair.b)));
    EXPECT_TRUE(areSameBits(floatsIn(page.at("flip")), comparison.flipMap.errors));
}

TEST(ComparisonHtml, HoldsEqualPicturesOnce) {
    Pair pair;
    pair.b = pair.a;
    const ImageComparison comparison = comparisonOf(pair);
    const Json page = reportInPage(comparisonHtml(pageOf(pair, comparison))).at("page");
    EXPECT_TRUE(page.at("pictures").at(1).at("pixels").is_null());
    EXPECT_FALSE(page.contains("flip"));
    EXPECT_EQ(page.at("ulps"), Json({{0, 0, 3 * 40 * 24}}));
}

TEST(ComparisonHtml, CountsDistances) {
    const Pair pair;
    const ImageComparison comparison = comparisonOf(pair);
    ComparisonPage page = pageOf(pair, comparison);
    // By another way: signed integers, which floats are ordered by.
    const auto place = [](float value) {
        const auto bits = std::bit_cast<std::int32_t>(value);
        return bits >= 0 ? std::int64_t{bits} : -1 - (std::int64_t{bits} & 0x7fffffff);
    };
    std::map<int, std::uint64_t> counts;
    const std::vector<float> a = valuesOf(pair.a);
    const std::vector<float> b = valuesOf(pair.b);
    for (std::size_t i = 0; i < a.size(); ++i) {
        const std::int64_t distance = std::abs(place(a[i]) - place(b[i]));
        ++counts[distance == 0 ? 0 : 1 + static_cast<int>(std::log2(static_cast<double>(distance)))];
    }
    const auto expectCounts = [&] {
        const Json bins = Json(comparisonPageToJson(page)).at("page").at("ulps");
        EXPECT_EQ(bins.size(), static_cast<std::size_t>(counts.rbegin()->first) + 1);
        for (std::size_t i = 0; i < bins.size(); ++i)
            EXPECT_EQ(bins[i][2], counts[static_cast<int>(i)]) << i;
        EXPECT_EQ(bins[0], Json({0, 0, counts[0]}));
        EXPECT_EQ(bins[1], Json({1, 1, counts[1]}));
        EXPECT_EQ(bins[4][0], 8);
        EXPECT_EQ(bins[4][1], 15);
    };
    EXPECT_EQ(counts[1], 2u); // the next float, and zeros
    expectCounts();
    page.mask = Mask(40 * 24, 1);
    page.mask[5 * 40 + 3] = 0;
    counts[0] -= 2;
    counts[1] -= 1;
    expectCounts();
}

TEST(ComparisonHtml, HasAlpha) {
    Pair pair;
    pair.b = pair.a;
    const std::vector<float> alpha(40 * 24, 0.5f);
    const ImageComparison comparison = comparisonOf(pair);
    ComparisonPage page = pageOf(pair, comparison);
    page.second.alpha = alpha;
    const Json json = Json(comparisonPageToJson(page)).at("page");
    EXPECT_EQ(json.at("channels"), 4);
    EXPECT_EQ(floatsIn(json.at("pictures").at(0).at("pixels")).at(7), 1.0f);
    EXPECT_EQ(floatsIn(json.at("pictures").at(1).at("pixels")).at(7), 0.5f);
    EXPECT_EQ(json.at("ulps").back().at(2), 40 * 24);
}

TEST(ComparisonHtml, HasAPartOfALargePicture) {
    Pair pair;
    pair.a = Image(3000, 2000);
    pair.b = pair.a;
    pair.b.at(2990, 1000).y = 1.0f;
    ImageComparison comparison;
    comparison.pixels = comparePixels(pair.a, pair.b);
    comparison.flipMap = {3000, 2000, std::vector<float>(3000 * 2000)};
    ComparisonPage page = pageOf(pair, comparison);
    page.centre = {comparison.pixels.worstX, comparison.pixels.worstY};
    const Json json = Json(comparisonPageToJson(page)).at("page");
    EXPECT_EQ(json.at("window"), Json({952, 3000, 488, 1512}));
    const std::vector<float> values = floatsIn(json.at("pictures").at(1).at("pixels"));
    EXPECT_EQ(values.size(), 3u * pagePixelCountMax);
    EXPECT_EQ(values[3 * ((1000 - 488) * 2048 + (2990 - 952)) + 1], 1.0f);
    EXPECT_EQ(json.at("ulps").at(0).at(2), 3 * 3000 * 2000 - 1); // of the whole
}

TEST(ComparisonHtml, ItsScriptComputesAsTheProgramDoes) {
    const Pair pair;
    const ImageComparison comparison = comparisonOf(pair);
    const std::string page = comparisonHtml(pageOf(pair, comparison));
    for (const double stops : {0.0, 1.75, -3.0}) {
        const auto rows = numbersByScript(page, stops);
        ASSERT_EQ(rows.size(), pair.a.pixels().size());
        std::size_t column = 0;
        for (const auto &[name, curve] : toneCurveNames) {
            const std::vector<std::uint8_t> levels = toneMap(pair.a, stops, curve);
            for (std::size_t i = 0; i < rows.size(); ++i)
                for (std::size_t k = 0; k < 3; ++k)
                    EXPECT_EQ(rows[i].at(column + k), levels[3 * i + k]) << name << ' ' << i;
            column += 3;
        }
        for (std::size_t i = 0; i < rows.size(); ++i) {
            std::uint32_t distance = 0;
            for (int k = 0; k < 3; ++k)
                distance = std::max(distance, ulpDistance(pair.a.pixels()[i][k], pair.b.pixels()[i][k]));
            EXPECT_EQ(rows[i].at(column), distance) << i;
        }
    }
}

TEST(ComparisonHtml, ShowsFiguresOriginsAndTheFirstStepThatDiffers) {
    Pair pair;
    pair.a.at(0, 1) = pair.b.at(0, 1); // two pixels differ
    pair.a.at(39, 23) = pair.b.at(39, 23);
    const ImageComparison comparison = comparisonOf(pair);
    ComparisonPage page = pageOf(pair, comparison);
    page.corner = {100, 200};
    page.first.origin = {{"driver", "one"}, {"arithmetic", "IEEE"}};
    page.second.origin = {{"driver", "two"}, {"arithmetic", "IEEE"}};
    page.report["commandLine"] = "hyalite compare";
    page.report["settings"] = {{"spp", 4}};
    page.report["gates"] = {{{"option", "--max-flip"}, {"limit", 0.5}, {"value", 0.25}, {"passed", true}}};
    page.report["divergence"] = {{"pixel", {103, 205}},      {"sample", 1},  {"bounce", 2},
                                 {"quantity", "throughput"}, {"first", "x"}, {"second", "y"}};
    page.report["traces"] = {
        {"step", 1},
        {"first", {{0, "hit", "sphere 1"}, {2, "throughput", "x"}}},
        {"second", {{0, "hit", "sphere 1"}, {2, "throughput", "y"}, {2, "hit", "none"}}}};
    const std::string html = comparisonHtml(page);
    const std::string text = testing::printedByNode("lab/page_text.js", html, "");
    expectParts(text,
                {"a and b: NOT equal\n", "names: first: cpu; second: device\n", "differing pixels 2 of 960",
                 "differing values 4 of 2880", "--max-flip 0.5 passed, 0.25",
                 fmt::format("PSNR {:.2f} dB", comparison.pixels.psnrDecibels()),
                 fmt::format("HDR-FLIP, mean {:.6f}", comparison.flip.mean),
                 "reading: Pixel (103, 205): 1 ULP at most", "driver one two", "arithmetic IEEE",
                 "commandLine hyalite compare", "settings.spp 4", "gamma srgb aces agx",
                 "Pixel (103, 205), sample 1, bounce 2: throughput first: x second: y",
                 "0 hit sphere 1 sphere 1 2 throughput x y 2 hit – none"});
    // All keys can be pressed; the second difference is the largest, and follows the first.
    for (const char *keys : {"1 2 3 4 5 6 t t t t + - 0 z [ ] , . ArrowLeft ' ' 0 l", "n", "p"})
        expectParts(testing::printedByNode("lab/page_text.js", html, keys),
                    {"reading: Pixel (109, 207): ", "G 0.", "-1 0xbf800000", "100 0x42c80000"});
    EXPECT_EQ(text.find("undefined"), std::string::npos) << text;
}

TEST(ComparisonHtml, ShowsEqualPictures) {
    Pair pair;
    pair.b = pair.a;
    const ImageComparison comparison = comparisonOf(pair);
    const std::string text =
        testing::printedByNode("lab/page_text.js", comparisonHtml(pageOf(pair, comparison)), "2 3 4 5 6 n l");
    expectParts(text, {"differing values 0 of 2880", "PSNR ∞ dB", "SSIM not available",
                       "histogram: ULP values share  0 2880 100.000 %"});
}

TEST(ComparisonHtml, NeedsNothingElseAndNamesMayHoldAnything) {
    const Pair pair;
    const ImageComparison comparison = comparisonOf(pair);
    ComparisonPage page = pageOf(pair, comparison);
    const std::string hostile = "</script><!--<script>&\"'\x1b\u202e\xff]]>";
    page.title = hostile;
    page.second.name = hostile;
    page.second.origin = {{hostile, hostile}};
    page.report["scene"] = hostile;
    const std::string html = comparisonHtml(page);
    EXPECT_EQ(reportInPage(html).at("page").at("pictures").at(1).at("origin").at(0).at(1),
              "</script><!--<script>&\"'\x1b\u202e\ufffd]]>");
    EXPECT_TRUE(html.starts_with("<!DOCTYPE html>"));
    EXPECT_TRUE(html.ends_with("</html>\n"));
    EXPECT_NE(html.find("default-src 'none'"), std::string::npos);
    for (const char *outside :
         {"http:", "https:", "<link", "url(", "@import", "fetch(", "XMLHttp", "src=", "innerHTML", "eval("})
        EXPECT_EQ(html.find(outside), std::string::npos) << outside;
    std::size_t count = 0;
    for (std::size_t i = html.find("</script"); i != std::string::npos; i = html.find("</script", i + 1))
        ++count;
    EXPECT_EQ(count, 2u);
    expectParts(testing::printedByNode("lab/page_text.js", html, ""),
                {"title: </script><!--<script>&\"'\ufffd\ufffd\ufffd]]>\n", "scene </script>"});
}

} // namespace
} // namespace hyalite::core
