// Lights of a glTF file (KHR_lights_punctual, EXT_lights_ies).
#pragma once

#include "host/import/file_access.h"
#include "host/import/gltf/buffers.h"
#include "host/import/gltf/document.h"
#include "host/import/profile_library.h"
#include "host/scene/scene.h"

#include <glm/mat4x3.hpp>

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hyalite::core::gltf {

/// The element of the `lights` of the extension `name` that its use, in a node or a scene, refers to. Throws
/// Error{BadInput} for one that is not there.
[[nodiscard]] JsonNode lightOf(const Document &document, const JsonObject &use, std::string_view name);

/// The light of a node, where its map to the world brings it; nothing for a node without one. Candela and lux count as
/// watts per steradian and per square metre. A range is passed over with a warning.
[[nodiscard]] std::optional<Light> readLight(const Document &document, const JsonObject &node,
                                             const glm::dmat4x3 &toWorld);

/// Lights with the profile of a lamp, each file once.
class ProfiledLights {
  public:
    /// Both outlive the object.
    ProfiledLights(Buffers &buffers, const FileAccess &access) : buffers_(buffers), access_(access) {}

    /// The light of a node that has one, where its map to the world brings it: it shines along -z, and C is 0 along +x.
    /// Throws Error{BadInput} for references that lead nowhere, and as readIes() does.
    [[nodiscard]] std::optional<Light> read(const JsonObject &node, const glm::dmat4x3 &toWorld);

    [[nodiscard]] std::vector<LightProfile> give() { return library_.give(); }
    [[nodiscard]] const std::vector<std::string> &warnings() const { return warnings_; }

  private:
    std::uint32_t profileOf(const JsonNode &light);
    std::uint32_t load(const JsonNode &light, const std::string &name);

    Buffers &buffers_;
    const FileAccess &access_;
    ProfileLibrary library_;
    std::map<std::string, std::uint32_t> profiles_; ///< of lights, by their place in the file
    std::vector<std::string> warnings_;
};

} // namespace hyalite::core::gltf
