#include "host/lab/comparison_index.h"

#include "host/base/markup.h"
#include "host/image/heat_map.h"
#include "host/image/png.h"
#include "host/image/tone_map.h"
#include "host/lab/comparison_index_page.h"
#include "host/report/page.h"

#include <fmt/format.h>
#include <glm/vec4.hpp>

#include <algorithm>

namespace hyalite::core {

namespace {

/// The grid of a thumbnail: each of its pixels has as many of the picture's, but for those at the edges.
struct Grid {
    int step;
    int width;
    int height;

    Grid(int pictureWidth, int pictureHeight) {
        constexpr int maxSide = 320;
        step = (std::max(pictureWidth, pictureHeight) + maxSide - 1) / maxSide;
        width = (pictureWidth + step - 1) / step;
        height = (pictureHeight + step - 1) / step;
    }

    /// Calls visit(index of a pixel of the thumbnail, x, y) for each pixel of the picture.
    template <class Visit> void visit(int pictureWidth, int pictureHeight, const Visit &visit) const {
        for (int y = 0; y < pictureHeight; ++y)
            for (int x = 0; x < pictureWidth; ++x)
                visit(static_cast<std::size_t>(y / step * width + x / step), x, y);
    }
};

std::string imageElement(const std::vector<std::byte> &png, const char *text) {
    return png.empty() ? std::string()
                       : fmt::format(R"(<img src="data:image/png;base64,{}" alt="{}">)", base64(png), text);
}

/// A name as the address of a file in the same folder.
std::string addressOf(const std::string &name) {
    std::string address = "./";
    for (const char letter : name) {
        const bool isPlain = (letter >= 'a' && letter <= 'z') || (letter >= 'A' && letter <= 'Z') ||
                             (letter >= '0' && letter <= '9') || letter == '-' || letter == '_' ||
                             letter == '.';
        address +=
            isPlain ? std::string(1, letter) : fmt::format("%{:02X}", static_cast<unsigned char>(letter));
    }
    return address;
}

std::string cardOf(const IndexedComparison &comparison) {
    const std::string content =
        fmt::format("<span class=\"pictures\">{}{}</span><strong>{}</strong>",
                    imageElement(comparison.picture, "the first picture"),
                    imageElement(comparison.errors, "where they differ"), markupText(comparison.title));
    return fmt::format("<li class=\"{}\">{}<p>{}</p></li>\n", comparison.isPassed ? "passed" : "failed",
                       comparison.page.empty()
                           ? content
                           : fmt::format("<a href=\"{}\">{}</a>", addressOf(comparison.page), content),
                       markupText(comparison.verdict));
}

} // namespace

std::vector<std::byte> thumbnail(const Image &image) {
    const Grid grid(image.width(), image.height());
    std::vector<glm::dvec4> sums(static_cast<std::size_t>(grid.width) *
                                 static_cast<std::size_t>(grid.height));
    grid.visit(image.width(), image.height(), [&](std::size_t to, int x, int y) {
        sums[to] += glm::dvec4(glm::dvec3(image.at(x, y)), 1.0);
    });
    Image small(grid.width, grid.height);
    std::ranges::transform(sums, small.pixels().begin(),
                           [](const glm::dvec4 &sum) { return glm::vec3(glm::dvec3(sum) / sum.w); });
    return encodePng(grid.width, grid.height, toneMap(small, 0.0));
}

std::vector<std::byte> thumbnail(const ErrorMap &errors) {
    const Grid grid(errors.width, errors.height);
    ErrorMap small{grid.width, grid.height, {}};
    small.errors.resize(static_cast<std::size_t>(grid.width) * static_cast<std::size_t>(grid.height));
    grid.visit(errors.width, errors.height, [&](std::size_t to, int x, int y) {
        const float error =
            errors.errors[static_cast<std::size_t>(y) * static_cast<std::size_t>(errors.width) +
                          static_cast<std::size_t>(x)];
        small.errors[to] = std::max(small.errors[to], error);
    });
    return encodePng(grid.width, grid.height, heatMap(small));
}

std::string comparisonIndexHtml(std::span<const IndexedComparison> comparisons) {
    std::string cards;
    for (const bool isPassed : {false, true})
        for (const IndexedComparison &comparison : comparisons)
            if (comparison.isPassed == isPassed)
                cards += cardOf(comparison);
    const auto passed = std::ranges::count(comparisons, true, &IndexedComparison::isPassed);
    const std::string summary = fmt::format("{} of {} scenes passed", passed, comparisons.size());
    return filledPage(comparison_index_page::indexHtml, {{"<h1>", summary}, {"<ul>\n", cards}});
}

} // namespace hyalite::core
