#include "host/jobs/display.h"

#include "host/base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <string_view>
#include <utility>

namespace hyalite::core {

namespace {

static_assert(std::endian::native == std::endian::little, "packets are little-endian");

const std::string portOfTev = "14158";
constexpr int tileSide = 64;
constexpr std::array<std::string_view, 3> channels{"R", "G", "B"};

/// Kinds of packets.
enum class Operation : std::uint8_t { CloseImage = 2, CreateImage = 4, UpdateImage = 6 };

/// A packet: its own length in bytes, and what is put into it.
class Packet {
  public:
    explicit Packet(Operation operation) : bytes_(sizeof(std::uint32_t)) { put(operation); }

    template <class Number> void put(const Number &number) {
        const auto bytes = std::as_bytes(std::span(&number, 1));
        bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
    }
    void putText(std::string_view text) {
        for (const char c : text)
            put(c);
        put('\0');
    }
    void putChannels() {
        put(static_cast<std::int32_t>(channels.size()));
        for (const std::string_view channel : channels)
            putText(channel);
    }
    [[nodiscard]] std::span<const std::byte> finished() {
        const auto size = static_cast<std::uint32_t>(bytes_.size());
        std::memcpy(bytes_.data(), &size, sizeof size);
        return bytes_;
    }

  private:
    std::vector<std::byte> bytes_;
};

/// Calls visit(tile) for each tile of a picture, row by row.
template <class Visit> void forEachTile(int width, int height, const Visit &visit) {
    for (int y = 0; y < height; y += tileSide)
        for (int x = 0; x < width; x += tileSide)
            visit(Crop{x, std::min(x + tileSide, width), y, std::min(y + tileSide, height)});
}

} // namespace

Display::Display(const std::string &address, std::string name)
    : address_(readTcpAddress(address, portOfTev)), name_(std::move(name)) {
    try {
        connection_.emplace(address_);
    } catch (const Error &error) {
        throw Error(error.kind, fmt::format("{}; a viewer such as tev must be open there", error.what()));
    }
}

void Display::send(std::span<const std::byte> packet) {
    try {
        connection_->send(packet);
    } catch (...) {
        connection_.reset();
        sampleCounts_.clear();
        throw;
    }
}

void Display::connect(int width, int height) {
    if (!connection_)
        connection_.emplace(address_);
    if (!sampleCounts_.empty())
        return;
    Packet close(Operation::CloseImage); // of an earlier render
    close.putText(name_);
    send(close.finished());
    Packet create(Operation::CreateImage);
    create.put(std::uint8_t{1}); // it is selected
    create.putText(name_);
    create.put(width);
    create.put(height);
    create.putChannels();
    send(create.finished());
    forEachTile(width, height, [this](const Crop &) { sampleCounts_.push_back(0); });
}

void Display::sendTile(const Crop &tile, const std::function<glm::vec3(int x, int y)> &colourAt) {
    Packet packet(Operation::UpdateImage);
    packet.put(std::uint8_t{0}); // whoever looks at another image keeps it
    packet.putText(name_);
    packet.putChannels();
    for (const int number : {tile.x0, tile.y0, tile.width(), tile.height()})
        packet.put(number);
    for (std::int64_t offset = 0; offset < std::ssize(channels); ++offset) // in floats, of each channel
        packet.put(offset);
    for (std::size_t i = 0; i < channels.size(); ++i)
        packet.put(static_cast<std::int64_t>(channels.size()));
    for (int y = tile.y0; y < tile.y1; ++y)
        for (int x = tile.x0; x < tile.x1; ++x)
            packet.put(colourAt(x, y));
    send(packet.finished());
}

void Display::update(const Film &film) {
    connect(film.crop.width(), film.crop.height());
    const auto pixelAt = [&](int x, int y) -> const layout::FilmPixel & {
        return rowOf(film, y)[static_cast<std::size_t>(x)];
    };
    std::size_t index = 0;
    forEachTile(film.crop.width(), film.crop.height(), [&](const Crop &tile) {
        std::uint64_t count = 0;
        for (int y = tile.y0; y < tile.y1; ++y)
            for (int x = tile.x0; x < tile.x1; ++x)
                count += pixelAt(x, y).sampleCount;
        if (count != sampleCounts_[index])
            sendTile(tile, [&](int x, int y) { return meanOf(pixelAt(x, y)); });
        sampleCounts_[index++] = count;
    });
}

void Display::show(const Image &image) {
    connect(image.width(), image.height());
    forEachTile(image.width(), image.height(),
                [&](const Crop &tile) { sendTile(tile, [&](int x, int y) { return image.at(x, y); }); });
}

void showOn(std::unique_ptr<Display> &display, Observer &observer,
            const std::function<void(Display &)> &show) {
    if (!display)
        return;
    try {
        show(*display);
    } catch (const Error &error) {
        observer.warning(error.what());
        display.reset();
    }
}

} // namespace hyalite::core
