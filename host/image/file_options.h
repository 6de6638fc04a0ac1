// Options of picture files: what a request says of the file, and not of the samples.
#pragma once

#include "host/image/exr_options.h"
#include "host/image/tone_map.h"

#include <optional>

namespace hyalite::core {

struct FileOptions {
    ToneCurve tone = ToneCurve::Gamma; ///< of a PNG
    ExrOptions exr{};                  ///< of an EXR
};

/// The same as it is asked for: what is empty is the default.
struct FileRequest {
    std::optional<ToneCurve> tone{};
    bool isHalf = false;
    std::optional<ExrCompression> compression{};

    [[nodiscard]] FileOptions options() const {
        return {tone.value_or(FileOptions().tone), {isHalf, compression.value_or(ExrOptions().compression)}};
    }
};

} // namespace hyalite::core
