#include "host/film/checkpoint.h"

#include "host/base/atomic_file.h"
#include "host/base/clean_text.h"
#include "host/base/error.h"
#include "host/base/hash.h"
#include "host/base/input_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <string_view>
#include <system_error>

namespace hyalite {

namespace {

constexpr std::string_view magic = "hyalite checkpoint\n";
constexpr std::uint32_t currentVersion = 2;
constexpr std::uint32_t maxIdentityBytes = 1u << 16;

struct Header {
    std::uint32_t version;
    std::uint32_t identityBytes;
    std::int32_t x0, x1, y0, y1;
    std::array<std::uint64_t, rayKinds.size()> rays;
};
static_assert(sizeof(Header) == 64 && std::has_unique_object_representations_v<Header>);

/// The file is complete, but this render cannot continue from it.
class OtherRender : public Error {
  public:
    using Error::Error;
};

std::string identityText(const RenderIdentity &identity) {
    std::string text;
    for (const auto &[name, value] : identity)
        text += fmt::format("{}: {}\n", name, value);
    return text;
}

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

/// "seed 1 there, 2 here; sampler ..."
std::string describeDifferences(std::string_view there, const RenderIdentity &here) {
    std::string differences;
    for (const auto &[name, value] : here)
        if (const std::string other = valueOf(there, name); other != excerpt(value, shownBytes))
            differences += fmt::format("{}{}: {} there, {} here", differences.empty() ? "" : "; ", name,
                                       other, excerpt(value, shownBytes));
    return differences.empty() ? "it has settings that this program does not know" : differences;
}

class Reader {
  public:
    explicit Reader(const std::filesystem::path &path) : file_(path) {}

    [[nodiscard]] Checkpoint read(const RenderIdentity &identity, const Crop &crop,
                                  std::uint32_t samplesPerPixel) {
        const std::vector<std::byte> head = file_.head(magic.size() + sizeof(Header));
        if (head.size() < magic.size() || std::memcmp(head.data(), magic.data(), magic.size()) != 0)
            throw file_.bad(file_.sizeBytes() == 0 ? "it is empty" : "it is not a checkpoint of Hyalite");
        if (head.size() < magic.size() + sizeof(Header))
            throw file_.bad(fmt::format("it ends after {} bytes, within its header", head.size()));
        Header header{};
        std::memcpy(&header, head.data() + magic.size(), sizeof header);
        if (header.version != currentVersion)
            throw OtherRender(ErrorKind::BadInput,
                              fmt::format("cannot resume from '{}': its format has version {}, and this "
                                          "program reads version {}; finish it with the version that began "
                                          "it, or remove it",
                                          file_.path().string(), header.version, currentVersion));
        const std::uint64_t pixelCount = countPixels(header);
        std::string identityThere(header.identityBytes, '\0');
        offset_ = head.size();
        readPiece(std::as_writable_bytes(std::span(identityThere)));
        // Sizes are checked against that of the file, so memory is never more than the file has.
        Checkpoint checkpoint{Film({header.x0, header.x1, header.y0, header.y1}), {}};
        for (std::size_t i = 0; i < rayKinds.size(); ++i)
            checkpoint.rays.*rayKinds[i].count = header.rays[i];
        readPiece(std::as_writable_bytes(std::span(checkpoint.film.pixels)));
        std::uint64_t hash = hashBytes(head);
        hash = hashBytes(std::as_bytes(std::span(identityThere)), hash);
        hash = hashBytes(std::as_bytes(std::span(checkpoint.film.pixels)), hash);
        std::uint64_t expected = 0;
        readPiece(std::as_writable_bytes(std::span(&expected, 1)));
        if (hash != expected)
            throw file_.bad(
                fmt::format("it is damaged: the hash of its {} pixels and settings is {:016x}, and it "
                            "should be {:016x}",
                            pixelCount, hash, expected));

        if (identityThere != identityText(identity))
            throw other(describeDifferences(identityThere, identity));
        const Crop &found = checkpoint.film.crop;
        if (found.x0 != crop.x0 || found.x1 != crop.x1 || found.y0 != crop.y0 || found.y1 != crop.y1)
            throw other(fmt::format("crop: {},{},{},{} there, {},{},{},{} here", found.x0, found.x1, found.y0,
                                    found.y1, crop.x0, crop.x1, crop.y0, crop.y1));
        std::uint32_t maxSamples = 0;
        for (const layout::FilmPixel &pixel : checkpoint.film.pixels)
            maxSamples = std::max(maxSamples, pixel.sampleCount);
        if (maxSamples > samplesPerPixel)
            throw other(
                fmt::format("samples per pixel: up to {} there, {} here", maxSamples, samplesPerPixel));
        return checkpoint;
    }

