// Options of scenes by their names, and other views of a prepared scene.
#include "host/engine/scene_options.h"

#include <gtest/gtest.h>

#include <cstring>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace hyalite::core {
namespace {

using Options = std::vector<std::pair<std::string, OptionValue>>;

SceneOptions optionsOf(const std::string &scene, const Options &values) {
    SceneOptions options;
    options.scene = scene;
    for (const auto &[name, value] : values)
        setSceneOption(options, name, value);
    return options;
}

std::string refusalOf(const std::string &name, const OptionValue &value) {
    try {
        static_cast<void>(optionsOf("spheres", {{name, value}}));
    } catch (const OverrideError &error) {
        return error.name + ": " + error.what();
    }
    return "not refused";
}

TEST(SceneOptions, AreSetByTheirNames) {
    const SceneOptions options = optionsOf("spheres", {{"width", 64.0},
                                                       {"crop", std::vector{0.0, 8.0, 2.0, 4.0}},
                                                       {"up", std::string("-z")},
                                                       {"look-at", std::vector{1.0, 2.0, 3.5}},
                                                       {"camera", std::string("front")},
                                                       {"flatten", true},
                                                       {"max-depth", 3.0},
                                                       {"integrator", std::string("path")}});
    EXPECT_EQ(options.width, 64);
    EXPECT_EQ(options.crop, (std::vector{0, 8, 2, 4}));
    EXPECT_EQ(options.up, (std::vector{0.0, 0.0, -1.0}));
    EXPECT_EQ(options.lookAt, (std::vector{1.0, 2.0, 3.5}));
    EXPECT_EQ(options.load.camera, "front");
    EXPECT_TRUE(options.isFlattened);
    RenderSettings settings;
    for (const SettingChange &change : options.settings)
        change.apply(settings);
    EXPECT_EQ(settings.maxDepth, 3);
    EXPECT_EQ(settings.integrator, Integrator::Path);
}

TEST(SceneOptions, AreRefusedInTheWordsOfTheCommandLine) {
    EXPECT_EQ(refusalOf("spp", 0.0), "spp: found \"0\"; allowed: a whole number from 1 to 65536");
    EXPECT_EQ(refusalOf("max-depth", 1.5), "max-depth: found \"1.5\"; allowed: a whole number from 1 to 32");
    EXPECT_EQ(refusalOf("fov", 180.0), "fov: found \"180\"; allowed: a number more than 0 and less than 180");
    EXPECT_EQ(refusalOf("fov", std::string("wide")),
              "fov: found \"wide\"; allowed: a number more than 0 and less than 180");
    EXPECT_EQ(refusalOf("look-at", std::vector{1.0, 2.0}), "look-at: found \"1,2\"; allowed: 3 numbers");
    EXPECT_EQ(refusalOf("up", std::string("w")),
              "up: found \"w\"; allowed: 3 numbers, or x, y, z, -x, -y or -z");
    EXPECT_EQ(refusalOf("filter", std::string("bix")),
              "filter: found \"bix\"; allowed: \"box\", \"blackman-harris\"; did you mean \"box\"?");
    EXPECT_EQ(refusalOf("scale", std::string("0%")), "scale: found \"0%\"; allowed: a percentage, as 25%");
    EXPECT_EQ(refusalOf("flatten", 1.0), "flatten: found \"1\"; allowed: true or false");
    EXPECT_EQ(refusalOf("environment", std::string()),
              "environment: found \"\"; allowed: the name of a file");
    EXPECT_EQ(refusalOf("sppp", 1.0), "sppp: is no setting; did you mean \"spp\"?");
}

/// What renderers and files read of a prepared scene.
void expectSame(const PreparedScene &a, const PreparedScene &b, const std::string &what) {
    EXPECT_EQ(a.contentHash(), b.contentHash()) << what;
    EXPECT_EQ(a.packed.camera, b.packed.camera) << what;
    const layout::FrameRecord frameA = frameOf(a.packed, a.loaded.settings);
    const layout::FrameRecord frameB = frameOf(b.packed, b.loaded.settings);
    EXPECT_EQ(std::memcmp(&frameA, &frameB, sizeof frameA), 0) << what;
    EXPECT_EQ(settingsToJson(a.loaded.settings), settingsToJson(b.loaded.settings)) << what;
    EXPECT_EQ(a.crop.width(), b.crop.width()) << what;
    EXPECT_EQ(a.crop.x0, b.crop.x0) << what;
}

TEST(OtherViews, AreAsIfPreparedAnew) {
    const std::vector<Options> views{
        {},
        {{"spp", 3.0}, {"seed", 5.0}},
        {{"width", 40.0}},
        {{"width", 40.0}, {"height", 20.0}, {"crop", std::vector{3.0, 9.0, 0.0, 20.0}}},
        {{"camera-position", std::vector{1.0, 2.0, 30.0}}},
        {{"camera-position", std::vector{1.0, 2.0, 30.0}}, {"look-at", std::vector{0.0, 1.0, 0.0}}},
        {{"scale", std::string("50%")}, {"crop", std::vector{3.0, 9.0, 0.0, 20.0}}},
        {{"fov", 30.0}, {"up", std::string("x")}},
        {{"aperture", 0.5}, {"focus-distance", 20.0}},
        {{"max-depth", 2.0}, {"sampler", std::string("centre")}, {"exposure", 1.0}}};
    for (const std::string scene : {"spheres", "spheres-nested", "cornell", "cat"}) {
        PreparedScene moved = prepareScene(optionsOf(scene, {}), Source::Dropped, nobody());
        SceneOptions before = optionsOf(scene, {});
        for (const Options &view : views) {
            const SceneOptions options = optionsOf(scene, view);
            ASSERT_TRUE(isOtherView(moved, before, options));
            changeView(moved, options);
            before = options;
            expectSame(moved, prepareScene(options, Source::Dropped, nobody()),
                       scene + ", view " + std::to_string(&view - views.data()));
        }
    }
}

TEST(SceneOptions, ACameraHasOnlyWhatItsKindHas) {
    const auto refusal = [](const std::string &scene, const std::string &name) {
        try {
            static_cast<void>(prepareScene(optionsOf(scene, {{name, 3.0}}), Source::Dropped, nobody()));
        } catch (const OverrideError &error) {
            return error.name + ": " + error.what();
        }
        return std::string("not refused");
    };
    EXPECT_EQ(
        refusal("spheres", "view-width"),
        "view-width: found a camera of the type perspective, which has no view width; allowed: with one of "
        "the type orthographic");
    const std::string orthographic = HYALITE_SOURCE_DIR "/tests/bits/orthographic.json";
    EXPECT_EQ(refusal(orthographic, "view-width"), "not refused");
    for (const char *name : {"fov", "aperture", "focus-distance"})
        EXPECT_NE(refusal(orthographic, name).find("allowed: with one of the type perspective"),
                  std::string::npos);
    const PreparedScene wide =
        prepareScene(optionsOf(orthographic, {{"view-width", 3.0}}), Source::Dropped, nobody());
    EXPECT_EQ(wide.loaded.scene.camera.viewWidth, 3.0);
}

TEST(SceneOptions, InstancesAreTheSameSceneAsMeshesAreAndSayWhatTheyBecame) {
    const auto preparedWith = [](const Options &options) {
        return prepareScene(optionsOf("tea-table", options), Source::Dropped, nobody());
    };
    const PreparedScene kept = preparedWith({{"keep-instances", true}});
    EXPECT_GT(kept.packed.instances.size(), 0u);
    EXPECT_EQ(kept.arrangement.instanceCount, kept.packed.instances.size() + kept.arrangement.flattenedCount);
    for (const Options &options : {Options{}, Options{{"flatten", true}}}) {
        const PreparedScene flattened = preparedWith(options);
        EXPECT_EQ(flattened.packed.instances.size(), 0u);
        EXPECT_EQ(flattened.arrangement.flattenedCount, kept.arrangement.instanceCount);
        EXPECT_EQ(flattened.contentHash(), kept.contentHash()) << "checkpoints and parts fit";
    }
    EXPECT_THROW((void)preparedWith({{"keep-instances", true}, {"flatten", true}}), OverrideError);
    EXPECT_THROW((void)preparedWith({{"keep-instances", true}, {"bvh", std::string("none")}}), OverrideError);
}

TEST(OtherViews, AreNotWhatIsPackedAnew) {
    const SceneOptions options = optionsOf("cornell", {});
    const PreparedScene scene = prepareScene(options, Source::Dropped, nobody());
    for (const Options &other : std::vector<Options>{{{"bvh", std::string("midpoint")}},
                                                     {{"leaf-size", 2.0}},
                                                     {{"light-choice", std::string("tree")}},
                                                     {{"integrator", std::string("whitted")}},
                                                     {{"background", std::vector{1.0, 1.0, 1.0}}},
                                                     {{"environment", std::string("neutral")}},
                                                     {{"keep-instances", true}},
                                                     {{"flatten", true}}})
        EXPECT_FALSE(isOtherView(scene, options, optionsOf("cornell", other))) << other.front().first;
    EXPECT_FALSE(isOtherView(scene, options, optionsOf("metals", {})));
}

TEST(OtherViews, CanFollowOneThatWasRefused) {
    PreparedScene scene = prepareScene(optionsOf("cornell", {}), Source::Dropped, nobody());
    EXPECT_THROW(changeView(scene, optionsOf("cornell", {{"crop", std::vector{0.0, 99999.0, 0.0, 1.0}}})),
                 OverrideError);
    EXPECT_THROW(changeView(scene, optionsOf("cornell", {{"ao-distance", 1.0}})), OverrideError);
    const SceneOptions options = optionsOf("cornell", {{"width", 24.0}});
    changeView(scene, options);
    expectSame(scene, prepareScene(options, Source::Dropped, nobody()), "after refusals");
}

} // namespace
} // namespace hyalite::core
