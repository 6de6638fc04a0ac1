// Scenes: a file, a JSON document, arrays, or a document with arrays.
#pragma once

#include "hyalite/version.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace hyalite {

/// A mesh as arrays, which are copied. Each is row by row without gaps; optional ones may be empty.
struct MeshArrays {
    std::span<const double> vertices; ///< n x 3, in world space unless instances place them; float64 is kept
                                      ///< until a scene far from zero is moved near it
    std::span<const std::uint32_t>
        faces; ///< m x cornersPerFace: indices of vertices, counter-clockwise from outside
    std::size_t cornersPerFace = 3;    ///< more are polygons, which may be concave
    std::span<const double> normals{}; ///< n x 3, of any length
    std::span<const double> uvs{};     ///< n x 2; v grows upwards
    std::span<const float> colours{};  ///< n x 3, linear, in [0, 1]
};

/// A copy is cheap, and changes on its own. Functions that do not change a scene may be called by several threads.
class HYALITE_API Scene {
  public:
    /// Nothing: what is added is framed and, if nothing shines, lit as a bare mesh is, unless the document says
    /// otherwise (set()).
    Scene();
    /// A scene or mesh file, or the name of a shipped scene, as for `hyalite render`. It is read when it is rendered,
    /// by each renderer once for each such object and its copies. Throws Error{BadInput} if there is none.
    [[nodiscard]] static Scene load(const std::string &source);
    /// The JSON text of a scene file. Names of files in it are relative to `folder`. Throws Error{BadInput} if the text
    /// is no JSON object; what it says is checked when it is rendered, or by check().
    [[nodiscard]] static Scene fromJson(const std::string &text, const std::string &folder = ".");

    // The following change the document; a JSON file that was loaded is read now, and others cannot be changed:
    // Error{Usage} says to name such a file as a mesh of a document.

    /// Sets a member of the document, such as "camera", "lights" or "settings", to a JSON text.
    Scene &set(const std::string &key, const std::string &json);
    /// Defines a material by a JSON text such as {"type": "dielectric", "ior": 1.5}.
    Scene &addMaterial(const std::string &name, const std::string &json);
    /// Adds a mesh. `material` names one of the document; empty: the neutral one. `instances` are row-major 4 x 4
    /// matrices, 16 numbers each, that map the mesh to world space; none: it is there once, as it is. Throws
    /// Error{Usage} for arrays of wrong sizes, and for a name that an array has already. Returns the mesh's name.
    std::string addMesh(const MeshArrays &arrays, const std::string &material = "",
                        std::span<const double> instances = {}, const std::string &name = "");
    /// Defines a texture of bytes, height x width x channels (1, 3 or 4; colours are sRGB), by the name that "file" has
    /// for it in materials. Likewise.
    Scene &addTexture(const std::string &name, int width, int height, int channels,
                      std::span<const std::uint8_t> levels);
    /// Light from all around: linear radiance by longitude and latitude, height x width x 3. Likewise.
    Scene &setEnvironment(int width, int height, std::span<const float> radiance, double scale = 1.0,
                          double rotateDegrees = 0.0);

    /// The document as JSON, whose files may be names of arrays; or {"file": ...} of a scene that is a file.
    [[nodiscard]] std::string json() const;
    /// Loads all of it. Throws Error{BadInput} for what a render would refuse.
    void check() const;

    struct Content; ///< of the library alone
    [[nodiscard]] const std::shared_ptr<const Content> &content() const noexcept { return content_; }

  private:
    std::shared_ptr<const Content> content_;
};

} // namespace hyalite
