// A connection to another program, over which bytes are sent.
#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace hyalite::core {

/// Where a program listens.
struct TcpAddress {
    std::string host; ///< a name or a number
    std::string port;

    [[nodiscard]] std::string text() const;
};

/// Of HOST, HOST:PORT, or [HOST]:PORT for the numbers of IPv6. Throws Error{Usage} for other text.
[[nodiscard]] TcpAddress readTcpAddress(const std::string &text, const std::string &defaultPort);

/// Closed when it is destroyed. Waits for the other program for a few seconds at most.
class TcpConnection {
  public:
    /// Throws Error{OutputNotWritten} if nothing answers there.
    explicit TcpConnection(const TcpAddress &address);
    ~TcpConnection();
    TcpConnection(const TcpConnection &) = delete;
    TcpConnection &operator=(const TcpConnection &) = delete;

    /// Throws Error{OutputNotWritten} once the other program is gone, or takes nothing any more.
    void send(std::span<const std::byte> bytes);

  private:
    TcpAddress address_;
    int socket_ = -1;
};

} // namespace hyalite::core
