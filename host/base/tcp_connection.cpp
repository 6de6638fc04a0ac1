#include "host/base/tcp_connection.h"

#include "host/base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <memory>

#include <netdb.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

namespace hyalite::core {

namespace {

constexpr timeval patience{3, 0}; // seconds

[[noreturn]] void failAt(const TcpAddress &address, const char *reason) {
    throw Error(ErrorKind::OutputNotWritten, fmt::format("cannot send to {}: {}", address.text(), reason));
}

const char *reasonOf(int error) {
    const bool isLate = error == EAGAIN || error == EWOULDBLOCK || error == EINPROGRESS;
    return isLate ? "it does not answer" : std::strerror(error);
}

bool isPort(const std::string &text) {
    const auto isDigit = [](char c) { return c >= '0' && c <= '9'; };
    return !text.empty() && text.size() <= 5 && std::ranges::all_of(text, isDigit) && std::stoi(text) >= 1 &&
           std::stoi(text) <= 65535;
}

} // namespace

std::string TcpAddress::text() const {
    return host.find(':') != std::string::npos ? fmt::format("[{}]:{}", host, port)
                                               : fmt::format("{}:{}", host, port);
}

TcpAddress readTcpAddress(const std::string &text, const std::string &defaultPort) {
    TcpAddress address{text, defaultPort};
    std::size_t end = std::string::npos; // of the host
    if (text.starts_with('[')) {
        end = std::min(text.find(']'), text.size() - 1) + 1;
        address.host = text.substr(1, end - 2);
    } else if (std::ranges::count(text, ':') == 1) { // more are a number of IPv6
        end = text.find(':');
        address.host = text.substr(0, end);
    }
    const std::string rest = end < text.size() ? text.substr(end) : "";
    if (!rest.empty())
        address.port = rest.substr(1);
    const bool isWellFormed =
        (rest.empty() || rest[0] == ':') && text.starts_with('[') == (text.find(']') != std::string::npos);
    if (address.host.empty() || !isWellFormed || !isPort(address.port))
        throw Error(
            ErrorKind::Usage,
            fmt::format("found the address '{}'; allowed: HOST or HOST:PORT, with a port from 1 to 65535",
                        text));
    return address;
}

TcpConnection::TcpConnection(const TcpAddress &address) : address_(address) {
    addrinfo hints{};
    hints.ai_family = AF_UNSPEC;
    hints.ai_socktype = SOCK_STREAM;
    addrinfo *found = nullptr;
    if (const int fault = getaddrinfo(address.host.c_str(), address.port.c_str(), &hints, &found); fault != 0)
        failAt(address, fault == EAI_SYSTEM ? std::strerror(errno) : gai_strerror(fault));
    const std::unique_ptr<addrinfo, decltype(&freeaddrinfo)> list(found, freeaddrinfo);
    int error = 0;
    for (const addrinfo *each = list.get(); each != nullptr; each = each->ai_next) {
        socket_ = socket(each->ai_family, each->ai_socktype | SOCK_CLOEXEC, each->ai_protocol);
        if (socket_ >= 0) {
            setsockopt(socket_, SOL_SOCKET, SO_SNDTIMEO, &patience, sizeof patience); // of connect(), too
            if (connect(socket_, each->ai_addr, each->ai_addrlen) == 0)
                return;
        }
        error = errno;
        if (socket_ >= 0)
            close(socket_);
    }
    failAt(address, reasonOf(error));
}

TcpConnection::~TcpConnection() { close(socket_); }

void TcpConnection::send(std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
        const ssize_t sent = ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
        if (sent >= 0)
            bytes = bytes.subspan(static_cast<std::size_t>(sent));
        else if (errno != EINTR)
            failAt(address_, reasonOf(errno));
    }
}

} // namespace hyalite::core
