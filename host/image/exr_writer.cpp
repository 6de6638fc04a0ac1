#include "host/base/error.h"
#include "host/image/exr.h"
#include "host/image/image_file.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStdIO.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfThreading.h>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <half.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <exception>
#include <new>
#include <thread>
#include <variant>

namespace hyalite::core {

namespace {

/// Output of the library. The library finishes a file in a destructor, which swallows exceptions, so the first
/// exception is kept and thrown later.
class ExrOutput : public Imf::OStream {
  public:
    explicit ExrOutput(AtomicFile &file) : Imf::OStream(file.path().c_str()), file_(file) {}

    void write(const char bytes[], int countBytes) override {
        try {
            file_.writeAt(position_, std::as_bytes(std::span(bytes, static_cast<std::size_t>(countBytes))));
        } catch (...) {
            failure_ = failure_ ? failure_ : std::current_exception();
            throw;
        }
        position_ += static_cast<std::uint64_t>(countBytes);
    }
    std::uint64_t tellp() override { return position_; }
    void seekp(std::uint64_t position) override { position_ = position; }

    void requireSuccess() const {
        if (failure_)
            std::rethrow_exception(failure_);
    }

  private:
    AtomicFile &file_;
    std::uint64_t position_ = 0;
    std::exception_ptr failure_;
};

std::vector<std::string> channelNames(const Layer &layer) {
    if (layer.channels.empty())
        return {layer.name};
    std::vector<std::string> names;
    for (const char letter : layer.channels)
        names.push_back(layer.name.empty() ? std::string(1, letter)
                                           : fmt::format("{}.{}", layer.name, letter));
    return names;
}

constexpr float halfMax = 65504.0f;

Layer colourLayer(const Image &image) {
    return {"", "RGB",
            [&image](int y, std::span<float> row) {
                for (int x = 0; x < image.width(); ++x)
                    for (int channel = 0; channel < 3; ++channel)
                        row[static_cast<std::size_t>(3 * x + channel)] = image.at(x, y)[channel];
            },
            true};
}

Layer alphaLayer(std::span<const float> alpha) {
    return {"", "A",
            [alpha](int y, std::span<float> row) {
                std::ranges::copy(alpha.subspan(static_cast<std::size_t>(y) * row.size(), row.size()),
                                  row.begin());
            },
            true};
}

std::vector<Layer> layersOf(const Picture &picture) {
    std::vector<Layer> layers = picture.layers;
    layers.push_back(colourLayer(picture.colour));
    if (!picture.alpha.empty())
        layers.push_back(alphaLayer(picture.alpha));
    return layers;
}

Imf::PixelType typeOf(const Layer &layer, const ExrOptions &options) {
    if (layer.fillWholeRow)
        return Imf::UINT;
    return layer.isLight && options.isHalf ? Imf::HALF : Imf::FLOAT;
}

Imf::Compression compressionOf(ExrCompression compression) {
    switch (compression) {
    case ExrCompression::None:
        return Imf::NO_COMPRESSION;
    case ExrCompression::Rle:
        return Imf::RLE_COMPRESSION;
    case ExrCompression::Zips:
        return Imf::ZIPS_COMPRESSION;
    case ExrCompression::Zip:
        break;
    case ExrCompression::Piz:
        return Imf::PIZ_COMPRESSION;
    case ExrCompression::Pxr24:
        return Imf::PXR24_COMPRESSION;
    case ExrCompression::B44:
        return Imf::B44_COMPRESSION;
    case ExrCompression::B44a:
        return Imf::B44A_COMPRESSION;
    case ExrCompression::Dwaa:
        return Imf::DWAA_COMPRESSION;
    case ExrCompression::Dwab:
        return Imf::DWAB_COMPRESSION;
    }
    return Imf::ZIP_COMPRESSION;
}

/// Whether the compression changes a channel. PXR24 rounds 32-bit floats to 24 bits, B44 packs 16-bit ones; DWA
/// transforms what it takes for colours by the last part of their name (ImfDwaCompressor.cpp).
bool changes(ExrCompression compression, Imf::PixelType type, const std::string &channel) {
    switch (compression) {
    case ExrCompression::Pxr24:
        return type == Imf::FLOAT;
    case ExrCompression::B44:
    case ExrCompression::B44a:
        return type == Imf::HALF;
    case ExrCompression::Dwaa:
    case ExrCompression::Dwab: {
        const std::string suffix = channel.substr(channel.rfind('.') + 1); // npos + 1 is 0
        return type != Imf::UINT && (suffix == "R" || suffix == "G" || suffix == "B" || suffix == "Y");
    }
    default:
        return false;
    }
}

Imath::M44f matrixOf(const std::array<double, 16> &values) {
    Imath::M44f matrix;
    for (std::size_t i = 0; i < values.size(); ++i)
        matrix[static_cast<int>(i / 4)][i % 4] = static_cast<float>(values[i]) + 0.0f; // no -0
    return matrix;
}

Imf::Header headerOf(const Picture &picture, const std::vector<Layer> &layers, const ExrOptions &options) {
    const Crop &crop = picture.crop;
    Imf::Header header(Imath::Box2i({0, 0}, {picture.wholeWidth - 1, picture.wholeHeight - 1}),
                       Imath::Box2i({crop.x0, crop.y0}, {crop.x1 - 1, crop.y1 - 1}));
    header.compression() = compressionOf(options.compression);
    Imf::addChromaticities(header, Imf::Chromaticities()); // Rec. 709
    if (picture.projection) {
        Imf::addWorldToCamera(header, matrixOf(picture.projection->worldToCamera));
        Imf::addWorldToNDC(header, matrixOf(picture.projection->worldToNdc));
        header.screenWindowWidth() = static_cast<float>(picture.projection->screenWindowWidth);
    }
    for (const auto &[name, text] : picture.attributes)
        header.insert(name, Imf::StringAttribute(text));
    for (const Layer &layer : layers)
        for (const std::string &name : channelNames(layer))
            header.channels().insert(name, Imf::Channel(typeOf(layer, options)));
    return header;
}

void fillRow(const Layer &layer, int y, std::span<float> row) { layer.fillRow(y, row); }
void fillRow(const Layer &layer, int y, std::span<std::uint32_t> row) { layer.fillWholeRow(y, row); }
/// The nearest half; NaN stays what it is.
half halfOf(float value) { return {std::abs(value) > halfMax ? std::copysign(halfMax, value) : value}; }

void fillRow(const Layer &layer, int y, std::span<half> row) {
    std::vector<float> values(row.size());
    layer.fillRow(y, values);
    std::ranges::transform(values, row.begin(), halfOf);
}

/// Rows of one layer in the layout of the library.
class LayerRows {
  public:
    LayerRows(const Layer &layer, Imf::PixelType type, const Crop &crop, int rowCountMax)
        : layer_(layer), type_(type), crop_(crop), names_(channelNames(layer)),
          rowSize_(static_cast<std::size_t>(crop.width()) * names_.size()) {
        const std::size_t size = rowSize_ * static_cast<std::size_t>(rowCountMax);
        if (type == Imf::UINT)
            values_ = std::vector<std::uint32_t>(size);
        else if (type == Imf::HALF)
            values_ = std::vector<half>(size);
        else
            values_ = std::vector<float>(size);
    }

