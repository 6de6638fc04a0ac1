#include "host/base/error.h"
#include "host/image/exr.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfThreading.h>

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <exception>
#include <new>
#include <thread>

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

Layer colourLayer(const Image &image) {
    return {"", "RGB", [&image](int y, std::span<float> row) {
                for (int x = 0; x < image.width(); ++x)
                    for (int channel = 0; channel < 3; ++channel)
                        row[static_cast<std::size_t>(3 * x + channel)] = image.at(x, y)[channel];
            }};
}

Imf::Header headerOf(const Picture &picture, const std::vector<Layer> &layers) {
    const Crop &crop = picture.crop;
    Imf::Header header(Imath::Box2i({0, 0}, {picture.wholeWidth - 1, picture.wholeHeight - 1}),
                       Imath::Box2i({crop.x0, crop.y0}, {crop.x1 - 1, crop.y1 - 1}));
    header.compression() = Imf::ZIP_COMPRESSION;
    Imf::addChromaticities(header, Imf::Chromaticities()); // Rec. 709
    for (const auto &[name, text] : picture.attributes)
        header.insert(name, Imf::StringAttribute(text));
    for (const Layer &layer : layers)
        for (const std::string &name : channelNames(layer))
            header.channels().insert(name, Imf::Channel(Imf::FLOAT));
    return header;
}

/// Rows of one layer in the layout of the library.
class LayerRows {
  public:
    LayerRows(const Layer &layer, const Crop &crop, int rowCountMax)
        : layer_(layer), crop_(crop), names_(channelNames(layer)),
          rowSize_(static_cast<std::size_t>(crop.width()) * names_.size()),
          values_(rowSize_ * static_cast<std::size_t>(rowCountMax)) {}

    /// Fills in `rowCount` rows of the crop from row `y` on.
    void fill(int y, int rowCount, Imf::FrameBuffer &frameBuffer) {
        for (int row = 0; row < rowCount; ++row)
            layer_.fillRow(y + row,
                           std::span(values_).subspan(static_cast<std::size_t>(row) * rowSize_, rowSize_));
        for (std::size_t i = 0; i < names_.size(); ++i)
            frameBuffer.insert(names_[i],
                               Imf::Slice::Make(Imf::FLOAT, values_.data() + i,
                                                Imath::V2i(crop_.x0, crop_.y0 + y), crop_.width(), rowCount,
                                                names_.size() * sizeof(float), rowSize_ * sizeof(float)));
    }

  private:
    const Layer &layer_;
    Crop crop_;
    std::vector<std::string> names_;
    std::size_t rowSize_;
    std::vector<float> values_;
};

void writeRows(ExrOutput &output, const Picture &picture) {
    std::vector<Layer> layers = picture.layers;
    layers.push_back(colourLayer(picture.colour));
    // Compression uses all processors, because it can take longer than the render.
    const int threadCount = std::clamp(static_cast<int>(std::thread::hardware_concurrency()), 1, 16);
    Imf::setGlobalThreadCount(threadCount);
    Imf::OutputFile file(output, headerOf(picture, layers), threadCount);
    constexpr int rowCountPacked = 16; // ZIP compresses 16 rows as a block
    const int rowCountMax = rowCountPacked * threadCount;
    std::vector<LayerRows> rows;
    rows.reserve(layers.size());
    for (const Layer &layer : layers)
        rows.emplace_back(layer, picture.crop, rowCountMax);
    for (int y = 0; y < picture.crop.height(); y += rowCountMax) {
        const int rowCount = std::min(rowCountMax, picture.crop.height() - y);
        Imf::FrameBuffer frameBuffer;
        for (LayerRows &layer : rows)
            layer.fill(y, rowCount, frameBuffer);
        file.setFrameBuffer(frameBuffer);
        file.writePixels(rowCount);
    }
}

} // namespace

void writeExr(AtomicFile &file, const Picture &picture) {
    assert(picture.colour.width() == picture.crop.width() &&
           picture.colour.height() == picture.crop.height());
    ExrOutput output(file);
    try {
        writeRows(output, picture);
    } catch (const std::bad_alloc &) {
        throw;
    } catch (const std::exception &error) {
        output.requireSuccess();
        throw Error(ErrorKind::OutputNotWritten,
                    fmt::format("cannot write '{}': OpenEXR says: {}", file.path().string(), error.what()));
    }
    output.requireSuccess();
}

} // namespace hyalite::core
