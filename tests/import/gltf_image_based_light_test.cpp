// glTF: light from all around by EXT_lights_image_based.
#include "host/import/load.h"
#include "tests/fixtures/gltf_fixture.h"
#include "tests/fixtures/png_fixture.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace hyalite::core {
namespace {

constexpr int faceSize = 8;

/// Red in the right half, green in the lower half, and as much blue as the face has: 0, 51, ... 255.
std::string facePng(int face, std::uint8_t alpha) {
    std::vector<std::uint8_t> levels;
    for (int row = 0; row < faceSize; ++row)
        for (int column = 0; column < faceSize; ++column)
            levels.insert(levels.end(), {static_cast<std::uint8_t>(column < faceSize / 2 ? 0 : 255),
                                         static_cast<std::uint8_t>(row < faceSize / 2 ? 0 : 255),
                                         static_cast<std::uint8_t>(51 * face), alpha});
    return storedPng(6, levels, faceSize);
}

class GltfImageBasedLight : public GltfFolder {
  protected:
    [[nodiscard]] static GltfMaker lit(std::uint8_t alpha = 255) {
        GltfMaker maker = oneTriangle();
        nlohmann::json faces;
        for (int face = 0; face < 6; ++face) {
            maker.json["images"].push_back(
                {{"bufferView", maker.addView(facePng(face, alpha))}, {"mimeType", "image/png"}});
            faces.push_back(face);
        }
        maker.json["extensionsUsed"] = {"EXT_lights_image_based"};
        maker.json["extensions"]["EXT_lights_image_based"]["lights"] = {
            {{"specularImageSize", faceSize}, {"specularImages", {faces}}, {"irradianceCoefficients", {}}}};
        maker.json["scenes"][0]["extensions"]["EXT_lights_image_based"]["light"] = 0;
        return maker;
    }
    [[nodiscard]] static nlohmann::json &lightOf(GltfMaker &maker) {
        return maker.json["extensions"]["EXT_lights_image_based"]["lights"][0];
    }

    /// The radiance from a direction: the middle of the image is -z, its top +y, and +x is to the right of -z.
    [[nodiscard]] static glm::vec3 radianceFrom(const Image &image, const glm::dvec3 &direction) {
        const double u = 0.5 + std::atan2(direction.x, -direction.z) / (2.0 * std::numbers::pi);
        const double v = std::acos(direction.y / glm::length(direction)) / std::numbers::pi;
        const int x = static_cast<int>(u * image.width()) % image.width();
        const int y = static_cast<int>(v * image.height());
        return image.pixels()[static_cast<std::size_t>(y * image.width() + x)];
    }
};

/// Where cube maps of OpenGL (4.6, table 8.19) have a direction: the face, and s and t from -1 to 1.
struct CubeMapPlace {
    int face;
    double s;
    double t;
};
CubeMapPlace placeOf(const glm::dvec3 &r) {
    const glm::dvec3 size(std::abs(r.x), std::abs(r.y), std::abs(r.z));
    if (size.x > size.y && size.x > size.z)
        return r.x > 0 ? CubeMapPlace{0, -r.z / size.x, -r.y / size.x}
                       : CubeMapPlace{1, r.z / size.x, -r.y / size.x};
    if (size.y > size.z)
        return r.y > 0 ? CubeMapPlace{2, r.x / size.y, r.z / size.y}
                       : CubeMapPlace{3, r.x / size.y, -r.z / size.y};
    return r.z > 0 ? CubeMapPlace{4, r.x / size.z, -r.y / size.z}
                   : CubeMapPlace{5, -r.x / size.z, -r.y / size.z};
}

/// The middles of all quarters of all faces, but for the places of the axes.
std::vector<glm::dvec3> quarters() {
    std::vector<glm::dvec3> directions;
    for (const double sign : {-1.0, 1.0})
        for (const double a : {-0.5, 0.5})
            for (const double b : {-0.5, 0.5}) {
                directions.emplace_back(sign, a, b);
                directions.emplace_back(a, sign, b);
                directions.emplace_back(a, b, sign);
            }
    return directions;
}

TEST_F(GltfImageBasedLight, HasTheFacesOfACubeMapMirroredLeftToRight) {
    const LoadedScene loaded = load(lit());
    EXPECT_TRUE(loaded.scene.textures.empty());
    EXPECT_TRUE(loaded.meshReports.at(0).warnings.empty());
    const Image &image = loaded.scene.environment.radiance;
    ASSERT_EQ(image.width(), 4 * faceSize);
    for (const glm::dvec3 &direction : quarters()) {
        const glm::vec3 found = radianceFrom(image, direction);
        const CubeMapPlace place = placeOf(direction);
        EXPECT_NEAR(found.x, place.s < 0 ? 1.0 : 0.0, 0.01); // mirrored
        EXPECT_NEAR(found.y, place.t > 0 ? 1.0 : 0.0, 0.01);
        const double encoded = 0.2 * place.face;
        EXPECT_NEAR(found.z, encoded == 0.0 ? 0.0 : std::pow((encoded + 0.055) / 1.055, 2.4), 1e-5)
            << direction.x << ' ' << direction.y << ' ' << direction.z;
    }
}

TEST_F(GltfImageBasedLight, IsTurnedAndScaledAndDividedByAlpha) {
    GltfMaker maker = lit(51);
    lightOf(maker)["intensity"] = 3;
    lightOf(maker)["rotation"] = {0.0, std::sin(0.25 * std::numbers::pi), 0.0,
                                  std::cos(0.25 * std::numbers::pi)};
    const LoadedScene loaded = load(maker);
    const Image plain = load(lit()).scene.environment.radiance;
    for (const glm::dvec3 &direction : quarters()) {
        // A quarter turn about +y brings +z to +x.
        const glm::dvec3 turned(direction.z, direction.y, -direction.x);
        const glm::vec3 expected = 15.0f * radianceFrom(plain, direction);
        const glm::vec3 found = radianceFrom(loaded.scene.environment.radiance, turned);
        for (glm::length_t channel = 0; channel < 3; ++channel)
            EXPECT_NEAR(found[channel], expected[channel], 0.2);
    }
}

TEST_F(GltfImageBasedLight, BesideOtherLightsAndOfTheChosenSceneAlone) {
    GltfMaker maker = lit();
    maker.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}}};
    maker.json["nodes"][0]["extensions"]["KHR_lights_punctual"]["light"] = 0;
    maker.json["scenes"].push_back({{"nodes", {0}}});
    const LoadedScene both = load(maker);
    EXPECT_EQ(both.scene.lights.size(), 1u);
    EXPECT_FALSE(both.scene.environment.radiance.pixels().empty());
    EXPECT_TRUE(load(maker, {.gltfScene = "1"}).scene.environment.radiance.pixels().empty());
}

