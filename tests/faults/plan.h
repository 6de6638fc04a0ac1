// Which calls fail, and what was called: the layer's only state beside the functions below it.
#pragma once

#include <vulkan/vulkan.h>

#include <map>
#include <mutex>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace hyalite::faults {

struct Fault {
    std::string function; ///< "*": any
    long call;            ///< counted from 1
    bool isLasting;       ///< all calls from then on
    VkResult result;
};

/// Of the whole process: it outlives instances and devices. All functions can be called by several threads.
class Plan {
  public:
    void setFaults(std::string_view text);
    void setFakes(std::string_view text);

    /// Counts a call. VK_SUCCESS where it shall do its work.
    [[nodiscard]] VkResult countCall(const std::string &function);
    void countCreated(const std::string &creator);
    void countDestroyed(const std::string &creator);

    /// Whether the word is among the fakes.
    [[nodiscard]] bool isFaked(std::string_view word) const;
    [[nodiscard]] std::string tally() const;

  private:
    mutable std::mutex mutex_;
    std::vector<Fault> faults_;
    std::set<std::string, std::less<>> fakes_;
    std::map<std::string, long> calls_;
    std::map<std::string, long> alive_;
    std::vector<std::string> failed_;
    long callCount_ = 0;
};

/// The value of a variable, or "".
[[nodiscard]] const char *fromEnvironment(const char *name);

/// From the environment, at first.
[[nodiscard]] Plan &plan();

} // namespace hyalite::faults
