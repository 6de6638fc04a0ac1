#include "host/lab/film_load.h"

#include "host/base/error.h"
#include "host/base/hash.h"
#include "host/lab/comparison_run.h"
#include "host/lab/shipped_films.h"

#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <optional>
#include <utility>
#include <vector>

namespace hyalite::core {

namespace {

constexpr int replayCount = 10;
constexpr std::uint64_t maxExplained = 10; // faults of a load: to explain takes passes
constexpr std::size_t maxIdentified = 16;  // pixels of a film whose wrong sample is looked for
constexpr double minHangSeconds = 20.0;
constexpr double maxReadBackShare = 0.03; // of the time of a load

class FilmLoad : public RunningLoad {
  public:
    FilmLoad(Soak &soak, const Loads &loads, const Load &load, bool isLarge, Backend &backend)
        : RunningLoad(soak, load.name, "rays"), loads_(loads), load_(load), isShared_(!isLarge),
          size_(isLarge ? load.large : load.small), backend_(backend) {}

  protected:
    void run(const TimeLimit &slice) override {
        if (!expected_ && !begin())
            return;
        repeat([&] { return goesOn(slice) || open_.has_value(); });
        if (closed_ && !soak_.isStopped())
            conclude(*std::exchange(closed_, std::nullopt));
    }

    void tellOpenFaults() override {
        for (std::optional<SoakFault> *fault : {&open_, &closed_})
            if (*fault)
                soak_.report(std::move(**fault));
    }

  private:
    /// The film as it should be: the device's own, if its hash is the known one, else that of the CPU twin. False: the
    /// soak ended meanwhile.
    bool begin() {
        scene_ = prepareLoad(loads_, load_, size_);
        const auto mustEnd = [this] { return soak_.isStopped() || soak_.isOver(load()); };
        const auto isRightBy = [&](Backend &backend) {
            BackendResult result = unlessFailed(
                backend.render(scene_->packed, settings(), Film(scene_->crop), {.shouldStop = mustEnd}));
            expectedRays_ = result.rays;
            expected_ = std::move(result.film);
            return mustEnd() || filmHash(*expected_) == size_.hash;
        };
        Stopwatch watch;
        const bool isRight = isRightBy(backend_);
        firstSeconds_ = watch.lap().seconds();
        if (!isRight && !isRightBy(*openBackend("cpu", nobody()))) {
            giveUp();
            throw Error(ErrorKind::DeviceLost,
                        "the film has the shipped bits neither here nor on this machine's processors: they, "
                        "or this build of the program, compute otherwise");
        }
        if (!mustEnd())
            return true;
        expected_.reset();
        return false;
    }

    [[nodiscard]] const RenderSettings &settings() const { return scene_->loaded.settings; }

    void repeat(const std::function<bool()> &wantsMore) {
        PassTime time;
        bool isHanging = false;
        const auto shouldStop = [&] {
            isHanging = isHanging || time.seconds(isShared_) > longestPass();
            return isHanging || soak_.isStopped();
        };
        const auto onPass = [&](const RepeatedPass &pass) {
            judge(pass);
            time = PassTime();
            // What films are compared with is uploaded anew by the next slice.
            return !std::exchange(isCopyWrong_, false) && !closed_ && wantsMore();
        };
        backend_.repeat(scene_->packed, settings(), *expected_, {.shouldStop = shouldStop, .onPass = onPass});
        if (!isHanging)
            return;
        scene_ = prepareLoad(loads_, load_, size_); // a damaged tree may lead in circles
        throw Error(ErrorKind::DeviceLost,
                    fmt::format("a pass did not end in {:.0f} s, and was given up", longestPass()));
    }

    /// From the beginning of a pass.
    struct PassTime {
        Stopwatch wall{};
        std::clock_t processor = std::clock();

        /// `isShared`: a renderer that computes on processors may have to wait for them while others are busy.
        [[nodiscard]] double seconds(bool isShared) const {
            Stopwatch watch = wall;
            const double passed = watch.lap().seconds();
            const double used = static_cast<double>(std::clock() - processor) / CLOCKS_PER_SEC;
            return isShared ? std::min(passed, used) : passed;
        }
    };

