// Drivers' manifests: found where the Vulkan loader looks for them, and what is wrong with each.
#include "host/gpu/vk/driver_manifests.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <unistd.h>

namespace hyalite::core::gpu {
namespace {

namespace fs = std::filesystem;

class DriverManifests : public ::testing::Test {
  protected:
    void SetUp() override {
        for (const char *name : names)
            unsetenv(name);
        setenv("HOME", folder.c_str(), 1);
        setenv("XDG_CONFIG_DIRS", (folder / "xdg").c_str(), 1);
        setenv("XDG_DATA_DIRS", (folder / "a").string().append(":").append(folder / "b").c_str(), 1);
    }
    void TearDown() override {
        for (const char *name : names)
            unsetenv(name);
        fs::remove_all(folder);
    }

    [[nodiscard]] fs::path store(const fs::path &name, const std::string &text) const {
        fs::create_directories((folder / name).parent_path());
        std::ofstream(folder / name) << text;
        return folder / name;
    }

    const std::vector<const char *> names{"VK_DRIVER_FILES", "VK_ICD_FILENAMES", "VK_ADD_DRIVER_FILES",
                                          "XDG_CONFIG_HOME", "XDG_CONFIG_DIRS",  "XDG_DATA_HOME",
                                          "XDG_DATA_DIRS"};
    const fs::path folder = fs::temp_directory_path() / ("hyalite-manifests-" + std::to_string(getpid()));
};

TEST_F(DriverManifests, AreFoundInTheLoadersFolders) {
    const fs::path second = store("b/vulkan/icd.d/b.json", "{}");
    const fs::path first = store("a/vulkan/icd.d/a.json", "{}");
    const fs::path users = store(".local/share/vulkan/icd.d/u.json", "{}");
    static_cast<void>(store("a/vulkan/icd.d/a.txt", "{}"));
    static_cast<void>(store("a/vulkan/explicit_layer.d/l.json", "{}"));
    std::vector<fs::path> found;
    for (const fs::path &manifest : driverManifests())
        if (manifest.string().starts_with(folder.string())) // /etc may have some
            found.push_back(manifest);
    EXPECT_EQ(found, (std::vector{users, first, second}));
    setenv("VK_ADD_DRIVER_FILES", "/x/added.json", 1);
    EXPECT_EQ(driverManifests().front(), "/x/added.json");
}

TEST_F(DriverManifests, AreThoseOfAVariableAlone) {
    const fs::path inFolder = store("more/c.json", "{}");
    static_cast<void>(store("a/vulkan/icd.d/a.json", "{}"));
    setenv("VK_DRIVER_FILES", ("/x/one.json:" + (folder / "more").string()).c_str(), 1);
    setenv("VK_ICD_FILENAMES", "/x/other.json", 1);
    setenv("VK_ADD_DRIVER_FILES", "/x/added.json", 1);
    EXPECT_EQ(driverManifests(), (std::vector<fs::path>{"/x/one.json", inFolder}));
    EXPECT_EQ(driverVariables().size(), 2u);
}

TEST_F(DriverManifests, MayBeFaulty) {
    const auto expectFault = [&](const std::string &text, const std::string &part) {
        const std::string fault = faultOf(store("d.json", text));
        EXPECT_NE(fault.find(part), std::string::npos) << fault;
    };
    expectFault("{", "d.json");
    expectFault("{\"ICD\": {}}", "no /ICD/library_path");
    expectFault("{\"ICD\": {\"library_path\": \"./missing.so\"}}", "cannot be loaded");
    EXPECT_EQ(faultOf(store("d.json", "{\"ICD\": {\"library_path\": \"libc.so.6\"}}")), "");
    EXPECT_NE(faultOf(folder / "none.json").find("there is no file"), std::string::npos);
}

} // namespace
} // namespace hyalite::core::gpu
