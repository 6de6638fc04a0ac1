// Diagnosis: machines with one thing wrong, and the finding that names it.
#include "host/lab/diagnosis.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>
#include <string>
#include <vector>

#include <unistd.h>

namespace hyalite::core {
namespace {

namespace fs = std::filesystem;

const ListedDevice lavapipe{0, "llvmpipe", 0x10005, 0, true, ""};

/// A machine on which all is well: lavapipe is installed, and nothing else is there.
Machine wellMachine() {
    Machine machine;
    machine.drivers = {{"/usr/share/vulkan/icd.d/lvp_icd.x86_64.json", ""}};
    return machine;
}

/// One with NVIDIA's card, module, node and driver, as far as they are wanted.
Machine nvidiaMachine() {
    Machine machine = wellMachine();
    machine.cards = {{"0000:01:00.0", vendorNvidia, 0x2335, "nvidia"}};
    machine.nvidiaModule = "580.159.04";
    machine.nodes = {{"/dev/nvidia0", "root", true}};
    machine.drivers.push_back({"/etc/vulkan/icd.d/nvidia_icd.json", ""});
    return machine;
}

std::set<std::string> problemsOf(const Machine &machine,
                                 const std::vector<ListedDevice> &devices = {lavapipe},
                                 const std::string &loaderError = "") {
    std::set<std::string> codes;
    for (const Finding &finding : diagnose(machine, devices, loaderError))
        if (finding.isProblem)
            codes.insert(finding.code);
    return codes;
}

using Codes = std::set<std::string>;

TEST(Diagnosis, FindsNothingWhereAllIsWell) {
    EXPECT_EQ(problemsOf(wellMachine()), Codes{});
    const ListedDevice card{1, "NVIDIA H200", vendorNvidia, 0x2335, false, ""};
    EXPECT_EQ(problemsOf(nvidiaMachine(), {card, lavapipe}), Codes{});
}

TEST(Diagnosis, SaysThatNoDriverIsInstalled) {
    const std::vector<Finding> findings = diagnose(Machine{}, {}, "no Vulkan driver can be used");
    EXPECT_EQ(problemsOf(Machine{}, {}, "no"), (Codes{"no-device", "no-driver"}));
    EXPECT_TRUE(std::ranges::any_of(findings, [](const Finding &finding) {
        return finding.remedy.find("mesa-vulkan-drivers") != std::string::npos;
    }));
}

TEST(Diagnosis, SaysWhatADriversLibraryLacks) {
    Machine machine = wellMachine();
    machine.drivers.push_back({"/etc/vulkan/icd.d/nvidia_icd.json",
                               "the library that nvidia_icd.json names cannot be loaded: "
                               "libXext.so.6: cannot open shared object file"});
    const std::vector<Finding> findings = diagnose(machine, std::vector{lavapipe}, "");
    EXPECT_EQ(findings.front().code, "driver-file") << "problems come first";
    EXPECT_NE(findings.front().remedy.find("libxext6"), std::string::npos) << findings.front().remedy;
    machine.drivers.back().fault = "/usr/lib/i386-linux-gnu/libvulkan_lvp.so: wrong ELF class: ELFCLASS32";
    EXPECT_EQ(problemsOf(machine), Codes{}) << "a driver of programs with 32 bits is no fault";
}

TEST(Diagnosis, KnowsTheDriverOfAnArchive) {
    Machine machine = wellMachine();
    machine.variables = {{"VK_DRIVER_FILES", "/opt/hyalite-0.1.0/lib/hyalite/lavapipe/lvp_icd.json"}};
    EXPECT_EQ(diagnose(machine, std::vector{lavapipe}, "").back().code, "bundled-driver");
    machine.variables = {{"VK_DRIVER_FILES", "/opt/other.json"}};
    EXPECT_EQ(diagnose(machine, std::vector{lavapipe}, "").back().code, "driver-variable");
}

TEST(Diagnosis, NamesTheGroupOfANodeThatMayNotBeOpened) {
    Machine machine = wellMachine();
    machine.nodes = {{"/dev/dri/renderD128", "render", false}};
    const std::vector<Finding> findings = diagnose(machine, std::vector{lavapipe}, "");
    EXPECT_EQ(findings.front().code, "device-node");
    EXPECT_NE(findings.front().remedy.find("usermod -aG render"), std::string::npos)
        << findings.front().remedy;
}

TEST(Diagnosis, FindsWhyNvidiasCardIsNoDevice) {
    Machine machine = nvidiaMachine();
    EXPECT_EQ(problemsOf(machine), Codes{"nvidia-silent"});
    machine.drivers.pop_back();
    EXPECT_EQ(problemsOf(machine), Codes{"nvidia-driver-file"});
    machine.nodes.clear();
    EXPECT_EQ(problemsOf(machine), Codes{"nvidia-node"});
    machine.isContainer = true;
    EXPECT_EQ(problemsOf(machine), Codes{"nvidia-capabilities"});
    machine.variables = {{"NVIDIA_DRIVER_CAPABILITIES", "compute,utility"}};
    EXPECT_EQ(problemsOf(machine), Codes{"nvidia-capabilities"});
    machine.variables = {{"NVIDIA_DRIVER_CAPABILITIES", "compute,graphics,utility"}};
    EXPECT_EQ(problemsOf(machine), Codes{"nvidia-node"});
    machine.nvidiaModule.clear();
    EXPECT_EQ(problemsOf(machine), Codes{"nvidia-module"});
}

TEST(Diagnosis, FindsWhyAnotherCardIsNoDevice) {
    Machine machine = wellMachine();
    machine.cards = {{"0000:00:02.0", vendorIntel, 0x9a49, "i915"}};
    machine.nodes = {{"/dev/dri/renderD128", "render", true}};
    EXPECT_EQ(problemsOf(machine), Codes{"card-driver-file"});
    machine.drivers.push_back({"/usr/share/vulkan/icd.d/intel_icd.x86_64.json", ""});
    EXPECT_EQ(problemsOf(machine), Codes{"card-silent"});
    machine.nodes.clear();
    EXPECT_EQ(problemsOf(machine), Codes{"render-node"});
    machine.cards.front().kernelDriver.clear();
    EXPECT_EQ(problemsOf(machine), Codes{"kernel-driver"});
    machine.cards = {{"0000:00:02.0", vendorAmd, 0x7550, "vfio-pci"},
                     {"0000:00:03.0", 0x1234, 0x1111, "bochs"}};
    EXPECT_EQ(problemsOf(machine), Codes{}) << "cards of virtual machines, and those that cannot compute";
}

TEST(Diagnosis, SaysWhyADeviceCannotBeUsed) {
    ListedDevice old = lavapipe;
    old.rejection = "offers Vulkan 1.0, 1.1 is needed";
    EXPECT_EQ(problemsOf(wellMachine(), {old}), Codes{"unusable-device"});
}

/// A system's files, made up.
class MadeUpSystem : public ::testing::Test {
  protected:
    MadeUpSystem() { fs::create_directories(root); }
    ~MadeUpSystem() override { fs::remove_all(root); }

