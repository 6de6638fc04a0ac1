#include "host/process/apart.h"

#include "host/base/error.h"

#include <fmt/format.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <new>
#include <string>

#include <sys/wait.h>
#include <unistd.h>

namespace hyalite::core {

namespace {

using Json = nlohmann::json;

/// Reads until the writer closes the pipe.
std::string drain(int pipe) {
    std::string text;
    std::array<char, 4096> block{};
    for (;;) {
        const ssize_t count = read(pipe, block.data(), block.size());
        if (count < 0 && errno == EINTR)
            continue;
        if (count <= 0)
            return text;
        text.append(block.data(), static_cast<std::size_t>(count));
    }
}

/// Runs `work`, writes its result or error, and exits without destructors: objects of the parent are not ours to
/// destroy.
[[noreturn]] void sendResult(int pipe, const std::function<Json()> &work) {
    Json said;
    try {
        said["result"] = work();
    } catch (const Error &error) {
        said = {{"kind", static_cast<int>(error.kind)}, {"error", error.what()}};
    } catch (const std::bad_alloc &) {
        said = {{"kind", static_cast<int>(ErrorKind::LimitExceeded)}, {"error", "out of memory"}};
    } catch (const std::exception &error) {
        said = {{"kind", static_cast<int>(ErrorKind::Internal)}, {"error", error.what()}};
    }
    const std::string text = said.dump(); // fits into the buffer of a pipe
    const bool isWritten = write(pipe, text.data(), text.size()) == static_cast<ssize_t>(text.size());
    _exit(isWritten ? 0 : 1);
}

} // namespace

nlohmann::json inOwnProcess(const std::function<Json()> &work) {
    std::array<int, 2> ends{};
    if (pipe(ends.data()) != 0)
        throw Error(ErrorKind::LimitExceeded,
                    fmt::format("pipe for a measurement: {}", std::strerror(errno)));
    const pid_t child = fork();
    if (child == 0)
        sendResult(ends[1], work);
    const int forkError = errno;
    close(ends[1]);
    const std::string text = child > 0 ? drain(ends[0]) : std::string();
    close(ends[0]);
    if (child < 0)
        throw Error(ErrorKind::LimitExceeded,
                    fmt::format("fork for a measurement: {}", std::strerror(forkError)));
    int status = 0;
    waitpid(child, &status, 0);
    if (WIFSIGNALED(status))
        throw Error(ErrorKind::DeviceLost, fmt::format("a measurement was killed by signal {}: {}",
                                                       WTERMSIG(status), strsignal(WTERMSIG(status))));
    const Json said = Json::parse(text);
    if (said.contains("error"))
        throw Error(static_cast<ErrorKind>(said.at("kind").get<int>()), said.at("error"));
    return said.at("result");
}

} // namespace hyalite::core
