// Slots that take samples in turn (shaders/drive/regeneration.glsl) make the film and the counts of the
// reference, whatever the dispatches.
#include "tests/fixtures/test_extent.h"
#include "tests/fixtures/test_scene.h"
#include "tests/images/rendering.h"

#include <gtest/gtest.h>

#include <array>
#include <string>

namespace hyalite::core {
namespace {

using testing::differingPixels;

/// A film of some samples, from one copy of it on.
class OneCopy : public SnapshotTaker {
  public:
    explicit OneCopy(int wanted) : wanted_(wanted) {}
    [[nodiscard]] bool isWanted() const noexcept override { return count_ <= wanted_; }
    void take(const std::function<void(Film &)> &copyTo, const RayCounts &raysSoFar) override {
        if (count_++ != wanted_)
            return;
        copyTo(film);
        rays = raysSoFar;
        isTaken = true;
    }

    Film film{Crop{}};
    RayCounts rays;
    bool isTaken = false;

  private:
    int wanted_;
    int count_ = 0;
};

// A room of few triangles, glass, and an environment.
const std::array scenes{"cornell", "caustics", "metals"};

class PathRegeneration : public ::testing::TestWithParam<std::size_t> {
  protected:
    // Counts of samples and pixels that no power of two divides; of tiles, too.
    TestScene scene = testing::shippedScene(scenes.at(GetParam()), 37, 23, 13);
    PackedScene packed = testing::pack(scene);
    reference::Result whole = testing::renderOnCpu(scene, packed);
};

// From more steps than any path takes to fewer than one pass does: then slots are late, finished samples wait for
// earlier ones, and at last the resumable kernel takes over. The scenes take the budgets in turn.
TEST_P(PathRegeneration, MakeTheSameFilmWithAnyBudget) {
    struct Budget {
        std::uint32_t steps;
        int samplesInFlight;
        const char *kernel;
    };
    std::size_t turn = 0;
    for (const auto &[steps, inFlight, kernel] : {Budget{0, 0, "skip-list"},
                                                  {600, 4, "skip-list-x2"},
                                                  {120, 0, "skip-list-x2"},
                                                  {120, 1, "skip-list"},
                                                  {30, 4, "skip-list"},
                                                  {5, 0, "skip-list"}}) {
        if (turn++ % scenes.size() != GetParam() && !testing::isTestingAll())
            continue;
        const gpu::Result result = testing::renderOnDevice(scene, packed,
                                                           {.tileWidth = 16,
                                                            .tileHeight = 24,
                                                            .steps = steps,
                                                            .samplesInFlight = inFlight,
                                                            .kernel = gpu::findKernel(kernel)});
        EXPECT_EQ(differingPixels(result.film, whole.film), 0u)
            << steps << " steps, " << inFlight << " in flight, " << kernel;
        EXPECT_EQ(result.rays, whole.rays) << steps << " steps, " << inFlight << " in flight";
    }
}

TEST_P(PathRegeneration, GoOnFromAnyFilm) {
    const Crop crop{0, 37, 0, 23};
    const gpu::RenderConfig config{
        .tileWidth = 16, .tileHeight = 16, .steps = 100, .kernel = gpu::findKernel("skip-list")};
    for (const int copy : {0, 3, 10}) {
        OneCopy part(copy);
        gpu::Renderer &renderer = testing::rendererBy(config);
        (void)renderer.render(packed, scene.settings, crop, {.snapshots = &part});
        ASSERT_TRUE(part.isTaken);
        const gpu::Result rest = renderer.render(packed, scene.settings, part.film);
        EXPECT_EQ(differingPixels(rest.film, whole.film), 0u) << "from copy " << copy;
        EXPECT_EQ(part.rays + rest.rays, whole.rays) << "from copy " << copy;
    }
}

INSTANTIATE_TEST_SUITE_P(Of, PathRegeneration, ::testing::Range<std::size_t>(0, scenes.size()),
                         [](const auto &row) { return std::string(scenes.at(row.param)); });

} // namespace
} // namespace hyalite::core