    void store(const fs::path &file, const std::string &text) const {
        fs::create_directories((root / file).parent_path());
        std::ofstream(root / file) << text;
    }

    const fs::path root =
        fs::temp_directory_path() /
        ("hyalite-" + std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()) +
         std::to_string(getpid()));
};

TEST_F(MadeUpSystem, IsDescribed) {
    store("etc/os-release", "NAME=\"Debian GNU/Linux\"\nPRETTY_NAME=\"Debian GNU/Linux 12 (bookworm)\"\n");
    store("proc/cpuinfo", "processor\t: 0\nmodel name\t: A Processor\n");
    store("proc/meminfo", "MemTotal:       2048 kB\nMemFree:        1 kB\n");
    store("proc/driver/nvidia/version", "NVRM version: NVIDIA UNIX x86_64 Kernel Module  580.159.04  Tue\n");
    store("sys/bus/pci/devices/0000:01:00.0/class", "0x030200\n");
    store("sys/bus/pci/devices/0000:01:00.0/vendor", "0x10de\n");
    store("sys/bus/pci/devices/0000:01:00.0/device", "0x2335\n");
    store("sys/bus/pci/devices/0000:02:00.0/class", "0x020000\n"); // a network's
    store("dev/dri/renderD128", "");
    store("dev/dri/card0", "");
    store(".dockerenv", "");
    fs::create_directory_symlink("../../../bus/pci/drivers/nvidia",
                                 root / "sys/bus/pci/devices/0000:01:00.0/driver");
    setenv("NVIDIA_DRIVER_CAPABILITIES", "compute", 1);
    const Machine machine = describeMachine(root);
    unsetenv("NVIDIA_DRIVER_CAPABILITIES");
    EXPECT_EQ(machine.system, "Debian GNU/Linux 12 (bookworm)");
    EXPECT_EQ(machine.processor, "A Processor");
    EXPECT_EQ(machine.memoryBytes, 2u << 20);
    EXPECT_EQ(machine.nvidiaModule, "580.159.04");
    EXPECT_TRUE(machine.isContainer);
    ASSERT_EQ(machine.cards.size(), 1u);
    EXPECT_EQ(machine.cards[0].address, "0000:01:00.0");
    EXPECT_EQ(machine.cards[0].vendorId, vendorNvidia);
    EXPECT_EQ(machine.cards[0].deviceId, 0x2335u);
    EXPECT_EQ(machine.cards[0].kernelDriver, "nvidia");
    ASSERT_EQ(machine.nodes.size(), 1u);
    EXPECT_EQ(machine.nodes[0].file.filename(), "renderD128");
    EXPECT_TRUE(machine.nodes[0].isAccessible);
    EXPECT_EQ(machine.variable("NVIDIA_DRIVER_CAPABILITIES"), "compute");
}

TEST_F(MadeUpSystem, MayBeEmpty) {
    const Machine machine = describeMachine(root);
    EXPECT_EQ(machine.system, "");
    EXPECT_FALSE(machine.memoryBytes.has_value());
    EXPECT_TRUE(machine.cards.empty() && machine.nodes.empty() && machine.drivers.empty());
}

} // namespace
} // namespace hyalite::core
