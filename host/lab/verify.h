// Verification: the shipped films, rendered by a device with each of its kernels, must have the bits that their hashes
// say.
#pragma once

#include "host/engine/open_backends.h"
#include "host/lab/shipped_films.h"
#include "host/reference/divergence.h"

#include <glm/vec2.hpp>

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hyalite::core {

/// Where a film first differs from that of the CPU twin.
struct FilmDifference {
    /// Number of pixels that differ in any bit; 0: the twin's film has the same bits, which are not the shipped ones.
    std::size_t pixelCount = 0;
    glm::uvec2 pixel{0}; ///< the first of them, row by row from the top left of the whole image
    /// The dispatch that rendered it: its tile. Empty for a reference renderer.
    std::optional<DispatchRecord> dispatch;
    std::optional<Divergence> divergence; ///< empty: the paths agree in every step
};

/// The verdict on one film of one kernel.
struct FilmVerdict {
    ShippedFilm film;
    std::string kernel; ///< the user's word; empty for the CPU twin
    double seconds = 0.0;
    std::uint64_t hash = 0; ///< of the film
    std::string lack;       ///< why this kernel cannot render this film here; empty: it did
    std::string failure;    ///< what went wrong meanwhile, such as a lost device; empty: nothing
    std::optional<FilmDifference> difference; ///< set if and only if the hash is another one

    [[nodiscard]] bool isSkipped() const { return !lack.empty(); }
    [[nodiscard]] bool isFaulty() const { return !failure.empty() || difference.has_value(); }
};

/// The verdicts on one device.
struct DeviceVerdict {
    std::string device;      ///< name, or "cpu"
    std::string description; ///< for people
    gpu::BitGuarantee bits;  ///< as known before this verification
    std::vector<FilmVerdict> films;

    /// Whether each film was rendered that a kernel can render, and each of them with the shipped bits.
    [[nodiscard]] bool isPassed() const;
};

/// Renders `shipped.films` on "cpu", or on a device as openBackend() takes it, with those of gpu::kernelTable that
/// `wanted` names (none: that the device may choose by itself) and the device can run, several at a time. `onFilm` gets
/// each verdict with the finished share of the work, from one thread at a time. Devices that fail while they render do
/// not throw. Throws as openBackend() and prepareScene() do, and Error of the stop's kind once the observer wants one.
[[nodiscard]] DeviceVerdict verifyDevice(const std::string &device, const ShippedFilms &shipped,
                                         Observer &observer, const std::vector<std::string> &wanted = {},
                                         const std::function<void(const FilmVerdict &, double)> &onFilm = {});

} // namespace hyalite::core
