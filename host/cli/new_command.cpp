#include "host/base/error.h"
#include "host/base/message.h"
#include "host/base/shell.h"
#include "host/cli/commands.h"
#include "host/cli/first_scene.h"
#include "host/cli/options.h"
#include "host/import/assets.h"
#include "host/jobs/model_scene.h"

#include <fmt/format.h>

#include <cerrno>
#include <memory>
#include <optional>
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

struct NewOptions {
    std::string path;
    std::string model;
    std::optional<glm::dvec3> turnDegrees;
};

void runNew(const NewOptions &options) {
    const std::string &path = options.path;
    if (!hasExtension(path, ".json"))
        throw Error(ErrorKind::Usage,
                    fmt::format("{}: the name of a scene ends in .json; name it {}.json", path, path));
    if (options.turnDegrees && options.model.empty())
        throw Error(ErrorKind::Usage, "--up needs --from MODEL, whose up it is");
    std::string text(firstScene);
    if (!options.model.empty())
        text = sceneAround(options.model, path, options.turnDegrees.value_or(glm::dvec3(0.0)));
    writeNewFile(path, text);
    const std::string contents = options.model.empty() ? "a floor, three objects, a lamp and a sky"
                                                       : "the model, a floor, a lamp and a sky";
    const char *const words[] = {path.c_str()};
    printResult("{}: {}, to change as you like. Next:\n"
                "  hyalite render {} -o {} --tone agx\n",
                path, contents, shellLine(words), options.model.empty() ? "first.png" : "model.png");
}

} // namespace

void addNewCommand(CLI::App &app, CommandContext & /*context*/) {
    CLI::App *command = app.add_subcommand("new", "write a small scene with explanations, to start from");
    const auto options = std::make_shared<NewOptions>();
    command->add_option("file", options->path, "the scene to write, which must not exist yet")
        ->required()
        ->type_name("FILE.json");
    addFile(*command, "--from", options->model, "MODEL",
            "a scene of this model, a .gltf, .glb, .obj, .ply or .stl file in the scene's folder or below "
            "it: on a "
            "floor, under a lamp, before a camera that sees it");
    addChoice(*command, "--up", options->turnDegrees, upTurns,
              "the axis of the model that is up; y without it. Files for printers and CAD mostly have z");
    command->callback([options] { runNew(*options); });
}

} // namespace hyalite::core
