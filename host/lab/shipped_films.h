// Shipped films: small scenes that are installed with the program, and hashes of their films, the same on every
// machine.
#pragma once

#include "host/base/json_reader.h"
#include "host/film/film.h"
#include "host/scene/integrators.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace hyalite::core {

/// A scene of the folder verify/, rendered with its own settings but the integrator.
struct ShippedFilm {
    std::string scene; ///< without folder and extension
    Integrator integrator = Integrator::Path;
    int maxSlots = 1;       ///< kernels with at most so many path slots an invocation render it
    std::uint64_t hash = 0; ///< filmHash()
};

struct ShippedFilms {
    std::filesystem::path folder; ///< of the scenes
    int version = 0;              ///< grows with each change of a hash
    std::vector<ShippedFilm> films;

    [[nodiscard]] std::filesystem::path fileOf(const ShippedFilm &film) const {
        return folder / (film.scene + ".json");
    }
    /// The names of the scenes, each once, in their order.
    [[nodiscard]] std::vector<std::string> sceneNames() const;
};

/// A hash as 16 hexadecimal digits, as hashText() writes it. Throws Error{BadInput}.
[[nodiscard]] std::uint64_t readHash(const JsonNode &node);

/// The version of a shipped file. Throws Error{BadInput}.
[[nodiscard]] int readVersion(const JsonObject &object);

/// Reads verify/films.json of the first asset folder that has one. Throws Error{BadInput}.
[[nodiscard]] ShippedFilms readShippedFilms();

/// Hash of all that a film holds, pixel by pixel, whatever the layout of its records: the sums, their squares and the
/// sample counts, as little-endian words; then, if any pixel is transparent, the sums of that.
[[nodiscard]] std::uint64_t filmHash(const Film &film);

} // namespace hyalite::core
