#include "host/base/clean_text.h"
#include "host/image/exr.h"
#include "host/image/exr_picture.h"
#include "host/image/image_file.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfOpaqueAttribute.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfTileDescription.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <exception>
#include <map>
#include <new>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

namespace hyalite::core {

namespace {

constexpr std::array<unsigned char, 4> magicBytes{0x76, 0x2f, 0x31, 0x01};
constexpr std::size_t exrHeaderBytesMax = std::size_t{1} << 20;

std::uint32_t little32(std::span<const std::byte> bytes) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < 4; ++i)
        value |= static_cast<std::uint32_t>(bytes[i]) << (8 * i);
    return value;
}

/// The header of a file, or the headers of its parts, that are safe to pass to the library. For some attributes the
/// library allocates the size that they claim before it checks the data. Here they get a type that it does not know, so
/// that it keeps their bytes as they are.
///
///     76 2f 31 01   version and flags   (name \0 type \0 size value)...   \0     of several parts: one after the other,
///                                                                            and another \0
class SafeHeader {
  public:
    explicit SafeHeader(const InputFile &file) : file_(file), bytes_(file.head(exrHeaderBytesMax)) {
        requireKnownKind();
        constexpr std::size_t maxParts = 1000;
        std::size_t position = 8;
        do {
            if (parts_.size() == maxParts)
                throw file_.bad(fmt::format("it has more than {} parts", maxParts));
            parts_.push_back(position);
            while (byteAt(position) != std::byte{0})
                position = passAttribute(position);
            ++position;
        } while (hasParts_ && byteAt(position) != std::byte{0});
        bytes_.resize(position + (hasParts_ ? 1 : 0));
    }

    [[nodiscard]] std::span<const std::byte> bytes() const { return bytes_; }
    [[nodiscard]] bool hasParts() const { return hasParts_; }
    /// The type that a file gives an attribute, in its last part.
    [[nodiscard]] std::string typeOf(const std::string &attribute) const {
        const auto type = types_.find(attribute);
        return type != types_.end() ? type->second : "";
    }
    /// Where the header of each part begins; of a file without parts, of its only one.
    [[nodiscard]] std::span<const std::size_t> parts() const { return parts_; }

  private:
    [[nodiscard]] std::byte byteAt(std::size_t position) const {
        if (position >= bytes_.size())
            throw file_.bad(file_.sizeBytes() > exrHeaderBytesMax
                                ? fmt::format("its OpenEXR header is longer than {} bytes", exrHeaderBytesMax)
                                : "its OpenEXR header is cut short");
        return bytes_[position];
    }

    void requireKnownKind() {
        (void)byteAt(7);
        const std::uint32_t version = little32(std::span(bytes_).subspan(4));
        if ((version & 0xffu) != 2)
            throw file_.bad(fmt::format("it is OpenEXR of version {}; version 2 is read", version & 0xffu));
        constexpr std::uint32_t tiles = 0x200;
        constexpr std::uint32_t longNames = 0x400;
        constexpr std::uint32_t deepPixels = 0x800;
        constexpr std::uint32_t severalParts = 0x1000;
        if ((version & deepPixels) != 0)
            throw file_.bad("it is OpenEXR with deep pixels; store flat ones");
        if ((version & ~(0xffu | tiles | longNames | severalParts)) != 0)
            throw file_.bad(fmt::format("its OpenEXR version field is {:#x}, which is unknown", version));
        hasParts_ = (version & severalParts) != 0;
    }

    /// The text that begins at `begin`. Its terminating zero lies within the header.
    [[nodiscard]] std::string_view textAt(std::size_t begin) const {
        constexpr std::size_t lengthMax = 255;
        std::size_t end = begin;
        while (byteAt(end) != std::byte{0})
            if (++end - begin > lengthMax)
                throw file_.bad(
                    fmt::format("its OpenEXR header has a name of more than {} bytes", lengthMax));
        return {reinterpret_cast<const char *>(bytes_.data()) + begin, end - begin};
    }

