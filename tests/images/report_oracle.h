// The report's renderer written a second time, in double precision and by the most direct route, so that
// images of the real renderer can be held against it. It shares no code with the project and no layout:
// recursion instead of a ray stack, spheres left exactly instead of by an offset, its own median-split tree.
//
// Right-handed world, y up. Radiance and albedo are linear RGB. Assertions guard the ranges
// stated below; only memory that runs out throws.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace hyalite::oracle {

struct Vec3 {
    double x = 0;
    double y = 0;
    double z = 0;
};

using Rgb = Vec3; // x red, y green, z blue

enum class MaterialKind : std::uint8_t { diffuse, mirror, dielectric };

struct Material {
    MaterialKind kind = MaterialKind::diffuse;
    Rgb albedo{};             // diffuse only
    double index = 1;         // dielectric only: refractive, behind the normal; in front of it the index is 1
    Rgb segmentTint{1, 1, 1}; // dielectric only: factor on all that a segment ending here from inside returns
};

[[nodiscard]] Material makeDiffuse(Rgb albedo);
[[nodiscard]] Material makeMirror();
// index > 0.
[[nodiscard]] Material makeDielectric(double index, Rgb segmentTint);

// The normal is (P - centre) / radius, negated where inwardNormal is set: a dielectric's matter then lies
// outside the sphere. Two spheres must not coincide; they may touch at a point.
struct Sphere {
    Vec3 centre{};
    double radius = 1;
    bool inwardNormal = false;
    Material material{};
};

// The geometric normal is (v1 - v0) x (v2 - v0), counter-clockwise vertices facing the viewer:
//
//        v2
//       /  \       normal towards the reader
//     v0 -- v1
//
// With vertex normals the shading normal is their normalised barycentric blend (the geometric normal where
// the blend vanishes). Triangles without area are never hit.
struct Triangle {
    std::array<Vec3, 3> vertices{};
    std::optional<std::array<Vec3, 3>> normals;
    Material material{};
};

struct PointLight {
    Vec3 position{-10, 20, 40};
    double power = 1e5; // per channel
};

// Paths are followed by recursion into both branches of each dielectric: keep maxDepth below 200 for the
// stack, and below 20 or so where shells are nested, for the time.
struct Scene {
    std::vector<Sphere> spheres;
    std::vector<Triangle> triangles;
    PointLight light{};
    double glassShadow = 0.8; // visibility of the light through dielectrics alone, whatever their number
    int maxDepth = 5;         // segments of a path, the primary ray being the first; shadow rays do not count
    Rgb background{};
};

// A pinhole. Pixel (0, 0) is the top left one and its centre is (0.5, 0.5):
//
//     (0,0) +----------> px     right = forward x up
//           |                   direction = right   * (px + 0.5 - W / 2)
//           v                             + upImage * (H / 2 - (py + 0.5))
//           py                            + forward * W / (2 tan(fovRadians / 2)), then normalised
//
// forward and up need not be unit vectors but must not be parallel; fovRadians, in (0, pi), is horizontal.
struct Camera {
    Vec3 position{0, 0, 55};
    Vec3 forward{0, 0, -1};
    Vec3 up{0, 1, 0};
    double fovRadians = 1.0471975511965977462; // 60 degrees
};

// Row-major, top row first: pixel (px, py) is entry py * width + px.
struct Image {
    int width = 0;
    int height = 0;
    std::vector<Rgb> radiance;
    std::vector<std::uint8_t> unstable; // 1 where unstable; empty until markUnstable has run
};

// How markUnstable probes a pixel. A zero offset leaves its probes out.
struct StabilityProbe {
    double pixelOffset = 1.0 / 256; // the ray through the pixel centre moved by (+-offset, +-offset) pixels
    double eyeOffset = 0;           // the eye moved by +-offset world units along right, upImage and forward
    double tolerance = 2;           // largest change of displayValue that still counts as stable
};

// The scene with its triangle tree, for single rays. Keeps a reference: the scene must outlive it and stay
// unchanged. Safe to share between threads.
class Tracer {
  public:
    explicit Tracer(const Scene &scene);

    // Radiance arriving at origin from a direction of any positive length.
    [[nodiscard]] Rgb radiance(Vec3 origin, Vec3 direction) const;

  private:
    struct State;
    std::shared_ptr<const State> state_;
};

// One ray through each pixel centre (all samples of the report are that same ray). width, height > 0.
[[nodiscard]] Image render(const Scene &scene, const Camera &camera, int width, int height);

// Fills image.unstable for an image that render returned for the same scene and camera. A pixel is unstable
// if moving its ray as `probe` says changes displayValue of any channel by more than probe.tolerance:
// outlines, shadow edges, and the spots where glass magnifies a small error. There another correct renderer
// may differ. Costs up to four more images (ten with eye probes); a pixel is left at its first failing probe.
void markUnstable(const Scene &scene, const Camera &camera, Image &image, const StabilityProbe &probe = {});

// 255 * clamp(radiance, 0, 1) ^ (1 / 2.2), not rounded.
[[nodiscard]] double displayValue(double radiance);

// displayValue rounded to the nearest integer. (The report's own pictures were truncated.)
[[nodiscard]] std::uint8_t toEightBit(double radiance);

// The report's three balls in the six-walled room: mirror, glass, and glass with a cavity of radius 9.9.
// maxDepth 7.
[[nodiscard]] Scene spheresScene();

// The same with four shells (9.9, 9.8, 9.7, 9.6; normals inward, outward, inward, outward) in the right ball.
// maxDepth 12.
[[nodiscard]] Scene spheresNestedScene();

// The six walls alone, maxDepth 5, to add triangles to.
[[nodiscard]] Scene catRoom();

// The diffuse material of the report's cat.
[[nodiscard]] Material catMaterial();

} // namespace hyalite::oracle
