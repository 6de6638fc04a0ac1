// What a viewer shows is what a render makes.
#include "tests/view/viewer_fixture.h"

#include "host/engine/backend.h"
#include "host/image/exr.h"
#include "host/image/image_file.h"
#include "host/jobs/denoising.h"
#include "host/jobs/layers.h"

#include <cmath>

namespace hyalite::core::testing {
namespace {

using Json = nlohmann::json;

struct Viewers : ViewerFolder {};

/// The picture of a render with these options, once without and once with the denoiser.
struct Expected {
    Image raw{0, 0};
    std::optional<Image> clean;
};
Expected rendered(SceneOptions options, std::optional<Integrator> shown = {}) {
    PreparedScene scene = prepareScene(options, Source::Dropped, nobody());
    RenderSettings &settings = scene.loaded.settings;
    settings.integrator = shown.value_or(settings.integrator);
    settings.hasDenoisingData = true;
    const auto backend = openBackend("cpu", nobody());
    const std::vector<ViewFilm> views =
        renderViews(*backend, scene, viewsOf(scene), {}, {}, nobody(), TimeLimit());
    const Film film =
        render(*backend, scene.packed, settings, Film(scene.crop), nobody(), {.name = "", .keepsFirst = true})
            .film;
    return {film.toImage(),
            haveDenoiserViews(views) ? denoised(*backend, film, views, nobody()) : std::nullopt};
}

TEST_F(Viewers, ShowTheBitsOfARender) {
    const std::string scene = store("ball.json", ballScene(0.5, 11)); // no power of two
    Viewer viewer(requestOf(scene), nobody());
    SceneOptions options;
    options.scene = scene;
    Json state = waitForAll(viewer);
    EXPECT_EQ(state["renderers"][0]["samples"], 11);
    EXPECT_EQ(viewer.frame(0, false)->image.pixels(), rendered(options).raw.pixels());

    viewer.change(
        {{"camera-position", {1.0, 2.0, 4.0}}, {"fov", 40}, {"spp", 3}, {"width", 30}, {"clean", true}});
    state = waitForAll(viewer);
    EXPECT_EQ(state["camera"]["position"], Json({1.0, 2.0, 4.0}));
    for (const auto &[name, value] : std::vector<std::pair<const char *, OptionValue>>{
             {"camera-position", std::vector{1.0, 2.0, 4.0}}, {"fov", 40.0}, {"spp", 3.0}, {"width", 30.0}})
        setSceneOption(options, name, value);
    const Expected moved = rendered(options);
    EXPECT_EQ(viewer.frame(0, false)->image.pixels(), moved.raw.pixels());
    ASSERT_TRUE(viewer.frame(0, true)->isClean);
    EXPECT_EQ(viewer.frame(0, true)->image.pixels(), moved.clean->pixels());

    viewer.change({{"show", "normal"}, {"clean", false}});
    waitForAll(viewer);
    EXPECT_EQ(viewer.frame(0, false)->image.pixels(), rendered(options, Integrator::Normal).raw.pixels());
}

TEST_F(Viewers, ShowAnAdaptiveRender) {
    const std::string scene = store("ball.json", ballScene(0.5, 64));
    SceneOptions options;
    options.scene = scene;
    setSceneOption(options, "noise", std::string("4%"));
    setSceneOption(options, "spp", 256.0);
    ViewRequest request = requestOf(scene);
    request.scene = options;
    Viewer viewer(std::move(request), nobody());
    waitForAll(viewer);
    EXPECT_EQ(viewer.frame(0, false)->image.pixels(), rendered(options).raw.pixels());
}

// Samples for a noise are many more than a layer needs.
TEST_F(Viewers, GiveALayerTheSamplesOfTheSceneWhereANoiseIsAskedFor) {
    ViewRequest request = requestOf(store("ball.json", ballScene(0.5, 5)));
    setSceneOption(request.scene, "noise", std::string("20%"));
    Viewer viewer(std::move(request), nobody());
    viewer.change({{"show", "normal"}});
    const Json state = waitForAll(viewer);
    EXPECT_EQ(state["samplesPerPixel"], 5);
    EXPECT_EQ(viewer.frame(0, false)->samples, 5);
}

TEST_F(Viewers, CompareTwoRenderers) {
    const std::string scene = store("ball.json", ballScene(0.5, 16));
    const auto differenceOf = [&](const RendererNames &other) {
        Viewer viewer(requestOf(scene, {{"cpu"}, other}), nobody());
        waitForAll(viewer);
        const Json difference = viewer.state()["difference"];
        EXPECT_EQ(difference["samples"], 16);
        const auto a = viewer.frame(0, false);
        const auto b = viewer.frame(1, false);
        std::size_t pixels = 0;
        for (std::size_t i = 0; i < a->image.pixels().size(); ++i)
            pixels += a->image.pixels()[i] != b->image.pixels()[i];
        EXPECT_EQ(difference["pixels"], pixels);
        return pixels;
    };
    EXPECT_EQ(differenceOf({"cpu"}), 0u);
    EXPECT_GT(differenceOf({"cpu-double"}), 0u) << "it has bits of its own";
}

TEST_F(Viewers, RefuseWhatIsNotAllowedAndKeepTheRest) {
    const std::string scene = store("ball.json", ballScene(0.5));
    Viewer viewer(requestOf(scene), nobody());
    waitForAll(viewer);
    const std::uint64_t view = viewer.state()["view"];
    for (const Json &wish : std::vector<Json>{{{"fov", 200}},
                                              {{"camera-position", {1, 2}}},
                                              {{"camera-position", "here"}},
                                              {{"show", "cost"}},
                                              {{"show", 3}},
                                              {{"clean", "yes"}},
                                              {{"environment", "/etc/passwd"}},
                                              {{"colour", 1}},
                                              {{"spp", Json::object()}},
                                              {{"width", 1e9}},
                                              Json::array(),
                                              "x"})
        EXPECT_THROW(viewer.change(wish), OverrideError) << wish;
    EXPECT_EQ(viewer.state()["view"], view);
    // Each by itself is allowed; together they are not.
    for (const Json &wish : std::vector<Json>{{{"camera-position", {0, 0, 0}}, {"look-at", {0, 0, 0}}},
                                              {{"width", 32768}, {"height", 32768}},
                                              {{"camera", "none"}}}) {
        viewer.change(wish);
        waitFor(viewer, [](const Json &state) { return state["fault"] != "" && !state["isChanging"]; });
    }
    const std::shared_ptr<const ViewFrame> before = viewer.frame(0, false);
    viewer.change({{"fov", 30}});
    const Json state = waitFor(viewer, [](const Json &now) {
        return now["fault"] == "" && now["camera"]["fov"] == 30.0 && now["renderers"][0]["isFinished"];
    });
    EXPECT_EQ(state["camera"]["position"], Json({0.0, 0.0, 5.0}));
    EXPECT_NE(viewer.frame(0, false)->number, before->number);
}

TEST_F(Viewers, ReadChangedFilesAgain) {
    const std::string scene = store("ball.json", ballScene(0.25));
    Viewer viewer(requestOf(scene), nobody());
    waitForAll(viewer);
    const auto middle = [&] { return viewer.frame(0, false)->image.at(12, 7).x; };
    const float dark = middle();
    static_cast<void>(store("ball.json", "{\"spheres\": 3}"));
    Json state = waitFor(viewer, [](const Json &now) { return now["fault"] != ""; });
    EXPECT_NE(state["fault"].get<std::string>().find("spheres"), std::string::npos);
    EXPECT_EQ(middle(), dark) << "the old picture stays";
    std::filesystem::remove(scene);
    static_cast<void>(store("ball.json", ballScene(0.5)));
    state = waitFor(viewer, [](const Json &now) {
        return now["fault"] == "" && now["view"] > 1 && now["renderers"][0]["isFinished"];
    });
    EXPECT_FLOAT_EQ(middle(), 2.0f * dark);
}

TEST_F(Viewers, GivePicturesAndScenesAway) {
    const std::string scene = store("ball.json", ballScene(0.5, 8));
    Viewer viewer(requestOf(scene), nobody());
    viewer.change({{"camera-position", {1.0, 2.0, 4.0}}, {"up", {0.0, 1.0, 0.1}}, {"aperture", 0.1}});
    waitForAll(viewer);
    const std::vector<glm::vec3> shown = viewer.frame(0, false)->image.pixels();
    const std::vector<std::byte> exr = viewer.pictureFile(0, {.format = ImageFormat::Exr, .isClean = false});
    const std::string path = store("view.exr", {reinterpret_cast<const char *>(exr.data()), exr.size()});
    EXPECT_EQ(readExr(InputFile(path)).pixels(), shown);
    const std::vector<std::byte> png = viewer.pictureFile(
        0, {.format = ImageFormat::Png, .isClean = false, .tone = ToneCurve::Agx, .exposureStops = 1.0});
    const std::string pngPath = store("view.png", {reinterpret_cast<const char *>(png.data()), png.size()});
    const LoadedImage read = readImage(pngPath);
    EXPECT_EQ(pngLevels(read.image, read.alpha), toneMap(viewer.frame(0, false)->image, 1.0, ToneCurve::Agx));

    SceneOptions again;
    again.scene = store("again.json", viewer.sceneText());
    EXPECT_EQ(rendered(again).raw.pixels(), shown) << viewer.sceneText();
}

TEST_F(Viewers, OfAMeshGiveASceneAroundIt) {
    const std::string mesh = store("box.obj", "v -1 -1 0\nv 1 -1 0\nv 1 1 0.5\nv -1 1 0\nf 1 2 3\nf 1 3 4\n");
    Viewer viewer(requestOf(mesh), nobody());
    viewer.change({{"camera-position", {1.0, 2.0, 6.0}}, {"width", 40}, {"height", 30}, {"spp", 2}});
    waitForAll(viewer);
    SceneOptions again;
    again.scene = store("again.json", viewer.sceneText());
    EXPECT_EQ(rendered(again).raw.pixels(), viewer.frame(0, false)->image.pixels()) << viewer.sceneText();
}

TEST_F(Viewers, PickWhatAPixelShows) {
    const std::string scene = store("ball.json", ballScene(0.5));
    const Viewer viewer(requestOf(scene), nobody());
    const std::optional<Pick> middle = viewer.pick(0.5, 0.5);
    ASSERT_TRUE(middle);
    EXPECT_NEAR(middle->distance, 4.0, 0.05);
    EXPECT_NEAR(middle->position.z, 1.0, 0.05);
    EXPECT_LE(middle->depth, middle->distance);
    EXPECT_EQ(middle->material, "clay");
    EXPECT_FALSE(viewer.pick(0.0, 0.0));
}

TEST_F(Viewers, EndWhileTheyRender) {
    const std::string scene = store("ball.json", ballScene(0.5, 65536));
    Viewer viewer(requestOf(scene), nobody());
    waitFor(viewer, [](const Json &state) { return state["renderers"][0]["samples"] > 1; });
    EXPECT_TRUE(viewer.stop(std::chrono::seconds(60)));
}

} // namespace
} // namespace hyalite::core::testing
