#include "host/image/apng.h"

#include "host/image/png.h"
#include "host/image/png_text.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>
#include <vector>

namespace hyalite::core {

namespace {

constexpr std::size_t dataBegin = pngHeaderEnd + 8; // of IDAT, the only chunk but for IHDR and IEND
constexpr std::size_t besideData = 4 + 12;          // its checksum, and IEND

/// The time of a frame, in seconds, as a fraction of 16-bit numbers.
std::pair<std::uint32_t, std::uint32_t> delayOf(double framesPerSecond) {
    const bool isFast = framesPerSecond >= 1.0;
    const double ratio = isFast ? framesPerSecond : 1.0 / framesPerSecond;
    std::uint32_t scale = 1000;
    while (ratio * scale > 65535.0)
        scale /= 10;
    const auto scaled = static_cast<std::uint32_t>(std::lround(ratio * scale));
    return isFast ? std::pair{scale, scaled} : std::pair{scaled, scale};
}

class ApngWriter : public ClipWriter {
  public:
    ApngWriter(AtomicFile &file, double framesPerSecond) : ClipWriter(file, framesPerSecond) {}

    void finish(std::span<const Attribute> attributes) override {
        std::vector<std::byte> end = textChunks(attributes);
        appendChunk(end, "IEND", {});
        file_.write(end);
        file_.writeAt(pngHeaderEnd, control());
    }

  private:
    void begin(int, int, bool) override {}

    void append(int width, int height, std::span<const std::uint8_t> levels) override {
        const std::vector<std::byte> png = encodePng(width, height, levels);
        const std::span<const std::byte> all = png;
        const std::span<const std::byte> data = all.subspan(dataBegin, all.size() - dataBegin - besideData);
        const bool isFirst = frameCount() == 0;
        if (isFirst) {
            file_.write(all.first(pngHeaderEnd));
            file_.write(control()); // a place for that of all frames
        }
        std::vector<std::byte> chunks;
        appendFrameControl(chunks, width, height);
        if (isFirst) {
            appendChunk(chunks, "IDAT", data);
        } else {
            std::vector<std::byte> numbered;
            appendBigEndian32(numbered, chunkCount_++);
            numbered.insert(numbered.end(), data.begin(), data.end());
            appendChunk(chunks, "fdAT", numbered);
        }
        file_.write(chunks);
    }

    /// The chunk of the animation: how many frames, and that it plays for ever.
    [[nodiscard]] std::vector<std::byte> control() const {
        std::vector<std::byte> data;
        appendBigEndian32(data, frameCount());
        appendBigEndian32(data, 0);
        std::vector<std::byte> chunk;
        appendChunk(chunk, "acTL", data);
        return chunk;
    }

    void appendFrameControl(std::vector<std::byte> &chunks, int width, int height) {
        const auto [numerator, denominator] = delayOf(framesPerSecond_);
        std::vector<std::byte> data;
        for (const std::uint64_t value : {std::uint64_t{chunkCount_++}, static_cast<std::uint64_t>(width),
                                          static_cast<std::uint64_t>(height), std::uint64_t{0},
                                          std::uint64_t{0}, std::uint64_t{numerator << 16 | denominator}})
            appendBigEndian32(data, value);
        data.resize(data.size() + 2); // the frame stays until the next one, which replaces it, alpha too
        appendChunk(chunks, "fcTL", data);
    }

    std::uint32_t chunkCount_ = 0; ///< of those that are numbered
};

} // namespace

std::unique_ptr<ClipWriter> makeApngWriter(AtomicFile &file, double framesPerSecond) {
    return std::make_unique<ApngWriter>(file, framesPerSecond);
}

} // namespace hyalite::core
