// farm_model [--scene NAME] [--spp COUNT] [--whole SECONDS] [--start SECONDS] [--tile SECONDS] [--merge SECONDS]
// [--network BYTES]
//
// Computes, and does not measure, how long a picture takes on 1 to 10,000 nodes like this machine, in parts and by
// ranks. What it computes with is measured, here or elsewhere:
//
// - the work of each block of 8x8 pixels of the scene at 1920x1080: by the CPU twin, 2 samples a pixel, one thread;
// scaled
//   so that the whole picture takes what this machine's device takes for it (8 samples, or --whole SECONDS);
// - the options: start of a process, setting up a tile, reading a part in `merge`, bytes a second between ranks.
//
// Parts are those of Partition, tiles those of TileQueue and tilePixels(): the program's own.
#include "host/engine/cpu_backend.h"
#include "host/engine/open_backends.h"
#include "host/engine/tile_queue.h"
#include "host/film/partition.h"
#include "host/process/silent_observer.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <exception>
#include <functional>
#include <queue>
#include <string>
#include <vector>

#include <time.h>

namespace hyalite::core {

namespace {

constexpr int width = 1920;
constexpr int height = 1080;

struct Options {
    std::string scene = "studio-cat";
    double samplesPerPixel = 4096;
    double wholeSeconds = 0.0; ///< of the picture on one node; 0: measure
    double startSeconds = 0.4;
    double tileSeconds = 0.002;
    double mergeSecondsPerPart = 0.001;
    double mergeSecondsPerPixel = 1e-7;
    double networkBytesPerSecond = 1e8;
};

double secondsOf(const std::function<void()> &work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Of this thread on a processor: what else the machine does must not make a block of pixels dear.
double processorSecondsOf(const std::function<void()> &work) {
    const auto now = [] {
        timespec time{};
        clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
        return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
    };
    const double start = now();
    work();
    return now() - start;
}

PreparedScene prepare(const std::string &name, int samplesPerPixel) {
    SceneOptions options;
    options.scene = name;
    options.width = width;
    options.height = height;
    options.settings.push_back(
        {[=](RenderSettings &settings) { settings.samplesPerPixel = samplesPerPixel; }});
    return prepareScene(options, Source::Dropped, nobody());
}

/// The work of rectangles of a picture, in seconds of this machine at the wanted samples.
class WorkMap {
  public:
    explicit WorkMap(const Options &options) {
        const PreparedScene scene = prepare(options.scene, 2);
        const std::unique_ptr<Backend> cpu = makeCpuBackend(reference::Precision::Float32, 1);
        double sum = 0.0;
        for (int y = 0; y < rows; ++y)
            for (int x = 0; x < columns; ++x) {
                const double seconds = processorSecondsOf(
                    [&] { (void)cpu->render(scene.packed, scene.loaded.settings, blockAt(x, y)); });
                sums_[index(x + 1, y + 1)] = seconds;
                sum += seconds;
            }
        wholeSeconds_ = options.wholeSeconds > 0.0 ? options.wholeSeconds : measureWhole(options);
        for (int y = 1; y <= rows; ++y)
            for (int x = 1; x <= columns; ++x) {
                double &here = sums_[index(x, y)];
                here = here * wholeSeconds_ / sum + sums_[index(x - 1, y)] + sums_[index(x, y - 1)] -
                       sums_[index(x - 1, y - 1)];
            }
    }

    [[nodiscard]] double wholeSeconds() const { return wholeSeconds_; }

    /// Of a rectangle of whole blocks.
    [[nodiscard]] double secondsIn(const Crop &crop) const {
        const int x0 = crop.x0 / side;
        const int y0 = crop.y0 / side;
        const int x1 = (crop.x1 + side - 1) / side;
        const int y1 = (crop.y1 + side - 1) / side;
        return sums_[index(x1, y1)] - sums_[index(x0, y1)] - sums_[index(x1, y0)] + sums_[index(x0, y0)];
    }

  private:
    static constexpr int side = TileQueue::blockSide;
    static constexpr int columns = width / side;
    static constexpr int rows = height / side;

    static double measureWhole(const Options &options) {
        const PreparedScene timed = prepare(options.scene, 8);
        SilentObserver observer;
        const std::unique_ptr<Backend> device = openBackend("auto", observer, processorsFor(0, timed));
        (void)device->render(timed.packed, timed.loaded.settings, timed.crop); // compiles
        return secondsOf([&] { (void)device->render(timed.packed, timed.loaded.settings, timed.crop); }) /
               8.0 * options.samplesPerPixel;
    }

    [[nodiscard]] static Crop blockAt(int x, int y) {
        return {x * side, (x + 1) * side, y * side, (y + 1) * side};
    }
    [[nodiscard]] static std::size_t index(int x, int y) {
        return static_cast<std::size_t>(y) * (columns + 1) + static_cast<std::size_t>(x);
    }

    std::vector<double> sums_ = std::vector<double>(static_cast<std::size_t>(columns + 1) * (rows + 1));
    double wholeSeconds_ = 0.0;
};

struct Outcome {
    double seconds = 0.0;
    std::string bound; ///< what takes most of what is no work
};

std::string largest(std::initializer_list<std::pair<const char *, double>> shares) {
    return std::max(shares, [](const auto &a, const auto &b) { return a.second < b.second; }).first;
}

/// Each node renders a part, and one merges when all are finished.
Outcome inParts(const WorkMap &work, const Options &options, std::uint32_t nodes) {
    const Partition partition({0, width, 0, height}, nodes);
    double longest = 0.0;
    for (std::uint32_t part = 1; part <= nodes; ++part) {
        double seconds = 0.0;
        for (const Crop &square : partition.squaresOf(part))
            seconds += work.secondsIn(square);
        longest = std::max(longest, seconds);
    }
    const double fair = work.wholeSeconds() / nodes;
    const double merging =
        nodes * options.mergeSecondsPerPart + width * height * options.mergeSecondsPerPixel;
    return {
        options.startSeconds + longest + merging,
        largest({{"start", options.startSeconds}, {"unequal parts", longest - fair}, {"merge", merging}})};
}

/// Each node takes tiles from rank 0, whose messages go one after the other.
Outcome byRanks(const WorkMap &work, const Options &options, std::uint32_t nodes) {
    struct Node {
        double speed = 0.0; ///< samples a second, as SharedBackend takes it
        double lastSamples = 0.0;
        double samples = 0.0;
        double seconds = 0.0;
    };
    const double all = static_cast<double>(width) * height * options.samplesPerPixel;
    const Film film(Crop{0, width, 0, height});
    TileQueue queue(film, 1);
    std::vector<Node> ranks(nodes);
    using Event = std::pair<double, std::uint32_t>; // when a node wants a tile
    std::priority_queue<Event, std::vector<Event>, std::greater<>> events;
    for (std::uint32_t i = 0; i < nodes; ++i)
        events.push({options.startSeconds, i});
    double networkFree = 0.0;
    double networkSeconds = 0.0;
    double setUpSeconds = 0.0;
    double end = 0.0;
    const double guess = all / work.wholeSeconds(); // of nodes that have not rendered yet
    double speeds = guess * nodes;
    while (!events.empty()) {
        const auto [now, i] = events.top();
        events.pop();
        Node &node = ranks[i];
        const TileWish wish{options.samplesPerPixel, node.speed, speeds, node.lastSamples,
                            static_cast<double>(queue.pixelCount())};
        const std::optional<Crop> tile = queue.take(tilePixels(wish));
        if (!tile) {
            end = std::max(end, now);
            continue;
        }
        const auto pixels = static_cast<double>(tile->pixelCount());
        const double message =
            2.0 * pixels * sizeof(layout::FilmPixel) / options.networkBytesPerSecond; // there, back
        networkFree = std::max(networkFree, now) + message;
        networkSeconds += message;
        const double seconds = work.secondsIn(*tile);
        setUpSeconds += options.tileSeconds;
        const double samples = pixels * options.samplesPerPixel;
        const double before = node.speed > 0.0 ? node.speed : guess;
        node.samples += samples;
        node.seconds += seconds;
        node.speed = std::min(samples / seconds, node.samples / node.seconds);
        node.lastSamples = samples;
        speeds += node.speed - before;
        events.push({networkFree + options.tileSeconds + seconds, i});
    }
    const double fair = work.wholeSeconds() / nodes;
    return {end, largest({{"start", options.startSeconds},
                          {"network of rank 0", networkSeconds},
                          {"tiles' set-up", setUpSeconds / nodes},
                          {"the last tiles",
                           end - options.startSeconds - fair - networkSeconds - setUpSeconds / nodes}})};
}

void run(const Options &options) {
    const WorkMap work(options);
    fmt::print(
        "{}, {}x{}, {} spp: {:.0f} s on one node like this machine\n"
        "start {} s, a tile {} s, merging {} s a part and {} s a pixel, {} bytes/s between ranks\n\n"
        "| nodes | in parts, s | efficiency | loses most by | by ranks, s | efficiency | loses most by |\n"
        "|---|---|---|---|---|---|---|\n",
        options.scene, width, height, options.samplesPerPixel, work.wholeSeconds(), options.startSeconds,
        options.tileSeconds, options.mergeSecondsPerPart, options.mergeSecondsPerPixel,
        options.networkBytesPerSecond);
    for (const std::uint32_t nodes : {1u, 2u, 4u, 16u, 64u, 256u, 1000u, 4000u, 10000u}) {
        const Outcome parts = inParts(work, options, nodes);
        const Outcome ranks = byRanks(work, options, nodes);
        const auto efficiency = [&](const Outcome &outcome) {
            return 100.0 * work.wholeSeconds() / nodes / outcome.seconds;
        };
        fmt::print("| {} | {:.1f} | {:.0f} % | {} | {:.1f} | {:.0f} % | {} |\n", nodes, parts.seconds,
                   efficiency(parts), parts.bound, ranks.seconds, efficiency(ranks), ranks.bound);
    }
}

} // namespace

} // namespace hyalite::core

int main(int argumentCount, char **arguments) {
    hyalite::core::Options options;
    CLI::App app("how long a picture takes on many nodes: computed");
    app.add_option("--scene", options.scene);
    app.add_option("--spp", options.samplesPerPixel);
    app.add_option("--whole", options.wholeSeconds, "of the picture on one node, seconds");
    app.add_option("--start", options.startSeconds, "of a process until its first ray, seconds");
    app.add_option("--tile", options.tileSeconds, "setting one up, seconds");
    app.add_option("--merge", options.mergeSecondsPerPart, "reading a part, seconds");
    app.add_option("--write", options.mergeSecondsPerPixel, "writing the merged picture, seconds a pixel");
    app.add_option("--network", options.networkBytesPerSecond, "bytes a second at rank 0");
    CLI11_PARSE(app, argumentCount, arguments);
    try {
        hyalite::core::run(options);
        return 0;
    } catch (const std::exception &error) {
        fmt::print(stderr, "farm_model: {}\n", error.what());
        return 1;
    }
}
