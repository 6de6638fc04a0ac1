// The public types of the library, as programs use them.
#include "hyalite/hyalite.h"

#include "host/engine/open_backends.h"
#include "host/engine/prepare.h"
#include "tests/fixtures/temporary_folder.h"
#include "tests/fixtures/test_extent.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <sys/wait.h>
#include <unistd.h>

namespace hyalite {
namespace {

const Settings tiny{{"spp", 2}, {"width", 24}, {"height", 16}};

std::vector<float> pixelsOf(const Image &image) { return {image.pixels().begin(), image.pixels().end()}; }

bool haveEqualBits(std::span<const float> a, std::span<const float> b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size_bytes()) == 0;
}

/// One renderer for the tests that need no other: opening it takes longer than they do.
Renderer &device() {
    static Renderer renderer = [] {
        core::testing::hastenLavapipe();
        return Renderer("auto");
    }();
    return renderer;
}

void expectError(ErrorKind kind, const std::string &words, const std::function<void()> &work) {
    try {
        work();
        ADD_FAILURE() << "no error: " << words;
    } catch (const Error &error) {
        EXPECT_EQ(error.kind(), kind) << error.what();
        EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    }
}

TEST(ApiRenderer, HasTheBitsOfTheEngine) {
    core::SceneOptions options;
    options.scene = "metals";
    options.width = 24;
    options.height = 16;
    const core::PreparedScene scene = core::prepareScene(options, core::Source::Dropped, core::nobody());
    const auto cpu = core::openBackend("cpu", core::nobody());
    core::RenderSettings settings = scene.loaded.settings;
    settings.samplesPerPixel = 2;
    const core::Image expected = cpu->render(scene.packed, settings, core::Film(scene.crop)).film.toImage();
    const Image image = device().render(Scene::load("metals"), tiny);
    ASSERT_EQ(image.pixels().size(), 3 * expected.pixels().size());
    EXPECT_TRUE(haveEqualBits(image.pixels(), {&expected.pixels().data()->x, image.pixels().size()}));
    EXPECT_EQ(image.width(), 24);
    EXPECT_TRUE(image.isFinished());
    EXPECT_EQ(image.rays().primary, 24u * 16u * 2u);
    EXPECT_TRUE(std::ranges::all_of(image.samples(), [](std::uint32_t count) { return count == 2; }));
    EXPECT_NE(image.provenance().find("\"spp\": 2"), std::string::npos) << image.provenance();
}

TEST(ApiRenderer, GivesLayers) {
    const Image image = device().render(Scene::load("metals"), tiny, {.layers = {"depth", "albedo"}});
    ASSERT_EQ(image.layers().size(), 2u);
    EXPECT_EQ(image.layers()[0].name, "depth");
    EXPECT_EQ(image.layers()[0].channels, "Z");
    EXPECT_EQ(image.layers()[0].values.size(), 24u * 16u);
    EXPECT_EQ(image.layers()[1].values.size(), 3u * 24u * 16u);
    EXPECT_GT(*std::ranges::max_element(image.layers()[1].values), 0.1f);
    expectError(ErrorKind::Usage, "layers: found \"albdo\"", [] {
        static_cast<void>(device().render(Scene::load("metals"), tiny, {.layers = {"albdo"}}));
    });
}

TEST(ApiRenderer, DenoisesAndKeepsTheData) {
    Settings settings = tiny;
    settings.set("integrator", "path").set("denoise", true);
    const Image clean = device().render(Scene::load("metals"), settings, {.layers = {"depth"}});
    const Image noisy = device().render(Scene::load("metals"), Settings(tiny).set("integrator", "path"));
    std::vector<std::string> names;
    for (const Layer &layer : clean.layers())
        names.push_back(layer.name + "." + layer.channels);
    EXPECT_EQ(names, (std::vector<std::string>{"noisy.RGB", "denoising_first.RGB",
                                               "denoising_first_samples.Y", "depth.Z", "denoising_albedo.RGB",
                                               "denoising_normal.XYZ", "denoising_depth.Y"}));
    EXPECT_TRUE(haveEqualBits(clean.layers()[0].values, noisy.pixels()));
    EXPECT_TRUE(
        haveEqualBits(Renderer("cpu").render(Scene::load("metals"), settings).pixels(), clean.pixels()));
    EXPECT_NE(clean.provenance().find("\"denoised\": \"hyalite denoiser 3\""), std::string::npos)
        << clean.provenance();
    expectError(ErrorKind::Usage, "denoise: found true with 1 sample", [&] {
        static_cast<void>(device().render(Scene::load("metals"), Settings(settings).set("spp", 1)));
    });
}

// The last scene stays; what has changed about it must be seen all the same.
TEST(ApiRenderer, ShowsEachViewAndEachChange) {
    Renderer cpu("cpu");
    Scene scene = Scene::load("spheres");
    const auto fresh = [](const Scene &of, const Settings &settings) {
        return pixelsOf(Renderer("cpu").render(of, settings));
    };
    for (const Settings &settings :
         {tiny, Settings(tiny).set("camera_position", {3.0, 2.0, 40.0}),
          Settings(tiny).set("crop", {2, 9, 1, 5}), Settings(tiny).set("integrator", "normal"),
          Settings(tiny).set("bvh", "none"), tiny})
        EXPECT_EQ(pixelsOf(cpu.render(scene, settings)), fresh(scene, settings));
    const std::vector<float> before = pixelsOf(cpu.render(scene, tiny));
    const Scene copy = scene;
    scene.set("background", "[0, 0, 1]").set("spheres", "[]").set("lights", "[]");
    EXPECT_NE(pixelsOf(cpu.render(scene, tiny)), before);
    EXPECT_EQ(pixelsOf(cpu.render(copy, tiny)), before);
}

TEST(ApiRenderer, CanBeSharedByThreads) {
    const Scene scene = Scene::load("spheres");
    const std::vector<float> expected = pixelsOf(device().render(scene, tiny));
    std::atomic<int> equalCount = 0;
    std::vector<std::thread> threads;
    Renderer cpu("cpu");
    for (int i = 0; i < 4; ++i)
        threads.emplace_back([&, i] {
            Renderer &renderer = i % 2 == 0 ? device() : cpu;
            for (int repeat = 0; repeat < 3; ++repeat)
                equalCount += pixelsOf(renderer.render(scene, tiny)) == expected;
        });
    for (std::thread &thread : threads)
        thread.join();
    EXPECT_EQ(equalCount, 12);
}

TEST(ApiWatch, PassesOnWhatCallbacksThrow) {
    const Scene scene = Scene::load("spheres");
    RenderOptions options;
    options.watch.progress = [](const std::string &task, double) {
        if (task == "render")
            throw std::out_of_range("enough");
    };
    EXPECT_THROW(static_cast<void>(device().render(scene, tiny, options)), std::out_of_range);
    options.watch.progress = [](const std::string &, double) { throw 7; };
    EXPECT_THROW(static_cast<void>(device().render(scene, tiny, options)), int);
    EXPECT_TRUE(device().render(scene, tiny).isFinished());
}

TEST(ApiWatch, EndsARenderWithWhatIsFinished) {
    const Settings endless{{"spp", 65536}, {"width", 64}, {"height", 64}};
    std::atomic<bool> hasSamples = false;
    RenderOptions options;
    options.watch.progress = [&](const std::string &task, double share) {
        hasSamples = hasSamples || (task == "render" && share > 0.0);
    };
    options.watch.shouldStop = [&] { return hasSamples.load(); };
    for (const char *name : {"cpu", "auto"}) {
        hasSamples = false;
        Renderer renderer(name);
        const Image image = renderer.render(Scene::load("spheres"), endless, options);
        EXPECT_FALSE(image.isFinished()) << name;
        EXPECT_GT(*std::ranges::max_element(image.samples()), 0u) << name;
    }
}

TEST(ApiWatch, TellsWarnings) {
    Scene scene;
    const std::array<double, 9> corners{0, 0, 0, 1, 0, 0, 0, 1, 0};
    const std::array<std::uint32_t, 3> face{0, 1, 2};
    scene.addMesh({.vertices = corners, .faces = face});
    const std::array<float, 6> sky{-1, 1, 1, 1, 1, 1};
    scene.setEnvironment(2, 1, sky);
    std::vector<std::string> told;
    RenderOptions options;
    options.watch.message = [&](MessageKind kind, const std::string &text) {
        if (kind == MessageKind::Warning)
            told.push_back(text);
    };
    static_cast<void>(device().render(scene, tiny, options));
    ASSERT_EQ(told.size(), 1u);
    EXPECT_NE(told[0].find("1 of 2 pixels have negative numbers"), std::string::npos) << told[0];
}

TEST(ApiScene, RefusesArraysOfWrongSizes) {
    Scene scene;
    const std::array<double, 9> corners{0, 0, 0, 1, 0, 0, 0, 1, 0};
    const std::array<std::uint32_t, 3> face{0, 1, 2};
    const std::array<double, 4> four{};
    const std::array<float, 9> bright{2.0f};
    const std::span<const double> flat = std::span(corners).first(8);
    const std::span<const std::uint32_t> edge = std::span(face).first(2);
    using Arrays = MeshArrays;
    const std::vector<std::pair<std::string, Arrays>> wrong{
        {"vertices: found 8 numbers", {.vertices = flat, .faces = face}},
        {"faces: found 2 indices", {.vertices = corners, .faces = edge}},
        {"faces: found 2 corners", {.vertices = corners, .faces = face, .cornersPerFace = 2}},
        {"normals: found 4 numbers; allowed: 3 rows of 3",
         {.vertices = corners, .faces = face, .normals = four}},
        {"uvs: found 4 numbers; allowed: 3 rows of 2", {.vertices = corners, .faces = face, .uvs = four}},
        {"colours: found 2; allowed: numbers from 0 to 1",
         {.vertices = corners, .faces = face, .colours = bright}}};
    for (const auto &[words, arrays] : wrong)
        expectError(ErrorKind::Usage, words, [&, &mesh = arrays] { scene.addMesh(mesh); });
    expectError(ErrorKind::Usage, "instances: found 4 numbers",
                [&] { scene.addMesh({.vertices = corners, .faces = face}, "", four); });
    scene.addMesh({.vertices = corners, .faces = face}, "", {}, "floor");
    expectError(ErrorKind::Usage, "mesh \"floor\"",
                [&] { scene.addMesh({.vertices = corners, .faces = face}, "", {}, "floor"); });
    const std::array<std::uint8_t, 3> levels{};
    expectError(ErrorKind::Usage, "texture: found 2 channels",
                [&] { scene.addTexture("t", 1, 1, 2, levels); });
    expectError(ErrorKind::Usage, "environment: found 3 numbers",
                [&] { scene.setEnvironment(2, 1, std::array<float, 3>{}); });
    EXPECT_TRUE(device().render(scene, tiny).isFinished()); // nothing of it was taken
}

TEST(ApiScene, ReadsJson) {
    expectError(ErrorKind::BadInput, "/spheres: found 3",
                [] { Scene::fromJson(R"({"spheres": 3})").check(); });
    expectError(ErrorKind::BadInput, "no object", [] { static_cast<void>(Scene::fromJson("[1]")); });
    expectError(ErrorKind::BadInput, "", [] { static_cast<void>(Scene::fromJson("{")); });
    expectError(ErrorKind::BadInput, "the shipped scenes are",
                [] { static_cast<void>(Scene::load("sphere")); });
    Scene tea = Scene::load("tea-table");
    expectError(ErrorKind::Usage, "as a mesh of a new scene", [&] { tea.set("lights", "[]"); });
}

TEST(ApiImage, IsSavedAndReadAgain) {
    const core::testing::TemporaryFolder folder;
    const std::string name = folder.path / "image";
    const Image image = device().render(Scene::load("spheres"), tiny, {.layers = {"normal"}});
    image.save(name + ".exr");
    image.save(name + ".png", "aces");
    EXPECT_TRUE(haveEqualBits(Image::load(name + ".exr").pixels(), image.pixels()));
    EXPECT_TRUE(Image::load(name + ".png").isDisplayEncoded());
    std::ifstream file(name + ".png", std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(file), {}};
    EXPECT_EQ(image.png("aces").substr(0, 8), bytes.substr(0, 8));
    Image::load(name + ".png").save(name + "2.png");
    EXPECT_TRUE(diff(Image::load(name + ".png"), Image::load(name + "2.png")).isIdentical);
    expectError(ErrorKind::Usage, "tone: found \"filmic\"", [&] { image.save(name + ".png", "filmic"); });
    expectError(ErrorKind::Usage, "", [&] { image.save(name + ".bmp"); });
    expectError(ErrorKind::OutputNotWritten, "", [&] { image.save("/nowhere/at/all.png"); });
    expectError(ErrorKind::Usage, "allowed: the name of a file", [&] { image.save("-"); });
    expectError(ErrorKind::Usage, "3 of each pixel", [] { Image(2, 2, std::array<float, 3>{}); });
}

TEST(ApiImage, KeepsAlphaInFilesThatHaveIt) {
    const std::vector<float> pixels{0.25f, 0.125f, 0.0f, 0.5f, 1e6f, 0.0f};
    const std::vector<float> alpha{0.5f, 1.0f};
    const Image image(2, 1, pixels, alpha);
    EXPECT_TRUE(haveEqualBits(image.alpha(), alpha));
    const core::testing::TemporaryFolder folder;
    const std::string name = folder.path / "alpha";
    std::vector<std::string> warnings;
    SaveOptions options;
    options.warning = [&](const std::string &text) { warnings.push_back(text); };
    image.save(name + ".exr", options);
    EXPECT_TRUE(haveEqualBits(Image::load(name + ".exr").alpha(), alpha));
    image.save(name + ".png", options);
    EXPECT_EQ(Image::load(name + ".png").alpha()[0], 128.0f / 255.0f);
    EXPECT_TRUE(warnings.empty());
    image.save(name + ".hdr", options);
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_NE(warnings[0].find(name + ".hdr: HDR has no alpha"), std::string::npos) << warnings[0];
    options.half = true;
    options.compression = "piz";
    image.save(name + ".exr", options);
    ASSERT_EQ(warnings.size(), 2u);
    EXPECT_NE(warnings[1].find("1 value is beyond 65504"), std::string::npos) << warnings[1];
    EXPECT_EQ(Image::load(name + ".exr").pixels()[4], 65504.0f);
    options.compression = "pizz";
    expectError(ErrorKind::Usage, "compression", [&] { image.save(name + ".exr", options); });
    expectError(ErrorKind::Usage, "alpha", [&] { Image(2, 1, pixels, std::array<float, 3>{}); });
    EXPECT_TRUE(Image(2, 1, pixels).alpha().empty());
    const Difference difference = diff(image, Image(2, 1, pixels));
    EXPECT_FALSE(difference.isIdentical);
    EXPECT_EQ(difference.differingPixels, 0u);
    EXPECT_EQ(difference.alphaMax, 0.5);
    EXPECT_EQ(difference.alphaMean, 0.25);
}

TEST(ApiChecks, TellHowImagesDiffer) {
    const std::vector<float> dark(3 * 16 * 16, 0.25f);
    std::vector<float> light(dark);
    light[0] = 0.75f;
    const Difference difference = diff(Image(16, 16, dark), Image(16, 16, light));
    EXPECT_FALSE(difference.isIdentical);
    EXPECT_EQ(difference.differingPixels, 1u);
    EXPECT_NEAR(difference.psnrDecibels, -10.0 * std::log10(0.25 / (3 * 256)), 1e-9);
    EXPECT_NEAR(difference.errorMap[0], 0.25 / 3.0, 1e-7);
    EXPECT_GT(difference.flipMap[0], 0.1f);
    EXPECT_EQ(difference.flipMap[255], 0.0f);
    EXPECT_TRUE(std::isnan(difference.ssimMap[0]));
    EXPECT_LT(difference.ssimMap[16 * 5 + 5], 1.0f);
    EXPECT_EQ(difference.ssimMap[16 * 10 + 10], 1.0f);
    expectError(ErrorKind::Usage, "images of one size",
                [&] { static_cast<void>(diff(Image(16, 16, dark), Image(8, 32, dark))); });
}

TEST(ApiChecks, CompareAndProfile) {
    const Comparison comparison = compare(Scene::load("spheres"), tiny);
    EXPECT_TRUE(comparison.isEqual) << comparison.json;
    EXPECT_TRUE(haveEqualBits(comparison.first.pixels(), comparison.second.pixels()));
    const Profile figures = profile(Scene::load("spheres"), tiny, {.repeats = 3});
    EXPECT_EQ(figures.frameMillis.size(), 3u);
    EXPECT_GT(figures.megaraysPerSecond, 0.0);
    EXPECT_NE(figures.json.find("profileVersion"), std::string::npos);
    const std::vector<Device> all = devices();
    EXPECT_EQ(all.back().name, "cpu");
    EXPECT_TRUE(std::ranges::all_of(all, [](const Device &entry) { return !entry.json.empty(); }));
}

TEST(ApiSettings, AreThoseOfTheCommandLine) {
    const std::vector<std::string> names = settingNames();
    for (const char *name : {"spp", "max_depth", "camera_position", "environment_rotate", "crop"})
        EXPECT_EQ(std::ranges::count(names, name), 1) << name;
    expectError(ErrorKind::Usage, "max_depth: found \"0\"; allowed: a whole number from 1 to 32", [] {
        static_cast<void>(device().render(Scene::load("spheres"), {{"max_depth", 0}}));
    });
    expectError(ErrorKind::Usage, "crop: 0,9,0,9 is empty or leaves the image", [] {
        static_cast<void>(device().render(Scene::load("spheres"), {{"width", 8}, {"crop", {0, 9, 0, 9}}}));
    });
}

// Neither drivers nor OpenMP have their threads in the child: what would hang is refused.
TEST(ApiProcess, RefusesToWorkAfterAFork) {
    static_cast<void>(device());
    const pid_t child = fork();
    if (child == 0) {
        int refusedCount = 0;
        for (const auto &work : std::vector<std::function<void()>>{
                 [] { static_cast<void>(device().render(Scene::load("spheres"), tiny)); },
                 [] { Renderer another("cpu"); }, [] { static_cast<void>(devices()); }})
            try {
                work();
            } catch (const Error &error) {
                refusedCount += std::string(error.what()).find("forked") != std::string::npos;
            }
        _exit(refusedCount);
    }
    int status = 0;
    for (int tenths = 0; tenths < 100 && waitpid(child, &status, WNOHANG) == 0; ++tenths)
        std::this_thread::sleep_for(std::chrono::milliseconds(100));
    kill(child, SIGKILL); // if it hangs
    EXPECT_TRUE(WIFEXITED(status));
    EXPECT_EQ(WEXITSTATUS(status), 3);
}

} // namespace
} // namespace hyalite
