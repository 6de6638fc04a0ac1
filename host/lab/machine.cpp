#include "host/lab/machine.h"

#include "host/lab/system_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <fstream>
#include <regex>
#include <system_error>
#include <thread>

#include <gnu/libc-version.h>
#include <grp.h>
#include <sys/stat.h>
#include <sys/utsname.h>
#include <unistd.h>

namespace hyalite::core {

namespace fs = std::filesystem;

namespace {

/// The variables by which loader, drivers and container runtimes are told what to do.
constexpr std::array variableNames{"VK_DRIVER_FILES",
                                   "VK_ICD_FILENAMES",
                                   "VK_ADD_DRIVER_FILES",
                                   "VK_LOADER_DRIVERS_SELECT",
                                   "VK_LOADER_DRIVERS_DISABLE",
                                   "VK_INSTANCE_LAYERS",
                                   "XDG_DATA_DIRS",
                                   "LD_LIBRARY_PATH",
                                   "NVIDIA_DRIVER_CAPABILITIES",
                                   "NVIDIA_VISIBLE_DEVICES",
                                   "CUDA_VISIBLE_DEVICES",
                                   "MESA_VK_DEVICE_SELECT",
                                   "LP_NATIVE_VECTOR_WIDTH",
                                   "LP_NUM_THREADS",
                                   "OMP_NUM_THREADS",
                                   "HYALITE_ASSETS",
                                   "HYALITE_BUNDLED_DRIVER",
                                   "HYALITE_VALIDATION"};

/// The value behind `key` and `separator` of the first line that has it, without quotes and blanks around it.
std::string valueIn(const fs::path &file, const std::string &key, char separator) {
    std::ifstream stream(file);
    for (std::string line; std::getline(stream, line);) {
        const std::size_t end = line.find(separator);
        if (!line.starts_with(key) || end == std::string::npos ||
            line.find_first_not_of(" \t", key.size()) < end)
            continue;
        std::string value = line.substr(end + 1);
        value.erase(0, value.find_first_not_of(" \t\""));
        value.erase(value.find_last_not_of(" \t\"") + 1);
        return value;
    }
    return "";
}

std::uint32_t hexIn(const fs::path &file) {
    return static_cast<std::uint32_t>(std::strtoul(firstLineOf(file).c_str(), nullptr, 16));
}

std::vector<GraphicsCard> findCards(const fs::path &root) {
    std::vector<GraphicsCard> cards;
    for (const fs::path &device : filesIn(root / "sys/bus/pci/devices")) {
        constexpr std::uint32_t displayController = 0x03; // class code of PCI
        if (hexIn(device / "class") >> 16 != displayController)
            continue;
        std::error_code error;
        cards.push_back({device.filename(), hexIn(device / "vendor"), hexIn(device / "device"),
                         fs::read_symlink(device / "driver", error).filename()});
    }
    return cards;
}

std::string groupOf(const fs::path &file) {
    struct stat status {};
    if (stat(file.c_str(), &status) != 0)
        return "";
    const struct group *const entry = getgrgid(status.st_gid);
    return entry != nullptr ? entry->gr_name : std::to_string(status.st_gid);
}

/// Of all cards: render nodes, NVIDIA's, and that of Windows' subsystem.
std::vector<DeviceNode> findNodes(const fs::path &root) {
    const std::regex names("renderD[0-9]+|nvidiactl|nvidia[0-9]+|dxg|kfd");
    std::vector<DeviceNode> nodes;
    for (const char *folder : {"dev/dri", "dev"})
        for (const fs::path &file : filesIn(root / folder))
            if (std::regex_match(file.filename().string(), names))
                nodes.push_back({file, groupOf(file), access(file.c_str(), R_OK | W_OK) == 0});
    return nodes;
}

std::string nvidiaModuleIn(const fs::path &root) {
    const std::string line = firstLineOf(root / "proc/driver/nvidia/version");
    std::smatch match;
    const bool isFound = std::regex_search(line, match, std::regex(" ([0-9]+\\.[0-9.]+) "));
    return isFound ? match[1].str() : line.empty() ? "" : "of an unknown version";
}

std::optional<std::uint64_t> memoryIn(const fs::path &root) {
    const std::string total = valueIn(root / "proc/meminfo", "MemTotal", ':'); // "24576000 kB"
    return total.empty() ? std::nullopt
                         : std::optional(std::uint64_t{1024} * std::strtoull(total.c_str(), nullptr, 10));
}

bool isContainerIn(const fs::path &root) {
    std::error_code error;
    return std::getenv("container") != nullptr || fs::exists(root / ".dockerenv", error) ||
           fs::exists(root / "run/.containerenv", error);
}

} // namespace

std::string_view Machine::variable(std::string_view name) const {
    const auto found = std::ranges::find(variables, name, &std::pair<std::string, std::string>::first);
    return found != variables.end() ? std::string_view(found->second) : std::string_view();
}

Machine describeMachine(const fs::path &root) {
    Machine machine;
    machine.system = valueIn(root / "etc/os-release", "PRETTY_NAME", '=');
    utsname name{};
    if (uname(&name) == 0) {
        machine.kernel = fmt::format("{} {}", name.sysname, name.release);
        machine.architecture = name.machine;
    }
    machine.libc = fmt::format("glibc {}", gnu_get_libc_version());
    machine.processor = valueIn(root / "proc/cpuinfo", "model name", ':');
    machine.threadCount = std::thread::hardware_concurrency();
    machine.memoryBytes = memoryIn(root);
    machine.isContainer = isContainerIn(root);
    machine.nvidiaModule = nvidiaModuleIn(root);
    machine.cards = findCards(root);
    machine.nodes = findNodes(root);
    for (const char *variable : variableNames)
        if (const char *value = std::getenv(variable); value != nullptr)
            machine.variables.emplace_back(variable, value);
    return machine;
}

} // namespace hyalite::core
