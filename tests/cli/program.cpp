#include "tests/cli/program.h"

#include <gtest/gtest.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <ostream>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/ioctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

extern char **environ;

namespace hyalite::core::testing {

namespace {

using Clock = std::chrono::steady_clock;

#ifdef __SANITIZE_ADDRESS__
constexpr double slowdown = 15.0;
#else
constexpr double slowdown = 1.0;
#endif

double secondsSince(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

[[noreturn]] void failWithErrno(const char *step, int errorNumber) {
    throw std::system_error(errorNumber, std::generic_category(), step);
}

/// A file descriptor that closes itself.
class Descriptor {
  public:
    Descriptor() = default;
    explicit Descriptor(int number) : number_(number) {}
    Descriptor(Descriptor &&other) noexcept : number_(std::exchange(other.number_, -1)) {}
    Descriptor &operator=(Descriptor &&other) noexcept {
        reset();
        number_ = std::exchange(other.number_, -1);
        return *this;
    }
    ~Descriptor() { reset(); }
    void reset() {
        if (number_ >= 0)
            close(number_);
        number_ = -1;
    }
    [[nodiscard]] int number() const { return number_; }

  private:
    int number_ = -1;
};

/// One stream: the end that the program writes to and, if captured, the end that is read here.
struct Channel {
    Descriptor ours;
    Descriptor theirs;
};

Channel openTerminal() {
    Channel channel{Descriptor(posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC)), {}};
    std::array<char, 128> name{};
    if (channel.ours.number() < 0 || grantpt(channel.ours.number()) != 0 ||
        unlockpt(channel.ours.number()) != 0 ||
        ptsname_r(channel.ours.number(), name.data(), name.size()) != 0)
        failWithErrno("opening a pseudo terminal", errno);
    channel.theirs = Descriptor(open(name.data(), O_RDWR | O_NOCTTY | O_CLOEXEC));
    winsize size{};
    size.ws_row = 24;
    size.ws_col = 80;
    if (channel.theirs.number() < 0 || ioctl(channel.theirs.number(), TIOCSWINSZ, &size) != 0)
        failWithErrno("opening a pseudo terminal", errno);
    return channel;
}

Channel openChannel(Stream stream) {
    switch (stream) {
    case Stream::Closed:
        return {};
    case Stream::FullDevice: {
        Channel channel{{}, Descriptor(open("/dev/full", O_WRONLY | O_CLOEXEC))};
        if (channel.theirs.number() < 0)
            failWithErrno("opening /dev/full", errno);
        return channel;
    }
    case Stream::Terminal:
        return openTerminal();
    case Stream::Captured:
        break;
    }
    std::array<int, 2> ends{};
    if (pipe2(ends.data(), O_CLOEXEC) != 0)
        failWithErrno("opening a pipe", errno);
    return {Descriptor(ends[0]), Descriptor(ends[1])};
}

/// What posix_spawn does in the new process before the program starts.
class FileActions {
  public:
    FileActions() { posix_spawn_file_actions_init(&actions_); }
    ~FileActions() { posix_spawn_file_actions_destroy(&actions_); }
    FileActions(const FileActions &) = delete;
    FileActions &operator=(const FileActions &) = delete;

    void enterFolder(const std::filesystem::path &folder) {
        posix_spawn_file_actions_addchdir_np(&actions_, folder.c_str());
    }
    void readFrom(const std::filesystem::path &input) {
        posix_spawn_file_actions_addopen(&actions_, STDIN_FILENO, input.c_str(), O_RDONLY, 0);
    }
    void connect(const Channel &channel, int target) {
        if (channel.theirs.number() >= 0)
            posix_spawn_file_actions_adddup2(&actions_, channel.theirs.number(), target);
        else
            posix_spawn_file_actions_addclose(&actions_, target);
    }
    [[nodiscard]] const posix_spawn_file_actions_t *get() const { return &actions_; }

  private:
    posix_spawn_file_actions_t actions_{};
};

/// While it lives, processes that start cannot write files larger than the limit.
class FileSizeLimit {
  public:
    explicit FileSizeLimit(std::size_t limitBytes) : isSet_(limitBytes > 0) {
        if (!isSet_)
            return;
        getrlimit(RLIMIT_FSIZE, &before_);
        rlimit limit = before_;
        limit.rlim_cur = limitBytes;
        setrlimit(RLIMIT_FSIZE, &limit);
    }
    ~FileSizeLimit() {
        if (!isSet_)
            return;
        setrlimit(RLIMIT_FSIZE, &before_);
    }
    FileSizeLimit(const FileSizeLimit &) = delete;
    FileSizeLimit &operator=(const FileSizeLimit &) = delete;