    /// Whether the bytes are a channel list: names, each followed by 16 bytes, and an empty name at the end.
    [[nodiscard]] bool isChannelList(std::size_t begin, std::size_t size) const {
        std::size_t position = begin;
        while (position < begin + size && byteAt(position) != std::byte{0})
            position += textAt(position).size() + 1 + 16;
        return position + 1 == begin + size;
    }

    /// Checks one attribute and returns the offset of the next one.
    std::size_t passAttribute(std::size_t begin) {
        const std::string_view name = textAt(begin);
        const std::size_t typeBegin = begin + name.size() + 1;
        const std::size_t typeSize = textAt(typeBegin).size();
        types_[std::string(name)] = textAt(typeBegin);
        const std::size_t sizeBegin = typeBegin + typeSize + 1;
        (void)byteAt(sizeBegin + 3);
        const std::uint32_t size = little32(std::span(bytes_).subspan(sizeBegin));
        const std::size_t valueBegin = sizeBegin + 4;
        (void)byteAt(valueBegin + size);
        // For these types the library reads a fixed number of bytes, whatever the size says.
        constexpr std::array<std::pair<std::string_view, std::size_t>, 9> needed{{{"compression", 1},
                                                                                  {"dataWindow", 16},
                                                                                  {"displayWindow", 16},
                                                                                  {"lineOrder", 1},
                                                                                  {"pixelAspectRatio", 4},
                                                                                  {"screenWindowCenter", 8},
                                                                                  {"screenWindowWidth", 4},
                                                                                  {"tiles", 9},
                                                                                  {"chunkCount", 4}}};
        const bool isText = name == "name" || name == "type"; // of a part
        const auto sized =
            std::find_if(needed.begin(), needed.end(), [&](const auto &n) { return n.first == name; });
        const bool isRight = name == "channels"      ? isChannelList(valueBegin, size)
                             : sized != needed.end() ? sized->second == size
                                                     : true;
        if (!isRight)
            throw file_.bad(fmt::format("its OpenEXR attribute {} is damaged", name));
        if (name != "channels" && !isText && sized == needed.end())
            std::fill_n(bytes_.begin() + static_cast<std::ptrdiff_t>(typeBegin), typeSize, std::byte{'~'});
        return valueBegin + size;
    }

    const InputFile &file_;
    std::vector<std::byte> bytes_;
    std::vector<std::size_t> parts_;
    std::map<std::string, std::string> types_; ///< of attributes
    bool hasParts_ = false;
};

/// The input file with its header replaced by the safe one.
class ExrInput : public Imf::IStream {
  public:
    ExrInput(const InputFile &file, const SafeHeader &header)
        : Imf::IStream(file.path().c_str()), file_(file), header_(header.bytes()) {}

    bool read(char bytes[], int countBytes) override {
        const auto count = static_cast<std::uint64_t>(countBytes);
        if (countBytes < 0 || position_ > file_.sizeBytes() || count > file_.sizeBytes() - position_)
            throw file_.bad("it is cut short");
        const std::uint64_t fromHeader =
            position_ < header_.size() ? std::min(count, header_.size() - position_) : 0;
        if (fromHeader > 0)
            std::memcpy(bytes, header_.data() + position_, fromHeader);
        file_.read(position_ + fromHeader,
                   std::as_writable_bytes(std::span(bytes + fromHeader, count - fromHeader)));
        position_ += count;
        return position_ < file_.sizeBytes();
    }
    std::uint64_t tellg() override { return position_; }
    void seekg(std::uint64_t position) override { position_ = position; }

  private:
    const InputFile &file_;
    std::span<const std::byte> header_;
    std::uint64_t position_ = 0;
};

int linesPackedTogether(Imf::Compression compression) {
    switch (compression) {
    case Imf::ZIP_COMPRESSION:
    case Imf::PXR24_COMPRESSION:
        return 16;
    case Imf::PIZ_COMPRESSION:
    case Imf::B44_COMPRESSION:
    case Imf::B44A_COMPRESSION:
    case Imf::DWAA_COMPRESSION:
        return 32;
    case Imf::DWAB_COMPRESSION:
        return 256;
    default:
        return 1;
    }
}

