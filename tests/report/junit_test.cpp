// JUnit XML, read by the parser of another program.
#include "host/report/junit.h"

#include "tests/fixtures/temporary_folder.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cstdio>
#include <filesystem>
#include <fstream>

namespace hyalite::core {
namespace {

/// Elements as arrays of name, attributes and children, by Python's parser. Null: it is not well-formed.
nlohmann::json parsed(const std::string &xml) {
    const testing::TemporaryFolder folder;
    const std::filesystem::path file = folder.path / "junit.xml";
    std::ofstream(file) << xml;
    const std::string program =
        "import json, sys, xml.etree.ElementTree as tree\n"
        "as_list = lambda node: [node.tag, node.attrib, [as_list(part) for part in node]]\n"
        "print(json.dumps(as_list(tree.parse(sys.argv[1]).getroot())))\n";
    FILE *const pipe = popen(fmt::format("python3 -c '{}' '{}' 2>&1", program, file.string()).c_str(), "r");
    std::string text;
    for (int letter = 0; (letter = std::fgetc(pipe)) != EOF;)
        text += static_cast<char>(letter);
    EXPECT_EQ(pclose(pipe), 0) << text;
    return nlohmann::json::parse(text, nullptr, false);
}

TEST(Junit, HasASuiteOfCasesWithTheirOutcomes) {
    const std::vector<TestSuite> suites{{"a device",
                                         {{"group", "passes", 1.25},
                                          {"group", "fails", 0.5, "it differs"},
                                          {"group", "waits", 0.0, "", "no"}}},
                                        {"another", {}}};
    EXPECT_EQ(parsed(junitText("all", suites)), nlohmann::json::parse(R"(
        ["testsuites", {"name": "all"}, [
            ["testsuite", {"name": "a device", "tests": "3", "failures": "1", "skipped": "1", "errors": "0",
                           "time": "1.750"}, [
                ["testcase", {"classname": "group", "name": "passes", "time": "1.250"}, []],
                ["testcase", {"classname": "group", "name": "fails", "time": "0.500"},
                    [["failure", {"message": "it differs"}, []]]],
                ["testcase", {"classname": "group", "name": "waits", "time": "0.000"},
                    [["skipped", {"message": "no"}, []]]]]],
            ["testsuite", {"name": "another", "tests": "0", "failures": "0", "skipped": "0", "errors": "0",
                           "time": "0.000"}, []]]])"));
}

TEST(Junit, IsWellFormedForAnyNames) {
    std::string any;
    for (int byte = 0; byte < 256; ++byte)
        any += static_cast<char>(byte);
    for (const std::string &name :
         {any, std::string("]]><!--&amp;<a b='c'>\ufffe\uffff\u202e"), std::string("")}) {
        const std::vector<TestSuite> suites{{name, {{name, name, 0.0, name + "!"}}}};
        const nlohmann::json suite = parsed(junitText(name, suites)).at(2).at(0);
        EXPECT_EQ(suite.at(2).at(0).at(2).at(0).at(0), "failure");
        EXPECT_EQ(suite.at(1).at("name").get<std::string>().find('\x1b'), std::string::npos);
    }
}

} // namespace
} // namespace hyalite::core
