#include "host/process/lavapipe.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <optional>
#include <set>
#include <string>

namespace hyalite::core {
namespace {

constexpr const char *width = "LP_NATIVE_VECTOR_WIDTH";
constexpr const char *flags = "GALLIVM_PERF";

/// Of this process, as they were before.
class Variable {
  public:
    explicit Variable(const char *name) : name_(name) {
        if (const char *value = std::getenv(name))
            before_ = value;
    }
    ~Variable() {
        if (before_)
            setenv(name_, before_->c_str(), 1);
        else
            unsetenv(name_);
    }
    Variable(const Variable &) = delete;
    Variable &operator=(const Variable &) = delete;

  private:
    const char *name_;
    std::optional<std::string> before_;
};

TEST(Lavapipe, KeepsCompiledFunctionsOfWidthsApart) {
    const Variable widthBefore(width);
    const Variable flagsBefore(flags);
    setenv(flags, "nopt", 1);
    std::set<std::string> found;
    for (const char *bits : {"128", "256", "512"}) {
        setenv(width, bits, 1);
        keepWidthsApart();
        const std::string once = std::getenv(flags);
        EXPECT_TRUE(once.starts_with("nopt,")) << once;
        keepWidthsApart();
        EXPECT_EQ(std::getenv(flags), once);
        found.insert(once);
    }
    EXPECT_EQ(found.size(), 3u) << ::testing::PrintToString(found);
    unsetenv(width); // as 256: the driver's own choice
    keepWidthsApart();
    EXPECT_EQ(std::string(std::getenv(flags)), "nopt,");
    unsetenv(flags);
    keepWidthsApart();
    EXPECT_EQ(std::getenv(flags), nullptr);
}

} // namespace
} // namespace hyalite::core
