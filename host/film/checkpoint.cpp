#include "host/film/checkpoint.h"

#include "host/base/atomic_file.h"
#include "host/base/clean_text.h"
#include "host/base/error.h"
#include "host/base/hash.h"
#include "host/base/input_file.h"
#include "host/film/noise.h"
#include "host/scene/settings_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <string_view>
#include <system_error>

namespace hyalite::core {

namespace {

constexpr std::string_view magic = "hyalite checkpoint\n";
constexpr std::uint32_t maxIdentityBytes = 1u << 16;
constexpr std::uint32_t maxOriginBytes = 1u << 26; // it has the names of the scene, where layers need them
constexpr std::uint32_t maxLayers = 64;            // of light, likewise

struct Header {
    std::uint32_t version;
    std::uint32_t identityBytes;
    std::int32_t x0, x1, y0, y1;
    std::array<std::uint64_t, rayKinds.size()> rays;
    std::uint32_t partIndex, partCount;
    std::uint32_t samplesPerPixel;
    std::uint32_t layerCount;
    std::uint32_t originBytes;
    std::uint32_t lightPlanes;
    std::uint32_t keepsFirst;
    std::uint32_t keepsWanted;
    std::uint64_t noise; // its bits
};
static_assert(sizeof(Header) == 104 && std::has_unique_object_representations_v<Header>);

/// The file is complete, but this render cannot continue from it.
class OtherRender : public Error {
  public:
    using Error::Error;
};

constexpr std::size_t shownBytes = 120;

/// The value of a name in an identity's text, or "nothing".
std::string valueOf(std::string_view text, std::string_view name) {
    while (!text.empty()) {
        const std::string_view line = text.substr(0, text.find('\n'));
        if (line.size() > name.size() + 1 && line.starts_with(name) && line[name.size()] == ':')
            return excerpt(line.substr(name.size() + 2), shownBytes);
        text.remove_prefix(std::min(line.size() + 1, text.size()));
    }
    return "nothing";
}

class Reader {
  public:
    Reader(const std::filesystem::path &path, const Partition *known) : file_(path), known_(known) {}

    [[nodiscard]] CheckpointFile read() {
        const std::vector<std::byte> head = file_.head(magic.size() + sizeof(Header));
        if (head.size() < magic.size() || std::memcmp(head.data(), magic.data(), magic.size()) != 0)
            throw file_.bad(file_.sizeBytes() == 0 ? "it is empty" : "it is not a checkpoint of Hyalite");
        if (head.size() < magic.size() + sizeof(Header))
            throw file_.bad(fmt::format("it ends after {} bytes, within its header", head.size()));
        Header header{};
        std::memcpy(&header, head.data() + magic.size(), sizeof header);
        if (header.version != checkpointVersion)
            throw OtherRender(ErrorKind::BadInput,
                              fmt::format("cannot resume from '{}': its format has version {}, and this "
                                          "program reads version {}; finish it with the version that began "
                                          "it, or remove it",
                                          file_.path().string(), header.version, checkpointVersion));
        // Sizes are checked against that of the file, so memory is never more than the file has.
        const std::size_t pixelCount = countPixels(header);
        CheckpointFile contents;
        contents.path = file_.path();
        contents.crop = {header.x0, header.x1, header.y0, header.y1};
        contents.part = {header.partIndex, header.partCount};
        contents.samplesPerPixel = header.samplesPerPixel;
        contents.noise = std::bit_cast<double>(header.noise);
        for (std::size_t i = 0; i < rayKinds.size(); ++i)
            contents.rays.*rayKinds[i].count = header.rays[i];
        contents.identity.resize(header.identityBytes);
        contents.origin.resize(header.originBytes);
        contents.lightPlaneCount = header.lightPlanes;
        contents.film.pixels.resize(pixelCount);
        contents.film.light.resize(pixelCount * layout::lightWordsPerPlane * header.lightPlanes);
        contents.film.first.resize(pixelCount * header.keepsFirst);
        contents.film.wanted.resize(pixelCount * header.keepsWanted);
        contents.layers.resize(header.layerCount);
        for (FilmRecords &layer : contents.layers)
            layer.pixels.resize(pixelCount);
        offset_ = head.size();
        std::uint64_t hash = hashBytes(head);
        const auto readHashed = [&](std::span<std::byte> piece) {
            readPiece(piece);
            hash = hashBytes(piece, hash);
        };
        readHashed(std::as_writable_bytes(std::span(contents.identity)));
        readHashed(std::as_writable_bytes(std::span(contents.origin)));
        const auto readRecords = [&](FilmRecords &records) {
            readHashed(std::as_writable_bytes(std::span(records.pixels)));
            if (!records.light.empty())
                readHashed(std::as_writable_bytes(std::span(records.light)));
            if (!records.first.empty())
                readHashed(std::as_writable_bytes(std::span(records.first)));
            if (!records.wanted.empty())
                readHashed(std::as_writable_bytes(std::span(records.wanted)));
        };
        readRecords(contents.film);
        std::ranges::for_each(contents.layers, readRecords);
        std::uint64_t expected = 0;
        readPiece(std::as_writable_bytes(std::span(&expected, 1)));
        if (hash != expected)
            throw file_.bad(
                fmt::format("it is damaged: the hash of its {} pixels and settings is {:016x}, and it "
                            "should be {:016x}",
                            pixelCount, hash, expected));
        return contents;
    }

