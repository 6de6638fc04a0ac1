#include "host/view/bounded_server.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <span>
#include <string>
#include <system_error>
#include <thread>
#include <utility>

#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

namespace hyalite::core {

namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;
using std::chrono::seconds;

/// How long a thread waits before it looks whether the server is stopping.
constexpr milliseconds betweenLooks{50};

constexpr int maxRequests = 10'000; ///< of a connection

/// Of a thread that has a connection too many: it closes it.
thread_local bool isRefusing = false;

/// Whether the socket is ready for `events` before `deadline`.
bool waitFor(int socket, short events, Clock::time_point deadline, const std::atomic<bool> &isStopping) {
    while (!isStopping) {
        pollfd entry{socket, events, 0};
        const int count = poll(&entry, 1, static_cast<int>(betweenLooks.count()));
        if (count > 0)
            return true;
        if ((count < 0 && errno != EINTR) || Clock::now() > deadline)
            return false;
    }
    return false;
}

/// A connection, of which each request has its bounds.
class BoundedStream : public httplib::Stream {
  public:
    BoundedStream(int socket, const std::atomic<bool> &isStopping)
        : socket_(socket), isStopping_(isStopping) {}

    /// Waits for the first byte of a request.
    [[nodiscard]] bool beginRequest() {
        if (unread_.empty() &&
            !waitFor(socket_, POLLIN, Clock::now() + seconds(BoundedServer::idleSeconds), isStopping_))
            return false;
        bytesLeft_ = BoundedServer::maxRequestBytes;
        deadline_ = Clock::now() + seconds(BoundedServer::requestSeconds);
        return true;
    }

    [[nodiscard]] bool is_readable() const override { return !unread_.empty() || isReady(POLLIN); }
    [[nodiscard]] bool is_writable() const override {
        return waitFor(socket_, POLLOUT, Clock::now() + seconds(BoundedServer::writeSeconds), isStopping_);
    }
    ssize_t read(char *to, std::size_t size) override {
        if (bytesLeft_ == 0)
            return -1;
        if (unread_.empty()) {
            if (!waitFor(socket_, POLLIN, deadline_, isStopping_))
                return -1;
            const ssize_t count = recv(socket_, buffer_.data(), buffer_.size(), 0);
            if (count <= 0)
                return count;
            unread_ = std::span(buffer_).first(static_cast<std::size_t>(count));
        }
        const std::size_t count = std::min({size, unread_.size(), bytesLeft_});
        std::ranges::copy(unread_.first(count), to);
        unread_ = unread_.subspan(count);
        bytesLeft_ -= count;
        return static_cast<ssize_t>(count);
    }
    ssize_t write(const char *from, std::size_t size) override {
        while (is_writable()) {
            const ssize_t count = send(socket_, from, size, MSG_NOSIGNAL | MSG_DONTWAIT);
            if (count >= 0 || (errno != EAGAIN && errno != EINTR))
                return count;
        }
        return -1;
    }
    void get_remote_ip_and_port(std::string & /*ip*/, int & /*port*/) const override {}
    void get_local_ip_and_port(std::string & /*ip*/, int & /*port*/) const override {}
    [[nodiscard]] socket_t socket() const override { return socket_; }

  private:
    [[nodiscard]] bool isReady(short events) const {
        pollfd entry{socket_, events, 0};
        return poll(&entry, 1, 0) > 0;
    }

    int socket_;
    const std::atomic<bool> &isStopping_;
    std::array<char, 4096> buffer_{};
    std::span<const char> unread_;
    std::size_t bytesLeft_ = 0;
    Clock::time_point deadline_;
};

} // namespace

/// A thread for each connection, up to the bound.
class BoundedServer::Threads : public httplib::TaskQueue {
  public:
    void enqueue(std::function<void()> task) override {
        {
            std::unique_lock lock(mutex_);
            if (count_ < maxConnections) {
                ++count_;
                lock.unlock();
                if (begin(task))
                    return;
                lock.lock();
                --count_;
            }
        }
        isRefusing = true;
        task();
        isRefusing = false;
    }
    void shutdown() override {
        std::unique_lock lock(mutex_);
        ended_.wait(lock, [this] { return count_ == 0; });
    }

  private:
    /// Returns whether there is a thread for it.
    bool begin(const std::function<void()> &task) {
        try {
            std::thread([this, task] {
                task();
                const std::lock_guard lock(mutex_);
                --count_;
                ended_.notify_all();
            }).detach();
            return true;
        } catch (const std::system_error &) {
            return false;
        }
    }

    std::mutex mutex_;
    std::condition_variable ended_;
    int count_ = 0;
};

BoundedServer::BoundedServer() {
    new_task_queue = [] { return new Threads; };
    set_tcp_nodelay(true); // else small answers wait 40 ms for an acknowledgement
    set_payload_max_length(maxRequestBytes);
    set_keep_alive_max_count(maxRequests); // what answers say
    set_keep_alive_timeout(idleSeconds);
}

int BoundedServer::bindTo(const std::string &address, int port) {
    constexpr int waiting =
        128; // the library has 5 connections wait, of which a page has more; others are a second late
    const int bound = port == 0 ? bind_to_any_port(address) : bind_to_port(address, port) ? port : -1;
    if (bound >= 0)
        ::listen(svr_sock_, waiting);
    return bound;
}

void BoundedServer::stopAll() {
    isStopping_ = true;
    stop();
}

bool BoundedServer::processRequest(httplib::Stream &stream, bool isLast, bool &isClosed) {
    const auto call = [&](auto &self) {
        if constexpr (requires { self.process_request(stream, isLast, isClosed, nullptr); })
            return self.process_request(stream, isLast, isClosed, nullptr);
        else
            return self.process_request(stream, std::string(), 0, std::string(), 0, isLast, isClosed,
                                        nullptr);
    };
    return call(*this);
}

bool BoundedServer::process_and_close_socket(socket_t socket) {

    if (!isRefusing) {
        BoundedStream stream(socket, isStopping_);
        bool isClosed = false;
        for (int left = maxRequests; left > 0 && !isClosed && stream.beginRequest(); --left)
            if (!processRequest(stream, left == 1, isClosed))
                break;
    }
    shutdown(socket, SHUT_RDWR);
    close(socket);
    return true;
}

} // namespace hyalite::core
