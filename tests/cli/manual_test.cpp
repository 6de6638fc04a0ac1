// The manual page and the completion of bash, which the build installs.
#include "tests/cli/command_line.h"

#include <cstdlib>
#include <regex>
#include <set>
#include <sstream>
#include <string>

namespace hyalite::core::testing {
namespace {

class Manual : public CommandLine {
  protected:
    /// Standard output of a command that succeeds.
    [[nodiscard]] std::string printed(const std::string &line) const {
        const Outcome outcome = run(line);
        EXPECT_EQ(outcome.exitCode, 0) << outcome;
        return outcome.output;
    }
    /// The completions of a line, whose last word is not finished.
    [[nodiscard]] std::string completed(const std::string &words, int last) const {
        store("completion.bash", printed("--bash-completion"));
        const std::string script = ". ./completion.bash; COMP_WORDS=(" + words +
                                   "); COMP_CWORD=" + std::to_string(last) +
                                   "; _hyalite; echo \"${COMPREPLY[@]}\" >found";
        const std::string command = "cd '" + folder.string() + "' && bash -c '" + script + "'";
        EXPECT_EQ(std::system(command.c_str()), 0) << command;
        return load("found");
    }
};

TEST_F(Manual, HasEveryOptionOfEveryCommand) {
    const std::string page = printed("--manual-page");
    const std::string completion = printed("--bash-completion");
    EXPECT_TRUE(page.starts_with(".TH HYALITE 1 "));
    for (const char *part : {".SS \"render\"", ".SS \"verify\"", "\\-\\-checkpoint\\-interval SECONDS",
                             "\\-o,\\-\\-output FILE", ".SH EXIT STATUS", "stopped by SIGHUP"})
        EXPECT_TRUE(contains(page, part)) << part;
    for (const char *command : {"render", "compare", "verify", "profile", "devices", "doctor", "inspect",
                                "denoise", "diff", "tonemap"}) {
        const std::string help = printed(std::string(command) + " --help");
        std::size_t count = 0;
        const std::regex option("(^|\\n)  (-\\w,)?(--[a-z-]+)");
        for (auto found = std::sregex_iterator(help.begin(), help.end(), option);
             found != std::sregex_iterator(); ++found) {
            const std::string name = (*found)[3];
            EXPECT_TRUE(contains(page, std::regex_replace(name, std::regex("-"), "\\-")))
                << command << ' ' << name;
            EXPECT_TRUE(contains(completion, name)) << command << ' ' << name;
            ++count;
        }
        EXPECT_GE(count, 1u) << command;
    }
}

TEST_F(Manual, LinesAreNoCommandsOfRoffByChance) {
    std::istringstream lines(printed("--manual-page"));
    for (std::string line; std::getline(lines, line);) {
        if (!line.starts_with('.'))
            continue;
        const std::string macro = line.substr(1, line.find(' ') - 1);
        EXPECT_TRUE((std::set<std::string>{"TH", "SH", "SS", "TP", "PP", "B", "I"}).contains(macro)) << line;
    }
}

TEST_F(Manual, BashCompletesCommandsOptionsAndWords) {
    EXPECT_EQ(completed("hyalite ve", 1), "verify\n");
    EXPECT_EQ(completed("hyalite render --checkpoint-", 2), "--checkpoint-interval\n");
    EXPECT_EQ(completed("hyalite render spheres --tone a", 4), "aces agx\n");
    store("sphinx.json", "");
    EXPECT_EQ(completed(HYALITE_PROGRAM " render sph", 2), "spheres spheres-nested sphinx.json\n");
    EXPECT_EQ(completed("hyalite diff sphe", 2), "\n") << "files are left to bash";
}

} // namespace
} // namespace hyalite::core::testing