    /// Seconds after which a pass will not end: paths of damaged data may go on for ever. A first pass may wait for the
    /// driver's compiler, as the first render did.
    [[nodiscard]] double longestPass() const {
        const double usual =
            load().passes == 0 ? firstSeconds_ : load().workSeconds / static_cast<double>(load().passes);
        return std::max(minHangSeconds, 50.0 * usual);
    }

    using RunningLoad::countPass;
    void countPass(const RepeatedPass &pass) {
        countPass(static_cast<double>(pass.rays.total()), pass.renderSeconds, pass.compareSeconds);
    }

    void judge(const RepeatedPass &pass) {
        countPass(pass);
        Stopwatch watch;
        if (pass.isEqual && pass.rays == expectedRays_ && !mayReadBack()) {
            followOpen(nullptr);
            return;
        }
        const Film film = pass.film();
        const std::size_t first = firstDifference(film, *expected_);
        const bool isRight = first == film.pixels.size();
        if (!isRight)
            explain(pass, film, first, !open_);
        else if (!pass.isEqual) {
            fail(newFault(SoakFault::Kind::Comparison));
            isCopyWrong_ = true;
        } else if (pass.rays != expectedRays_)
            fail(newFault(SoakFault::Kind::Rays));
        followOpen(isRight ? nullptr : &film);
        const double seconds = watch.lap().seconds();
        load().checkSeconds += pass.isEqual ? seconds : 0.0; // of an explanation it is no checking
        readBackSeconds_ += seconds;
        ++load().readBacks;
    }

    /// Now and then, as far as the time allows it: a device whose comparison is wrong would hide its faults.
    [[nodiscard]] bool mayReadBack() const {
        return load().readBacks == 0 || readBackSeconds_ < maxReadBackShare * load().workSeconds;
    }

    void fail(SoakFault fault) {
        ++load().wrongPasses;
        soak_.report(std::move(fault));
    }

    /// `mayOpen`: it may be looked at whether it comes again.
    void explain(const RepeatedPass &pass, const Film &film, std::size_t first, bool mayOpen) {
        SoakFault fault = newFault(pass.isEqual ? SoakFault::Kind::Comparison : SoakFault::Kind::Film);
        const auto pixelOf = [&](std::size_t index) {
            const auto i = static_cast<int>(index);
            return glm::uvec2(film.crop.x0 + i % film.crop.width(), film.crop.y0 + i / film.crop.width());
        };
        fault.pixel = pixelOf(first);
        fault.words = wrongWords(film.pixels[first], expected_->pixels[first]);
        for (const DispatchRecord &dispatch : pass.timeline.dispatches)
            if (!fault.dispatch && contains(dispatch, fault.pixel))
                fault.dispatch = dispatch;
        const bool isExplained = mayOpen && explained_ < maxExplained;
        std::size_t identified = 0;
        for (std::size_t i = first; i < film.pixels.size(); ++i) {
            if (haveEqualBits(film, *expected_, i))
                continue;
            ++fault.wrongCount;
            for (const WrongFilmWord &word : wrongWords(film.pixels[i], expected_->pixels[i]))
                soak_.verdict.patterns.add(word);
            if (!isExplained || identified >= maxIdentified)
                continue;
            ++identified;
            const std::vector<std::uint32_t> samples = wrongSamples(film, i, pixelOf(i));
            if (samples.empty())
                continue;
            const std::optional<std::uint32_t> lane = pass.laneOf(pixelOf(i), samples.front());
            if (lane && samples.size() == 1)
                soak_.verdict.patterns.addLane(*lane);
            if (i == first) {
                fault.samples = samples;
                fault.lane = lane;
            }
        }
        ++load().wrongPasses;
        if (isExplained) { // told once it is known whether it comes again
            ++explained_;
            openIndex_ = first;
            open_ = std::move(fault);
            isNew_ = true;
        } else {
            soak_.report(std::move(fault));
        }
    }

