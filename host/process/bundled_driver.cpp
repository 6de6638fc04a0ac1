#include "host/process/bundled_driver.h"

#include "host/base/clean_text.h"
#include "host/base/error.h"
#include "host/gpu/vk/bundled_manifest.h"
#include "host/gpu/vk/driver_manifests.h"

#include <fmt/format.h>

#include <cstdlib>
#include <string_view>
#include <system_error>

namespace hyalite::core {

namespace fs = std::filesystem;

std::optional<fs::path> bundledDriver() {
    std::error_code error;
    const fs::path program = fs::canonical("/proc/self/exe", error);
    const fs::path manifest = (program.parent_path() / ".." / gpu::bundledManifest).lexically_normal();
    return fs::is_regular_file(manifest, error) ? std::optional(manifest) : std::nullopt;
}

void offerBundledDriver() {
    constexpr const char *variable = "HYALITE_BUNDLED_DRIVER";
    const char *const value = std::getenv(variable);
    const std::string_view wish = value != nullptr ? value : "";
    if (!wish.empty() && wish != "0" && wish != "1")
        throw Error(ErrorKind::Usage,
                    fmt::format("{}: found \"{}\"; allowed: 0, 1, or unset it", variable, excerpt(wish)));
    const std::optional<fs::path> manifest = bundledDriver();
    if (wish == "1" && !manifest)
        throw Error(
            ErrorKind::NoDevice,
            fmt::format("{} is 1, but no driver was installed beside this program; unset it", variable));
    if (!manifest || wish == "0" || (wish.empty() && !gpu::driverManifests().empty()))
        return;
    for (const char *name : {"VK_DRIVER_FILES", "VK_ICD_FILENAMES"}) // older loaders know the second
        setenv(name, manifest->c_str(), 1);
}

} // namespace hyalite::core