  private:
    /// Of the part, if the size of the file matches it.
    [[nodiscard]] std::size_t countPixels(const Header &header) const {
        constexpr std::int32_t maxSide = 1 << 20;
        const std::int64_t width = std::int64_t{header.x1} - header.x0;
        const std::int64_t height = std::int64_t{header.y1} - header.y0;
        if (header.x0 < 0 || header.y0 < 0 || width < 1 || height < 1 || header.x1 > maxSide ||
            header.y1 > maxSide)
            throw file_.bad(fmt::format("it is damaged: its image would have {} x {} pixels", width, height));
        for (const auto &[bytes, maxBytes] : {std::pair{header.identityBytes, maxIdentityBytes},
                                              std::pair{header.originBytes, maxOriginBytes}})
            if (bytes > maxBytes)
                throw file_.bad(fmt::format("it is damaged: its settings would take {} bytes, and at most {} "
                                            "are allowed",
                                            bytes, maxBytes));
        const Crop crop{header.x0, header.x1, header.y0, header.y1};
        const auto noise = std::bit_cast<double>(header.noise);
        if (!rangeOf(&RenderSettings::noise).contains(noise))
            throw file_.bad(fmt::format("it is damaged: its wanted noise would be {}", noise));
        const int smallest = smallestSquare(noise);
        if (header.partIndex < 1 || header.partIndex > header.partCount ||
            header.partCount > Partition::maxParts(crop, smallest) || header.layerCount > maxLayers ||
            header.lightPlanes > maxLayers || header.keepsFirst > 1 || header.keepsWanted > 1)
            throw file_.bad(
                fmt::format("it is damaged: it would be part {} of {}, with {} layers, {} of light, {} of "
                            "first samples and {} of wanted counts",
                            header.partIndex, header.partCount, header.layerCount, header.lightPlanes,
                            header.keepsFirst, header.keepsWanted));
        const std::uint64_t besidePixels =
            magic.size() + sizeof(Header) + header.identityBytes + header.originBytes + sizeof(std::uint64_t);
        const std::uint64_t bytesEach = sizeof(layout::FilmPixel) * (1 + header.layerCount) +
                                        sizeof(float) * layout::lightWordsPerPlane * header.lightPlanes +
                                        sizeof(FirstSamples) * header.keepsFirst +
                                        sizeof(std::uint32_t) * header.keepsWanted;
        const std::uint64_t inFile =
            file_.sizeBytes() < besidePixels ? 0 : (file_.sizeBytes() - besidePixels) / bytesEach;
        // Before the squares are counted, which takes memory: parts are alike, except for few squares.
        const bool isPlausible = static_cast<std::uint64_t>(width * height) / 2 / header.partCount <
                                 inFile + 2 * std::uint64_t{Partition::maxSide} * Partition::maxSide;
        const bool isKnown = known_ != nullptr && known_->crop() == crop &&
                             known_->partCount() == header.partCount && known_->smallestSide() == smallest;
        const std::uint64_t expected =
            isKnown       ? known_->pixelCountOf(header.partIndex)
            : isPlausible ? Partition(crop, header.partCount, smallest).pixelCountOf(header.partIndex)
                          : 0;
        if (inFile != expected || file_.sizeBytes() != besidePixels + inFile * bytesEach)
            throw file_.bad(
                fmt::format("it is damaged: part {} of {} of {} x {} pixels has another size than "
                            "its {} bytes",
                            header.partIndex, header.partCount, width, height, file_.sizeBytes()));
        return inFile;
    }

    void readPiece(std::span<std::byte> piece) {
        file_.read(offset_, piece);
        offset_ += piece.size();
    }

