#include "host/import/assets.h"

#include "host/base/error.h"
#include "host/base/letter_case.h"
#include "host/import/foreign_format.h"
#include "host/import/formats.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <set>

#include <dlfcn.h>

namespace hyalite::core {
namespace {

/// Of shipped scenes. Where a folder has both for one name, the first wins.
constexpr std::array<std::string_view, 2> sceneExtensions{".json", ".glb"};

/// "; the shipped scenes are cat, spheres"
std::string listOfScenes() {
    const std::vector<std::string> names = availableScenes();
    if (names.empty())
        return "; no shipped scene was found: set HYALITE_ASSETS to the folder that holds scenes/";
    return fmt::format("; the shipped scenes are {}", fmt::join(names, ", "));
}

/// The file that this code was loaded from: the program, or a shared library.
std::filesystem::path libraryFile() {
    Dl_info info{};
    std::error_code error;
    if (dladdr(reinterpret_cast<const void *>(&availableScenes), &info) == 0 || info.dli_fname == nullptr)
        return {};
    return std::filesystem::canonical(info.dli_fname, error);
}

} // namespace

std::vector<std::filesystem::path> assetFolders() {
    std::vector<std::filesystem::path> folders;
    if (const char *folder = std::getenv("HYALITE_ASSETS"); folder != nullptr && *folder != '\0')
        folders.emplace_back(folder);
    std::error_code error;
    const std::filesystem::path program = std::filesystem::canonical("/proc/self/exe", error);
    if (!error)
        folders.push_back(program.parent_path().parent_path() / "share" / "hyalite");
    if (!folders.empty() && std::filesystem::is_directory(folders.back(), error))
        return folders;
    // Of a library in another program: beside a module, in lib, in lib/MACHINE; or where all was installed.
    for (const char *way :
         {"share/hyalite", "../share/hyalite", "../../share/hyalite", HYALITE_DATA_FOLDER}) {
        const std::filesystem::path folder =
            std::filesystem::weakly_canonical(libraryFile().parent_path() / way, error);
        if (std::filesystem::is_directory(folder, error)) {
            folders.push_back(folder);
            break;
        }
    }
    return folders;
}

std::vector<std::string> availableScenes() {
    std::set<std::string> names;
    for (const std::filesystem::path &folder : assetFolders()) {
        std::error_code error; // a folder that is missing or may not be read holds no scenes
        for (std::filesystem::directory_iterator entry(folder / "scenes", error), end; !error && entry != end;
             entry.increment(error))
            if (std::count(sceneExtensions.begin(), sceneExtensions.end(),
                           entry->path().extension().string()) != 0)
                names.insert(entry->path().stem().string());
    }
    return {names.begin(), names.end()};
}

std::filesystem::path resolveScene(const std::string &argument) {
    refuseForeignFormat(argument);
    if (formatOf(argument) != nullptr)
        return argument;
    if (argument.empty() || argument.find_first_of("./") != std::string::npos)
        throw Error(
            ErrorKind::BadInput,
            fmt::format(
                "\"{}\" is not a scene: give a file that ends in {}, or the name of a shipped scene{}",
                argument, listOfExtensions(), listOfScenes()));
    std::vector<std::string> lookedAt;
    for (const std::filesystem::path &folder : assetFolders()) {
        for (const std::string_view extension : sceneExtensions) {
            std::filesystem::path file = folder / "scenes" / (argument + std::string(extension));
            std::error_code error;
            if (std::filesystem::is_regular_file(file, error))
                return file;
        }
        lookedAt.push_back((folder / "scenes" / (argument + ".json")).string() + " (or .glb)");
    }
    throw Error(ErrorKind::BadInput, fmt::format("no scene is named \"{}\": looked for {}{}", argument,
                                                 fmt::join(lookedAt, " and "), listOfScenes()));
}

bool hasExtension(const std::filesystem::path &file, std::string_view extension) {
    return lowerCase(file.extension().string()) == extension;
}

} // namespace hyalite::core