  private:
    bool isSet_;
    rlimit before_{};
};

std::vector<std::string> makeEnvironment(const std::map<std::string, std::optional<std::string>> &changes) {
    std::vector<std::string> variables;
    for (char **variable = environ; *variable != nullptr; ++variable) {
        const std::string text = *variable;
        if (!changes.contains(text.substr(0, text.find('='))))
            variables.push_back(text);
    }
    for (const auto &[name, value] : changes)
        if (value)
            variables.push_back(name + "=" + *value);
    return variables;
}

std::vector<char *> pointersTo(std::vector<std::string> &texts) {
    std::vector<char *> pointers;
    for (std::string &text : texts)
        pointers.push_back(text.data());
    pointers.push_back(nullptr);
    return pointers;
}

/// Signals as a user's shell leaves them, whatever runs the tests: what runs in the background may ignore some.
class SpawnAttributes {
  public:
    SpawnAttributes() {
        posix_spawnattr_init(&attributes_);
        sigset_t signals;
        sigemptyset(&signals);
        for (const int signal : {SIGINT, SIGTERM, SIGHUP})
            sigaddset(&signals, signal);
        posix_spawnattr_setsigdefault(&attributes_, &signals);
        posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETSIGDEF);
    }
    ~SpawnAttributes() { posix_spawnattr_destroy(&attributes_); }
    SpawnAttributes(const SpawnAttributes &) = delete;
    SpawnAttributes &operator=(const SpawnAttributes &) = delete;

    [[nodiscard]] const posix_spawnattr_t *get() const { return &attributes_; }

  private:
    posix_spawnattr_t attributes_{};
};

pid_t start(const std::vector<std::string> &arguments, const Surroundings &surroundings,
            const Channel &output, const Channel &errors) {
    std::vector<std::string> words{HYALITE_PROGRAM};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<std::string> variables = makeEnvironment(surroundings.environment);
    const SpawnAttributes attributes;
    FileActions actions;
    actions.enterFolder(surroundings.folder);
    actions.readFrom(surroundings.input);
    actions.connect(output, STDOUT_FILENO);
    actions.connect(errors, STDERR_FILENO);
    const FileSizeLimit limit(surroundings.fileSizeLimitBytes);
    pid_t process = -1;
    const int errorNumber = posix_spawn(&process, HYALITE_PROGRAM, actions.get(), attributes.get(),
                                        pointersTo(words).data(), pointersTo(variables).data());
    if (errorNumber != 0)
        failWithErrno("starting " HYALITE_PROGRAM, errorNumber);
    return process;
}

/// Appends what there is to read. Closes the descriptor at the end of the stream.
void readSome(Descriptor &descriptor, std::string &text) {
    std::array<char, 4096> bytes{};
    const ssize_t count = read(descriptor.number(), bytes.data(), bytes.size());
    if (count > 0)
        text.append(bytes.data(), static_cast<std::size_t>(count));
    else if (count == 0 || errno != EINTR) // a pseudo terminal ends with EIO
        descriptor.reset();
}

} // namespace

std::ostream &operator<<(std::ostream &stream, const Outcome &outcome) {
    return stream << "exit code " << outcome.exitCode << " after " << outcome.seconds
                  << " s\n--- standard output\n"
                  << outcome.output << "\n--- standard error\n"
                  << outcome.errors << "\n---";
}

Outcome runProgram(const std::vector<std::string> &arguments, const Surroundings &surroundings) {
    const Clock::time_point begin = Clock::now();
    Channel output = openChannel(surroundings.output);
    Channel errors = openChannel(surroundings.errors);
    const pid_t process = start(arguments, surroundings, output, errors);
    output.theirs.reset();
    errors.theirs.reset();

    const double timeoutSeconds = slowdown * surroundings.timeoutSeconds;
    Outcome outcome;
    bool isSignalSent = false;
    Clock::time_point lastSignal;
    bool isKilled = false;
    int status = 0;
    rusage usage{};
    bool isRunning = true;
    while (isRunning || output.ours.number() >= 0 || errors.ours.number() >= 0) {
        // poll() ignores descriptors below 0.
        std::array<pollfd, 2> streams{pollfd{output.ours.number(), POLLIN, 0},
                                      pollfd{errors.ours.number(), POLLIN, 0}};
        const int pollMillis = surroundings.signalWhen && !isSignalSent ? 1 : 10;
        poll(streams.data(), streams.size(), pollMillis);
        if (streams[0].revents != 0)
            readSome(output.ours, outcome.output);
        if (streams[1].revents != 0)
            readSome(errors.ours, outcome.errors);
        if (!isRunning)
            continue;
        const bool isWanted = isSignalSent
                                  ? surroundings.signalAgainSeconds > 0.0 &&
                                        secondsSince(lastSignal) > surroundings.signalAgainSeconds
                                  : (!surroundings.signalAfter.empty() &&
                                     outcome.errors.find(surroundings.signalAfter) != std::string::npos) ||
                                        (surroundings.signalWhen && surroundings.signalWhen());
        if (isWanted) {
            kill(process, surroundings.signal);
            isSignalSent = true;
            lastSignal = Clock::now();
        }
        if (!isKilled && secondsSince(begin) > timeoutSeconds) {
            kill(process, SIGKILL);
            isKilled = true;
        }
        isRunning = wait4(process, &status, WNOHANG, &usage) == 0;
    }
    outcome.seconds = secondsSince(begin);
    outcome.peakMemoryBytes = static_cast<std::size_t>(usage.ru_maxrss) * 1024;
    outcome.exitCode = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    if (isKilled)
        ADD_FAILURE() << "killed after " << timeoutSeconds << " s: " << outcome;
    return outcome;
}

} // namespace hyalite::core::testing
