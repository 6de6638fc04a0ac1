// A viewer that shows a picture while it is rendered: tev, or a program that speaks its protocol
// (https://github.com/Tom94/tev), as other renderers do.
#pragma once

#include "host/base/tcp_connection.h"
#include "host/engine/observer.h"
#include "host/film/film.h"
#include "host/image/image.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace hyalite::core {

/// An image in the viewer: linear radiance in the channels R, G and B. Calls come from one thread at a time. After a
/// failure, the next one connects again, and sends everything.
class Display {
  public:
    /// Between two updates of a picture that is being made: each looks at all of its pixels.
    static constexpr double secondsBetween = 0.25;

    /// `address` as readTcpAddress() takes it; the port may be left out. `name` is that of the image, in place of another of
    /// that name. Throws Error{OutputNotWritten} if nothing listens there, and Error{Usage} for what is no address.
    Display(const std::string &address, std::string name);

    /// Sends the tiles whose pixels have got samples since the last call. All films and images have one size. Throws
    /// Error{OutputNotWritten} if the viewer is gone.
    void update(const Film &film);
    /// Sends another picture of the same pixels.
    void show(const Image &image);

  private:
    void connect(int width, int height);
    void send(std::span<const std::byte> packet);
    void sendTile(const Crop &tile, const std::function<glm::vec3(int x, int y)> &colourAt);

    TcpAddress address_;
    std::string name_;
    std::optional<TcpConnection> connection_;
    std::vector<std::uint64_t> sampleCounts_{}; ///< of each tile, as sent; empty: the viewer has no image yet
};

/// Calls show(*display), if there is one. A viewer that is gone costs no picture: the observer is warned, and there is none
/// any more.
void showOn(std::unique_ptr<Display> &display, Observer &observer,
            const std::function<void(Display &)> &show);

} // namespace hyalite::core
