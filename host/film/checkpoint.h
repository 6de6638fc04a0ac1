// Checkpoints: the state of a render, in a file from which it can continue. A part of a picture is one, too.
//
// There are two generations: FILE, the newer one, and FILE.1. Each is written, synced to disk and then renamed into
// place, so that at any moment at least one of them is complete. All numbers are little endian:
//
//     "hyalite checkpoint\n"
//     u32 version     u32 bytes of the identity
//     i32 x0, x1, y0, y1 of the crop
//     u64 primary, shadow, reflection, refraction and bounce rays that were traced
//     u32 index of the part, from 1     u32 number of parts: 1 for a whole render
//     u32 samples wanted for each pixel     u32 number of layers
//     u32 bytes of the origin     u32 number of layers of light
//     u32 1 if first samples are kept, or 0     u32 1 if wanted counts are, or 0
//     f64 wanted noise: 0 for the same number of samples in each pixel
//     the identity, a line "name: value" for each of its parts
//     the origin: what the writer says of itself
//     the part's pixels, as layout::FilmPixel: its squares in their order (partition.h), each row by row. One word of a
//     pixel is 0, and is kept for what later samples or filters want to know of it; more than that is a layer
//     the layers of light of these pixels (film.h)
//     their first samples, as FirstSamples (film.h), if they are kept
//     their wanted counts, u32 each (film.h), if they are kept
//     the pixels of each layer
//     u64 hash of all that
#pragma once

#include "host/film/film.h"
#include "host/film/partition.h"
#include "host/film/ray_counts.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace hyalite::core {

/// Of checkpoints and parts. Files of another version are refused by name.
inline constexpr std::uint32_t checkpointVersion = 10;

/// Everything that affects the samples of a render, by name. Renders with equal identities may share samples. Names and
/// values have no line ends, and names have no colons.
using RenderIdentity = std::vector<std::pair<std::string, std::string>>;

/// The content of a file.
struct CheckpointFile {
    std::filesystem::path path;
    std::string identity; ///< a line "name: value" for each of its parts
    std::string origin;
    Crop crop;
    Part part;
    std::uint32_t samplesPerPixel = 0; ///< that are wanted
    double noise = 0.0;                ///< likewise (noise.h); 0: none
    RayCounts rays;                    ///< traced for the pixels
    std::uint32_t lightPlaneCount = 0;
    FilmRecords film; ///< of the part
    std::vector<FilmRecords> layers;
};

struct Checkpoint {
    Film film;                ///< pixels outside of the part have the samples that are wanted, and no colour
    std::vector<Film> layers; ///< of a part, likewise
    RayCounts rays;           ///< traced for the film; a device may have started samples that are not in it
    std::uint32_t samplesPerPixel = 0; ///< that were wanted
    double noise = 0.0;                ///< likewise
};

/// The part of a render, beside its identity, that all generations of its checkpoint have in common.
struct CheckpointSubject {
    Crop crop;
    Part part;
    std::uint32_t samplesPerPixel = 1;
    std::string origin;
    double noise = 0.0; ///< wanted, as samplesPerPixel; 0: none
};

/// The older generation of a checkpoint: FILE.1.
[[nodiscard]] std::filesystem::path olderCheckpoint(const std::filesystem::path &path);

/// Throws Error{OutputNotWritten} if no checkpoint can be written there.
void requireWritableCheckpoint(const std::filesystem::path &path);

/// Throws Error{OutputNotWritten} if a generation would replace a file that is neither a checkpoint, damaged or not,
/// nor empty.
void requireOwnCheckpoint(const std::filesystem::path &path);

/// Writes checkpoints of one render.
class CheckpointWriter {
  public:
    /// `isNewestWhole`: `path` is a readable checkpoint of this render, which then becomes the older generation. Throws
    /// Error{OutputNotWritten} if `path` cannot be written.
    CheckpointWriter(const std::filesystem::path &path, const RenderIdentity &identity,
                     CheckpointSubject subject, bool isNewestWhole);

    /// Stores a generation on disk; films have the crop of the subject. Throws Error{OutputNotWritten}; then the
    /// previous generations are kept.
    void write(const Film &film, const RayCounts &rays, std::span<const Film *const> layers = {});

    [[nodiscard]] const std::filesystem::path &path() const { return path_; }

  private:
    std::filesystem::path path_;
    std::string identity_;
    CheckpointSubject subject_;
    Partition partition_;
    bool isNewestWhole_;
};

/// Reads one generation; memory is in proportion to the size of the file, except for some 100 MB at most where it
/// claims to be of very many parts. Throws Error{BadInput}, naming the file, if it cannot be read, is not a checkpoint,
/// has another version or is damaged. `known` may be a partition that was made before, which then is not made again.
[[nodiscard]] CheckpointFile readCheckpointFile(const std::filesystem::path &path,
                                                const Partition *known = nullptr);

/// The same, for a render that goes on. Throws Error{BadInput} likewise; and, with the difference and both values, if
/// the file belongs to another render.
[[nodiscard]] Checkpoint readCheckpoint(const std::filesystem::path &path, const RenderIdentity &identity,
                                        const CheckpointSubject &subject);

/// An identity as a file has it.
[[nodiscard]] std::string identityText(const RenderIdentity &identity);

/// How two identities differ, as the lines of a file: "seed: 1 there, 2 here; sampler: ...".
[[nodiscard]] std::string describeDifferences(std::string_view there, std::string_view here);

struct ResumedCheckpoint {
    Checkpoint checkpoint;
    std::filesystem::path path; ///< of the generation that was read
    std::string damage;         ///< the fault of the newer generation, if the older one was read
};

/// Reads the newer generation or, if it is missing or damaged, the older one. Empty if neither exists. Throws
/// Error{BadInput} as readCheckpoint does, with all reasons.
[[nodiscard]] std::optional<ResumedCheckpoint> resumeCheckpoint(const std::filesystem::path &path,
                                                                const RenderIdentity &identity,
                                                                const CheckpointSubject &subject);

} // namespace hyalite::core
