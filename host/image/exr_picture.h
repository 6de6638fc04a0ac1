// An OpenEXR file as a whole: all channels, texts and options, so that it can be written again with other colours.
#pragma once

#include "host/base/input_file.h"
#include "host/image/attribute.h"
#include "host/image/crop.h"
#include "host/image/exr_options.h"
#include "host/image/picture.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hyalite::core {

/// Row by row from the top left.
struct ExrChannel {
    std::string name;                         ///< with that of its layer: "variance.R"
    std::vector<float> values{};              ///< empty if they are whole numbers
    std::vector<std::uint32_t> wholeValues{}; ///< or those
    bool isHalf = false;                      ///< stored as 16-bit floats
};

struct ExrPicture {
    int wholeWidth = 0; ///< of the display window
    int wholeHeight = 0;
    Crop crop{}; ///< the data window, in the display window
    std::vector<ExrChannel> channels{};
    std::vector<Attribute> attributes{}; ///< those that are texts
    std::optional<Projection> projection{};
    ExrOptions options{}; ///< as its colours are stored

    /// Null: it has none of the name.
    [[nodiscard]] const ExrChannel *find(std::string_view name) const {
        const auto channel = std::ranges::find(channels, name, &ExrChannel::name);
        return channel != channels.end() ? &*channel : nullptr;
    }
};

/// Reads a file of one part, whose data window is inside the display window. Throws as readExr() does.
[[nodiscard]] ExrPicture readExrPicture(const InputFile &file);

/// The layers of a picture of such a file: each channel but those of the colours and of alpha. `picture` must outlive
/// them.
[[nodiscard]] std::vector<Layer> layersOf(const ExrPicture &picture);

} // namespace hyalite::core
