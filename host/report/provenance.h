// Provenance: the origin of a picture or a report, as all files state it.
#pragma once

#include "host/image/attribute.h"
#include "host/scene/settings.h"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace hyalite::core {

/// The renderer.
struct RendererIdentity {
    std::string name;             ///< "cpu", or the name of the device
    std::string driver;           ///< name and version
    std::string arithmetic;       ///< division and square root
    std::string equalBits;        ///< "promised", or how sure they are, with the reason
    std::string kernel;           ///< empty for the reference renderer
    std::uint64_t kernelHash = 0; ///< of its SPIR-V for all scenes and devices
};

/// The render.
struct Provenance {
    std::string commandLine;
    std::string scene;           ///< path of the file
    std::uint64_t sceneHash = 0; ///< PackedScene::contentHash()
    std::size_t triangleCount = 0;
    glm::dvec3 coordinateOrigin{0.0}; ///< Scene::origin
    int width = 0;                    ///< of the output, pixels
    int height = 0;
    RenderSettings settings;
};

/// The program and its command line: the beginning of every report.
[[nodiscard]] nlohmann::ordered_json programToJson(const std::string &commandLine);
/// The same, with the render and the renderer.
[[nodiscard]] nlohmann::ordered_json provenanceToJson(const Provenance &provenance);
[[nodiscard]] nlohmann::ordered_json provenanceToJson(const Provenance &provenance,
                                                      const RendererIdentity &device);
[[nodiscard]] nlohmann::ordered_json rendererToJson(const RendererIdentity &renderer);

/// The same as attributes of an image file: each value by its path, as "device.driver", and the program as "software".
/// Texts are clean: names may have control characters.
[[nodiscard]] std::vector<Attribute> attributesOf(const nlohmann::ordered_json &provenance);

/// Whether a provenance, as a file has it, has no other attributes than those above: files would take some names for
/// their own, such as "tiles" in OpenEXR.
[[nodiscard]] bool hasKnownAttributes(const nlohmann::ordered_json &provenance);

} // namespace hyalite::core
