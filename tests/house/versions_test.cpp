// The guide's table of versions says what files say.
#include "host/api/version.h"
#include "host/film/checkpoint.h"
#include "host/lab/doctor_json.h"
#include "host/lab/scene_summary_json.h"
#include "host/report/profile_json.h"
#include "tests/house/source_text.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>

namespace hyalite::core::testing {
namespace {

TEST(Versions, InTheGuideAreThoseOfFiles) {
    const std::filesystem::path root = HYALITE_SOURCE_DIR;
    const std::string guide = textOf(root / "host/cli/README.md");
    const auto expectRow = [&](const std::string &what, const std::string &version) {
        EXPECT_NE(guide.find(fmt::format("| {} | {} |", what, version)), std::string::npos)
            << what << ' ' << version;
    };
    expectRow("the program, its options and exit codes", HYALITE_VERSION);
    expectRow("the interface of the library", fmt::format("{}.{}", HYALITE_API_MAJOR, HYALITE_API_MINOR));
    expectRow("checkpoints and parts", std::to_string(checkpointVersion));
    expectRow("reports of `profile`, which are baselines", std::to_string(profileVersion));
    expectRow("documents of `inspect --json`", std::to_string(inspectVersion));
    expectRow("reports of `doctor`", std::to_string(doctorVersion));
    const nlohmann::json films = nlohmann::json::parse(textOf(root / "assets/verify/films.json"));
    expectRow("films of `verify`", films.at("version").dump());
    const std::string sums = textOf(root / "tests/bits/cases.txt");
    const std::string begin = "# The bits of pictures, version ";
    ASSERT_TRUE(sums.starts_with(begin));
    expectRow("sums of pictures", sums.substr(begin.size(), sums.find(':') - begin.size()));
}

} // namespace
} // namespace hyalite::core::testing
