// Inputs and outputs of a probed function as words, and how those of the device are compared with the host's.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <bit>
#include <cstdint>
#include <vector>

namespace hyalite::core::testing {

/// The words of one input or output, in the order in which the probe kernel takes or gives them.
class Words {
  public:
    Words &operator<<(std::uint32_t value) {
        words_.push_back({value, false});
        return *this;
    }
    Words &operator<<(bool value) { return *this << std::uint32_t{value}; }
    Words &operator<<(float value) {
        words_.push_back({std::bit_cast<std::uint32_t>(value), true});
        return *this;
    }
    template <int count, class Number> Words &operator<<(const glm::vec<count, Number> &v) {
        for (int i = 0; i < count; ++i)
            *this << v[i];
        return *this;
    }

    struct Word {
        std::uint32_t bits;
        bool isFloat;
    };
    [[nodiscard]] const std::vector<Word> &get() const { return words_; }

    void clear() { words_.clear(); }

  private:
    std::vector<Word> words_;
};

/// Reads an input as the probe kernel does.
class WordReader {
  public:
    explicit WordReader(const std::uint32_t *words) : next_(words) {}

    WordReader &operator>>(std::uint32_t &value) {
        value = *next_++;
        return *this;
    }
    WordReader &operator>>(bool &value) {
        value = *next_++ != 0;
        return *this;
    }
    WordReader &operator>>(float &value) {
        value = std::bit_cast<float>(*next_++);
        return *this;
    }
    template <int count, class Number> WordReader &operator>>(glm::vec<count, Number> &v) {
        for (int i = 0; i < count; ++i)
            *this >> v[i];
        return *this;
    }

  private:
    const std::uint32_t *next_;
};

/// Equal to the bit; but any NaN equals any other, as no standard says which one an operation gives.
[[nodiscard]] inline bool isSame(const Words::Word &expected, std::uint32_t bits) {
    const auto isNan = [](std::uint32_t word) { return (word & 0x7FFFFFFFu) > 0x7F800000u; };
    return expected.bits == bits || (expected.isFloat && isNan(expected.bits) && isNan(bits));
}

} // namespace hyalite::core::testing
