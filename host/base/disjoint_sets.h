// Sets of numbers that are joined until no more belong together.
#pragma once

#include <cstddef>
#include <numeric>
#include <vector>

namespace hyalite::core {

/// Of the numbers 0 to count - 1, each at first in a set of its own.
class DisjointSets {
  public:
    explicit DisjointSets(std::size_t count) : parents_(count) {
        std::iota(parents_.begin(), parents_.end(), std::size_t{0});
    }
    /// The number that stands for the set of `i`.
    std::size_t rootOf(std::size_t i) {
        while (parents_[i] != i)
            i = parents_[i] = parents_[parents_[i]];
        return i;
    }
    /// The root of a's set stands for both.
    void join(std::size_t a, std::size_t b) { parents_[rootOf(b)] = rootOf(a); }

  private:
    std::vector<std::size_t> parents_;
};

} // namespace hyalite::core
