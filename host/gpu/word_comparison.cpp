#include "host/gpu/word_comparison.h"

#include "shaders/embedded_kernels.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace hyalite::core::gpu {

namespace {

constexpr std::uint32_t wordGroupSize = 64;
constexpr std::uint32_t maxGroups = 1u << 14;

struct Record {
    layout::WordTask task;
    std::array<layout::WrongWord, layout::maxWrongWords> wrong;
};

constexpr std::array<BufferUse, 3> uses{BufferUse::Storage, BufferUse::Storage, BufferUse::Counters};

} // namespace

std::uint32_t wordGroups(std::uint32_t count, const DeviceInfo &device) {
    const std::uint32_t most = std::min(maxGroups, device.maxWorkgroupCount);
    return std::clamp((count + wordGroupSize - 1) / wordGroupSize, 1u, most);
}

ExpectedWords::ExpectedWords(Device &device, std::span<const std::uint32_t> words)
    : device_(device), period_(static_cast<std::uint32_t>(words.size())),
      expected_(device, "the expected words", BufferUse::Storage, words.size_bytes()),
      task_(device, "the record of a comparison", BufferUse::Counters, sizeof(Record)),
      pipeline_(std::make_shared<Pipeline>(device, "compareWords", embeddedKernel("compareWords"),
                                           std::span<const std::uint32_t>(), uses)) {
    replace(words);
}

WordDifferences ExpectedWords::compare(const Buffer &buffer, std::uint32_t wordCount, std::uint32_t offset,
                                       std::uint32_t mask) {
    Record record{};
    record.task = {wordCount, period_, offset, mask, 0, 0, layout::noWord, 0};
    task_.upload(std::as_bytes(std::span(&record, 1)));
    const std::array<const Buffer *, 3> bound{&buffer, &expected_, &task_};
    Kernel(device_, pipeline_, bound).run({}, wordGroups(wordCount, device_.info()));
    task_.download(std::as_writable_bytes(std::span(&record, 1)));
    const auto recorded = std::min<std::ptrdiff_t>(record.task.recordedCount, layout::maxWrongWords);
    return {record.task.wrongCount, {record.wrong.begin(), record.wrong.begin() + recorded}};
}

} // namespace hyalite::core::gpu
