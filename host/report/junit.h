// JUnit XML: what was tested, as CI systems read it.
#pragma once

#include <span>
#include <string>
#include <vector>

namespace hyalite::core {

struct TestCase {
    std::string group; ///< "classname": what is tested
    std::string name;
    double seconds = 0.0;
    std::string failure{}; ///< empty: it passed
    std::string skipped{}; ///< why it was not run
};

struct TestSuite {
    std::string name;
    std::vector<TestCase> cases;
};

/// Texts may be any bytes. `name` is that of all suites.
[[nodiscard]] std::string junitText(const std::string &name, std::span<const TestSuite> suites);

} // namespace hyalite::core
