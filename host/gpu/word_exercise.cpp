#include "host/gpu/word_exercise.h"

#include "host/base/error.h"
#include "host/base/host_memory.h"
#include "host/film/timeline.h"
#include "shaders/embedded_kernels.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

namespace hyalite::core::gpu {

namespace {

// Primes.
constexpr std::uint32_t memoryPeriod = 1'048'573;
constexpr std::uint32_t arithmeticPeriod = 4093;

constexpr std::uint32_t memoryRounds = 1;
constexpr std::uint32_t arithmeticRounds = 2048;
constexpr std::uint64_t maxPieceBytes = std::uint64_t{1} << 30;
constexpr std::uint64_t maxSoftwareBytes = std::uint64_t{1} << 28;
constexpr std::uint32_t minWords = 1u << 14;
constexpr std::uint32_t maxArithmeticWords = 1u << 24;
constexpr double enoughSeconds = 0.1;
constexpr std::array<std::uint32_t, 4> masks{0u, ~0u, 0x55555555u, 0xAAAAAAAAu};
constexpr std::array<BufferUse, 2> fillUses{BufferUse::Storage, BufferUse::Counters};

} // namespace

std::vector<std::uint32_t> knownWords(std::uint32_t count, std::uint32_t rounds) {
    std::vector<std::uint32_t> words(count);
    for (std::uint32_t i = 0; i < count; ++i)
        words[i] = layout::wordOf(i, rounds);
    return words;
}

std::uint64_t exercisableBytes(const DeviceInfo &device) {
    if (!device.isSoftware() && device.type != DeviceType::Integrated)
        return device.deviceMemoryBytes / 5 * 4;
    const std::uint64_t quarter =
        std::min(device.deviceMemoryBytes, availableHostBytes().value_or(device.deviceMemoryBytes)) / 4;
    return device.isSoftware() ? std::min(quarter, maxSoftwareBytes) : quarter;
}

WordExercise::WordExercise(const DeviceInfo &info, WordWork work, std::uint64_t maxBytes)
    : device_(info), rounds_(work == WordWork::Memory ? memoryRounds : arithmeticRounds),
      period_(work == WordWork::Memory ? memoryPeriod : arithmeticPeriod),
      filling_(std::make_shared<Pipeline>(device_, "fillWords", embeddedKernel("fillWords"),
                                          std::span<const std::uint32_t>(), fillUses)),
      task_(device_, "the task of an exercise", BufferUse::Counters, sizeof(layout::WordTask)) {
    expected_.emplace(device_, knownWords(period_, rounds_));
    work == WordWork::Memory ? takeMemory(maxBytes) : takeTenthOfSecond();
}

void WordExercise::takeMemory(std::uint64_t maxBytes) {
    const std::uint64_t most =
        std::min({maxPieceBytes, maxBufferBytes(BufferUse::Storage, device_.info()), maxBytes});
    wordsAtOnce_ = std::max(static_cast<std::uint32_t>(most / sizeof(std::uint32_t)), minWords);
    const std::size_t pieceBytes = std::size_t{wordsAtOnce_} * sizeof(std::uint32_t);
    do {
        try {
            buffers_.emplace_back(device_, "exercised memory", BufferUse::Storage, pieceBytes);
        } catch (const Error &) { // others have the rest
            if (buffers_.empty())
                throw;
            return;
        }
    } while (sizeBytes() + pieceBytes <= maxBytes);
}

void WordExercise::takeTenthOfSecond() {
    buffers_.emplace_back(device_, "results of an exercise", BufferUse::Storage,
                          std::size_t{maxArithmeticWords} * sizeof(std::uint32_t));
    wordsAtOnce_ = minWords;
    fill(buffers_.front(), wordsAtOnce_, 0, 0); // drivers compile now
    for (Stopwatch watch; wordsAtOnce_ < maxArithmeticWords; wordsAtOnce_ *= 2) {
        fill(buffers_.front(), wordsAtOnce_, 0, 0);
        if (watch.lap().seconds() >= enoughSeconds / 2.0)
            return;
    }
}

std::uint64_t WordExercise::sizeBytes() const {
    return std::accumulate(buffers_.begin(), buffers_.end(), std::uint64_t{0},
                           [](std::uint64_t sum, const Buffer &buffer) { return sum + buffer.sizeBytes(); });
}

void WordExercise::fill(const Buffer &buffer, std::uint32_t wordCount, std::uint32_t offset,
                        std::uint32_t mask) {
    const layout::WordTask task{wordCount, period_, offset, mask, rounds_, 0, layout::noWord, 0};
    task_.upload(std::as_bytes(std::span(&task, 1)));
    const std::array<const Buffer *, 2> bound{&buffer, &task_};
    Kernel(device_, filling_, bound).run({}, wordGroups(wordCount, device_.info()));
}

WordPass WordExercise::run(std::uint64_t number, const std::function<bool()> &shouldStop) {
    const auto offsetOf = [&](std::size_t buffer) {
        return static_cast<std::uint32_t>((number * 7919 + buffer * 104'729) % period_);
    };
    const std::uint32_t mask = masks[number % masks.size()];
    WordPass pass;
    Stopwatch watch;
    // All is written before any of it is compared: a word that changes later is found, too.
    for (std::size_t i = 0; i < buffers_.size(); ++i) {
        if (shouldStop && shouldStop())
            return pass;
        fill(buffers_[i], wordsAtOnce_, offsetOf(i), mask);
    }
    pass.fillSeconds = watch.lap().seconds();
    std::uint64_t first = 0;
    for (std::size_t i = 0; i < buffers_.size(); ++i) {
        if (shouldStop && shouldStop())
            break;
        const WordDifferences differences = expected_->compare(buffers_[i], wordsAtOnce_, offsetOf(i), mask);
        pass.wordCount += wordsAtOnce_;
        pass.wrongCount += differences.count;
        for (const layout::WrongWord &word : differences.words)
            pass.wrong.push_back({first + word.index, word.found, word.expected});
        first += wordsAtOnce_;
    }
    pass.compareSeconds = watch.lap().seconds();
    std::ranges::sort(pass.wrong, {}, &WrongMemory::word);
    return pass;
}

} // namespace hyalite::core::gpu
