// Doctor: an examination of this machine, its Vulkan devices and the CPU renderer: what can be used, whether the bits are the
// shipped ones, and how fast it is.
#pragma once

#include "host/engine/observer.h"
#include "host/lab/diagnosis.h"
#include "host/lab/machine.h"
#include "host/lab/speed.h"
#include "host/lab/tune.h"

#include <nlohmann/json.hpp>

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace hyalite::core {

/// Shipped films (shipped_films.h) by the kernels that renders choose, as far as there was time.
struct BitsFigure {
    std::size_t renderedCount = 0;
    std::size_t equalCount = 0;
    double seconds = 0.0;
    bool isWhole = false; ///< all films that these kernels render were rendered
    std::vector<std::string> faults{};
};

/// A renderer of this machine.
struct Patient {
    std::string name;             ///< for openBackend(): "cpu" or an index
    nlohmann::ordered_json facts; ///< deviceToJson(), or referenceToJson()
    std::optional<BitsFigure> bits{};
    std::vector<SpeedFigure> speed{};
    std::string failure{}; ///< what ended its examination, such as a driver that crashed; or empty

    [[nodiscard]] bool isVulkan() const { return name != "cpu"; }
    [[nodiscard]] bool isUsable() const { return facts.at("isUsable").get<bool>(); }
    /// Whether it was examined, and failed or has other bits.
    [[nodiscard]] bool isIll() const { return !failure.empty() || (bits && !bits->faults.empty()); }
};

struct ExaminationRequest {
    std::vector<std::string> devices{"all"}; ///< or "cpu", or as gpu::chooseDevice() takes them
    double timeLimitSeconds = 240.0;         ///< for bits and speeds
};

struct Examination {
    Machine machine;
    std::string date;
    int filmsVersion = 0;
    std::vector<Patient> patients;
    std::vector<Finding> findings;
    bool wantsVulkan = false; ///< whether the request has more than the CPU
};

/// Examines; the program has no other thread, and has not opened a device. Whatever loads a driver runs in a process of its
/// own (`runApart`), as drivers may crash. Throws Error{NoDevice} for a device that is named and not there, and
/// Error{BadInput} if shipped files are missing.
[[nodiscard]] Examination examine(const ExaminationRequest &request, Observer &observer,
                                  const RunApart &runApart);

} // namespace hyalite::core
