#include "tests/random/shrink.h"

#include <chrono>
#include <string>
#include <utility>
#include <vector>

namespace hyalite::core::testing {
namespace {

using nlohmann::json;
using Clock = std::chrono::steady_clock;

class Shrinker {
  public:
    Shrinker(json document, const std::function<bool(const json &)> &isFaulty, double maxSeconds)
        : document_(std::move(document)), isFaulty_(isFaulty),
          end_(Clock::now() +
               std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(maxSeconds))) {}

    json run() {
        do
            hasChanged_ = false;
        while (visit(document_), hasChanged_ && Clock::now() < end_);
        return std::move(document_);
    }

  private:
    /// Gives the node of the document another value, and keeps it if the fault remains.
    bool tryValue(json &node, json value) {
        if (value == node || Clock::now() >= end_)
            return false;
        std::swap(node, value);
        if (isFaulty_(document_))
            return hasChanged_ = true;
        std::swap(node, value);
        return false;
    }

    void removeMembers(json &node) {
        std::vector<std::string> keys;
        for (const auto &[key, value] : node.items())
            keys.push_back(key);
        for (const std::string &key : keys) {
            json without = node;
            without.erase(key);
            tryValue(node, std::move(without));
        }
    }

    void removeElements(json &node) {
        for (std::size_t count = node.size(); count > 0; count /= 2)
            for (std::size_t first = 0; first + count <= node.size();) {
                json without = node;
                const auto begin = without.begin() + static_cast<std::ptrdiff_t>(first);
                without.erase(begin, begin + static_cast<std::ptrdiff_t>(count));
                if (!tryValue(node, std::move(without)))
                    first += count;
            }
    }

    void visit(json &node) {
        if (node.is_object())
            removeMembers(node);
        else if (node.is_array())
            removeElements(node);
        else if (node.is_number() && node != 0)
            static_cast<void>(tryValue(node, 0) || tryValue(node, 1));
        if (node.is_structured())
            for (json &child : node)
                visit(child);
    }

    json document_;
    const std::function<bool(const json &)> &isFaulty_;
    Clock::time_point end_;
    bool hasChanged_ = false;
};

} // namespace

json shrunk(json document, const std::function<bool(const json &)> &isFaulty, double maxSeconds) {
    return Shrinker(std::move(document), isFaulty, maxSeconds).run();
}

} // namespace hyalite::core::testing
