// Coverage of pictures whose shares are known.
#include "host/lab/coverage.h"

#include "tests/fixtures/temporary_folder.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace hyalite::core {
namespace {

class CoverageOf : public ::testing::Test {
  protected:
    [[nodiscard]] Coverage measure(const std::string &scene, const std::vector<int> &crop = {}) const {
        const std::filesystem::path file = folder_ / "scene.json";
        std::ofstream(file) << scene;
        std::ofstream(folder_ / "square.obj") << "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nf 1 2 3 4\n";
        SceneOptions options;
        options.scene = file.string();
        options.crop = crop;
        return measureCoverage(prepareScene(options, Source::Kept, nobody()));
    }

    const testing::TemporaryFolder temporary_;
    const std::filesystem::path &folder_ = temporary_.path;
};

/// An orthographic camera that shows x and y from -4 to 4 in 80 x 80 pixels, and the rest of a scene.
std::string seenFromAhead(const std::string &rest) {
    return R"({"camera": {"type": "orthographic", "position": [0, 0, 20], "viewWidth": 8, "width": 80, "height": 80},
        "materials": {"red": {"type": "diffuse"}, "blue": {"type": "diffuse"}, "glass": {"type": "dielectric"}}, )" +
           rest + "}";
}

TEST_F(CoverageOf, CountsPixelsOfObjectsMaterialsAndBackground) {
    // Squares of side 2: 20 x 20 pixels. The one behind is half hidden.
    const Coverage coverage = measure(seenFromAhead(
        R"("meshes": [{"file": "square.obj", "material": "red", "translate": [-2, 2, 0]}],
           "shapes": [{"type": "quad", "material": "blue", "transform": [{"translate": [-1, 2, -1]}]},
                      {"type": "quad", "material": "blue", "transform": [{"translate": [30, 0, 0]}]}])"));
    EXPECT_EQ(coverage.pixelCount, 6400u);
    EXPECT_EQ(coverage.backgroundCount, 6400u - 600u);
    ASSERT_EQ(coverage.objects.size(), 2u);
    EXPECT_EQ(coverage.objects[0].node.name, "square.obj");
    EXPECT_EQ(coverage.objects[0].node.kind, NodeKind::Mesh);
    EXPECT_EQ(coverage.objects[0].pixels.pixelCount, 400u);
    EXPECT_EQ(coverage.objects[0].pixels.box, (Crop{10, 30, 10, 30}));
    EXPECT_EQ(coverage.objects[1].node.kind, NodeKind::Shape);
    EXPECT_EQ(coverage.objects[1].node.index, 0u);
    EXPECT_EQ(coverage.objects[1].pixels.pixelCount, 200u);
    EXPECT_EQ(coverage.objects[1].pixels.box, (Crop{30, 40, 10, 30}));
    EXPECT_FALSE(coverage.objects[1].instance);
    EXPECT_EQ(coverage.unseenCount, 1u);
    ASSERT_EQ(coverage.materials.size(), 2u);
    EXPECT_EQ(coverage.materials[0].name, "red");
    EXPECT_EQ(coverage.materials[1].pixels.pixelCount, 200u);
    EXPECT_EQ(coverage.shareOf(coverage.materials[1].pixels.pixelCount), 200.0 / 6400.0);
}

TEST_F(CoverageOf, TellsInstancesAndSpheresApart) {
    const Coverage coverage = measure(seenFromAhead(
        R"("spheres": [{"centre": [2, -2, 0], "radius": 1, "material": "blue"},
                       {"centre": [-2, -2, 0], "radius": 1.5, "material": "glass"}],
           "meshes": [{"file": "square.obj", "material": "red", "instances": [
               [{"translate": [-2, 2, 0]}], [{"translate": [2, 2, 0]}], [{"translate": [0, 50, 0]}]]}])"));
    ASSERT_EQ(coverage.objects.size(), 4u);
    EXPECT_EQ(coverage.objects[0].sphere, 1u) << "the larger one first; glass counts as seen";
    EXPECT_EQ(coverage.objects[0].material, "glass");
    EXPECT_NEAR(static_cast<double>(coverage.objects[0].pixels.pixelCount), 3.14159 * 15 * 15, 20);
    EXPECT_EQ(coverage.objects[1].instance, 0u);
    EXPECT_EQ(coverage.objects[1].pixels.box, (Crop{10, 30, 10, 30}));
    EXPECT_EQ(coverage.objects[2].instance, 1u);
    EXPECT_EQ(coverage.objects[2].pixels.box, (Crop{50, 70, 10, 30}));
    EXPECT_EQ(coverage.objects[3].sphere, 0u);
    EXPECT_EQ(coverage.unseenCount, 1u);
    EXPECT_EQ(coverage.materials[0].name, "red");
    EXPECT_EQ(coverage.materials[0].pixels.pixelCount, 800u);
}

TEST_F(CoverageOf, ACropIsTheWhole) {
    const Coverage coverage =
        measure(seenFromAhead(R"("shapes": [{"type": "quad", "material": "red"}])"), {30, 40, 30, 50});
    EXPECT_EQ(coverage.pixelCount, 200u);
    EXPECT_EQ(coverage.backgroundCount, 0u);
    EXPECT_EQ(coverage.objects.at(0).pixels.box, (Crop{30, 40, 30, 50}));
}

TEST_F(CoverageOf, ALensIsAPinholeAtItsCentre) {
    const auto sceneWith = [](const std::string &lens) {
        return R"({"camera": {"position": [0, 0, 9], "target": [0, 0, 0], "width": 64, "height": 64)" + lens +
               R"(}, "materials": {"a": {"type": "diffuse"}}, "shapes": [{"type": "box", "material": "a"}]})";
    };
    const Coverage sharp = measure(sceneWith(""));
    const Coverage blurred = measure(sceneWith(R"(, "aperture": 3, "focusDistance": 2)"));
    EXPECT_GT(sharp.backgroundCount, 100u);
    EXPECT_EQ(blurred.backgroundCount, sharp.backgroundCount);
    EXPECT_EQ(blurred.objects.at(0).pixels.box, sharp.objects.at(0).pixels.box);
}

} // namespace
} // namespace hyalite::core
