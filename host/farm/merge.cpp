#include "host/farm/merge.h"

#include "host/base/clean_text.h"
#include "host/base/error.h"
#include "host/base/quantities.h"
#include "host/engine/backend.h"
#include "host/film/first_samples.h"
#include "host/film/noise.h"
#include "host/film/tally.h"
#include "host/scene/names.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

namespace hyalite::core {

namespace {

constexpr std::size_t shownBytes = 300;

struct Place {
    Crop square;
    int x;
    int y;
};

/// Where pixel `index` of the squares is in the picture.
Place placeOf(std::span<const Crop> squares, std::size_t index) {
    for (const Crop &square : squares) {
        const auto width = static_cast<std::size_t>(square.width());
        if (index < square.pixelCount())
            return {square, square.x0 + static_cast<int>(index % width),
                    square.y0 + static_cast<int>(index / width)};
        index -= square.pixelCount();
    }
    return {};
}

NoiseTarget targetOf(double noise, std::uint32_t samplesPerPixel, const PartOrigin &origin) {
    RenderSettings settings;
    settings.samplesPerPixel = static_cast<int>(samplesPerPixel);
    settings.noise = noise;
    settings.exposureStops = origin.exposureStops;
    return noiseTargetOf(settings);
}

/// Pixels of an adaptive part in blocks that lack samples of the picture.
std::size_t pixelsInUnfinishedBlocks(const CheckpointFile &file, const PartOrigin &origin,
                                     std::span<const Crop> squares) {
    const PictureNoise noise =
        noiseOf(file.film, blocksInRecords(squares), targetOf(file.noise, file.samplesPerPixel, origin));
    return file.film.pixels.size() - noise.finishedPixels;
}

/// Pixels of the part that lack samples of the picture, unless it is adaptive, or of a layer.
std::size_t unfinishedPixels(const CheckpointFile &file, const PartOrigin &origin) {
    const auto samplesOfLayer = [&](std::size_t layer) {
        return static_cast<std::uint32_t>(samplesOfView(
            origin.layers[layer].view, samplesForViews(static_cast<int>(file.samplesPerPixel), file.noise),
            origin.areLayersThrough, origin.layers[layer].isOfDenoiser));
    };
    std::size_t count = 0;
    for (std::size_t i = 0; i < file.film.pixels.size(); ++i) {
        bool isFinished = file.noise > 0.0 ||
                          (file.film.pixels[i].sampleCount == file.samplesPerPixel &&
                           (file.film.first.empty() || isComplete(file.film.first[i], file.samplesPerPixel)));
        for (std::size_t layer = 0; layer < file.layers.size(); ++layer)
            isFinished = isFinished && file.layers[layer].pixels[i].sampleCount == samplesOfLayer(layer);
        count += !isFinished;
    }
    return count;
}

/// Whether all numbers of a tally have names.
bool haveNames(std::span<const layout::FilmPixel> tallies, std::size_t nameCount) {
    return std::ranges::all_of(tallies, [&](const layout::FilmPixel &pixel) {
        return std::ranges::all_of(tallyOf(pixel).numbers,
                                   [&](const NumberCount &entry) { return entry.number <= nameCount; });
    });
}

} // namespace

void Merger::add(const std::filesystem::path &path) {
    try {
        const CheckpointFile file = readCheckpointFile(path, partition_ ? &*partition_ : nullptr);
        PartOrigin origin;
        try {
            origin = readPartOrigin(file.origin);
            if (origin.layers.size() != file.layers.size())
                throw Error(ErrorKind::BadInput, fmt::format("it has {} layers and says that they are {}",
                                                             file.layers.size(), origin.layers.size()));
            for (std::size_t i = 0; i < file.layers.size(); ++i)
                if (rowOf(origin.layers[i].view).tallies() &&
                    !haveNames(file.layers[i].pixels, origin.layers[i].names.size()))
                    throw Error(ErrorKind::BadInput, fmt::format("its layer {} has a number without a name",
                                                                 nameOf(origin.layers[i].view)));
            if (origin.lightPlanes.size() != file.lightPlaneCount)
                throw Error(ErrorKind::BadInput,
                            fmt::format("it has {} layers of light and says that they are {}",
                                        file.lightPlaneCount, origin.lightPlanes.size()));
            if (origin.wholeWidth < file.crop.x1 || origin.wholeHeight < file.crop.y1)
                throw Error(ErrorKind::BadInput, "its crop is larger than its picture");
        } catch (const Error &error) {
            throw Error(error.kind,
                        fmt::format("cannot use part '{}': {}", path.string(),
                                    excerpt(error.what(), shownBytes))); // as of the file's own words
        }
        take(file, origin);
    } catch (const Error &error) {
        if (error.kind == ErrorKind::LimitExceeded)
            faults_.unusable.push_back(fmt::format("'{}': {}", path.string(), error.what()));
        else
            faults_.unusable.emplace_back(error.what());
    }
}

void Merger::take(const CheckpointFile &file, const PartOrigin &origin) {
    const std::string path = file.path.string();
    std::size_t unfinished = unfinishedPixels(file, origin);
    if (file.noise > 0.0) {
        std::optional<Partition> own;
        const Partition &partition =
            partition_ && isOfSamePartition(file)
                ? *partition_
                : own.emplace(file.crop, file.part.count, smallestSquare(file.noise));
        unfinished = std::max(unfinished,
                              pixelsInUnfinishedBlocks(file, origin, partition.squaresOf(file.part.index)));
    }
    if (unfinished > 0) {
        faults_.unusable.push_back(fmt::format("'{}' is not finished: {} of its {} pixels lack samples", path,
                                               unfinished, file.film.pixels.size()));
        return;
    }
    if (!subject_)
        begin(file, origin);
    if (const std::string difference = foreignness(file); !difference.empty()) {
        faults_.foreign.push_back(
            fmt::format("'{}' belongs to another picture than '{}': {}", path, firstPath_, difference));
        return;
    }
    const Taken taken{path, origin.maker()};
    if (parts_.contains(file.part.index)) {
        compare(file, taken);
        return;
    }
    const std::span<const Crop> squares = partition_->squaresOf(file.part.index);
    setRecordsIn(*film_, squares, file.film);
    for (std::size_t i = 0; i < layers_.size(); ++i)
        setRecordsIn(layers_[i].film, squares, file.layers[i]);
    rays_ += file.rays;
    parts_.emplace(file.part.index, taken);
}

bool Merger::isOfSamePartition(const CheckpointFile &file) const {
    return file.crop == partition_->crop() && file.part.count == partition_->partCount() &&
           smallestSquare(file.noise) == partition_->smallestSide();
}

NoiseTarget Merger::noiseTarget() const {
    return targetOf(subject_->noise, subject_->samplesPerPixel, origin_);
}

void Merger::begin(const CheckpointFile &file, const PartOrigin &origin) {
    const std::uint64_t firstBytes = file.part.count * (file.film.first.size() * sizeof(FirstSamples) +
                                                        file.film.wanted.size() * sizeof(std::uint32_t));
    requireFilmMemory(file.crop, 2 + static_cast<unsigned>(file.layers.size()), 2 * file.lightPlaneCount,
                      2 * firstBytes);
    subject_ = CheckpointSubject{file.crop, file.part, file.samplesPerPixel, {}, file.noise};
    firstPath_ = file.path.string();
    identity_ = file.identity;
    origin_ = origin;
    partition_.emplace(file.crop, file.part.count, smallestSquare(file.noise));
    film_.emplace(file.crop);
    film_->keepLight(origin.lightPlanes);
    if (!file.film.first.empty())
        film_->first.resize(film_->pixels.size());
    if (!file.film.wanted.empty())
        film_->wanted.resize(film_->pixels.size());
    for (const PartLayer &layer : origin.layers)
        layers_.push_back({layer.view, Film(file.crop), layer.names, layer.isOfDenoiser});
}

std::string Merger::foreignness(const CheckpointFile &file) const {
    if (file.identity != identity_)
        return describeDifferences(identity_, file.identity);
    if (file.part.count != subject_->part.count)
        return fmt::format("parts: {} there, {} here", subject_->part.count, file.part.count);
    if (file.samplesPerPixel != subject_->samplesPerPixel)
        return fmt::format("spp: {} there, {} here", subject_->samplesPerPixel, file.samplesPerPixel);
    if (file.noise != subject_->noise)
        return fmt::format("noise: {} there, {} here", percentText(subject_->noise), percentText(file.noise));
    if (file.lightPlaneCount != film_->lightPlanes.size())
        return fmt::format("layers of light: {} there, {} here", film_->lightPlanes.size(),
                           file.lightPlaneCount);
    if (file.film.first.empty() != film_->first.empty() || file.film.wanted.empty() != film_->wanted.empty())
        return "one of them has no first samples or wanted counts";
    if (file.layers.size() != layers_.size())
        return fmt::format("layers: {} there, {} here", layers_.size(), file.layers.size());
    return file.crop == subject_->crop ? "" : "it has another crop";
}

void Merger::compare(const CheckpointFile &file, const Taken &second) {
    const std::span<const Crop> squares = partition_->squaresOf(file.part.index);
    const auto compareFilm = [&](const Film &film, const FilmRecords &records, std::string_view of) {
        const std::size_t index = firstDifference(recordsIn(film, squares), records);
        if (index == records.pixels.size())
            return;
        const Place place = placeOf(squares, index);
        faults_.differences.push_back(fmt::format(
            "part {} of {} differs{} in the tile at {},{}, first at the pixel {},{}: {} and '{}', made by {}",
            file.part.index, file.part.count, of, place.square.x0, place.square.y0, place.x, place.y,
            describe(file.part.index), second.path, second.maker));
    };
    compareFilm(*film_, file.film, "");
    for (std::size_t i = 0; i < layers_.size(); ++i)
        compareFilm(layers_[i].film, file.layers[i],
                    fmt::format(" in its layer {}", nameOf(layers_[i].view)));
}

std::vector<std::uint32_t> Merger::missing() const {
    std::vector<std::uint32_t> indices;
    for (std::uint32_t index = 1; subject_ && index <= subject_->part.count; ++index)
        if (!parts_.contains(index))
            indices.push_back(index);
    return indices;
}

std::string Merger::describe(std::uint32_t index) const {
    const Taken &taken = parts_.at(index);
    return fmt::format("'{}', made by {}", taken.path, taken.maker);
}

std::map<std::string, std::size_t> Merger::makers() const {
    std::map<std::string, std::size_t> counts;
    for (const auto &[index, taken] : parts_)
        ++counts[taken.maker];
    return counts;
}

} // namespace hyalite::core
