// Environment variables and limits of the shell: each fault is named with its remedy, before anything ends the program.
#include "tests/cli/command_line.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <sys/wait.h>

namespace hyalite::core::testing {
namespace {

const std::string small = "render spheres -o a.png --width 16 --height 12 --spp 1";

struct EnvironmentFaults : CommandLine {
    [[nodiscard]] Outcome runWith(const std::string &name, const std::string &value,
                                  const std::string &line) const {
        Surroundings surroundings;
        surroundings.environment[name] = value;
        return runIn(surroundings, line);
    }
};

TEST_F(EnvironmentFaults, VectorWidthsThatCrashMesaAreRefused) {
    for (const char *bits : {"0", "1", "64", "100", "127", "1024", "-1", "wide"})
        for (const std::string &line : {small, std::string("devices")}) {
            const Outcome outcome = runWith("LP_NATIVE_VECTOR_WIDTH", bits, line);
            EXPECT_EQ(outcome.exitCode, 2) << outcome;
            EXPECT_TRUE(contains(outcome.errors, "LP_NATIVE_VECTOR_WIDTH: found \"" + std::string(bits) +
                                                     "\"; allowed: 128, 256 or 512"))
                << outcome;
        }
    EXPECT_EQ(runWith("LP_NATIVE_VECTOR_WIDTH", "0", small + " --device cpu").exitCode, 0);
    EXPECT_EQ(runWith("LP_NATIVE_VECTOR_WIDTH", "", small).exitCode, 0);
}

TEST_F(EnvironmentFaults, ThreadsThatOpenMpCannotStartAreNoAnswer) {
    for (const char *count : {"1000000000", "100000"}) {
        const Outcome outcome = runWith("OMP_NUM_THREADS", count, small + " --device cpu");
        EXPECT_EQ(outcome.exitCode, 2) << outcome;
        EXPECT_TRUE(contains(outcome.errors, "OMP_NUM_THREADS: found " + std::string(count))) << outcome;
        EXPECT_EQ(runWith("OMP_NUM_THREADS", count, "--version").exitCode, 0);
    }
    Surroundings surroundings;
    surroundings.environment = {{"OMP_STACKSIZE", "100000G"}, {"OMP_NUM_THREADS", "3"}};
    const Outcome outcome = runIn(surroundings, small + " --device cpu");
    EXPECT_EQ(outcome.exitCode, 5) << outcome;
    EXPECT_TRUE(contains(outcome.errors, "OMP_STACKSIZE")) << outcome;
}

TEST_F(EnvironmentFaults, LittleAddressSpaceIsToldAsMemory) {
    for (const char *kibibytes : {"100000", "200000", "340000"}) {
        const std::string command = "cd '" + folder.string() + "' && ulimit -v " + kibibytes +
                                    " && " HYALITE_PROGRAM " " + small + " 2>errors";
        const int status = std::system(command.c_str());
        EXPECT_EQ(WEXITSTATUS(status), 5) << kibibytes;
        EXPECT_TRUE(contains(load("errors"), "address space")) << load("errors");
        EXPECT_TRUE(contains(load("errors"), "ulimit -v")) << load("errors");
    }
}

TEST_F(EnvironmentFaults, ARelativeCacheFolderIsPassedOver) {
    Surroundings surroundings;
    surroundings.environment = {{"HYALITE_CACHE", std::nullopt},
                                {"XDG_CACHE_HOME", "relative"},
                                {"HOME", (folder / "home").string()},
                                {"MESA_SHADER_CACHE_DISABLE", "true"}};
    EXPECT_EQ(runIn(surroundings, small).exitCode, 0);
    EXPECT_FALSE(entries().contains("relative"));
}

TEST_F(EnvironmentFaults, ADriverFileIsNamedWithItsFault) {
    store("bad.json", "{\n");
    store("empty.json", "{}");
    store("missing.json", R"({"ICD": {"library_path": "./nowhere.so"}})");
    store("text.json", R"({"ICD": {"library_path": "./bad.json"}})");
    for (const auto &[files, fault] : std::vector<std::pair<std::string, std::string>>{
             {"/nonexistent/x.json", "there is no file /nonexistent/x.json"},
             {"bad.json", "bad.json:2:1: syntax error"},
             {"empty.json", "empty.json has no /ICD/library_path"},
             {"missing.json", "nowhere.so: cannot open shared object file"},
             {"text.json", "bad.json: "},
             {"empty.json:bad.json", "bad.json:2:1: syntax error"}})
        for (const auto &[name, other] : {std::pair("VK_DRIVER_FILES", "VK_ICD_FILENAMES"),
                                          std::pair("VK_ICD_FILENAMES", "VK_DRIVER_FILES")}) {
            Surroundings surroundings;
            surroundings.environment = {{name, files}, {other, std::nullopt}};
            const Outcome outcome = runIn(surroundings, small);
            EXPECT_EQ(outcome.exitCode, 4) << outcome;
            for (const std::string &part : {std::string(name) + " is " + files, fault,
                                            std::string("unset the variable"), std::string("--device cpu")})
                EXPECT_TRUE(contains(outcome.errors, part)) << part << '\n' << outcome;
        }
}

TEST_F(EnvironmentFaults, NamesWithControlCharactersStayOnTheirLine) {
    const std::string name = "a\033[31m\nequal, bit for bit\nb.png";
    Surroundings surroundings;
    surroundings.folder = folder;
    const Outcome outcome = runProgram(
        {"render", "spheres", "--device", "cpu", "--width", "16", "--height", "12", "--spp", "1", "-o", name},
        surroundings);
    EXPECT_EQ(outcome.exitCode, 0) << outcome;
    EXPECT_FALSE(contains(outcome.output, "\033")) << outcome;
    EXPECT_FALSE(contains(outcome.output, "\nequal")) << outcome;
}

} // namespace
} // namespace hyalite::core::testing
