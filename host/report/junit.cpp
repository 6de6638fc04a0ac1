#include "host/report/junit.h"

#include "host/base/markup.h"

#include <fmt/format.h>

#include <algorithm>

namespace hyalite::core {

namespace {

std::string caseText(const TestCase &test) {
    const std::string text = fmt::format("    <testcase classname=\"{}\" name=\"{}\" time=\"{:.3f}\"",
                                         markupText(test.group), markupText(test.name), test.seconds);
    const auto closed = [&](std::string_view outcome, const std::string &why) {
        return text +
               fmt::format(">\n      <{} message=\"{}\"/>\n    </testcase>\n", outcome, markupText(why));
    };
    if (!test.skipped.empty())
        return closed("skipped", test.skipped);
    return test.failure.empty() ? text + "/>\n" : closed("failure", test.failure);
}

} // namespace

std::string junitText(const std::string &name, std::span<const TestSuite> suites) {
    std::string text = fmt::format("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"{}\">\n",
                                   markupText(name));
    for (const TestSuite &suite : suites) {
        double seconds = 0.0;
        for (const TestCase &test : suite.cases)
            seconds += test.seconds;
        const auto count = [&](std::string TestCase::*member) {
            return std::ranges::count_if(suite.cases,
                                         [&](const TestCase &test) { return !(test.*member).empty(); });
        };
        text += fmt::format("  <testsuite name=\"{}\" tests=\"{}\" failures=\"{}\" skipped=\"{}\" "
                            "errors=\"0\" time=\"{:.3f}\">\n",
                            markupText(suite.name), suite.cases.size(), count(&TestCase::failure),
                            count(&TestCase::skipped), seconds);
        for (const TestCase &test : suite.cases)
            text += caseText(test);
        text += "  </testsuite>\n";
    }
    return text + "</testsuites>\n";
}

} // namespace hyalite::core
