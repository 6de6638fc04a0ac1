#include "tests/faults/flips.h"

#include "tests/faults/plan.h"

#include <algorithm>
#include <cstdlib>
#include <sstream>
#include <utility>

namespace hyalite::faults {

namespace {

constexpr std::size_t wordsOfPixel = 16;

} // namespace

Flips::Flips() {
    const std::string text = fromEnvironment("HYALITE_FLIPS");
    if (text.empty())
        return;
    period_ = std::strtol(text.c_str(), nullptr, 10);
    random_.seed(std::strtoul(text.substr(text.find(':') + 1).c_str(), nullptr, 10));
    std::istringstream names(fromEnvironment("HYALITE_FLIP_BUFFERS"));
    for (std::string name; std::getline(names, name, ',');)
        names_.insert(name);
    log_.open(fromEnvironment("HYALITE_FLIP_LOG"));
}

void Flips::noteBuffer(VkBuffer buffer, std::size_t sizeBytes) {
    const std::lock_guard lock(mutex_);
    buffers_[buffer] = {"", sizeBytes, VK_NULL_HANDLE};
}

void Flips::noteBound(VkBuffer buffer, VkDeviceMemory memory) {
    const std::lock_guard lock(mutex_);
    buffers_[buffer].memory = memory;
}

void Flips::noteMapped(VkDeviceMemory memory, void *address) {
    const std::lock_guard lock(mutex_);
    mapped_[memory] = address;
}

void Flips::noteGone(VkBuffer buffer) {
    const std::lock_guard lock(mutex_);
    if (const auto found = buffers_.find(buffer); found != buffers_.end()) {
        mapped_.erase(found->second.memory);
        buffers_.erase(found);
    }
}

void Flips::noteName(VkObjectType type, std::uint64_t handle, const std::string &name) {
    const std::lock_guard lock(mutex_);
    if (type == VK_OBJECT_TYPE_BUFFER)
        for (auto &[buffer, known] : buffers_)
            if (reinterpret_cast<std::uint64_t>(buffer) == handle)
                known.name = name;
    if (type != VK_OBJECT_TYPE_PIPELINE)
        return;
    comparisons_.erase(handle); // of one that is gone
    if (name.find("compareWords") != std::string::npos)
        comparisons_.insert(handle);
}

void Flips::notePipeline(VkPipeline pipeline) {
    const std::lock_guard lock(mutex_);
    isComparison_ = comparisons_.contains(reinterpret_cast<std::uint64_t>(pipeline));
}

std::uint32_t *Flips::wordsOf(const Buffer &buffer) const {
    const auto found = mapped_.find(buffer.memory);
    return found == mapped_.end() ? nullptr : static_cast<std::uint32_t *>(found->second);
}

void Flips::flip() {
    std::vector<const Buffer *> choices;
    for (const auto &[handle, buffer] : buffers_)
        if (names_.contains(buffer.name) && wordsOf(buffer) != nullptr)
            choices.push_back(&buffer);
    if (choices.empty())
        return;
    std::ranges::sort(choices, {},
                      [](const Buffer *buffer) { return buffer->name; }); // handles are addresses
    const Buffer &buffer = *choices[random_() % choices.size()];
    const std::size_t word = random_() % (buffer.sizeBytes / sizeof(std::uint32_t));
    const std::uint64_t bit = random_() % 32;
    wordsOf(buffer)[word] ^= 1u << bit;
    log_ << "flip " << buffer.name << ' ' << word << ' ' << bit << std::endl;
}

const std::uint32_t *Flips::wordsNamed(std::string_view name) const {
    for (const auto &[handle, buffer] : buffers_)
        if (buffer.name == name && wordsOf(buffer) != nullptr)
            return wordsOf(buffer);
    return nullptr;
}

std::size_t Flips::sizeOf(std::string_view name) const {
    for (const auto &[handle, buffer] : buffers_)
        if (buffer.name == name)
            return buffer.sizeBytes / sizeof(std::uint32_t);
    return 0;
}

void Flips::lookAtFilm() {
    const std::uint32_t *words = wordsNamed("the film");
    const std::uint32_t *expected = wordsNamed("the expected words");
    if (words == nullptr || expected == nullptr || sizeOf("the film") != sizeOf("the expected words"))
        return;
    if (film_.empty()) // before any bit of it flips
        film_.assign(expected, expected + sizeOf("the expected words"));
    const auto difference = std::mismatch(film_.begin(), film_.end(), words).first;
    if (difference == film_.end())
        log_ << "film equal" << std::endl;
    else
        log_ << "film " << static_cast<std::size_t>(difference - film_.begin()) / wordsOfPixel << std::endl;
}

void Flips::beforeSubmission() {
    const std::lock_guard lock(mutex_);
    const bool isComparison = std::exchange(isComparison_, false);
    if (!hasCompared_ && !isComparison)
        return; // it is not known yet how films should be
    const bool isFirst = !std::exchange(hasCompared_, true);
    if (!isFirst && ++submissions_ % period_ == 0)
        flip();
    if (isComparison)
        lookAtFilm();
}

Flips &flips() {
    static Flips all;
    return all;
}

} // namespace hyalite::faults
