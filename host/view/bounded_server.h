// A server of the HTTP library within bounds: of connections, of what a request holds, and of the time that it takes.
#pragma once

#include <httplib.h>

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <functional>
#include <mutex>
#include <string>

namespace hyalite::core {

/// Its connections have a thread each. One too many is closed at once, as is one that sends too much, too slowly, or
/// nothing. stop() ends them all in no time.
class BoundedServer : public httplib::Server {
  public:
    static constexpr int maxConnections = 64;
    static constexpr std::size_t maxRequestBytes = std::size_t{64} << 10; ///< with its headers
    static constexpr int requestSeconds = 10;                             ///< from its first byte to its last
    static constexpr int idleSeconds = 10;                                ///< between requests
    static constexpr int writeSeconds = 30; ///< without a byte that the other program takes

    BoundedServer();

    /// Binds it to a port, any free one for 0, and returns that; -1 where it cannot be had.
    [[nodiscard]] int bindTo(const std::string &address, int port);
    /// Ends listen_after_bind() and all connections.
    void stopAll();
    [[nodiscard]] bool isStopping() const { return isStopping_; }

  private:
    class Threads;

    bool process_and_close_socket(socket_t socket) override;
    /// Of the library's versions, each by its arguments.
    bool processRequest(httplib::Stream &stream, bool isLast, bool &isClosed);

    std::atomic<bool> isStopping_ = false;
};

} // namespace hyalite::core
