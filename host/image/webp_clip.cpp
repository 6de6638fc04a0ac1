#include "host/image/webp_clip.h"

#include "host/base/error.h"
#include "host/base/markup.h"

#include <fmt/format.h>
#include <webp/encode.h>

#include <cassert>
#include <cmath>
#include <string_view>
#include <vector>

namespace hyalite::core {

namespace {

static_assert(webpSideMax == WEBP_MAX_DIMENSION);

constexpr std::size_t headerBytes = 12; // "RIFF", the size of what follows, "WEBP"
/// Of all frames: sizes have 32 bits, and the attributes need some room.
constexpr std::uint64_t frameBytesMax = 0xffff'ffff - (std::uint64_t{16} << 20);

void appendLittleEndian(std::vector<std::byte> &bytes, std::uint64_t value, int byteCount) {
    for (int i = 0; i < byteCount; ++i)
        bytes.push_back(static_cast<std::byte>((value >> (8 * i)) & 0xffu));
}

void appendText(std::vector<std::byte> &bytes, std::string_view text) {
    for (const char letter : text)
        bytes.push_back(static_cast<std::byte>(letter));
}

/// A chunk of `head` and `data`, padded to an even size.
std::vector<std::byte> chunkOf(std::string_view type, std::span<const std::byte> head,
                               std::span<const std::byte> data = {}) {
    std::vector<std::byte> chunk;
    chunk.reserve(8 + head.size() + data.size() + 1);
    appendText(chunk, type);
    appendLittleEndian(chunk, head.size() + data.size(), 4);
    chunk.insert(chunk.end(), head.begin(), head.end());
    chunk.insert(chunk.end(), data.begin(), data.end());
    chunk.resize(chunk.size() + chunk.size() % 2);
    return chunk;
}

/// A still picture as a WebP without loss; exactly the levels, also where alpha is 0.
class StillWebp {
  public:
    /// `name` is for the message. Throws Error{LimitExceeded} where memory is short.
    StillWebp(const std::filesystem::path &name, int width, int height,
              std::span<const std::uint8_t> levels) {
        WebPMemoryWriterInit(&bytes_);
        constexpr int effort = 2; // of 9: 6 takes 1.3 to 4 times as long, for 2 to 10 % fewer bytes
        WebPConfig config;
        WebPPicture picture;
        const bool isReady = WebPConfigInit(&config) != 0 && WebPConfigLosslessPreset(&config, effort) != 0 &&
                             WebPPictureInit(&picture) != 0;
        assert(isReady); // else the headers are not those of the library
        static_cast<void>(isReady);
        config.exact = 1;
        config.thread_level = 1;
        picture.use_argb = 1;
        picture.width = width;
        picture.height = height;
        picture.writer = WebPMemoryWrite;
        picture.custom_ptr = &bytes_;
        const auto import =
            levels.size() == 3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height)
                ? WebPPictureImportRGB
                : WebPPictureImportRGBA;
        const auto rowBytes = static_cast<int>(levels.size() / static_cast<std::size_t>(height));
        const bool isPacked =
            import(&picture, levels.data(), rowBytes) != 0 && WebPEncode(&config, &picture) != 0;
        WebPPictureFree(&picture);
        if (isPacked)
            return;
        WebPMemoryWriterClear(&bytes_);
        throw Error(ErrorKind::LimitExceeded, fmt::format("'{}': no memory to pack a WebP of {} x {} pixels",
                                                          name.string(), width, height));
    }
    ~StillWebp() { WebPMemoryWriterClear(&bytes_); }
    StillWebp(const StillWebp &) = delete;
    StillWebp &operator=(const StillWebp &) = delete;

    /// The chunk of its pixels.
    [[nodiscard]] std::span<const std::byte> pixels() const {
        return std::as_bytes(std::span(bytes_.mem, bytes_.size)).subspan(headerBytes);
    }