TEST_F(GltfImageBasedLight, WithoutAnImageIsLeftOutWithAWarning) {
    GltfMaker maker = lit();
    maker.json["images"][3] = {{"uri", "absent.png"}};
    const LoadedScene loaded = load(maker);
    EXPECT_EQ(loaded.scene.environment.radiance.width(), 512); // the neutral one
    ASSERT_EQ(loaded.meshReports.at(0).warnings.size(), 1u);
    EXPECT_NE(loaded.meshReports[0].warnings[0].find("#/images/3"), std::string::npos);
}

TEST_F(GltfImageBasedLight, RefusesWhatIsNoCube) {
    GltfMaker five = lit();
    lightOf(five)["specularImages"][0].erase(0);
    EXPECT_TRUE(refusal(five).starts_with("/extensions/EXT_lights_image_based/lights/0/specularImages/0: "))
        << refusal(five);
    GltfMaker none = lit();
    lightOf(none)["specularImages"] = nlohmann::json::array();
    EXPECT_NE(refusal(none).find("an array of cube maps"), std::string::npos) << refusal(none);
    GltfMaker beyond = lit();
    lightOf(beyond)["specularImages"][0][2] = 9;
    EXPECT_NE(refusal(beyond).find("specularImages/0/2"), std::string::npos) << refusal(beyond);
    GltfMaker oblong = lit();
    oblong.json["images"][1]["bufferView"] =
        oblong.addView(storedPng(6, std::vector<std::uint8_t>(4 * 8 * 4, 255), 8));
    EXPECT_NE(refusal(oblong).find("8x4 pixels; allowed: a square"), std::string::npos) << refusal(oblong);
    GltfMaker unknown = lit();
    unknown.json["scenes"][0]["extensions"]["EXT_lights_image_based"]["light"] = 1;
    EXPECT_NE(refusal(unknown).find("EXT_lights_image_based/light"), std::string::npos) << refusal(unknown);
    GltfMaker still = lit();
    lightOf(still)["rotation"] = {0, 0, 0, 0};
    EXPECT_NE(refusal(still).find("a unit quaternion"), std::string::npos) << refusal(still);
}

} // namespace
} // namespace hyalite::core
