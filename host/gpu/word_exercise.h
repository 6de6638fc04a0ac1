// Exercises of a device with words that are known: as much of its memory as wanted, and its arithmetic.
#pragma once

#include "host/gpu/word_comparison.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace hyalite::core::gpu {

/// A word that was wrong, and where.
struct WrongMemory {
    std::uint64_t word = 0; ///< counted from 0 over all buffers
    std::uint32_t found = 0;
    std::uint32_t expected = 0;
};

/// One pass: all words written, and compared.
struct WordPass {
    std::uint64_t wordCount = 0;
    std::uint64_t wrongCount = 0;
    std::vector<WrongMemory> wrong{}; ///< some of them, sorted
    double fillSeconds = 0.0;
    double compareSeconds = 0.0;
};

/// Kinds of exercise: rounds of arithmetic for each word that is written.
enum class WordWork { Memory, Arithmetic };

/// A device of its own and its buffers, as long as it lives.
class WordExercise {
  public:
    /// Memory: takes pieces until `maxBytes` or the device's limit is reached, a piece at least. Arithmetic: takes as
    /// many words as a tenth of a second is enough for. Throws as Device, Buffer and Pipeline do.
    WordExercise(const DeviceInfo &info, WordWork work, std::uint64_t maxBytes);

    [[nodiscard]] std::uint64_t sizeBytes() const;
    [[nodiscard]] std::uint32_t rounds() const { return rounds_; }

    /// Other words at other addresses for each number. Ends early, with what was compared, once `shouldStop` returns
    /// true. Throws DeviceFault.
    [[nodiscard]] WordPass run(std::uint64_t number, const std::function<bool()> &shouldStop = {});

  private:
    void fill(const Buffer &buffer, std::uint32_t wordCount, std::uint32_t offset, std::uint32_t mask);
    void takeMemory(std::uint64_t maxBytes);
    void takeTenthOfSecond();

    Device device_;
    std::uint32_t rounds_;
    std::uint32_t period_;
    std::optional<ExpectedWords> expected_;
    std::shared_ptr<Pipeline> filling_;
    Buffer task_;
    std::vector<Buffer> buffers_;
    std::uint32_t wordsAtOnce_ = 0; ///< of each buffer, which has as many or more
};

/// The words that an exercise compares with: wordOf() of 0, 1, ..., by this machine's processor.
[[nodiscard]] std::vector<std::uint32_t> knownWords(std::uint32_t count, std::uint32_t rounds);

/// Bytes that an exercise may take of a device: four fifths of its memory, or a quarter of what the host has left where
/// the device shares it; 256 MiB of a software device, which takes seconds for them.
[[nodiscard]] std::uint64_t exercisableBytes(const DeviceInfo &device);

} // namespace hyalite::core::gpu
