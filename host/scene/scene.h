// The scene as plain data: world space, linear RGB, nothing of files or devices.
//
// World space is right-handed with +y up. Positions and lengths share one arbitrary unit. Loaders fill a
// Scene, `validateScene` (validate.h) checks it, and everything downstream may rely on what it promises.
#pragma once

#include "host/image/image.h"
#include "host/image/texture.h"
#include "host/scene/light_profile.h"
#include "host/scene/material.h"
#include "shaders/layout/layout.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace hyalite::core {

enum class CameraKind { Perspective, Orthographic, Panorama };

/// Pixel (0,0) is top left and its centre is (0.5, 0.5).
struct Camera {
    CameraKind kind = CameraKind::Perspective;
    glm::dvec3 position{0.0, 0.0, 55.0};
    glm::dvec3 direction{0.0, 0.0, -1.0}; ///< of view; any length but zero
    glm::dvec3 up{0.0, 1.0, 0.0};         ///< not parallel to `direction`; any length but zero
    double horizontalFovDegrees = 60.0;   ///< Perspective: in (0, 180)
    double aperture = 0.0;                ///< Perspective: diameter of a thin lens; 0: a pinhole
    double focusDistance = 10.0; ///< Perspective: of the plane that is sharp, along the view direction; > 0
    double viewWidth = 10.0;     ///< Orthographic: what the image's width shows; > 0
    int width = 512;             ///< pixels
    int height = 512;            ///< pixels
};

enum class LightKind : std::uint32_t { Point = 0, Spot = 1, Directional = 2 };

/// How a spot fades from the dark, t = 0, to its full light, t = 1, t being linear in the cosine of the angle. Smooth:
/// 3 t^2 - 2 t^3. Square: t^2, as glTF's lights do (KHR_lights_punctual).
enum class SpotFade { Smooth, Square };

/// A light without size.
struct Light {
    glm::dvec3 position{0.0}; ///< Point, Spot
    /// Per colour channel, >= 0; the radiant intensity is power / (4 pi), of a Spot on its axis; Directional: the
    /// irradiance of a surface that faces it.
    glm::dvec3 power{0.0};
    LightKind kind = LightKind::Point;
    /// Spot, Directional, and with a profile: in which light leaves; any length but zero.
    glm::dvec3 direction{0.0, -1.0, 0.0};
    double angleDegrees = 30.0;       ///< Spot: from its axis to the dark; in (0, 180]
    double blend = 0.2;               ///< Spot: share of the angle in which it fades, from 0 to 1
    SpotFade fade = SpotFade::Smooth; ///< Spot
    std::string lightGroup{};         ///< as Material::lightGroup
    /// Point, Spot: index in Scene::profiles. The radiant intensity above is then that of its greatest share; a point
    /// light has a direction, too.
    std::optional<std::uint32_t> profile{};
    /// With a profile: where C is 0; any length but zero, not parallel to `direction`.
    glm::dvec3 c0{1.0, 0.0, 0.0};
};

/// Light from all around: an image by longitude and latitude, whose middle is -z, whose top row is +y.
struct Environment {
    Image radiance;             ///< >= 0; empty: there is none
    double rotateDegrees = 0.0; ///< about +y
    float scale = 1.0f;         ///< factor on the image
    std::string lightGroup{};   ///< as Material::lightGroup
};

struct Sphere {
    glm::dvec3 centre{0.0};
    double radius = 1.0; ///< > 0
    std::uint32_t materialIndex = 0;
    bool inwardNormal = false; ///< the normal points to the centre: outside is where a glass shell's glass is
};

/// Corner indices into TriangleMesh::positions and ::normals; counter-clockwise seen from outside.
struct MeshTriangle {
    glm::uvec3 positions{0};
    /// All three set, or all three `noNormal`: then the geometric normal is used.
    glm::uvec3 normals{noNormal};

    static constexpr std::uint32_t noNormal = std::numeric_limits<std::uint32_t>::max();
};

/// Values at the corners of triangles.
template <class Value> struct CornerValues {
    std::vector<Value> values;
    /// Of each triangle's corners the indices in `values`, all three or none `none`; or empty: no triangle has any.
    std::vector<glm::uvec3> corners;

    static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
};

/// No index in Scene::nodes.
inline constexpr std::uint32_t noNode = std::numeric_limits<std::uint32_t>::max();

