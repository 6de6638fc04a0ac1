#include "tests/bench/process.h"

#include "tests/bench/race.h"

#include <fmt/ranges.h>

#include <fcntl.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <stdexcept>
#include <system_error>

namespace hyalite::core::bench {

namespace {

double secondsOf(const timeval &time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

/// As posix_spawn takes them. `texts` outlives the pointers.
std::vector<char *> pointersTo(std::vector<std::string> &texts) {
    std::vector<char *> pointers;
    for (std::string &text : texts)
        pointers.push_back(text.data());
    pointers.push_back(nullptr);
    return pointers;
}

} // namespace

TemporaryFolder::TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "hyalite-bench-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr)
        throw std::filesystem::filesystem_error("mkdtemp", name,
                                                std::error_code(errno, std::generic_category()));
    path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
}

double runHyalite(const std::vector<std::string> &arguments, const std::vector<std::string> &variables) {
    std::vector<std::string> words{HYALITE_PROGRAM};
    words.insert(words.end(), arguments.begin(), arguments.end());
    // The first of two variables of one name counts.
    std::vector<std::string> environment = variables;
    for (char **variable = environ; *variable != nullptr; ++variable)
        environment.emplace_back(*variable);

    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    const auto start = std::chrono::steady_clock::now();
    pid_t process = -1;
    const int error = posix_spawn(&process, HYALITE_PROGRAM, &actions, nullptr, pointersTo(words).data(),
                                  pointersTo(environment).data());
    posix_spawn_file_actions_destroy(&actions);
    if (error != 0)
        throw std::system_error(error, std::generic_category(), "starting " HYALITE_PROGRAM);
    int status = 0;
    rusage usage{};
    wait4(process, &status, 0, &usage);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
        throw std::runtime_error(fmt::format("hyalite {} failed", fmt::join(arguments, " ")));
    return areProcessorSecondsCounted() ? secondsOf(usage.ru_utime) + secondsOf(usage.ru_stime) : seconds;
}

} // namespace hyalite::core::bench