    static bool contains(const DispatchRecord &dispatch, const glm::uvec2 &pixel) {
        const auto x = static_cast<int>(pixel.x) - dispatch.tileX;
        const auto y = static_cast<int>(pixel.y) - dispatch.tileY;
        return x >= 0 && y >= 0 && x < dispatch.tileWidth && y < dispatch.tileHeight;
    }

    /// Counts the pass, wrong or not, as a replay of the fault that is looked at.
    void followOpen(const Film *film) {
        if (!open_ || std::exchange(isNew_, false))
            return;
        ++open_->replays;
        if (film != nullptr && !haveEqualBits(*film, *expected_, openIndex_))
            ++open_->repeats;
        if (open_->replays < replayCount)
            return;
        open_->recurrence = open_->repeats == 0             ? Recurrence::Transient
                            : open_->repeats == replayCount ? Recurrence::Permanent
                                                            : Recurrence::Intermittent;
        if (open_->recurrence == Recurrence::Permanent)
            closed_ = std::move(open_);
        else
            soak_.report(std::move(*open_));
        open_.reset();
    }

    /// A fault that always comes again: is it still there with the scene's data uploaded anew, and where does it begin?
    void conclude(SoakFault fault) {
        scene_ = prepareLoad(loads_, load_, size_);
        bool isStillThere = false;
        const auto onPass = [&](const RepeatedPass &pass) {
            countPass(pass);
            const Film film = pass.film();
            isStillThere = !haveEqualBits(film, *expected_, openIndex_);
            if (const std::size_t first = firstDifference(film, *expected_); first < film.pixels.size())
                explain(pass, film, first, !isStillThere);
            isNew_ = false;
            return false;
        };
        backend_.repeat(scene_->packed, settings(), *expected_, {.onPass = onPass});
        if (isStillThere)
            fault.divergence =
                findFirstDivergence(backend_, *openBackend("cpu", nobody()), *scene_, fault.pixel);
        else
            fault.recurrence = Recurrence::Data;
        soak_.report(std::move(fault));
    }

    /// The CPU twin's samples of a pixel, one by one, say which one is wrong.
    [[nodiscard]] std::vector<std::uint32_t> wrongSamples(const Film &film, std::size_t index,
                                                          const glm::uvec2 &pixel) const {
        const std::unique_ptr<Backend> twin = openBackend("cpu", nobody());
        const int x = static_cast<int>(pixel.x);
        const int y = static_cast<int>(pixel.y);
        Film one({x, x + 1, y, y + 1});
        RenderSettings some = settings();
        std::vector<glm::dvec3> values;
        for (some.samplesPerPixel = 1; some.samplesPerPixel <= settings().samplesPerPixel;
             ++some.samplesPerPixel) {
            const glm::dvec3 before = sumOf(one.pixels.front());
            one = twin->render(scene_->packed, some, std::move(one)).film;
            values.push_back(sumOf(one.pixels.front()) - before);
        }
        return samplesThatExplain(film.pixels[index], expected_->pixels[index], values);
    }

    const Loads &loads_;
    const Load &load_;
    bool isShared_; ///< the renderer computes on processors
    const LoadSize &size_;
    Backend &backend_;
    std::optional<PreparedScene> scene_;
    std::optional<Film> expected_;
    RayCounts expectedRays_;
    double firstSeconds_ = 0.0; ///< of the first render, and of what it compiled
    double readBackSeconds_ = 0.0;
    std::uint64_t explained_ = 0;
    std::optional<SoakFault> open_;   ///< whose replays are under way
    std::optional<SoakFault> closed_; ///< which came in all of them
    std::size_t openIndex_ = 0;       ///< of its pixel
    bool isNew_ = false;              ///< of this pass
    bool isCopyWrong_ = false;        ///< of the expected film, on the device
};

} // namespace

std::unique_ptr<RunningLoad> newFilmLoad(Soak &soak, const Loads &loads, const Load &load, bool isLarge,
                                         Backend &backend) {
    return std::make_unique<FilmLoad>(soak, loads, load, isLarge, backend);
}

} // namespace hyalite::core
