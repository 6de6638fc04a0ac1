#include "tests/bench/target.h"

#include "host/base/input_file.h"
#include "tests/bench/rendering.h"

#include <nlohmann/json.hpp>

#include <cstddef>

namespace hyalite::core::bench {

namespace {

constexpr std::size_t maxManifestBytes = std::size_t{1} << 16;

/// A path if it has a folder, relative to the manifest, and else a name that the system's linker knows.
std::filesystem::path readLibraryPath(const std::filesystem::path &manifest) {
    const InputFile file(manifest);
    try {
        const auto json = nlohmann::json::parse(file.head(maxManifestBytes));
        return json.at("ICD").at("library_path").get<std::string>();
    } catch (const nlohmann::json::exception &) {
        throw file.bad("not the manifest of a Vulkan driver");
    }
}

} // namespace

Target targetOf(const std::filesystem::path &manifest) {
    const std::filesystem::path file = std::filesystem::absolute(manifest);
    const std::filesystem::path library = readLibraryPath(file);
    // Loaders before 1.3.207 know the second variable.
    Target target{"", "auto", {"VK_DRIVER_FILES=" + file.string(), "VK_ICD_FILENAMES=" + file.string()}};
    if (library.has_parent_path()) // other libraries that came along with the driver
        target.environment.push_back("LD_LIBRARY_PATH=" +
                                     (file.parent_path() / library.parent_path()).string());
    Rendering rendering({"one pixel", "spheres", {"--width", "1", "--height", "1", "--spp", "1"}}, target);
    rendering.run();
    target.name = rendering.driver();
    return target;
}

} // namespace hyalite::core::bench
