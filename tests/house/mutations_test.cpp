// The faults of tests/mutation/mutations.txt can be planted: each text is in its file.
#include "tests/house/source_text.h"

#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <vector>

namespace hyalite::core::testing {
namespace {

std::string trimmed(const std::string &text) {
    const std::size_t begin = text.find_first_not_of(" \t");
    return begin == std::string::npos ? "" : text.substr(begin, text.find_last_not_of(" \t") + 1 - begin);
}

/// Between `|`, of which `\|` is none.
std::vector<std::string> fieldsOf(const std::string &line) {
    std::vector<std::string> fields(1);
    for (std::size_t i = 0; i < line.size(); ++i)
        if (line[i] == '|')
            fields.emplace_back();
        else
            fields.back() += line.compare(i, 2, "\\|") == 0 ? line[++i] : line[i];
    for (std::string &field : fields)
        field = trimmed(field);
    return fields;
}

TEST(Mutations, CanBePlanted) {
    const std::string root = std::string(HYALITE_SOURCE_DIR) + "/";
    std::istringstream lines(textOf(root + "tests/mutation/mutations.txt"));
    int faultCount = 0;
    for (std::string line; std::getline(lines, line);) {
        if (line.empty() || line[0] == '#')
            continue;
        ++faultCount;
        const std::vector<std::string> fields = fieldsOf(line);
        for (std::size_t i = 0; i + 1 < fields.size(); i += 3)
            EXPECT_NE(textOf(root + fields[i]).find(fields[i + 1]), std::string::npos)
                << "fault " << faultCount << ": " << fields[i] << " does not contain: " << fields[i + 1];
    }
    EXPECT_GT(faultCount, 100);
}

} // namespace
} // namespace hyalite::core::testing