    InputFile file_;
    const Partition *known_;
    std::uint64_t offset_ = 0;
};

} // namespace

std::filesystem::path olderCheckpoint(const std::filesystem::path &path) {
    // Beside the file itself where `path` is a link to it: only there one can take the other's place.
    return followLinks(path).string() + ".1";
}

std::string identityText(const RenderIdentity &identity) {
    std::string text;
    for (const auto &[name, value] : identity)
        text += fmt::format("{}: {}\n", name, value);
    return text;
}

std::string describeDifferences(std::string_view there, std::string_view here) {
    std::string differences;
    constexpr int most = 64; // lines that are looked at: a made-up file may have thousands
    int count = 0;
    for (std::string_view rest = here; !rest.empty() && count < most; ++count) {
        const std::string_view line = rest.substr(0, rest.find('\n'));
        rest.remove_prefix(std::min(line.size() + 1, rest.size()));
        const std::string_view name = line.substr(0, line.find(':'));
        const std::string value = valueOf(here, name);
        if (const std::string other = valueOf(there, name); other != value)
            differences +=
                fmt::format("{}{}: {} there, {} here", differences.empty() ? "" : "; ", name, other, value);
    }
    return differences.empty() ? "it has settings that this program does not know" : differences;
}

void requireWritableCheckpoint(const std::filesystem::path &path) {
    const AtomicFile newer(followLinks(path));
    const AtomicFile older(olderCheckpoint(path));
}

void requireOwnCheckpoint(const std::filesystem::path &path) {
    for (const std::filesystem::path &file : {followLinks(path), olderCheckpoint(path)}) {
        if (!std::filesystem::exists(file))
            continue;
        const std::vector<std::byte> head = InputFile(file).head(magic.size()); // shorter if the file is
        if (std::memcmp(head.data(), magic.data(), head.size()) != 0)
            throw Error(
                ErrorKind::OutputNotWritten,
                fmt::format("cannot write '{}': it exists, and is not a checkpoint of Hyalite; remove "
                            "it, or name another file",
                            file.string()));
    }
}

CheckpointWriter::CheckpointWriter(const std::filesystem::path &path, const RenderIdentity &identity,
                                   CheckpointSubject subject, bool isNewestWhole)
    : path_(followLinks(path)), identity_(identityText(identity)), subject_(std::move(subject)),
      partition_(subject_.crop, subject_.part.count, smallestSquare(subject_.noise)),
      isNewestWhole_(isNewestWhole) {
    for (const auto &[bytes, maxBytes] :
         {std::pair{identity_.size(), maxIdentityBytes}, std::pair{subject_.origin.size(), maxOriginBytes}})
        if (bytes > maxBytes)
            throw Error(
                ErrorKind::LimitExceeded,
                fmt::format("cannot write '{}': what it says of the render takes {} bytes, and at most {} "
                            "are allowed: the command line is too long, or the scene has too many names",
                            path_.string(), bytes, maxBytes));
    requireWritableCheckpoint(path_);
}

void CheckpointWriter::write(const Film &film, const RayCounts &rays, std::span<const Film *const> layers) {
    const Crop &crop = subject_.crop;
    Header header{checkpointVersion,
                  static_cast<std::uint32_t>(identity_.size()),
                  crop.x0,
                  crop.x1,
                  crop.y0,
                  crop.y1,
                  {},
                  subject_.part.index,
                  subject_.part.count,
                  subject_.samplesPerPixel,
                  static_cast<std::uint32_t>(layers.size()),
                  static_cast<std::uint32_t>(subject_.origin.size()),
                  static_cast<std::uint32_t>(film.lightSize() / layout::lightWordsPerPlane),
                  film.first.empty() ? 0u : 1u,
                  film.wanted.empty() ? 0u : 1u,
                  std::bit_cast<std::uint64_t>(subject_.noise)};
    for (std::size_t i = 0; i < rayKinds.size(); ++i)
        header.rays[i] = rays.*rayKinds[i].count;
    std::string head(magic);
    head.append(reinterpret_cast<const char *>(&header), sizeof header);

    AtomicFile file(path_);
    std::uint64_t hash = 0;
    const auto writeHashed = [&](std::span<const std::byte> piece) {
        file.write(piece);
        hash = hashBytes(piece, hash);
    };
    writeHashed(std::as_bytes(std::span(head)));
    writeHashed(std::as_bytes(std::span(identity_)));
    writeHashed(std::as_bytes(std::span(subject_.origin)));
    const std::span<const Crop> squares = partition_.squaresOf(subject_.part.index);
    const auto writeFilm = [&](const Film &whole) {
        const auto writeRecords = [&](const FilmRecords &records) {
            writeHashed(std::as_bytes(std::span(records.pixels)));
            if (!records.light.empty())
                writeHashed(std::as_bytes(std::span(records.light)));
            if (!records.first.empty())
                writeHashed(std::as_bytes(std::span(records.first)));
            if (!records.wanted.empty())
                writeHashed(std::as_bytes(std::span(records.wanted)));
        };
        if (subject_.part.count == 1)
            writeRecords(whole);
        else
            writeRecords(recordsIn(whole, squares));
    };
    writeFilm(film);
    for (const Film *layer : layers)
        writeFilm(*layer);
    file.write(std::as_bytes(std::span(&hash, 1)));
    // Until the new one is in place, the older generation is the only one.
    std::error_code error;
    const std::filesystem::path older = olderCheckpoint(path_);
    if (isNewestWhole_)
        std::filesystem::rename(path_, older, error); // there may be none
    const bool isMoved = isNewestWhole_ && !error;
    try {
        file.commit();
    } catch (const Error &) {
        if (isMoved && !std::filesystem::exists(path_, error))
            std::filesystem::rename(older, path_, error);
        throw;
    }
    isNewestWhole_ = true;
}

CheckpointFile readCheckpointFile(const std::filesystem::path &path, const Partition *known) {
    return Reader(path, known).read();
}

Checkpoint readCheckpoint(const std::filesystem::path &path, const RenderIdentity &identity,
                          const CheckpointSubject &subject) {
    CheckpointFile file = readCheckpointFile(path);
    const auto other = [&](const std::string &difference) {
        return OtherRender(ErrorKind::BadInput,
                           fmt::format("cannot resume from '{}': it belongs to another render: {}",
                                       path.string(), difference),
                           Remedy::BeginAnew);
    };
    if (const std::string here = identityText(identity); file.identity != here)
        throw other(describeDifferences(file.identity, here));
    const auto textOf = [](const Crop &crop) {
        return fmt::format("{},{},{},{}", crop.x0, crop.x1, crop.y0, crop.y1);
    };
    if (file.crop != subject.crop)
        throw other(fmt::format("crop: {} there, {} here", textOf(file.crop), textOf(subject.crop)));
    if (file.part != subject.part)
        throw other(fmt::format("part: {}/{} there, {}/{} here", file.part.index, file.part.count,
                                subject.part.index, subject.part.count));
    std::uint32_t maxSamples = 0;
    for (const layout::FilmPixel &pixel : file.film.pixels)
        maxSamples = std::max(maxSamples, pixel.sampleCount);
    if (maxSamples > subject.samplesPerPixel)
        throw other(
            fmt::format("samples per pixel: up to {} there, {} here", maxSamples, subject.samplesPerPixel));
    Checkpoint checkpoint{Film(Crop{}), {}, file.rays, file.samplesPerPixel, file.noise};
    if (file.part.count == 1) {
        checkpoint.film.crop = file.crop;
        static_cast<FilmRecords &>(checkpoint.film) = std::move(file.film);
    } else {
        const Partition partition(file.crop, file.part.count, smallestSquare(file.noise));
        const std::span<const Crop> squares = partition.squaresOf(file.part.index);
        checkpoint.film = filmOfSquares(file.crop, squares, subject.samplesPerPixel);
        setRecordsIn(checkpoint.film, squares, file.film);
        for (const FilmRecords &layer : file.layers) {
            checkpoint.layers.push_back(filmOfSquares(file.crop, squares, subject.samplesPerPixel));
            setRecordsIn(checkpoint.layers.back(), squares, layer);
        }
    }
    return checkpoint;
}

std::optional<ResumedCheckpoint> resumeCheckpoint(const std::filesystem::path &path,
                                                  const RenderIdentity &identity,
                                                  const CheckpointSubject &subject) {
    const std::filesystem::path older = olderCheckpoint(path);
    std::error_code error; // of a path that leads nowhere: reading it says why
    const bool isOlderThere = std::filesystem::exists(older, error);
    std::string damage;
    if (std::filesystem::exists(path, error)) {
        try {
            return ResumedCheckpoint{readCheckpoint(path, identity, subject), path, {}};
        } catch (const OtherRender &) {
            throw;
        } catch (const Error &newest) {
            if (!isOlderThere)
                throw;
            damage = newest.what();
        }
    } else if (isOlderThere) {
        damage = fmt::format("'{}' is missing", path.string());
    } else {
        return std::nullopt;
    }
    try {
        return ResumedCheckpoint{readCheckpoint(older, identity, subject), older, damage};
    } catch (const Error &oldest) {
        throw Error(ErrorKind::BadInput, fmt::format("{}; and {}", damage, oldest.what()), oldest.remedy);
    }
}

} // namespace hyalite::core
