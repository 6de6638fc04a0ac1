// Checkpoints: what a render has so far, in a file from which it can go on.
//
// There are two generations: FILE, the newer one, and FILE.1. Each is written whole, stored durably and put in place by
// renaming, so that at any moment one of them is there and whole. All numbers are little endian:
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

/// All that decides the pixels of a render, by name: two renders whose identities are equal may share samples. Neither
/// names nor values have line ends, and no name has a colon.
using RenderIdentity = std::vector<std::pair<std::string, std::string>>;

struct Checkpoint {
    Film film;
    RayCounts rays; ///< traced for the film: a device may have begun samples that are not in it
};

/// The older generation of a checkpoint: FILE.1.
[[nodiscard]] std::filesystem::path olderCheckpoint(const std::filesystem::path &path);

/// Writes checkpoints of one render.
class CheckpointWriter {
  public:
    /// `isNewestWhole`: `path` holds a checkpoint of this render that can be read, which is then worth keeping as the
    /// older generation. Throws Error{OutputNotWritten} where `path` cannot be written.
    CheckpointWriter(const std::filesystem::path &path, RenderIdentity identity, bool isNewestWhole);

    /// Stores a generation durably. Throws Error{OutputNotWritten}; then those that were there before still are.
    void write(const Film &film, const RayCounts &rays);

    [[nodiscard]] const std::filesystem::path &path() const { return path_; }

  private:
    std::filesystem::path path_;
    RenderIdentity identity_;
    bool isNewestWhole_;
};

/// Reads one generation. Memory goes with the size of the file. Throws Error{BadInput}, naming the file, where it cannot
/// be read, is not a checkpoint, of another version or damaged; and where it is whole but of another render: then with
/// what differs, and both values, in place of the damage.
[[nodiscard]] Checkpoint readCheckpoint(const std::filesystem::path &path, const RenderIdentity &identity,
                                        const Crop &crop, std::uint32_t samplesPerPixel);

struct ResumedCheckpoint {
    Checkpoint checkpoint;
    std::filesystem::path path; ///< of the generation that was read
    std::string damage;         ///< what is wrong with the newer generation, where the older one was read
};

/// Reads the newer generation or, if that is missing or damaged, the older one. Nothing where neither exists. Throws
/// Error{BadInput} as readCheckpoint does, with all reasons.
[[nodiscard]] std::optional<ResumedCheckpoint> resumeCheckpoint(const std::filesystem::path &path,
                                                                const RenderIdentity &identity,
                                                                const Crop &crop,
                                                                std::uint32_t samplesPerPixel);

} // namespace hyalite