  private:
    /// For the crop, if the size of the file matches it.
    [[nodiscard]] std::uint64_t countPixels(const Header &header) const {
        constexpr std::int32_t maxSide = 1 << 20;
        const std::int64_t width = std::int64_t{header.x1} - header.x0;
        const std::int64_t height = std::int64_t{header.y1} - header.y0;
        if (width < 1 || height < 1 || width > maxSide || height > maxSide)
            throw file_.bad(fmt::format("it is damaged: its image would have {} x {} pixels", width, height));
        if (header.identityBytes > maxIdentityBytes)
            throw file_.bad(
                fmt::format("it is damaged: its settings would take {} bytes, and at most {} are allowed",
                            header.identityBytes, maxIdentityBytes));
        const auto pixelCount = static_cast<std::uint64_t>(width * height);
        const std::uint64_t expectedBytes = magic.size() + sizeof(Header) + header.identityBytes +
                                            pixelCount * sizeof(layout::FilmPixel) + sizeof(std::uint64_t);
        if (file_.sizeBytes() != expectedBytes)
            throw file_.bad(fmt::format("it is damaged: {} x {} pixels make {} bytes, and it has {}", width,
                                        height, expectedBytes, file_.sizeBytes()));
        return pixelCount;
    }

    void readPiece(std::span<std::byte> piece) {
        file_.read(offset_, piece);
        offset_ += piece.size();
    }

    [[nodiscard]] OtherRender other(const std::string &difference) const {
        return OtherRender(ErrorKind::BadInput,
                           fmt::format("cannot resume from '{}': it belongs to another render: {}",
                                       file_.path().string(), difference),
                           Remedy::BeginAnew);
    }

    InputFile file_;
    std::uint64_t offset_ = 0;
};

} // namespace

std::filesystem::path olderCheckpoint(const std::filesystem::path &path) {
    // Beside the file itself where `path` is a link to it: only there one can take the other's place.
    return followLinks(path).string() + ".1";
}

CheckpointWriter::CheckpointWriter(const std::filesystem::path &path, RenderIdentity identity,
                                   bool isNewestWhole)
    : path_(followLinks(path)), identity_(std::move(identity)), isNewestWhole_(isNewestWhole) {
    const AtomicFile newer(path_);
    const AtomicFile older(olderCheckpoint(path_));
}

void CheckpointWriter::write(const Film &film, const RayCounts &rays) {
    const std::string identity = identityText(identity_);
    Header header{currentVersion,
                  static_cast<std::uint32_t>(identity.size()),
                  film.crop.x0,
                  film.crop.x1,
                  film.crop.y0,
                  film.crop.y1,
                  {}};
    for (std::size_t i = 0; i < rayKinds.size(); ++i)
        header.rays[i] = rays.*rayKinds[i].count;
    std::string head(magic);
    head.append(reinterpret_cast<const char *>(&header), sizeof header);
    std::uint64_t hash = hashBytes(std::as_bytes(std::span(head)));
    hash = hashBytes(std::as_bytes(std::span(identity)), hash);
    hash = hashBytes(std::as_bytes(std::span(film.pixels)), hash);

    AtomicFile file(path_);
    file.write(head);
    file.write(identity);
    file.write(std::as_bytes(std::span(film.pixels)));
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

Checkpoint readCheckpoint(const std::filesystem::path &path, const RenderIdentity &identity, const Crop &crop,
                          std::uint32_t samplesPerPixel) {
    return Reader(path).read(identity, crop, samplesPerPixel);
}

std::optional<ResumedCheckpoint> resumeCheckpoint(const std::filesystem::path &path,
                                                  const RenderIdentity &identity, const Crop &crop,
                                                  std::uint32_t samplesPerPixel) {
    const std::filesystem::path older = olderCheckpoint(path);
    std::error_code error; // of a path that leads nowhere: reading it says why
    const bool isOlderThere = std::filesystem::exists(older, error);
    std::string damage;
    if (std::filesystem::exists(path, error)) {
        try {
            return ResumedCheckpoint{readCheckpoint(path, identity, crop, samplesPerPixel), path, {}};
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
        return ResumedCheckpoint{readCheckpoint(older, identity, crop, samplesPerPixel), older, damage};
    } catch (const Error &oldest) {
        throw Error(ErrorKind::BadInput, fmt::format("{}; and {}", damage, oldest.what()), oldest.remedy);
    }
}

} // namespace hyalite