/// The depth is the channel Z, as compositors know it; files of Hyalite up to 0.1 call it depth.
std::string otherNameOf(const std::string &layer) {
    return layer == "depth" ? "Z" : layer == "Z" ? "depth" : layer;
}

std::string prefixOf(const std::string &layer) { return layer.empty() ? "" : layer + "."; }

/// The names of the channels of a layer that are read as R, G and B, if it has them.
std::optional<std::array<std::string, 3>> findChannels(const Imf::ChannelList &channels,
                                                       const std::string &layer) {
    const std::string prefix = prefixOf(layer);
    const auto has = [&](const std::string &name) { return channels.findChannel(name) != nullptr; };
    for (const std::string_view letters : {"RGB", "XYZ"}) {
        const std::array<std::string, 3> names{prefix + letters[0], prefix + letters[1], prefix + letters[2]};
        if ((letters == "RGB" || !layer.empty()) && std::ranges::all_of(names, has))
            return names;
    }
    for (const std::string &name : {layer, prefix + "Y", otherNameOf(layer)})
        if (has(name) && !has(prefix + "RY"))
            return {{name, name, name}};
    return std::nullopt;
}

[[noreturn]] void refuseChannels(const InputFile &file, const Imf::ChannelList &channels,
                                 const std::string &layer) {
    const std::string prefix = prefixOf(layer);
    std::vector<std::string> names;
    constexpr std::size_t maxListed = 12;
    std::size_t count = 0;
    for (Imf::ChannelList::ConstIterator i = channels.begin(); i != channels.end(); ++i)
        if (++count <= maxListed)
            names.push_back(excerpt(i.name(), 40));
    throw file.bad(fmt::format("it has no channels {}R, {}G and {}B, but {}{}", prefix, prefix, prefix,
                               names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", ")),
                               count > maxListed ? fmt::format(" and {} more", count - maxListed) : ""));
}

/// Checks before memory is allocated. Throws if the file cannot be read.
void requireReadable(const InputFile &file, const Imf::Header &header, bool wantsAlpha) {
    const Imath::Box2i &window = header.dataWindow();
    const std::int64_t width = std::int64_t{window.max.x} - window.min.x + 1;
    const std::int64_t height = std::int64_t{window.max.y} - window.min.y + 1;
    requireImageSize(file, width, height);
    std::uint64_t bytesPerPixel = 0;
    for (Imf::ChannelList::ConstIterator i = header.channels().begin(); i != header.channels().end(); ++i) {
        if (i.channel().xSampling != 1 || i.channel().ySampling != 1)
            throw file.bad(
                fmt::format("its channel {} has fewer values than pixels (subsampled {} x {}); store a "
                            "value for each pixel",
                            excerpt(i.name(), 40), i.channel().xSampling, i.channel().ySampling));
        bytesPerPixel += i.channel().type == Imf::HALF ? 2 : 4;
    }
    // Decompressed lines and the buffers of the library: DWA needs the most, five copies.
    constexpr std::uint64_t copyCount = 8;
    const std::uint64_t pixelCount = static_cast<std::uint64_t>(width * height);
    std::uint64_t linesTogether = static_cast<std::uint64_t>(linesPackedTogether(header.compression()));
    std::uint64_t widthTogether = static_cast<std::uint64_t>(width);
    if (header.hasTileDescription()) {
        const Imf::TileDescription &tiles = header.tileDescription();
        if (tiles.xSize == 0 || tiles.ySize == 0)
            throw file.bad("its tiles have no pixels");
        // The library keeps an offset for each tile, of each reduced image too, before it looks for one.
        constexpr std::uint64_t levelCopies = 4;
        const std::uint64_t tileCount =
            levelCopies * ((static_cast<std::uint64_t>(width) + tiles.xSize - 1) / tiles.xSize) *
            ((static_cast<std::uint64_t>(height) + tiles.ySize - 1) / tiles.ySize);
        if (tileCount > file.sizeBytes())
            throw file.bad(fmt::format("it is too short for its tiles of {} x {} pixels: it is damaged",
                                       tiles.xSize, tiles.ySize));
        linesTogether = tiles.ySize;
        widthTogether = std::max<std::uint64_t>(widthTogether, tiles.xSize);
    }
    constexpr std::uint64_t farTooMuch = std::uint64_t{1} << 40; // so that products fit
    if (linesTogether * widthTogether > farTooMuch)
        throw file.bad("its tiles are larger than any image");
    const std::uint64_t pixelBytes = sizeof(glm::vec3) + (wantsAlpha ? sizeof(float) : 0);
    const std::uint64_t packedBytes = widthTogether * bytesPerPixel * linesTogether;
    const std::uint64_t neededBytes = pixelCount * pixelBytes + copyCount * packedBytes;
    requireReadingMemory(file, static_cast<std::uint64_t>(width), static_cast<std::uint64_t>(height),
                         neededBytes);
}