  private:
    WebPMemoryWriter bytes_{};
};

/// The attributes as XMP (ISO 16684-1). Their names are those of XML, too.
std::string xmpOf(std::span<const Attribute> attributes) {
    std::string text = R"(<x:xmpmeta xmlns:x="adobe:ns:meta/">
<rdf:RDF xmlns:rdf="http://www.w3.org/1999/02/22-rdf-syntax-ns#">
<rdf:Description rdf:about="" xmlns:xmp="http://ns.adobe.com/xap/1.0/" xmlns:hyalite="urn:hyalite:">
)";
    for (const auto &[name, value] : attributes) {
        const std::string element = name == "software" ? "xmp:CreatorTool" : "hyalite:" + name;
        text += fmt::format("<{0}>{1}</{0}>\n", element, markupText(value));
    }
    return text + "</rdf:Description>\n</rdf:RDF>\n</x:xmpmeta>\n";
}

class WebpWriter : public ClipWriter {
  public:
    WebpWriter(AtomicFile &file, double framesPerSecond) : ClipWriter(file, framesPerSecond) {}

    void finish(std::span<const Attribute> attributes) override {
        const std::string xmp = xmpOf(attributes);
        write(chunkOf("XMP ", std::as_bytes(std::span(xmp))));
        std::vector<std::byte> size;
        appendLittleEndian(size, sizeBytes_ - 8, 4);
        file_.writeAt(4, size);
    }

  private:
    void begin(int width, int height, bool hasAlpha) override {
        constexpr unsigned isAnimated = 0x02, hasXmp = 0x04, isTransparent = 0x10;
        std::vector<std::byte> header;
        appendText(header, "RIFF");
        appendLittleEndian(header, 0, 4); // finish() writes it
        appendText(header, "WEBP");
        write(header);
        std::vector<std::byte> features;
        appendLittleEndian(features, isAnimated | hasXmp | (hasAlpha ? isTransparent : 0), 4);
        appendSize(features, width, height);
        write(chunkOf("VP8X", features));
        const std::vector<std::byte> forEver(6); // a background of no colour, and 0 rounds
        write(chunkOf("ANIM", forEver));
    }

    void append(int width, int height, std::span<const std::uint8_t> levels) override {
        constexpr unsigned replaces = 0x02; // what is there, alpha too
        const StillWebp still(file_.path(), width, height, levels);
        std::vector<std::byte> head;
        appendLittleEndian(head, 0, 6); // its place
        appendSize(head, width, height);
        appendLittleEndian(head, millisAt(frameCount() + 1) - millisAt(frameCount()), 3);
        appendLittleEndian(head, replaces, 1);
        const std::vector<std::byte> frame = chunkOf("ANMF", head, still.pixels());
        if (sizeBytes_ + frame.size() > frameBytesMax)
            throw Error(ErrorKind::LimitExceeded,
                        fmt::format("'{}': a WebP has less than 4 GiB; write an .apng, or fewer frames",
                                    file_.path().string()));
        write(frame);
    }

    static void appendSize(std::vector<std::byte> &bytes, int width, int height) {
        appendLittleEndian(bytes, static_cast<std::uint64_t>(width - 1), 3);
        appendLittleEndian(bytes, static_cast<std::uint64_t>(height - 1), 3);
    }

    /// Rounded in sum, so that no error grows.
    [[nodiscard]] std::uint64_t millisAt(std::size_t frame) const {
        return static_cast<std::uint64_t>(
            std::llround(1000.0 * static_cast<double>(frame) / framesPerSecond_));
    }

    void write(std::span<const std::byte> bytes) {
        sizeBytes_ += bytes.size();
        file_.write(bytes);
    }

    std::uint64_t sizeBytes_ = 0;
};

} // namespace

std::unique_ptr<ClipWriter> makeWebpWriter(AtomicFile &file, double framesPerSecond) {
    return std::make_unique<WebpWriter>(file, framesPerSecond);
}

} // namespace hyalite::core
