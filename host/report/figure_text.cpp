#include "host/report/figure_text.h"

#include <fmt/format.h>

namespace hyalite::core {

std::string millisText(double millis) {
    return fmt::format("{:.{}f}", millis, millis < 10.0 ? 3 : millis < 1000.0 ? 1 : 0);
}

std::string shareText(double share) { return fmt::format("{:.1f} %", share * 100.0); }

} // namespace hyalite::core
