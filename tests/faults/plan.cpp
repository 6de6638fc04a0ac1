#include "tests/faults/plan.h"

#include "tests/faults/fault_layer.h"

#include <fmt/format.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <utility>

namespace hyalite::faults {

namespace {

constexpr std::array<std::pair<std::string_view, VkResult>, 6> results{
    {{"VK_TIMEOUT", VK_TIMEOUT},
     {"VK_ERROR_OUT_OF_HOST_MEMORY", VK_ERROR_OUT_OF_HOST_MEMORY},
     {"VK_ERROR_OUT_OF_DEVICE_MEMORY", VK_ERROR_OUT_OF_DEVICE_MEMORY},
     {"VK_ERROR_INITIALIZATION_FAILED", VK_ERROR_INITIALIZATION_FAILED},
     {"VK_ERROR_MEMORY_MAP_FAILED", VK_ERROR_MEMORY_MAP_FAILED},
     {"VK_ERROR_DEVICE_LOST", VK_ERROR_DEVICE_LOST}}};

/// A test that cannot say what it wants has to be mended.
[[noreturn]] void refuse(std::string_view text) {
    fmt::print(stderr, "the fault layer does not understand \"{}\"\n", text);
    std::abort();
}

std::vector<std::string_view> split(std::string_view text, char separator) {
    std::vector<std::string_view> parts;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find(separator), text.size());
        parts.push_back(text.substr(0, end));
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return parts;
}

VkResult resultNamed(std::string_view name) {
    for (const auto &[word, result] : results)
        if (word == name)
            return result;
    refuse(name);
}

Fault readFault(std::string_view text) {
    const std::vector<std::string_view> parts = split(text, ':');
    if (parts.size() != 3)
        refuse(text);
    const long call = std::strtol(std::string(parts[1]).c_str(), nullptr, 10);
    if (call < 1)
        refuse(text);
    return {std::string(parts[0]), call, parts[1].ends_with('+'), resultNamed(parts[2])};
}

/// Writes the tally at the end of the process.
struct Process {
    Plan plan;

    Process() {
        plan.setFaults(fromEnvironment("HYALITE_FAULTS"));
        plan.setFakes(fromEnvironment("HYALITE_FAKES"));
    }
    ~Process() {
        const char *path = std::getenv("HYALITE_FAULT_TALLY");
        std::FILE *file = path != nullptr ? std::fopen(path, "w") : nullptr;
        if (file == nullptr)
            return;
        std::fputs(plan.tally().c_str(), file);
        std::fclose(file);
    }
};

} // namespace

const char *fromEnvironment(const char *name) {
    const char *value = std::getenv(name);
    return value != nullptr ? value : "";
}

void Plan::setFaults(std::string_view text) {
    const std::lock_guard lock(mutex_);
    faults_.clear();
    for (const std::string_view part : split(text, ','))
        faults_.push_back(readFault(part));
    calls_.clear();
    failed_.clear();
    callCount_ = 0;
}

void Plan::setFakes(std::string_view text) {
    const std::lock_guard lock(mutex_);
    fakes_.clear();
    for (const std::string_view word : split(text, ','))
        fakes_.emplace(word);
}

VkResult Plan::countCall(const std::string &function) {
    const std::lock_guard lock(mutex_);
    const long inAll = ++callCount_;
    const long ofFunction = ++calls_[function];
    for (const Fault &fault : faults_) {
        if (fault.function != "*" && fault.function != function)
            continue;
        const long call = fault.function == "*" ? inAll : ofFunction;
        if (call == fault.call || (fault.isLasting && call > fault.call)) {
            failed_.push_back(fmt::format("fault {} {}\n", function, ofFunction));
            return fault.result;
        }
    }
    return VK_SUCCESS;
}

void Plan::countCreated(const std::string &creator) {
    const std::lock_guard lock(mutex_);
    ++alive_[creator];
}

void Plan::countDestroyed(const std::string &creator) {
    const std::lock_guard lock(mutex_);
    --alive_[creator];
}

bool Plan::isFaked(std::string_view word) const {
    const std::lock_guard lock(mutex_);
    return fakes_.contains(word);
}

std::string Plan::tally() const {
    const std::lock_guard lock(mutex_);
    std::string text;
    for (const auto &[function, count] : calls_)
        text += fmt::format("call {} {}\n", function, count);
    for (const std::string &line : failed_)
        text += line;
    for (const auto &[creator, count] : alive_)
        if (count != 0)
            text += fmt::format("alive {} {}\n", creator, count);
    return text;
}

Plan &plan() {
    static Process process;
    return process.plan;
}

} // namespace hyalite::faults

void hyaliteSetFaults(const char *faults) { hyalite::faults::plan().setFaults(faults); }

void hyaliteSetFakes(const char *fakes) { hyalite::faults::plan().setFakes(fakes); }

const char *hyaliteFaultTally() {
    static std::string text;
    text = hyalite::faults::plan().tally();
    return text.c_str();
}

VkResult hyaliteNextFault(const char *function) { return hyalite::faults::plan().countCall(function); }

bool hyaliteIsFaked(const char *fake) { return hyalite::faults::plan().isFaked(fake); }
