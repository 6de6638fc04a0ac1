// Checkpoints: the state of a render, in a file from which it can continue.
//
// There are two generations: FILE, the newer one, and FILE.1. Each is written, synced to disk and then renamed into
// place, so that at any moment at least one of them is complete. All numbers are little endian:
//
//     "hyalite checkpoint\n"
//     u32 version     u32 bytes of the identity
//     i32 x0, x1, y0, y1 of the crop
//     u64 primary, shadow, reflection, refraction and bounce rays that were traced
//     the identity, a line "name: value" for each of its parts
//     the film's pixels, as layout::FilmPixel, row by row
//     u64 hash of all that
#pragma once

#include "host/film/film.h"
#include "host/film/ray_counts.h"

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace hyalite {

/// Everything that affects the samples of a render, by name. Renders with equal identities may share samples. Names and
/// values have no line ends, and names have no colons.
using RenderIdentity = std::vector<std::pair<std::string, std::string>>;

struct Checkpoint {
    Film film;
    RayCounts rays; ///< traced for the film; a device may have started samples that are not in it
};

/// The older generation of a checkpoint: FILE.1.
[[nodiscard]] std::filesystem::path olderCheckpoint(const std::filesystem::path &path);

/// Writes checkpoints of one render.
class CheckpointWriter {
  public:
    /// `isNewestWhole`: `path` is a readable checkpoint of this render, which then becomes the older generation. Throws
    /// Error{OutputNotWritten} if `path` cannot be written.
    CheckpointWriter(const std::filesystem::path &path, RenderIdentity identity, bool isNewestWhole);

    /// Stores a generation on disk. Throws Error{OutputNotWritten}; then the previous generations are kept.
    void write(const Film &film, const RayCounts &rays);

    [[nodiscard]] const std::filesystem::path &path() const { return path_; }

  private:
    std::filesystem::path path_;
    RenderIdentity identity_;
    bool isNewestWhole_;
};

/// Reads one generation; memory is in proportion to the size of the file. Throws Error{BadInput}, naming the file, if
/// it cannot be read, is not a checkpoint, has another version or is damaged; and, with the difference and both values,
/// if it belongs to another render.
[[nodiscard]] Checkpoint readCheckpoint(const std::filesystem::path &path, const RenderIdentity &identity,
                                        const Crop &crop, std::uint32_t samplesPerPixel);

struct ResumedCheckpoint {
    Checkpoint checkpoint;
    std::filesystem::path path; ///< of the generation that was read
    std::string damage;         ///< the fault of the newer generation, if the older one was read
};

/// Reads the newer generation or, if it is missing or damaged, the older one. Empty if neither exists. Throws
/// Error{BadInput} as readCheckpoint does, with all reasons.
[[nodiscard]] std::optional<ResumedCheckpoint> resumeCheckpoint(const std::filesystem::path &path,
                                                                const RenderIdentity &identity,
                                                                const Crop &crop,
                                                                std::uint32_t samplesPerPixel);

} // namespace hyalite
