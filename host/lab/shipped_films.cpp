#include "host/lab/shipped_films.h"

#include "host/base/hash.h"
#include "host/base/json_document.h"
#include "host/import/assets.h"
#include "host/scene/names.h"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <span>

namespace hyalite::core {

namespace {

constexpr Interval slotCounts{1, 2};
constexpr std::size_t maxFilmCount = 1000;

ShippedFilm readFilm(const JsonNode &node) {
    constexpr std::array<std::string_view, 4> keys{"scene", "integrator", "maxSlots", "hash"};
    const JsonObject object(node, keys);
    return {object.text("scene"), object.choice("integrator", integratorNames),
            object.integer("maxSlots", slotCounts, 1), readHash(object.at("hash"))};
}

} // namespace

std::vector<std::string> ShippedFilms::sceneNames() const {
    std::vector<std::string> names;
    for (const ShippedFilm &film : films)
        if (std::ranges::find(names, film.scene) == names.end())
            names.push_back(film.scene);
    return names;
}

std::uint64_t readHash(const JsonNode &node) {
    const std::string text = node.text();
    std::uint64_t hash = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), hash, 16);
    if (error != std::errc() || text != hashText(hash))
        node.refuse("16 hexadecimal digits");
    return hash;
}

int readVersion(const JsonObject &object) {
    constexpr Interval versions{1, 1'000'000};
    return static_cast<int>(object.at("version").wholeNumber(versions));
}

ShippedFilms readShippedFilms() {
    ShippedFilms shipped;
    const std::filesystem::path file = shippedFile("verify/films.json");
    shipped.folder = file.parent_path();
    const std::string fileName = file.string();
    const nlohmann::json document = readJsonFile(file);
    constexpr std::array<std::string_view, 2> keys{"version", "films"};
    const JsonObject object({&document, &fileName}, keys);
    shipped.version = readVersion(object);
    for (const JsonNode &film : object.elements("films", maxFilmCount))
        shipped.films.push_back(readFilm(film));
    if (shipped.films.empty())
        object.at("films").refuse("at least one film");
    return shipped;
}

std::uint64_t filmHash(const Film &film) {
    static_assert(std::endian::native == std::endian::little);
    std::vector<std::array<std::uint32_t, 13>> words;
    words.reserve(film.pixels.size());
    for (const layout::FilmPixel &pixel : film.pixels) {
        std::array<std::uint32_t, 13> &inFilm = words.emplace_back();
        auto next = inFilm.begin();
        for (const glm::vec3 &sum : {pixel.sum, pixel.sumRest, pixel.sumOfSquares, pixel.squaresRest})
            for (int channel = 0; channel < 3; ++channel)
                *next++ = std::bit_cast<std::uint32_t>(sum[channel]);
        *next = pixel.sampleCount;
    }
    const std::uint64_t hash = hashBytes(std::as_bytes(std::span(words)));
    std::vector<std::array<float, 2>> transparencies;
    for (const layout::FilmPixel &pixel : film.pixels)
        transparencies.push_back({pixel.transparency, pixel.transparencyRest});
    const bool isOpaque = std::ranges::all_of(transparencies, [](const auto &sum) { return sum[0] == 0.0f; });
    return isOpaque ? hash : hashBytes(std::as_bytes(std::span(transparencies)), hash);
}

} // namespace hyalite::core
