// Pictures that a formula predicts, pixel by pixel, from both renderers.
//
// Nothing here calls the code under test but to render: camera, intersections and light are written out again, in
// double precision. Where a pixel sits so close to a boundary that float32 may see its other side, the boundary moves
// with the sample: such pixels are found by asking the formula at points around the sample, and left out.
#include "tests/fixtures/test_scene.h"
#include "tests/images/rendering.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <set>

namespace hyalite::core {
namespace {

using glm::dvec2;
using glm::dvec3;

/// What the pixel at an image position shows.
struct Prediction {
    int region = 0;          ///< which side of all boundaries it is on
    dvec3 radiance{0.0};     ///< 0 stands for exactly 0
    double condition = 1.0;  ///< how much the formula enlarges rounding errors
    double offset = 0.0;     ///< absolute error that is allowed too
    bool isPredicted = true; ///< false: whatever it is
};

/// Of the image position in pixels, y down.
using Formula = std::function<Prediction(const dvec2 &)>;

struct Demands {
    double tolerance = 1e-5;    ///< relative, for a condition of 1
    double marginPixels = 1e-4; ///< pixels whose region changes within it are left out
    std::size_t regions = 1;    ///< at least so many must be seen, so that the test means something
};

bool isStable(const Formula &formula, const dvec2 &position, int region, double marginPixels) {
    for (int i = 0; i < 8; ++i) {
        const double angle = i * std::numbers::pi / 4.0;
        const dvec2 shift(std::cos(angle), std::sin(angle));
        if (formula(position + shift * marginPixels).region != region)
            return false;
    }
    return true;
}

void expectImage(const char *renderer, const Image &image, const Formula &formula, const Demands &demands) {
    int wrongCount = 0;
    int leftOutCount = 0;
    std::set<int> regions;
    for (int y = 0; y < image.height(); ++y) {
        for (int x = 0; x < image.width(); ++x) {
            const dvec2 position(x + 0.5, y + 0.5);
            const Prediction expected = formula(position);
            if (!expected.isPredicted)
                continue;
            if (!isStable(formula, position, expected.region, demands.marginPixels)) {
                ++leftOutCount;
                continue;
            }
            regions.insert(expected.region);
            const dvec3 found(image.at(x, y));
            const dvec3 allowed =
                expected.radiance * (demands.tolerance * expected.condition) + expected.offset;
            for (int c = 0; c < 3; ++c) {
                if (std::abs(found[c] - expected.radiance[c]) <= allowed[c])
                    continue;
                if (++wrongCount <= 3)
                    ADD_FAILURE() << renderer << ": pixel " << x << ", " << y << " channel " << c << ": "
                                  << found[c] << " instead of " << expected.radiance[c] << ", region "
                                  << expected.region;
            }
        }
    }
    EXPECT_EQ(wrongCount, 0) << renderer << ": values out of " << image.pixels().size() << " pixels";
    EXPECT_LE(leftOutCount, 2 + static_cast<int>(image.pixels().size() / 100)) << "too near to a boundary";
    EXPECT_GE(regions.size(), demands.regions);
}

/// Renders at pixel centres.
void expectPicture(TestScene scene, const Formula &formula, const Demands &demands = {}) {
    scene.settings.sampler = SamplerKind::Centre;
    scene.settings.samplesPerPixel = 1;
    expectImage("device", testing::renderOnDevice(scene).film.toImage(), formula, demands);
    expectImage("cpu", testing::renderOnCpu(scene).film.toImage(), formula, demands);
}

// ---- Scenes

TestScene emptyScene(int width, int height, double fovDegrees = 60.0) {
    TestScene scene;
    scene.camera.position = dvec3(0.0);
    scene.camera.horizontalFovDegrees = fovDegrees;
    scene.camera.width = width;
    scene.camera.height = height;
    return scene;
}

std::uint32_t addMaterial(TestScene &scene, const Material &material) {
    scene.materials.push_back(material);
    return static_cast<std::uint32_t>(scene.materials.size() - 1);
}

std::uint32_t addDiffuse(TestScene &scene, const glm::vec3 &albedo, bool twoSided = false) {
    Material material;
    material.albedo = albedo;
    material.twoSided = twoSided;
    return addMaterial(scene, material);
}

std::uint32_t addMirror(TestScene &scene) {
    Material material;
    material.kind = MaterialKind::Mirror;
    return addMaterial(scene, material);
}

std::uint32_t addGlass(TestScene &scene, float index, const glm::vec3 &tint = glm::vec3(1.0f)) {
    Material material;
    material.kind = MaterialKind::Dielectric;
    material.refractiveIndex = index;
    material.segmentTint = tint;
    return addMaterial(scene, material);
}

void addSphere(TestScene &scene, const dvec3 &centre, double radius, std::uint32_t material,
               bool inward = false) {
    scene.spheres.push_back({centre, radius, material, inward});
}

void addTriangle(TestScene &scene, const std::array<dvec3, 3> &corners, std::uint32_t material) {
    TriangleMesh mesh;
    mesh.materialIndex = material;
    for (const dvec3 &corner : corners)
        mesh.positions.emplace_back(corner);
    mesh.triangles.push_back({glm::uvec3(0, 1, 2)});
    scene.meshes.push_back(mesh);
}

/// A parallelogram: corner, and two edges whose cross product is the side that it faces.
struct Wall {
    dvec3 corner;
    dvec3 edgeU;
    dvec3 edgeV;