    /// Fills in `rowCount` rows of the crop from row `y` on.
    void fill(int y, int rowCount, Imf::FrameBuffer &frameBuffer) {
        std::visit(
            [&](auto &values) {
                for (int row = 0; row < rowCount; ++row)
                    fillRow(layer_, y + row,
                            std::span(values).subspan(static_cast<std::size_t>(row) * rowSize_, rowSize_));
                for (std::size_t i = 0; i < names_.size(); ++i)
                    frameBuffer.insert(names_[i],
                                       Imf::Slice::Make(type_, values.data() + i,
                                                        Imath::V2i(crop_.x0, crop_.y0 + y), crop_.width(),
                                                        rowCount, names_.size() * sizeof(values[0]),
                                                        rowSize_ * sizeof(values[0])));
            },
            values_);
    }

  private:
    const Layer &layer_;
    Imf::PixelType type_;
    Crop crop_;
    std::vector<std::string> names_;
    std::size_t rowSize_;
    std::variant<std::vector<float>, std::vector<half>, std::vector<std::uint32_t>> values_;
};

void writeRows(Imf::OStream &output, const Picture &picture, const ExrOptions &options) {
    const std::vector<Layer> layers = layersOf(picture);
    // Compression uses all processors, because it can take longer than the render.
    const int threadCount = std::clamp(static_cast<int>(std::thread::hardware_concurrency()), 1, 16);
    Imf::setGlobalThreadCount(threadCount);
    Imf::OutputFile file(output, headerOf(picture, layers, options), threadCount);
    constexpr int rowCountPacked = 16; // ZIP compresses 16 rows as a block
    const int rowCountMax = rowCountPacked * threadCount;
    std::vector<LayerRows> rows;
    rows.reserve(layers.size());
    for (const Layer &layer : layers)
        rows.emplace_back(layer, typeOf(layer, options), picture.crop, rowCountMax);
    for (int y = 0; y < picture.crop.height(); y += rowCountMax) {
        const int rowCount = std::min(rowCountMax, picture.crop.height() - y);
        Imf::FrameBuffer frameBuffer;
        for (LayerRows &layer : rows)
            layer.fill(y, rowCount, frameBuffer);
        file.setFrameBuffer(frameBuffer);
        file.writePixels(rowCount);
    }
}

/// Values of light beyond float16.
std::size_t countBeyondHalf(const Picture &picture) {
    std::size_t count = 0;
    for (const Layer &layer : layersOf(picture)) {
        if (!layer.isLight)
            continue;
        std::vector<float> row(static_cast<std::size_t>(picture.crop.width()) * channelNames(layer).size());
        for (int y = 0; y < picture.crop.height(); ++y) {
            layer.fillRow(y, row);
            count += static_cast<std::size_t>(
                std::ranges::count_if(row, [](float value) { return std::abs(value) > halfMax; }));
        }
    }
    return count;
}

std::vector<std::string> lossesOf(const Picture &picture, const ExrOptions &options) {
    std::vector<std::string> losses;
    if (options.isHalf)
        if (const std::size_t count = countBeyondHalf(picture); count > 0)
            losses.push_back(fmt::format("{} {} beyond {}, the largest 16-bit float, and {} stored as that",
                                         count, count == 1 ? "value is" : "values are", halfMax,
                                         count == 1 ? "is" : "are"));
    std::vector<std::string> changed;
    for (const Layer &layer : picture.layers)
        if (!layer.isLight && std::ranges::any_of(channelNames(layer), [&](const std::string &channel) {
                return changes(options.compression, typeOf(layer, options), channel);
            }))
            changed.push_back(layer.name);
    if (!changed.empty())
        losses.push_back(fmt::format("the compression {} is lossy: besides colours it changes {}",
                                     std::ranges::find(exrCompressionNames, options.compression,
                                                       [](const auto &row) { return row.second; })
                                         ->first,
                                     fmt::join(changed, ", ")));
    return losses;
}

/// The colours as they come back. Layers are written, too: a block of rows that gets no smaller is stored as it is, and
/// they decide whether it does.
AlphaImage readBack(const Picture &picture, const ExrOptions &options) {
    Imf::StdOSStream written;
    writeRows(written, picture, options);
    Imf::StdISStream stored;
    stored.str(written.str());
    Imf::InputFile file(stored);
    AlphaImage read{Image(picture.crop.width(), picture.crop.height()),
                    std::vector<float>(picture.alpha.size())};
    const Imath::Box2i &window = file.header().dataWindow();
    Imf::FrameBuffer frameBuffer;
    const char *const names[] = {"R", "G", "B"};
    for (std::size_t channel = 0; channel < 3; ++channel)
        frameBuffer.insert(names[channel],
                           Imf::Slice::Make(Imf::FLOAT, &read.image.pixels().front().x + channel, window,
                                            sizeof(glm::vec3)));
    if (!read.alpha.empty())
        frameBuffer.insert("A", Imf::Slice::Make(Imf::FLOAT, read.alpha.data(), window));
    file.setFrameBuffer(frameBuffer);
    file.readPixels(window.min.y, window.max.y);
    return read;
}

/// The colours as they are rounded.
AlphaImage halvesOf(const Picture &picture) {
    AlphaImage halves{picture.colour, {picture.alpha.begin(), picture.alpha.end()}};
    for (glm::vec3 &pixel : halves.image.pixels())
        pixel = {halfOf(pixel.x), halfOf(pixel.y), halfOf(pixel.z)};
    std::ranges::transform(halves.alpha, halves.alpha.begin(), halfOf);
    return halves;
}

} // namespace

bool isLossy(ExrCompression compression) {
    return changes(compression, Imf::FLOAT, "R") || changes(compression, Imf::HALF, "R");
}

std::string exrPixelHash(const Picture &picture, const ExrOptions &options) {
    if (!options.isHalf && !isLossy(options.compression))
        return pixelHash(picture.colour, picture.alpha);
    const AlphaImage stored = isLossy(options.compression) ? readBack(picture, options) : halvesOf(picture);
    return pixelHash(stored.image, stored.alpha);
}

std::vector<std::string> writeExr(AtomicFile &file, const Picture &picture, const ExrOptions &options) {
    assert(picture.colour.width() == picture.crop.width() &&
           picture.colour.height() == picture.crop.height());
    assert(picture.alpha.empty() || picture.alpha.size() == picture.colour.pixels().size());
    ExrOutput output(file);
    try {
        writeRows(output, picture, options);
    } catch (const std::bad_alloc &) {
        throw;
    } catch (const std::exception &error) {
        output.requireSuccess();
        throw Error(ErrorKind::OutputNotWritten,
                    fmt::format("cannot write '{}': OpenEXR says: {}", file.path().string(), error.what()));
    }
    output.requireSuccess();
    return lossesOf(picture, options);
}

} // namespace hyalite::core
