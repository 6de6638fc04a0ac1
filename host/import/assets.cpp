#include "host/import/assets.h"

#include "host/base/error.h"
#include "host/base/letter_case.h"
#include "host/import/foreign_format.h"
#include "host/import/formats.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
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

/// The folder that this code was loaded from: that of the program, or of a shared library.
std::filesystem::path codeFolder() {
    Dl_info info{};
    const bool isLibrary = dladdr(reinterpret_cast<const void *>(&availableScenes), &info) != 0 &&
                           std::strcmp(info.dli_fname, program_invocation_name) != 0;
    std::error_code error;
    return std::filesystem::canonical(isLibrary ? info.dli_fname : "/proc/self/exe", error).parent_path();
}

/// Of a program in bin and a library in lib; of a library in lib/MACHINE; of a module in
/// lib/python3/dist-packages/hyalite or in a wheel; and where all of it was installed.
constexpr std::array<const char *, 5> waysToShared{"../share/hyalite", "../../share/hyalite",
                                                   "../../../../share/hyalite", "share/hyalite",
                                                   HYALITE_DATA_FOLDER};

} // namespace

std::vector<std::filesystem::path> assetFolders() {
    std::vector<std::filesystem::path> folders;
    if (const char *folder = std::getenv("HYALITE_ASSETS"); folder != nullptr && *folder != '\0')
        folders.emplace_back(folder);
    std::error_code error;
    const auto folderBy = [&, code = codeFolder()](const char *way) {
        return std::filesystem::weakly_canonical(code / way, error);
    };
    const auto *const way = std::ranges::find_if(waysToShared, [&](const char *candidate) {
        return std::filesystem::is_directory(folderBy(candidate), error);
    });
    folders.push_back(folderBy(way != waysToShared.end() ? *way : waysToShared.front()));
    return folders;
}

std::filesystem::path shippedFile(const std::filesystem::path &path) {
    std::vector<std::string> lookedAt;
    for (const std::filesystem::path &folder : assetFolders()) {
        std::error_code error;
        if (std::filesystem::is_regular_file(folder / path, error))
            return folder / path;
        lookedAt.push_back((folder / path).string());
    }
    throw Error(ErrorKind::BadInput,
                fmt::format("a shipped file is missing: looked for {}; set HYALITE_ASSETS to the "
                            "folder that has it",
                            fmt::join(lookedAt, " and ")));
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