    [[nodiscard]] dvec3 normal() const { return glm::normalize(glm::cross(edgeU, edgeV)); }
};

void addWall(TestScene &scene, const Wall &wall, std::uint32_t material) {
    const dvec3 opposite = wall.corner + wall.edgeU + wall.edgeV;
    addTriangle(scene, {wall.corner, wall.corner + wall.edgeU, opposite}, material);
    addTriangle(scene, {wall.corner, opposite, wall.corner + wall.edgeV}, material);
}

// ---- Geometry and light, written out again

/// Of any length.
dvec3 directionThrough(const Camera &camera, const dvec2 &position) {
    const dvec3 forward = glm::normalize(camera.direction);
    const dvec3 right = glm::normalize(glm::cross(forward, camera.up));
    const dvec3 up = glm::cross(right, forward);
    const double focalLength =
        camera.width / (2.0 * std::tan(camera.horizontalFovDegrees * std::numbers::pi / 360.0));
    return right * (position.x - 0.5 * camera.width) + up * (0.5 * camera.height - position.y) +
           forward * focalLength;
}

/// Where the line meets the wall's plane, in units of the direction; nothing unless inside of the wall and ahead.
std::optional<double> intersectWall(const Wall &wall, const dvec3 &origin, const dvec3 &direction) {
    const dvec3 normal = glm::cross(wall.edgeU, wall.edgeV);
    const double t = glm::dot(wall.corner - origin, normal) / glm::dot(direction, normal);
    const dvec3 offset = origin + t * direction - wall.corner;
    const double u = glm::dot(glm::cross(offset, wall.edgeV), normal) / glm::dot(normal, normal);
    const double v = glm::dot(glm::cross(wall.edgeU, offset), normal) / glm::dot(normal, normal);
    if (!(t > 0.0 && u >= 0.0 && u <= 1.0 && v >= 0.0 && v <= 1.0))
        return {};
    return t;
}

/// Whether the line from `origin` passes the triangle, by the three edges alone. Exact where all coordinates are
/// integers of moderate size.
bool passesTriangle(const std::array<dvec3, 3> &corners, const dvec3 &origin, const dvec3 &direction) {
    std::array<double, 3> sides;
    for (std::size_t i = 0; i < 3; ++i)
        sides[i] = glm::dot(direction, glm::cross(corners[i] - origin, corners[(i + 1) % 3] - origin));
    return (sides[0] > 0.0 && sides[1] > 0.0 && sides[2] > 0.0) ||
           (sides[0] < 0.0 && sides[1] < 0.0 && sides[2] < 0.0);
}

bool segmentMeetsBall(const dvec3 &from, const dvec3 &to, const dvec3 &centre, double radius) {
    const dvec3 along = to - from;
    const double t = std::clamp(glm::dot(centre - from, along) / glm::dot(along, along), 0.0, 1.0);
    return glm::length(from + t * along - centre) < radius;
}

/// Lambert's law under a point light: power / (4 pi d^2) * albedo / pi * cos.
dvec3 directLight(const Light &light, const dvec3 &albedo, const dvec3 &point, const dvec3 &normal) {
    const dvec3 toLight = light.position - point;
    const double squared = glm::dot(toLight, toLight);
    const double cosine = std::max(glm::dot(glm::normalize(normal), toLight) / std::sqrt(squared), 0.0);
    const double pi = std::numbers::pi;
    return light.power / (4.0 * pi * squared) * albedo / pi * cosine;
}

/// Schlick's reflectance, `cosine` being that in the thinner medium.
double reflectanceOf(double index, double cosine) {
    const double normalReflectance = std::pow((index - 1.0) / (index + 1.0), 2.0);
    return normalReflectance + (1.0 - normalReflectance) * std::pow(1.0 - cosine, 5.0);
}

// ---- Flat walls

const Light warmLight{{0.0, 0.0, 0.0}, {1000.0, 500.0, 250.0}};
const glm::vec3 wallAlbedo(0.5f, 0.25f, 0.75f);
const Wall wallAhead{{-32.0, -32.0, -10.0}, {64.0, 0.0, 0.0}, {0.0, 64.0, 0.0}};

/// The light that a point of the wall reflects, were nothing else in the scene.
Prediction wallPrediction(const TestScene &scene, const Wall &wall, const dvec2 &position) {
    const dvec3 direction = directionThrough(scene.camera, position);
    const std::optional<double> t = intersectWall(wall, scene.camera.position, direction);
    if (!t)
        return {0, dvec3(scene.background)};
    const dvec3 point = scene.camera.position + *t * direction;
    Prediction prediction{1};
    for (const Light &light : scene.lights)
        prediction.radiance += directLight(light, dvec3(wallAlbedo), point, wall.normal());
    return prediction;
}

TEST(FlatWall, LitHeadOn) {
    TestScene scene = emptyScene(64, 48);
    scene.lights.push_back(warmLight);
    addWall(scene, wallAhead, addDiffuse(scene, wallAlbedo));
    expectPicture(scene, [&](const dvec2 &position) { return wallPrediction(scene, wallAhead, position); });
}

TEST(FlatWall, LitAndSeenObliquely) {
    TestScene scene = emptyScene(65, 49);
    scene.camera.position = {3.0, 2.0, 1.0};
    scene.camera.direction = {-0.25, -0.125, -1.0};
    scene.camera.up = {0.25, 1.0, 0.0};
    scene.background = {0.25f, 0.5f, 1.0f};
    scene.lights = {{{5.0, 3.0, 0.0}, warmLight.power}, {{-6.0, 1.0, -2.0}, {10.0, 100.0, 1000.0}}};
    const Wall wall{{-9.0, -7.0, -10.0}, {16.0, 1.0, -8.0}, {-1.0, 15.0, -4.0}};
    addWall(scene, wall, addDiffuse(scene, wallAlbedo));
    expectPicture(scene, [&](const dvec2 &position) { return wallPrediction(scene, wall, position); },
                  {.tolerance = 1e-5, .marginPixels = 1e-4, .regions = 2});
}

TEST(FlatWall, ShowsItsBackIfItHasOne) {
    const Wall away{{-32.0, -32.0, -10.0}, {0.0, 64.0, 0.0}, {64.0, 0.0, 0.0}};
    for (const bool twoSided : {false, true}) {
        for (const double lightZ : {0.0, -20.0}) {
            TestScene scene = emptyScene(16, 16);
            scene.lights.push_back({{1.0, 2.0, lightZ}, warmLight.power});
            addWall(scene, away, addDiffuse(scene, wallAlbedo, twoSided));
            const bool isLit = twoSided == (lightZ == 0.0);
            const Wall litSide = lightZ == 0.0 ? wallAhead : away;
            expectPicture(scene, [&](const dvec2 &position) {
                return isLit ? wallPrediction(scene, litSide, position) : Prediction{};
            });
        }
    }
}

// The inside of a large ball.
TEST(RoundWall, LitOffItsCentre) {
    TestScene scene = emptyScene(101, 51, 90.0);
    scene.camera.position = {0.0, 0.0, 55.0};
    scene.lights.push_back({{-10.0, 20.0, 40.0}, {1e5, 2e5, 3e5}});
    const dvec3 centre(0.0, 0.0, -1000.0);
    const double radius = 1940.0;
    addSphere(scene, centre, radius, addDiffuse(scene, wallAlbedo), true);
    expectPicture(scene, [&](const dvec2 &position) {
        const dvec3 direction = glm::normalize(directionThrough(scene.camera, position));
        const dvec3 fromCentre = scene.camera.position - centre;
        const double half = glm::dot(fromCentre, direction);
        const double t = -half + std::sqrt(half * half - glm::dot(fromCentre, fromCentre) + radius * radius);
        const dvec3 point = scene.camera.position + t * direction;
        return Prediction{0, directLight(scene.lights[0], dvec3(wallAlbedo), point, centre - point)};
    });
}

TEST(Lights, AddUp) {
    TestScene scene = emptyScene(33, 17);
    addWall(scene, wallAhead, addDiffuse(scene, wallAlbedo));
    scene.settings.sampler = SamplerKind::Centre;
    scene.settings.samplesPerPixel = 1;
    const std::vector<Light> lights = {{{4.0, 1.0, -2.0}, warmLight.power},
                                       {{-3.0, -5.0, 1.0}, {7.0, 70.0, 700.0}}};
    const auto render = [&](const std::vector<Light> &some, bool onDevice) {
        scene.lights = some;
        return onDevice ? testing::renderOnDevice(scene).film.toImage()
                        : testing::renderOnCpu(scene).film.toImage();
    };
    for (const bool onDevice : {true, false}) {
        const Image both = render(lights, onDevice);
        const Image first = render({lights[0]}, onDevice);
        const Image second = render({lights[1]}, onDevice);
        int wrongCount = 0;
        for (std::size_t i = 0; i < both.pixels().size(); ++i)
            wrongCount += both.pixels()[i] != first.pixels()[i] + second.pixels()[i] ? 1 : 0;
        EXPECT_EQ(wrongCount, 0);
    }
}

// ---- Shadows: whatever casts them stands beside the field of view

const Light lightAside{{8.0, 6.0, 0.0}, {3000.0, 2000.0, 1000.0}};

/// The wall, where `factor` says how much of the light reaches a point of it; nothing: the region with no light.
Formula shadowFormula(const TestScene &scene,
                      const std::function<std::pair<int, double>(const dvec3 &)> &visit) {
    return [&scene, visit](const dvec2 &position) {
        Prediction prediction = wallPrediction(scene, wallAhead, position);
        const dvec3 direction = directionThrough(scene.camera, position);
        const auto [region, factor] = visit(direction * (-10.0 / direction.z));
        prediction.region = region;
        prediction.radiance *= factor;
        return prediction;
    };
}

TEST(Shadow, OfABall) {
    for (const MaterialKind kind : {MaterialKind::Diffuse, MaterialKind::Mirror}) {
        TestScene scene = emptyScene(121, 91);
        scene.lights.push_back(lightAside);
        addWall(scene, wallAhead, addDiffuse(scene, wallAlbedo));
        const dvec3 centre(4.0, 3.0, -4.0);
        addSphere(scene, centre, 0.75,
                  kind == MaterialKind::Mirror ? addMirror(scene) : addDiffuse(scene, glm::vec3(1.0f)));
        expectPicture(scene,
                      shadowFormula(scene,
                                    [&](const dvec3 &point) {
                                        const bool isDark =
                                            segmentMeetsBall(point, lightAside.position, centre, 0.75);
                                        return std::pair(isDark ? 1 : 0, isDark ? 0.0 : 1.0);
                                    }),
                      {.tolerance = 1e-5, .marginPixels = 1e-3, .regions = 2});
    }
}

TEST(Shadow, OfATriangle) {
    TestScene scene = emptyScene(121, 91);
    scene.lights.push_back(lightAside);
    addWall(scene, wallAhead, addDiffuse(scene, wallAlbedo));
    const std::array<dvec3, 3> corners = {dvec3(4.0, 2.25, -4.0), dvec3(5.0, 3.5, -4.25),
                                          dvec3(3.5, 4.0, -3.5)};
    addTriangle(scene, corners, addDiffuse(scene, glm::vec3(1.0f)));
    expectPicture(scene,
                  shadowFormula(scene,
                                [&](const dvec3 &point) {
                                    const bool isDark =
                                        passesTriangle(corners, point, lightAside.position - point);
                                    return std::pair(isDark ? 1 : 0, isDark ? 0.0 : 1.0);
                                }),
                  {.tolerance = 1e-5, .marginPixels = 1e-3, .regions = 2});
}

// Two balls, a triangle of glass, and something opaque: glass counts once, opaque things always.
TEST(Shadow, IsDimmedOnceByGlass) {
    TestScene scene = emptyScene(121, 91);
    scene.lights.push_back(lightAside);
    scene.shadowThroughGlass = 0.625f;
    addWall(scene, wallAhead, addDiffuse(scene, wallAlbedo));
    const std::uint32_t glass = addGlass(scene, 1.5f, {0.5f, 0.5f, 0.5f});
    const dvec3 ballCentres[2] = {{4.0, 3.0, -4.0}, {6.5, 4.5, -2.0}};
    const dvec3 opaqueCentre(4.0, 4.0, -4.5);
    for (const dvec3 &centre : ballCentres)
        addSphere(scene, centre, 0.75, glass);
    addSphere(scene, opaqueCentre, 0.5, addDiffuse(scene, glm::vec3(1.0f)));
    const std::array<dvec3, 3> corners = {dvec3(4.0, 2.0, -4.0), dvec3(5.0, 3.5, -4.25),
                                          dvec3(3.5, 4.0, -3.5)};
    addTriangle(scene, corners, glass);
    expectPicture(scene,
                  shadowFormula(scene,
                                [&](const dvec3 &point) {
                                    const dvec3 &light = lightAside.position;
                                    int glassCount = passesTriangle(corners, point, light - point) ? 1 : 0;
                                    for (const dvec3 &centre : ballCentres)
                                        glassCount += segmentMeetsBall(point, light, centre, 0.75) ? 1 : 0;
                                    if (segmentMeetsBall(point, light, opaqueCentre, 0.5))
                                        return std::pair(4 + glassCount, 0.0);
                                    return std::pair(glassCount, glassCount > 0 ? 0.625 : 1.0);
                                }),
                  {.tolerance = 1e-5, .marginPixels = 1e-3, .regions = 6});
}

// ---- Glass balls. Every hit of the surface has the same angle, outside of the glass, and the same reflectance R

/// Sine of the angle at which the ray meets a ball: beyond 1 it misses.
double sineAtBall(const dvec3 &origin, const dvec3 &direction, const dvec3 &centre, double radius) {
    return glm::length(glm::cross(glm::normalize(direction), centre - origin)) / radius;
}

/// What comes back under a background of 1. R is reflected by the first hit; (1-R) enters; a segment inside with
/// j hits behind it carries (1-R) R^j tint^(j+1) to its end and lets (1-R) of that out, as long as it may split:
///
///     R + (1-R)^2 tint (1 - (R tint)^(depth-2)) / (1 - R tint)
double furnaceBall(double reflectance, double tint, int depth) {
    if (depth < 2)
        return 0.0;
    const double ratio = reflectance * tint;
    return reflectance +
           std::pow(1.0 - reflectance, 2.0) * tint * (1.0 - std::pow(ratio, depth - 2)) / (1.0 - ratio);
}

TEST(Furnace, GlassBallLosesWhatDepthCutsOff) {
    const dvec3 centre(0.5, -0.25, -4.0);
    const glm::vec3 tint(1.0f, 0.75f, 0.25f);
    for (const float index : {1.0f, 1.5f, 2.5f}) {
        for (const int depth : {1, 2, 3, 32}) {
            TestScene scene = emptyScene(41, 31, 40.0);
            scene.background = glm::vec3(1.0f);
            scene.settings.maxDepth = depth;
            addSphere(scene, centre, 1.0, addGlass(scene, index, tint));
            const Formula formula = [&](const dvec2 &position) {
                const double sine =
                    sineAtBall(dvec3(0.0), directionThrough(scene.camera, position), centre, 1.0);
                if (sine >= 1.0)
                    return Prediction{0, dvec3(1.0)};
                const double cosine = std::sqrt(1.0 - sine * sine);
                const double reflectance = reflectanceOf(static_cast<double>(index), cosine);
                Prediction prediction{1};
                for (int c = 0; c < 3; ++c)
                    prediction.radiance[c] = furnaceBall(reflectance, static_cast<double>(tint[c]), depth);
                // Each hit adds rounding to the angle inside, which is n^2 / cos of that outside.
                prediction.condition = 1.0 / (cosine * cosine);
                prediction.offset = 2e-7; // without it, an index of 1 would ask for all digits of nearly 0
                return prediction;
            };
            expectPicture(scene, formula, {.tolerance = 1e-5, .marginPixels = 1e-4, .regions = 2});
        }
    }
}

// Straight through the middle, the light that depth cuts off is (1-R) R^(depth-2) with R = ((n-1)/(n+1))^2.
TEST(Furnace, MiddleOfABallIsAGeometricSeries) {
    for (const double index : {1.5, 3.0}) {
        const double reflectance = std::pow((index - 1.0) / (index + 1.0), 2.0);
        for (const int depth : {2, 3, 5, 8}) {
            TestScene scene = emptyScene(1, 1);
            scene.background = glm::vec3(1.0f);
            scene.settings.maxDepth = depth;
            addSphere(scene, {0.0, 0.0, -4.0}, 1.0, addGlass(scene, static_cast<float>(index)));
            const double cutOff = (1.0 - reflectance) * std::pow(reflectance, depth - 2);
            expectPicture(scene, [&](const dvec2 &) { return Prediction{0, dvec3(1.0 - cutOff)}; });
        }
    }
}

TEST(Furnace, MirrorBallVanishes) {
    TestScene scene = emptyScene(40, 30);
    scene.background = {0.25f, 0.5f, 1.0f};
    addSphere(scene, {0.25, 0.5, -4.0}, 1.5, addMirror(scene));
    expectPicture(scene,
                  [&](const dvec2 &) {
                      return Prediction{0, dvec3(scene.background)};
                  },
                  {.tolerance = 0.0});
}

// The middle pixel sees a wall through the ball, and the background in all that comes back.
TEST(BallOnTheAxis, ShowsTheWallBehind) {
    const Wall wall{{-16.0, -16.0, -8.0}, {32.0, 0.0, 0.0}, {0.0, 32.0, 0.0}};
    const dvec3 tint(0.875, 0.5, 0.25);
    const double reflectance = 0.04;
    for (const bool isLightBehindBall : {false, true}) {
        for (const int depth : {1, 2, 3, 4, 5, 9}) {
            TestScene scene = emptyScene(1, 1);
            scene.camera.position = {0.0, 0.0, 10.0};
            scene.background = {0.25f, 0.5f, 1.0f};
            scene.shadowThroughGlass = 0.375f;
            scene.settings.maxDepth = depth;
            scene.lights.push_back({isLightBehindBall ? dvec3(0.0, 0.0, 6.0) : dvec3(4.0, 3.0, -3.0),
                                    {100000.0, 200000.0, 300000.0}});
            addWall(scene, wall, addDiffuse(scene, wallAlbedo));
            addSphere(scene, dvec3(0.0), 2.0, addGlass(scene, 1.5f, glm::vec3(tint)));
            const dvec3 onWall =
                directLight(scene.lights[0], dvec3(wallAlbedo), {0.0, 0.0, -8.0}, wall.normal()) *
                (isLightBehindBall ? 0.375 : 1.0);
            dvec3 expected(0.0);
            if (depth >= 2)
                expected += reflectance * dvec3(scene.background);
            // Segment 2 is the first one inside; what it lets out is followed by segment 3.
            dvec3 inside = (1.0 - reflectance) * tint;
            for (int segment = 2; segment < depth; ++segment) {
                expected +=
                    (1.0 - reflectance) * inside * (segment % 2 == 0 ? onWall : dvec3(scene.background));
                inside *= reflectance * tint;
            }
            expectPicture(scene, [&](const dvec2 &) { return Prediction{0, expected}; });
        }
    }
}

// A sheet that has no other side: what enters is lost in glass, and the background is seen through its tint.
TEST(GlassSheet, TintsTheBackgroundBehind) {
    TestScene scene = emptyScene(37, 25, 100.0);
    scene.background = {0.25f, 0.5f, 1.0f};
    const dvec3 tint(0.75, 0.25, 0.5);
    addWall(scene, wallAhead, addGlass(scene, 1.5f, glm::vec3(tint)));
    expectPicture(scene, [&](const dvec2 &position) {
        const dvec3 direction = glm::normalize(directionThrough(scene.camera, position));
        const double reflectance = reflectanceOf(1.5, -direction.z);
        return Prediction{0, dvec3(scene.background) * (reflectance + (1.0 - reflectance) * tint)};
    });
}

// Schlick's reflectance does not vanish for an index of 1, but away from the rim it is below rounding.
TEST(HollowBall, OfIndexOneIsNotThere) {
    TestScene scene = emptyScene(49, 49);
    scene.lights.push_back({{-3.0, 2.0, 1.0}, warmLight.power});
    const dvec3 centre(0.0, 0.0, -5.0);
    const std::uint32_t glass = addGlass(scene, 1.0f);
    addSphere(scene, centre, 2.0, glass);
    addSphere(scene, centre, 1.5, glass, true);
    addWall(scene, wallAhead, addDiffuse(scene, wallAlbedo));
    expectPicture(scene, [&](const dvec2 &position) {
        Prediction prediction = wallPrediction(scene, wallAhead, position);
        const double sine = sineAtBall(dvec3(0.0), directionThrough(scene.camera, position), centre, 1.5);
        prediction.isPredicted = sine < 0.3 || sine > 1.4;
        return prediction;
    });
}

// From inside of a ball: nothing gets out where the sine of the angle at the surface is over 1/n, and a ray that is
// reflected there meets the surface at the same angle for ever. Elsewhere all but R^(depth-1) gets out.
TEST(CriticalAngle, SplitsTheViewFromInsideGlass) {
    const double radius = 2.0;
    for (const float index : {1.25f, 1.5f, 2.5f}) {
        for (const int depth : {2, 3, 9}) {
            TestScene scene = emptyScene(97, 73, 110.0);
            scene.camera.position = {1.625, 0.25, -0.5};
            scene.camera.direction = {-0.5, 0.25, -1.0};
            scene.background = {1.0f, 0.5f, 0.25f};
            scene.settings.maxDepth = depth;
            addSphere(scene, dvec3(0.0), radius, addGlass(scene, index));
            const double n = static_cast<double>(index);
            const Formula formula = [&](const dvec2 &position) {
                const dvec3 direction = directionThrough(scene.camera, position);
                const double sine = n * sineAtBall(scene.camera.position, direction, dvec3(0.0), radius);
                if (sine > 1.0)
                    return Prediction{0, dvec3(0.0)};
                const double squaredCosine = 1.0 - sine * sine;
                const double reflectance = reflectanceOf(n, std::sqrt(squaredCosine));
                const dvec3 out = (1.0 - std::pow(reflectance, depth - 1)) * dvec3(scene.background);
                return Prediction{1, out, 1.0 / squaredCosine};
            };
            expectPicture(scene, formula, {.tolerance = 1e-5, .marginPixels = 1e-4, .regions = 2});
        }
    }
}

// ---- Depth: a path has maxDepth segments, and beyond them there is no light

// Between two parallel mirrors, unfolded: a ray that arrives k widths aside was reflected k times.
TEST(Depth, EndsACorridorOfMirrors) {
    for (const int depth : {1, 2, 5, 32}) {
        TestScene scene = emptyScene(101, 15, 100.0);
        scene.camera.position = {0.25, 0.0, 0.0};
        scene.background = {0.25f, 0.5f, 1.0f};
        scene.settings.maxDepth = depth;
        const std::uint32_t mirror = addMirror(scene);
        addWall(scene, {{-1.0, -64.0, -12.0}, {0.0, 128.0, 0.0}, {0.0, 0.0, 16.0}}, mirror);
        addWall(scene, {{1.0, -64.0, -12.0}, {0.0, 0.0, 16.0}, {0.0, 128.0, 0.0}}, mirror);
        const Formula formula = [&](const dvec2 &position) {
            const dvec3 direction = directionThrough(scene.camera, position);
            const double aside = scene.camera.position.x + direction.x * (-12.0 / direction.z);
            const int reflections = static_cast<int>(std::floor((std::abs(aside) + 1.0) / 2.0));
            return Prediction{reflections, reflections < depth ? dvec3(scene.background) : dvec3(0.0)};
        };
        expectPicture(scene, formula, {.tolerance = 0.0, .marginPixels = 1e-3, .regions = 7});
    }
}

TEST(Depth, LeavesAMirroredRoomDark) {
    for (const int depth : {1, 2, 32}) {
        TestScene scene = emptyScene(12, 9);
        scene.background = glm::vec3(1.0f);
        scene.settings.maxDepth = depth;
        addSphere(scene, {0.5, 0.25, 0.0}, 4.0, addMirror(scene), true);
        expectPicture(scene, [](const dvec2 &) { return Prediction{}; });
    }
}

// ---- Silhouettes: black on a white background, or lit by a light in the eye, which sees no shadow

const std::vector<glm::ivec2> pictureSizes = {{64, 64}, {37, 101}, {203, 5}, {1, 53}};

TEST(Silhouette, OfABallIsAConeAroundItsCentre) {
    const std::vector<Sphere> balls = {{{0.0, 0.0, -5.0}, 1.0},
                                       {{2.0, -1.5, -6.0}, 2.5},
                                       {{-30.0, 20.0, -64.0}, 25.0},
                                       {{0.0, 0.5, -1.0}, 1.0}};
    for (std::size_t i = 0; i < balls.size(); ++i) {
        for (const glm::ivec2 &size : pictureSizes) {
            TestScene scene = emptyScene(size.x, size.y, 40.0 + 30.0 * static_cast<double>(i));
            scene.camera.up = {0.25, 1.0, 0.125};
            scene.camera.direction = dvec3(0.0, 0.0625, -1.0) + balls[i].centre * 0.0625;
            scene.background = glm::vec3(1.0f);
            scene.spheres.push_back(balls[i]);
            addDiffuse(scene, glm::vec3(0.5f));
            const double distance = glm::length(balls[i].centre);
            const double halfAngle = std::asin(balls[i].radius / distance);
            expectPicture(scene, [&](const dvec2 &position) {
                const dvec3 direction = glm::normalize(directionThrough(scene.camera, position));
                const dvec3 axis = balls[i].centre / distance;
                const double angle =
                    std::atan2(glm::length(glm::cross(direction, axis)), glm::dot(direction, axis));
                return angle < halfAngle ? Prediction{1} : Prediction{0, dvec3(1.0)};
            });
        }
    }
}

// With a field of view of 90 degrees and corners at integers every edge function is exact. Each triangle has a layer
// of depth of its own, so that the first one passed is the one seen.
TEST(Silhouette, OfTrianglesIsTheirEdges) {
    std::mt19937 random(20);
    const auto integer = [&](int low, int high) {
        return static_cast<double>(low + static_cast<int>(random() % static_cast<unsigned>(high - low + 1)));
    };
    for (const glm::ivec2 &size : pictureSizes) {
        TestScene scene = emptyScene(size.x, size.y, 90.0);
        scene.background = {1.0f, 0.0f, 0.5f};
        scene.lights.push_back({dvec3(0.0), dvec3(1e4)});
        std::vector<std::array<dvec3, 3>> triangles;
        std::vector<dvec3> albedos;
        for (int layer = 0; layer < 24; ++layer) {
            std::array<dvec3, 3> corners;
            const int reach = 10 + 9 * layer;
            for (dvec3 &corner : corners)
                corner = {integer(-reach, reach), integer(-reach, reach),
                          integer(-8 * layer - 14, -8 * layer - 8)};
            if (layer % 4 == 0) // a sliver
                corners[2] = corners[0] + dvec3(1.0, 1.0, -1.0);
            const glm::vec3 albedo = glm::vec3(integer(1, 8), integer(1, 8), integer(1, 8)) / 8.0f;
            addTriangle(scene, corners, addDiffuse(scene, albedo, true));
            triangles.push_back(corners);
            albedos.emplace_back(albedo);
        }
        const Formula formula = [&](const dvec2 &position) {
            const dvec3 direction(2.0 * position.x - size.x, size.y - 2.0 * position.y, -size.x);
            for (std::size_t i = 0; i < triangles.size(); ++i) {
                const std::array<dvec3, 3> &corners = triangles[i];
                if (!passesTriangle(corners, dvec3(0.0), direction))
                    continue;
                const dvec3 normal = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
                const double approach = glm::dot(direction, normal);
                const dvec3 point = direction * (glm::dot(corners[0], normal) / approach);
                const double cosine = std::abs(approach) / (glm::length(direction) * glm::length(normal));
                return Prediction{
                    static_cast<int>(i) + 1,
                    directLight(scene.lights[0], albedos[i], point, approach < 0.0 ? normal : -normal),
                    1.0 / cosine};
            }
            return Prediction{0, dvec3(scene.background)};
        };
        // All of the widest picture's rows, and the narrowest picture's column, lie near the middle.
        const std::size_t regions = size.x > 1 && size.y > 5 ? 8 : 2;
        expectPicture(scene, formula, {.tolerance = 1e-5, .marginPixels = 1e-4, .regions = regions});
    }
}

// The corner of a box: three faces of three colours, found as the latest entry into the three slabs.
TEST(Silhouette, OfABoxIsThreeSlabs) {
    const dvec3 lower(-3.0, -2.0, -4.0);
    const dvec3 upper(2.0, 3.0, 1.0);
    const std::vector<dvec3> eyes = {{7.0, 8.0, 9.0}, {-9.0, 4.0, 6.0}, {5.0, -7.0, -10.0}, {2.5, 3.5, 1.5}};
    for (const dvec3 &eye : eyes) {
        for (const glm::ivec2 &size : pictureSizes) {
            TestScene scene = emptyScene(size.x, size.y, eye == eyes.back() ? 120.0 : 50.0);
            scene.camera.position = eye;
            scene.camera.direction = dvec3(-0.25, 0.125, -1.0) - eye;
            scene.camera.up = {0.125, 1.0, -0.25};
            scene.background = glm::vec3(0.0f, 0.0f, 0.0f);
            scene.lights.push_back({eye, dvec3(1e4)});
            for (int axis = 0; axis < 3; ++axis) {
                glm::vec3 albedo(0.125f);
                albedo[axis] = 1.0f;
                const std::uint32_t material = addDiffuse(scene, albedo);
                dvec3 u(0.0);
                dvec3 v(0.0);
                u[(axis + 1) % 3] = (upper - lower)[(axis + 1) % 3];
                v[(axis + 2) % 3] = (upper - lower)[(axis + 2) % 3];
                dvec3 upperCorner = lower;
                upperCorner[axis] = upper[axis];
                addWall(scene, {upperCorner, u, v}, material);
                addWall(scene, {lower, v, u}, material);
            }
            const Formula formula = [&](const dvec2 &position) {
                const dvec3 direction = directionThrough(scene.camera, position);
                const dvec3 toLower = (lower - eye) / direction;
                const dvec3 toUpper = (upper - eye) / direction;
                const dvec3 enter = glm::min(toLower, toUpper);
                const dvec3 leave = glm::max(toLower, toUpper);
                const int axis =
                    enter.x > enter.y ? (enter.x > enter.z ? 0 : 2) : (enter.y > enter.z ? 1 : 2);
                const double t = enter[axis];
                if (!(t > 0.0 && t < std::min({leave.x, leave.y, leave.z})))
                    return Prediction{0};
                dvec3 normal(0.0);
                normal[axis] = direction[axis] < 0.0 ? 1.0 : -1.0;
                dvec3 albedo(0.125);
                albedo[axis] = 1.0;
                const double cosine = std::abs(direction[axis]) / glm::length(direction);
                return Prediction{axis + 1, directLight(scene.lights[0], albedo, eye + t * direction, normal),
                                  1.0 / cosine};
            };
            expectPicture(scene, formula, {.tolerance = 1e-5, .marginPixels = 1e-4, .regions = 2});
        }
    }
}

} // namespace
} // namespace hyalite::core