/// The header of each part, checked.
std::vector<Imf::Header> readHeaders(const InputFile &file, const SafeHeader &safeHeader, ExrInput &input,
                                     bool wantsAlpha = false) {
    std::vector<Imf::Header> headers;
    for (const std::size_t begin : safeHeader.parts()) {
        int version = 2;
        input.seekg(begin);
        headers.emplace_back().readFrom(input, version);
        if (headers.back().hasType() && !Imf::isImage(headers.back().type()))
            throw file.bad("it is OpenEXR with deep pixels; store flat ones");
        requireReadable(file, headers.back(),
                        wantsAlpha && headers.back().channels().findChannel("A") != nullptr);
    }
    return headers;
}

/// A layer of a part.
struct FoundLayer {
    std::size_t part;
    std::array<std::string, 3> channels;
    std::string alpha{}; ///< empty: it has none
};

/// The alpha channel of a layer, or an empty name.
std::string alphaOf(const Imf::ChannelList &channels, const std::string &layer) {
    const std::string name = prefixOf(layer) + "A";
    return channels.findChannel(name) != nullptr ? name : "";
}

/// A layer is a group of channels, or a part of its name with R, G and B.
std::optional<FoundLayer> findLayer(const std::vector<Imf::Header> &headers, const std::string &layer) {
    for (std::size_t part = 0; part < headers.size(); ++part)
        if (const auto channels = findChannels(headers[part].channels(), layer))
            return FoundLayer{part, *channels, alphaOf(headers[part].channels(), layer)};
    for (std::size_t part = 0; part < headers.size(); ++part)
        if (headers[part].hasName() && headers[part].name() == layer)
            if (const auto channels = findChannels(headers[part].channels(), ""))
                return FoundLayer{part, *channels, alphaOf(headers[part].channels(), "")};
    return std::nullopt;
}

/// Reads the layer's channels, and alpha only if it is wanted. Reader is Imf::InputFile or Imf::InputPart, both of which
/// read tiles as lines.
template <class Reader>
AlphaImage readPixels(const InputFile &file, Reader &reader, const Imf::Header &header,
                      const FoundLayer &layer, bool wantsAlpha) {
    if (!reader.isComplete())
        throw file.bad("some of its rows are missing");
    const Imath::Box2i &window = header.dataWindow();
    AlphaImage read{Image(window.max.x - window.min.x + 1, window.max.y - window.min.y + 1), {}};
    Image &image = read.image;
    Imf::FrameBuffer frameBuffer;
    const auto width = static_cast<std::size_t>(image.width());
    const bool isGrey = layer.channels[0] == layer.channels[1];
    for (std::size_t channel = 0; channel < (isGrey ? 1u : 3u); ++channel)
        frameBuffer.insert(layer.channels[channel],
                           Imf::Slice::Make(Imf::FLOAT, &image.pixels().front().x + channel, window,
                                            sizeof(glm::vec3), sizeof(glm::vec3) * width));
    if (wantsAlpha && !layer.alpha.empty()) {
        read.alpha.resize(image.pixels().size());
        frameBuffer.insert(layer.alpha, Imf::Slice::Make(Imf::FLOAT, read.alpha.data(), window, sizeof(float),
                                                         sizeof(float) * width));
    }
    reader.setFrameBuffer(frameBuffer);
    reader.readPixels(window.min.y, window.max.y);
    if (isGrey)
        for (glm::vec3 &pixel : image.pixels())
            pixel = glm::vec3(pixel.x);
    return read;
}

