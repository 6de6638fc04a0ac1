#include "host/lab/comparison_html.h"

#include "host/image/crop.h"
#include "host/image/heat_map.h"
#include "host/image/ulp_histogram.h"
#include "host/lab/comparison_page.h"
#include "host/report/page.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>

namespace hyalite::core {

namespace {

static_assert(std::endian::native == std::endian::little);

/// All pixels, or the part of at most 2048 columns around the centre.
Crop windowOf(const ComparisonPage &page) {
    const int width = page.first.colour.width();
    const int height = page.first.colour.height();
    if (std::int64_t{width} * height <= pagePixelCountMax)
        return {0, width, 0, height};
    constexpr int widthMax = 2048;
    const int columns = std::min(width, widthMax);
    const int rows = static_cast<int>(std::min(std::int64_t{height}, pagePixelCountMax / columns));
    const int x0 = std::clamp(page.centre.x - columns / 2, 0, width - columns);
    const int y0 = std::clamp(page.centre.y - rows / 2, 0, height - rows);
    return {x0, x0 + columns, y0, y0 + rows};
}

/// Appends values of each pixel of a window.
template <class Append> std::vector<float> valuesIn(const Crop &window, int width, const Append &append) {
    std::vector<float> values;
    for (int y = window.y0; y < window.y1; ++y)
        for (int x = window.x0; x < window.x1; ++x)
            append(values, static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                               static_cast<std::size_t>(x));
    return values;
}

std::vector<float> valuesOf(const ComparedPicture &picture, const Crop &window, bool hasAlpha) {
    return valuesIn(window, picture.colour.width(), [&](std::vector<float> &values, std::size_t pixel) {
        const glm::vec3 &colour = picture.colour.pixels()[pixel];
        values.insert(values.end(), {colour.x, colour.y, colour.z});
        if (hasAlpha)
            values.push_back(picture.alpha.empty() ? 1.0f : picture.alpha[pixel]);
    });
}

std::string encoded(const std::vector<float> &values) { return base64(std::as_bytes(std::span(values))); }

bool haveSameBits(const std::vector<float> &a, const std::vector<float> &b) {
    return std::ranges::equal(std::as_bytes(std::span(a)), std::as_bytes(std::span(b)));
}

nlohmann::ordered_json pictureToJson(const ComparedPicture &picture) {
    nlohmann::ordered_json origin = nlohmann::ordered_json::array();
    for (const auto &[name, text] : picture.origin)
        origin.push_back({name, text});
    return {{"role", picture.role}, {"name", picture.name}, {"origin", origin}};
}

std::string errorColours() {
    std::vector<std::uint8_t> colours;
    for (int level = 0; level < 256; ++level) {
        const std::array<std::uint8_t, 3> colour = magma(static_cast<float>(level) / 255.0f);
        colours.insert(colours.end(), colour.begin(), colour.end());
    }
    return base64(std::as_bytes(std::span(colours)));
}

/// Up to the last bin with a value.
nlohmann::ordered_json ulpsToJson(const ComparisonPage &page, bool hasAlpha) {
    UlpHistogram histogram = ulpHistogram(page.first.colour, page.second.colour, page.mask);
    if (hasAlpha)
        addAlphaUlps(histogram, page.first.alpha, page.second.alpha, page.mask);
    nlohmann::ordered_json bins = nlohmann::ordered_json::array();
    std::size_t end = histogram.size();
    while (end > 1 && histogram[end - 1] == 0)
        --end;
    for (std::size_t i = 0; i < end; ++i) {
        const std::uint64_t least = i == 0 ? 0 : std::uint64_t{1} << (i - 1);
        bins.push_back({least, i == 0 ? 0 : 2 * least - 1, histogram[i]});
    }
    return bins;
}

} // namespace

nlohmann::ordered_json comparisonPageToJson(const ComparisonPage &page) {
    const Crop window = windowOf(page);
    const bool hasAlpha = !page.first.alpha.empty() || !page.second.alpha.empty();
    const std::vector<float> first = valuesOf(page.first, window, hasAlpha);
    const std::vector<float> second = valuesOf(page.second, window, hasAlpha);
    nlohmann::ordered_json pictures = {pictureToJson(page.first), pictureToJson(page.second)};
    pictures[0]["pixels"] = encoded(first);
    if (haveSameBits(first, second))
        pictures[1]["pixels"] = nullptr;
    else
        pictures[1]["pixels"] = encoded(second);

    nlohmann::ordered_json content{{"title", page.title},
                                   {"verdict", page.verdict},
                                   {"corner", {page.corner.x, page.corner.y}},
                                   {"window", {window.x0, window.x1, window.y0, window.y1}},
                                   {"channels", hasAlpha ? 4 : 3},
                                   {"pictures", std::move(pictures)}};
    const ErrorMap &map = page.comparison.flipMap;
    const std::vector<float> errors =
        valuesIn(window, map.width,
                 [&](std::vector<float> &values, std::size_t pixel) { values.push_back(map.errors[pixel]); });
    if (std::ranges::any_of(errors, [](float error) { return error != 0.0f; }))
        content["flip"] = encoded(errors);
    content["colours"] = errorColours();
    content["ulps"] = ulpsToJson(page, hasAlpha);

    nlohmann::ordered_json json = page.report;
    json["passed"] = page.isPassed;
    json["page"] = std::move(content);
    return json;
}

std::string comparisonHtml(const ComparisonPage &page) {
    namespace files = comparison_page;
    const std::string script = std::string(files::floatsJs)
                                   .append(files::toneJs)
                                   .append(files::picturesJs)
                                   .append(files::comparisonJs);
    return filledPage(files::comparisonHtml, {{"<style>\n", files::comparisonCss},
                                              {R"(id="report">)", scriptJson(comparisonPageToJson(page))},
                                              {"<script>\n", script}});
}

} // namespace hyalite::core
