// Merging: a picture of its parts, which any machines may have rendered.
#pragma once

#include "host/farm/part_origin.h"
#include "host/film/checkpoint.h"
#include "host/film/noise.h"
#include "host/film/view_film.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace hyalite::core {

/// Takes parts one by one; only one file is in memory at a time.
class Merger {
  public:
    /// Reads a part. What is wrong with it is in `faults` then.
    void add(const std::filesystem::path &path);

    /// Faults that keep parts from making one picture, each with the file's name, in the order of `add`.
    struct Faults {
        std::vector<std::string> unusable;    ///< damaged, unfinished, or not a part: it counts as missing
        std::vector<std::string> foreign;     ///< of another picture than the first
        std::vector<std::string> differences; ///< of two files of one part, which should be equal to the bit
    };
    [[nodiscard]] const Faults &faults() const { return faults_; }

    /// Whether there is any part.
    [[nodiscard]] bool hasParts() const { return subject_.has_value(); }
    [[nodiscard]] std::vector<std::uint32_t> missing() const;

    // All of the following need a part.

    [[nodiscard]] const std::string &identity() const { return identity_; }
    [[nodiscard]] const Part &firstPart() const { return subject_->part; }
    [[nodiscard]] const PartOrigin &origin() const { return origin_; } ///< of the first part
    [[nodiscard]] const Partition &partition() const { return *partition_; }
    [[nodiscard]] std::uint32_t samplesPerPixel() const { return subject_->samplesPerPixel; }
    [[nodiscard]] double noise() const { return subject_->noise; } ///< that is wanted; 0: none
    [[nodiscard]] NoiseTarget noiseTarget() const;                 ///< of a picture with such a noise
    [[nodiscard]] const Film &film() const { return *film_; }      ///< black where parts are missing
    [[nodiscard]] const std::vector<ViewFilm> &layers() const { return layers_; }
    [[nodiscard]] const RayCounts &rays() const { return rays_; }
    [[nodiscard]] std::size_t partCount() const { return parts_.size(); } ///< that are there
    [[nodiscard]] bool has(std::uint32_t index) const { return parts_.contains(index); }
    /// "'a.part', made by node7 (llvmpipe, Mesa 22.3.6)".
    [[nodiscard]] std::string describe(std::uint32_t index) const;
    /// How many parts each maker made.
    [[nodiscard]] std::map<std::string, std::size_t> makers() const;

  private:
    struct Taken {
        std::string path;
        std::string maker;
    };

    void take(const CheckpointFile &file, const PartOrigin &origin);
    [[nodiscard]] bool isOfSamePartition(const CheckpointFile &file) const;
    void begin(const CheckpointFile &file, const PartOrigin &origin);
    [[nodiscard]] std::string foreignness(const CheckpointFile &file) const;
    void compare(const CheckpointFile &file, const Taken &second);

    Faults faults_;
    std::optional<CheckpointSubject> subject_; ///< of the first part
    std::string firstPath_;
    std::string identity_;
    PartOrigin origin_;
    std::optional<Partition> partition_;
    std::optional<Film> film_;
    std::vector<ViewFilm> layers_;
    RayCounts rays_;
    std::map<std::uint32_t, Taken> parts_;
};

} // namespace hyalite::core