/// The picture of the display window, from that of the data window.
Image displayed(const InputFile &file, const Imf::Header &header, Image &&stored) {
    const Imath::Box2i &data = header.dataWindow();
    const Imath::Box2i &display = header.displayWindow();
    if (data == display)
        return std::move(stored);
    const std::int64_t width = std::int64_t{display.max.x} - display.min.x + 1;
    const std::int64_t height = std::int64_t{display.max.y} - display.min.y + 1;
    requireImageSize(file, width, height);
    requireReadingMemory(file, static_cast<std::uint64_t>(width), static_cast<std::uint64_t>(height),
                         static_cast<std::uint64_t>(width * height) * sizeof(glm::vec3) +
                             stored.pixels().size() * sizeof(glm::vec3));
    Image image(static_cast<int>(width), static_cast<int>(height));
    for (int y = std::max(data.min.y, display.min.y); y <= std::min(data.max.y, display.max.y); ++y)
        for (int x = std::max(data.min.x, display.min.x); x <= std::min(data.max.x, display.max.x); ++x)
            image.at(x - display.min.x, y - display.min.y) = stored.at(x - data.min.x, y - data.min.y);
    return image;
}

/// The result of read(input, its safe header, the checked headers of its parts, the layer).
template <class Read>
auto withLayer(const InputFile &file, const std::string &layer, bool wantsAlpha, const Read &read) {
    const SafeHeader safeHeader(file);
    ExrInput input(file, safeHeader);
    const std::vector<Imf::Header> headers = readHeaders(file, safeHeader, input, wantsAlpha);
    const std::optional<FoundLayer> found = findLayer(headers, layer);
    if (!found)
        refuseChannels(file, headers.front().channels(), layer);
    input.seekg(0);
    if (!safeHeader.hasParts()) {
        Imf::InputFile reader(input, 0);
        return read(reader, headers.front(), *found);
    }
    Imf::MultiPartInputFile parts(input, 0);
    Imf::InputPart reader(parts, static_cast<int>(found->part));
    return read(reader, headers[found->part], *found);
}

Image readLayer(const InputFile &file, const std::string &layer, ExrWindow window) {
    return withLayer(
        file, layer, false, [&](auto &reader, const Imf::Header &header, const FoundLayer &found) {
            Image stored = readPixels(file, reader, header, found, false).image;
            return window == ExrWindow::Data ? stored : displayed(file, header, std::move(stored));
        });
}

std::vector<std::uint32_t> readWhole(const InputFile &file, const std::string &layer) {
    return withLayer(
        file, layer, false, [&](auto &reader, const Imf::Header &header, const FoundLayer &found) {
            const std::string &channel = found.channels[0];
            if (channel != found.channels[1] || header.channels()[channel].type != Imf::UINT)
                throw file.bad(fmt::format("its layer {} is not one whole number (UINT) a pixel", layer));
            if (!reader.isComplete())
                throw file.bad("some of its rows are missing");
            const Imath::Box2i &window = header.dataWindow();
            const auto width = static_cast<std::size_t>(window.max.x - window.min.x + 1);
            std::vector<std::uint32_t> values(width *
                                              static_cast<std::size_t>(window.max.y - window.min.y + 1));
            Imf::FrameBuffer frameBuffer;
            frameBuffer.insert(channel, Imf::Slice::Make(Imf::UINT, values.data(), window, sizeof(values[0]),
                                                         sizeof(values[0]) * width));
            reader.setFrameBuffer(frameBuffer);
            reader.readPixels(window.min.y, window.max.y);
            return values;
        });
}

