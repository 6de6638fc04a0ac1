// Transforms of scene files: what they mean, and what is refused.
#include "host/import/transform_json.h"

#include "host/scene/instances.h"

#include <gtest/gtest.h>

namespace hyalite::core {
namespace {

const std::string fileName = "scene.json";

glm::dvec3 mapped(const std::string &text, const glm::dvec3 &point) {
    const nlohmann::json value = nlohmann::json::parse(text);
    const glm::dmat4x3 map = readTransform({&value, &fileName, nlohmann::json::json_pointer("/here")});
    return map[0] * point.x + map[1] * point.y + map[2] * point.z + map[3];
}

void expectNear(const glm::dvec3 &actual, const glm::dvec3 &expected) {
    for (glm::length_t i = 0; i < 3; ++i)
        EXPECT_NEAR(actual[i], expected[i], 1e-12) << i;
}

TEST(Transform, OfNumbersIsAMatrixByRows) {
    expectNear(mapped("[1, 2, 3, 4,  5, 6, 7, 8,  9, 10, 12, 12]", {1, 10, 100}), {325, 773, 1321});
    expectNear(mapped("[1, 2, 3, 4,  5, 6, 7, 8,  9, 10, 12, 12,  0, 0, 0, 1]", {1, 10, 100}),
               {325, 773, 1321});
}

TEST(Transform, OfStepsAppliesThemInTheirOrder) {
    expectNear(mapped("[]", {1, 2, 3}), {1, 2, 3});
    expectNear(mapped(R"([{"scale": 2}, {"translate": [1, 0, 0]}])", {1, 2, 3}), {3, 4, 6});
    expectNear(mapped(R"([{"translate": [1, 0, 0]}, {"scale": [2, 3, 4]}])", {1, 2, 3}), {4, 6, 12});
    expectNear(mapped(R"([{"matrix": [0, 1, 0, 5,  1, 0, 0, 6,  0, 0, 1, 7]}, {"scale": -1}])", {1, 2, 3}),
               {-7, -7, -10});
}

TEST(Transform, RotatesAboutXThenYThenZ) {
    expectNear(mapped(R"([{"rotateDegrees": [90, 0, 0]}])", {0, 1, 0}), {0, 0, 1});
    expectNear(mapped(R"([{"rotateDegrees": [0, 90, 0]}])", {0, 0, 1}), {1, 0, 0});
    expectNear(mapped(R"([{"rotateDegrees": [0, 0, 90]}])", {1, 0, 0}), {0, 1, 0});
    expectNear(mapped(R"([{"rotateDegrees": [90, 90, 0]}])", {0, 1, 0}), {1, 0, 0});
    expectNear(
        mapped(R"([{"rotateDegrees": [30, -40, 70]}])", {0.3, 0.5, 0.7}),
        mapped(
            R"([{"rotateDegrees": [30, 0, 0]}, {"rotateDegrees": [0, -40, 0]}, {"rotateDegrees": [0, 0, 70]}])",
            {0.3, 0.5, 0.7}));
}

struct WrongTransform {
    const char *text;
    const char *place;
    const char *allowed;
};

class RefusedTransform : public ::testing::TestWithParam<WrongTransform> {};

TEST_P(RefusedTransform, SaysWhatIsAllowed) {
    const nlohmann::json value = nlohmann::json::parse(GetParam().text);
    const JsonNode node{&value, &fileName, nlohmann::json::json_pointer("/here")};
    try {
        static_cast<void>(readTransform(node));
        FAIL() << "was accepted";
    } catch (const Error &error) {
        const std::string message = error.what();
        EXPECT_NE(message.find(std::string("scene.json: ") + GetParam().place + ": "), std::string::npos)
            << message;
        EXPECT_NE(message.find(GetParam().allowed), std::string::npos) << message;
    }
}

INSTANTIATE_TEST_SUITE_P(
    Each, RefusedTransform,
    ::testing::Values(WrongTransform{"5", "/here", "three rows of four"},
                      WrongTransform{"[1, 2, 3]", "/here", "three rows"},
                      WrongTransform{R"([1, 0, 0, 0, 0, 1, 0, 0, 0, 0, "x", 0])", "/here/10", "a number"},
                      WrongTransform{"[1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,1,1]", "/here", "0, 0, 0, 1"},
                      WrongTransform{R"([{"scale": 0}])", "/here", "with a volume"},
                      WrongTransform{R"([{"scale": [1, 0, 1]}])", "/here", "with a volume"},
                      WrongTransform{R"([{"scale": 1e-50}])", "/here", "with a volume"},
                      WrongTransform{R"([{"scale": 2, "translate": [0, 0, 0]}])", "/here/0", "one key"},
                      WrongTransform{R"([{"turn": 2}])", "/here/0/turn", "\"rotateDegrees\""},
                      WrongTransform{R"([{"translate": [0, 1e16, 0]}])", "/here/0/translate/1", "1e+15"}));

} // namespace
} // namespace hyalite::core
