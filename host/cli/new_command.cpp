#include "host/base/error.h"
#include "host/base/message.h"
#include "host/base/shell.h"
#include "host/cli/commands.h"
#include "host/cli/first_scene.h"
#include "host/cli/options.h"
#include "host/import/assets.h"

#include <fmt/format.h>

#include <cerrno>
#include <memory>
#include <string>
#include <string_view>
#include <system_error>

#include <fcntl.h>
#include <unistd.h>

namespace hyalite::core {

namespace {

[[noreturn]] void failToWrite(const std::string &path, int error) {
    throw Error(ErrorKind::OutputNotWritten,
                fmt::format("{}: {}", path,
                            error == EEXIST ? "exists already, and is left as it is; name another file"
                                            : std::generic_category().message(error)));
}

/// Writes a file that does not exist yet. What exists is never opened.
void writeNewFile(const std::string &path, std::string_view text) {
    const int descriptor = open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor < 0)
        failToWrite(path, errno);
    int error = 0;
    while (!text.empty() && error == 0) {
        const ssize_t count = write(descriptor, text.data(), text.size());
        if (count >= 0)
            text.remove_prefix(static_cast<std::size_t>(count));
        else if (errno != EINTR)
            error = errno;
    }
    if (close(descriptor) != 0 && error == 0)
        error = errno;
    if (error == 0)
        return;
    unlink(path.c_str());
    failToWrite(path, error);
}

void runNew(const std::string &path) {
    if (!hasExtension(path, ".json"))
        throw Error(ErrorKind::Usage,
                    fmt::format("{}: the name of a scene ends in .json; name it {}.json", path, path));
    writeNewFile(path, firstScene);
    const char *const words[] = {path.c_str()};
    printResult("{}: a floor, three objects, a lamp and a sky, to change as you like. Next:\n"
                "  hyalite render {} -o first.png --tone agx\n",
                path, shellLine(words));
}

} // namespace

void addNewCommand(CLI::App &app, CommandContext & /*context*/) {
    CLI::App *command = app.add_subcommand("new", "write a small scene with explanations, to start from");
    const auto path = std::make_shared<std::string>();
    command->add_option("file", *path, "the scene to write, which must not exist yet")
        ->required()
        ->type_name("FILE.json");
    command->callback([path] { runNew(*path); });
}

} // namespace hyalite::core