/// The texts, and the matrices of the projection, if both are there.
void readAttributes(const Imf::Header &header, const SafeHeader &safeHeader, ExrPicture &picture) {
    std::optional<std::array<double, 16>> worldToCamera;
    std::optional<std::array<double, 16>> worldToNdc;
    const auto matrixOf = [](std::span<const char> bytes) {
        std::array<double, 16> matrix{};
        for (std::size_t i = 0; i < matrix.size(); ++i)
            matrix[i] = std::bit_cast<float>(little32(std::as_bytes(bytes.subspan(4 * i, 4))));
        return matrix;
    };
    for (Imf::Header::ConstIterator i = header.begin(); i != header.end(); ++i) {
        // Those that are not opaque are the library's own.
        const auto *opaque = dynamic_cast<const Imf::OpaqueAttribute *>(&i.attribute());
        if (opaque == nullptr)
            continue;
        const std::string name = i.name();
        const std::span bytes(static_cast<const char *>(opaque->data()),
                              static_cast<std::size_t>(opaque->dataSize()));
        const std::string type = safeHeader.typeOf(name);
        if (type == "string")
            picture.attributes.emplace_back(name, std::string(bytes.begin(), bytes.end()));
        else if (type == "m44f" && bytes.size() == 16 * sizeof(float) && name == "worldToCamera")
            worldToCamera = matrixOf(bytes);
        else if (type == "m44f" && bytes.size() == 16 * sizeof(float) && name == "worldToNDC")
            worldToNdc = matrixOf(bytes);
    }
    if (worldToCamera && worldToNdc)
        picture.projection =
            Projection{*worldToCamera, *worldToNdc, static_cast<double>(header.screenWindowWidth())};
}

ExrCompression compressionOf(Imf::Compression compression) {
    // As the library numbers them.
    constexpr std::array known{ExrCompression::None, ExrCompression::Rle,  ExrCompression::Zips,
                               ExrCompression::Zip,  ExrCompression::Piz,  ExrCompression::Pxr24,
                               ExrCompression::B44,  ExrCompression::B44a, ExrCompression::Dwaa,
                               ExrCompression::Dwab};
    static_assert(Imf::NO_COMPRESSION == 0 && Imf::PIZ_COMPRESSION == 4 && Imf::DWAB_COMPRESSION == 9);
    const auto index = static_cast<std::size_t>(compression);
    return index < known.size() ? known[index] : ExrCompression::Zip;
}

template <class Reader> void readChannels(const InputFile &file, Reader &reader, ExrPicture &picture) {
    const Imf::Header &header = reader.header();
    const Imath::Box2i &window = header.dataWindow();
    const auto width = static_cast<std::size_t>(picture.crop.width());
    const std::size_t size = picture.crop.pixelCount();
    if (!reader.isComplete())
        throw file.bad("some of its rows are missing");
    std::uint64_t channelCount = 0;
    for (Imf::ChannelList::ConstIterator i = header.channels().begin(); i != header.channels().end(); ++i)
        ++channelCount;
    requireReadingMemory(file, width, static_cast<std::uint64_t>(picture.crop.height()),
                         channelCount * size * sizeof(float));
    Imf::FrameBuffer frameBuffer;
    for (Imf::ChannelList::ConstIterator i = header.channels().begin(); i != header.channels().end(); ++i) {
        ExrChannel &channel = picture.channels.emplace_back();
        channel.name = i.name();
        channel.isHalf = i.channel().type == Imf::HALF;
        const auto insert = [&](Imf::PixelType type, auto &values) {
            values.resize(size);
            frameBuffer.insert(channel.name, Imf::Slice::Make(type, values.data(), window, sizeof(values[0]),
                                                              sizeof(values[0]) * width));
        };
        if (i.channel().type == Imf::UINT)
            insert(Imf::UINT, channel.wholeValues);
        else
            insert(Imf::FLOAT, channel.values);
    }
    reader.setFrameBuffer(frameBuffer);
    reader.readPixels(window.min.y, window.max.y);
}

} // namespace

bool isExr(std::span<const std::byte> head) {
    return head.size() >= magicBytes.size() &&
           std::equal(magicBytes.begin(), magicBytes.end(), head.begin(),
                      [](unsigned char a, std::byte b) { return std::byte{a} == b; });
}

namespace {

/// The result of read(). Exceptions of the library become an Error about the file.
template <class Read> auto asked(const InputFile &file, const Read &read) {
    try {
        return read();
    } catch (const Error &) {
        throw;
    } catch (const std::bad_alloc &) {
        throw;
    } catch (const std::exception &error) {
        throw file.bad(fmt::format("OpenEXR says: {}", excerpt(error.what(), 200)));
    }
}

} // namespace

