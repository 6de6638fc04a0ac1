#include "host/base/quantities.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

namespace hyalite::core {

namespace {

/// A value below `step`, and the number of divisions by `step` that led to it.
struct Scaled {
    double value;
    std::size_t power = 0;
};

Scaled scale(std::uint64_t count, double step, std::size_t greatestPower) {
    Scaled scaled{static_cast<double>(count)};
    for (; scaled.value >= step && scaled.power < greatestPower; ++scaled.power)
        scaled.value /= step;
    return scaled;
}

} // namespace

std::string durationText(double seconds) {
    const long whole = std::lround(seconds);
    if (whole < 60)
        return fmt::format("{} s", whole);
    if (whole < 3600)
        return fmt::format("{} min {:02} s", whole / 60, whole % 60);
    return fmt::format("{} h {:02} min", whole / 3600, whole % 3600 / 60);
}

std::string roundedText(std::uint64_t count, std::string_view plural) {
    constexpr std::array<std::string_view, 5> prefixes{"", "k ", "M ", "G ", "T "};
    const auto [value, power] = scale(count, 1000.0, prefixes.size() - 1);
    const int decimals = power == 0 || value >= 100.0 ? 0 : value >= 10.0 ? 1 : 2;
    return fmt::format("{:.{}f} {}{}", value, decimals, prefixes[power], plural);
}

std::string percentText(double share) { return fmt::format("{:.3g} %", 100.0 * share); }

std::string sizeText(std::uint64_t bytes) {
    constexpr std::array<std::string_view, 5> units{"bytes", "KiB", "MiB", "GiB", "TiB"};
    const auto [value, power] = scale(bytes, 1024.0, units.size() - 1);
    return fmt::format("{:.{}f} {}", value, power == 0 ? 0 : 1, units[power]);
}

std::string countText(std::uint64_t count, std::string_view singular, std::string_view plural) {
    return fmt::format("{} {}", count, count == 1 ? singular : plural);
}

std::string countText(std::uint64_t count, std::string_view singular) {
    return countText(count, singular, fmt::format("{}s", singular));
}

} // namespace hyalite::core