/// How users name it.
enum class NodeKind {
    Gltf,  ///< a node of a glTF file
    Mesh,  ///< a mesh file: the scene itself, or an entry of "meshes"
    Shape, ///< an entry of "shapes"
};

/// A name in the input, for a mesh and its places, or for the nodes below it.
struct SceneNode {
    std::string name{}; ///< Gltf: may be empty; Mesh: the file, as the scene names it; Shape: its type
    std::string mesh{}; ///< Gltf: the name of its mesh, which may be empty
    NodeKind kind = NodeKind::Gltf;
    std::uint32_t index = 0;       ///< in /nodes, /meshes or /shapes of its file
    std::uint32_t parent = noNode; ///< in Scene::nodes, before it
};

struct TriangleMesh {
    std::string name; ///< for messages: the file it came from
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals; ///< unit length
    std::vector<MeshTriangle> triangles;
    std::uint32_t materialIndex = 0;
    std::vector<std::uint32_t> triangleMaterials{}; ///< instead of it, one for each triangle; or none at all
    std::vector<glm::vec2> uvs{};                   ///< finite
    /// Of each triangle's corners the indices in `uvs`, all three or none `noUv`; or none at all.
    std::vector<glm::uvec3> triangleUvs{};

    static constexpr std::uint32_t noUv = std::numeric_limits<std::uint32_t>::max();

    CornerValues<glm::vec2> secondUvs{}; ///< for textures whose uvSet is 1; finite
    /// Factors on base colour and opacity, linear, in [0, 1]; 1 at triangles without any.
    CornerValues<glm::vec4> colours{};
    /// For normal maps: vectors in which u grows, of any length, and the sign w of the direction of v, which is
    /// cross(normal, xyz) * w. Without them, tangents follow from the texture coordinates of each triangle.
    CornerValues<glm::vec4> tangents{};
    glm::dvec3 origin{0.0}; ///< what positions are relative to, while a scene is loaded (origin.h); then zero
    std::uint32_t node = noNode; ///< in Scene::nodes

    [[nodiscard]] std::uint32_t materialOf(std::size_t triangle) const {
        return triangleMaterials.empty() ? materialIndex : triangleMaterials[triangle];
    }
};

/// An affine map to world space. A coordinate is ((row.x x + row.y y) + row.z z) + offset, each operation rounded to
/// float: so that an instance and its flattened copy have the same bits (shaders/geometry/instance.glsl).
struct Placement {
    std::array<glm::vec3, 3> rows{glm::vec3(1.0f, 0.0f, 0.0f), glm::vec3(0.0f, 1.0f, 0.0f),
                                  glm::vec3(0.0f, 0.0f, 1.0f)};
    glm::vec3 offset{0.0f};
    /// Rounding error of the offset, while a scene is loaded (origin.h); then zero.
    glm::dvec3 offsetRest{0.0};
};

/// A place of a prototype. addInstances in instances.h adds them.
struct Instance {
    std::uint32_t prototype = 0;    ///< index in Scene::prototypes; of mirrored() ones where the map mirrors
    Placement toWorld;              ///< its determinant is not 0
    std::uint32_t meshesBefore = 0; ///< how many of Scene::meshes come before it in the input
    std::uint32_t node = noNode;    ///< in Scene::nodes
};

struct Scene {
    glm::dvec3 origin{0.0}; ///< coordinates of the file are those of the scene + this (origin.h)
    Camera camera;
    std::vector<Light> lights;
    Environment environment;    ///< instead of the background, where there is one
    glm::vec3 background{0.0f}; ///< radiance of rays that leave the scene
    /// Factor on light that reaches a point through dielectrics alone; in [0, 1].
    float shadowThroughGlass = 1.0f;
    std::vector<Texture> textures;
    std::vector<Material> materials;
    std::vector<Sphere> spheres;
    std::vector<TriangleMesh> meshes;     ///< in world space
    std::vector<TriangleMesh> prototypes; ///< meshes in a space of their own, seen only as instances
    std::vector<Instance> instances;      ///< in the order of the input
    std::vector<SceneNode> nodes{};       ///< parents before their children
    std::vector<LightProfile> profiles{};
};

/// Triangles of all meshes together, without instances.
[[nodiscard]] inline std::size_t triangleCount(const Scene &scene) {
    std::size_t count = 0;
    for (const TriangleMesh &mesh : scene.meshes)
        count += mesh.triangles.size();
    return count;
}

} // namespace hyalite::core