Image readExr(const InputFile &file, const std::string &layer, ExrWindow window) {
    return asked(file, [&] { return readLayer(file, layer, window); });
}

AlphaImage readExrWithAlpha(const InputFile &file) {
    return asked(file, [&] {
        return withLayer(file, "", true,
                         [&](auto &reader, const Imf::Header &header, const FoundLayer &found) {
                             return readPixels(file, reader, header, found, true);
                         });
    });
}

bool isGreyExrLayer(const InputFile &file, const std::string &layer) {
    return asked(file, [&] {
        return withLayer(file, layer, false, [](auto &, const Imf::Header &, const FoundLayer &found) {
            return found.channels[0] == found.channels[1];
        });
    });
}

std::vector<std::uint32_t> readExrWhole(const InputFile &file, const std::string &layer) {
    return asked(file, [&] { return readWhole(file, layer); });
}

std::vector<Attribute> readExrAttributes(const InputFile &file) {
    return asked(file, [&] {
        const SafeHeader safeHeader(file);
        ExrInput input(file, safeHeader);
        ExrPicture picture;
        readAttributes(readHeaders(file, safeHeader, input).front(), safeHeader, picture);
        return picture.attributes;
    });
}

ExrPicture readExrPicture(const InputFile &file) {
    return asked(file, [&] {
        const SafeHeader safeHeader(file);
        if (safeHeader.hasParts())
            throw file.bad("it has several parts; allowed: one");
        ExrInput input(file, safeHeader);
        const Imf::Header header = readHeaders(file, safeHeader, input).front();
        const Imath::Box2i &data = header.dataWindow();
        const Imath::Box2i &display = header.displayWindow();
        if (data.min.x < display.min.x || data.min.y < display.min.y || data.max.x > display.max.x ||
            data.max.y > display.max.y)
            throw file.bad("its data window leaves its display window");
        requireImageSize(file, std::int64_t{display.max.x} - display.min.x + 1,
                         std::int64_t{display.max.y} - display.min.y + 1);
        ExrPicture picture;
        picture.wholeWidth = display.max.x - display.min.x + 1;
        picture.wholeHeight = display.max.y - display.min.y + 1;
        picture.crop = {data.min.x - display.min.x, data.max.x - display.min.x + 1,
                        data.min.y - display.min.y, data.max.y - display.min.y + 1};
        readAttributes(header, safeHeader, picture);
        input.seekg(0);
        Imf::InputFile reader(input, 0);
        readChannels(file, reader, picture);
        const ExrChannel *red = picture.find("R");
        picture.options = {red != nullptr && red->isHalf, compressionOf(header.compression())};
        return picture;
    });
}

std::vector<Layer> layersOf(const ExrPicture &picture) {
    std::vector<Layer> layers;
    const auto width = static_cast<std::size_t>(picture.crop.width());
    const auto copyRow = [width](const auto &values, int y, auto row) {
        std::ranges::copy(std::span(values).subspan(static_cast<std::size_t>(y) * width, width), row.begin());
    };
    for (const ExrChannel &channel : picture.channels) {
        if (channel.name == "R" || channel.name == "G" || channel.name == "B" || channel.name == "A")
            continue;
        Layer layer{channel.name, "", {}};
        layer.isLight = channel.isHalf;
        if (channel.wholeValues.empty())
            layer.fillRow = [&channel, copyRow](int y, std::span<float> row) {
                copyRow(channel.values, y, row);
            };
        else
            layer.fillWholeRow = [&channel, copyRow](int y, std::span<std::uint32_t> row) {
                copyRow(channel.wholeValues, y, row);
            };
        layers.push_back(std::move(layer));
    }
    return layers;
}

bool hasExrLayer(const InputFile &file, const std::string &layer) {
    return asked(file, [&] {
        const SafeHeader safeHeader(file);
        ExrInput input(file, safeHeader);
        return findLayer(readHeaders(file, safeHeader, input), layer).has_value();
    });
}

} // namespace hyalite::core
