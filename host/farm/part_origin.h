// Origin of a part: who made it, and how it is made again.
#pragma once

#include "host/film/partition.h"
#include "host/image/picture.h"
#include "host/scene/settings.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hyalite::core {

struct PartLayer {
    Integrator view;
    std::vector<std::string> names{}; ///< of a view of numbers, from 1 on
    bool isOfDenoiser = false;        ///< after the others
};

struct PartOrigin {
    std::string host;               ///< name of the machine
    std::string folder;             ///< in which the command ran
    std::vector<std::string> words; ///< of the command line, the program first
    int wholeWidth = 0;             ///< of the picture that the crop is of, in pixels
    int wholeHeight = 0;
    std::vector<PartLayer> layers;
    std::vector<std::string> lightPlanes; ///< of the film
    std::optional<Projection> projection; ///< of the camera; none of a panorama, nor of older parts
    std::string provenance;               ///< of the render, with its device, as JSON

    // Read from the provenance.
    Integrator integrator = Integrator::Whitted;
    double exposureStops = 0.0;
    bool hasAlpha = false;
    bool areLayersThrough = false;
    bool isDenoised = false;
    std::string device; ///< its name and driver: "llvmpipe, Mesa 22.3.6"

    [[nodiscard]] std::vector<Integrator> views() const; ///< of the layers, but those of the denoiser
    /// "node7 (llvmpipe, Mesa 22.3.6)".
    [[nodiscard]] std::string maker() const;
};

[[nodiscard]] std::string hostName();

/// JSON.
[[nodiscard]] std::string toText(const PartOrigin &origin);

/// The opposite of toText. Throws Error{BadInput} for other text.
[[nodiscard]] PartOrigin readPartOrigin(std::string_view text);

} // namespace hyalite::core
