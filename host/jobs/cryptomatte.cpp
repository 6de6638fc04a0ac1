#include "host/jobs/cryptomatte.h"

#include "host/base/hash.h"
#include "host/film/tally.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <memory>
#include <string>
#include <utility>

namespace hyalite::core {

namespace {

constexpr int ranksPerLayer = 2;

struct MatteRank {
    std::uint32_t id = 0;
    std::uint32_t count = 0; ///< of samples
};

using MatteRanks = std::array<MatteRank, matteRankCount>;

/// `ids` has that of number n at n - 1.
MatteRanks ranksOf(const Tally &tally, const std::vector<std::uint32_t> &ids) {
    std::vector<MatteRank> all;
    for (const auto &[number, count] : tally.numbers) {
        assert(number <= ids.size());
        const std::uint32_t id = ids[number - 1];
        const auto same = std::ranges::find(all, id, &MatteRank::id);
        if (same == all.end())
            all.push_back({id, count});
        else
            same->count += count;
    }
    std::ranges::sort(all, [](const MatteRank &a, const MatteRank &b) {
        return a.count != b.count ? a.count > b.count : a.id < b.id;
    });
    MatteRanks ranks;
    std::ranges::copy_n(all.begin(), std::min<std::ptrdiff_t>(std::ssize(all), matteRankCount),
                        ranks.begin());
    return ranks;
}

} // namespace

std::uint32_t matteIdOf(std::string_view name) {
    const std::uint32_t hash = murmurHash3(name);
    const std::uint32_t exponent = hash >> 23u & 0xFFu;
    return exponent == 0 || exponent == 0xFFu ? hash ^ 1u << 23u : hash;
}

std::vector<Layer> matteLayers(const ViewFilm &film) {
    const auto ids = std::make_shared<std::vector<std::uint32_t>>();
    ids->reserve(film.names.size());
    for (const std::string &name : film.names)
        ids->push_back(matteIdOf(name));
    std::vector<Layer> layers;
    for (std::size_t first = 0; first < matteRankCount; first += ranksPerLayer) {
        const auto fillRow = [&film, ids, first](int y, std::span<float> row) {
            float *next = row.data();
            for (const layout::FilmPixel &pixel : rowOf(film.film, y)) {
                const Tally tally = tallyOf(pixel);
                const MatteRanks ranks = ranksOf(tally, *ids);
                for (std::size_t i = first; i < first + ranksPerLayer; ++i) {
                    *next++ = std::bit_cast<float>(ranks[i].id);
                    *next++ =
                        ranks[i].count == 0
                            ? 0.0f
                            : static_cast<float>(static_cast<double>(ranks[i].count) / tally.sampleCount);
                }
            }
        };
        const IntegratorRow &view = rowOf(film.view);
        layers.push_back({fmt::format("{}{:02}", view.cryptomatte, first / ranksPerLayer),
                          std::string(view.layerChannels), fillRow});
    }
    return layers;
}

std::vector<Attribute> matteAttributes(const ViewFilm &film) {
    const std::string_view name = rowOf(film.view).cryptomatte;
    // As a list of its entries: the object would look each name up.
    nlohmann::ordered_json::object_t manifest;
    for (const std::string &entry : film.names)
        manifest.Container::emplace_back(entry, fmt::format("{:08x}", matteIdOf(entry)));
    const std::string key = fmt::format("cryptomatte/{:.7}/", fmt::format("{:08x}", matteIdOf(name)));
    return {{key + "name", std::string(name)},
            {key + "hash", "MurmurHash3_32"},
            {key + "conversion", "uint32_to_float32"},
            {key + "manifest", nlohmann::ordered_json(std::move(manifest)).dump()}};
}

} // namespace hyalite::core
