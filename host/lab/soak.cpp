#include "host/lab/soak.h"

#include "host/base/error.h"
#include "host/base/hash.h"
#include "host/base/summary.h"
#include "host/lab/comparison_run.h"
#include "host/lab/shipped_films.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <ctime>
#include <memory>
#include <span>
#include <utility>

namespace hyalite::core {

namespace {

constexpr int replayCount = 10;
constexpr std::uint64_t maxExplained = 10; // faults of a load: to explain takes passes
constexpr std::size_t maxIdentified = 16;  // pixels of a film whose wrong sample is looked for
constexpr int maxDeviceFailures = 3;       // of a load
constexpr double minHangSeconds = 20.0;    // a device may compile meanwhile
constexpr double maxReadBackShare = 0.03;  // of the time of a load
constexpr double slowShareOfMedian = 0.8;
constexpr double maxSliceSeconds = 10.0;
constexpr double minSliceSeconds = 0.5;
constexpr double roundsAtLeast = 3.0;

std::string nowText() {
    return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}",
                       fmt::gmtime(std::chrono::system_clock::to_time_t(std::chrono::system_clock::now())));
}

/// What all loads of a device share.
struct Soak {
    const SoakRequest &request;
    Observer &observer;
    const SoakEvents &events;
    SoakVerdict verdict;
    std::int64_t beginNanos = hostNanos();

    [[nodiscard]] double seconds() const { return Span{beginNanos, hostNanos()}.seconds(); }

    [[nodiscard]] bool isStopped() const { return observer.wantsStop().has_value(); }
    [[nodiscard]] bool isOver(const SoakLoad &load) const {
        return request.passes > 0 ? load.passes >= request.passes
                                  : request.limit.isReached() && load.passes > 0;
    }
    void report(SoakFault fault) {
        if (verdict.faults.size() >= maxSoakFaults)
            return;
        if (events.onFault)
            events.onFault(fault);
        verdict.faults.push_back(std::move(fault));
    }
};

/// A load that is run for a while at a time. Its verdict is by index, as others are added meanwhile.
class RunningLoad {
  public:
    RunningLoad(Soak &soak, std::string name, std::string unit)
        : soak_(soak), index_(soak.verdict.loads.size()) {
        soak.verdict.loads.push_back({std::move(name), std::move(unit)});
    }
    virtual ~RunningLoad() = default;
    RunningLoad(const RunningLoad &) = delete;
    RunningLoad &operator=(const RunningLoad &) = delete;

    /// Runs passes until the slice is over, at least one.
    void runFor(double seconds) {
        if (isDone())
            return;
        const std::uint64_t before = load().passes;
        const double begin = soak_.seconds();
        runGuarded(TimeLimit(seconds));
        if (const std::uint64_t passes = load().passes - before; passes > 0) {
            const std::span<const float> all = load().speeds;
            const std::span<const float> these = all.last(static_cast<std::size_t>(passes));
            load().slices.push_back(
                {begin, passes, quantile(std::vector<double>(these.begin(), these.end()), 0.5)});
        }
    }
    /// Tells what it has not told yet.
    virtual void finish() {}
    [[nodiscard]] bool isDone() const {
        return !load().lack.empty() || failures_ >= maxDeviceFailures || soak_.isOver(load());
    }
    [[nodiscard]] const SoakLoad &load() const { return soak_.verdict.loads[index_]; }
    [[nodiscard]] SoakLoad &load() { return soak_.verdict.loads[index_]; }

  protected:
    virtual void run(const TimeLimit &slice) = 0;

    /// No slice follows.
    void giveUp() { failures_ = maxDeviceFailures; }
    [[nodiscard]] SoakFault newFault(SoakFault::Kind kind) const {
        SoakFault fault;
        fault.kind = kind;
        fault.load = load().name;
        fault.pass = load().passes;
        fault.time = nowText();
        return fault;
    }
    /// Whether another pass of this slice follows.
    [[nodiscard]] bool goesOn(const TimeLimit &slice) const {
        return !slice.isReached() && !soak_.isOver(load()) && !soak_.isStopped();
    }
    void countPass(double work, double workSeconds, double checkSeconds) {
        ++load().passes;
        load().speeds.push_back(static_cast<float>(work / std::max(workSeconds, 1e-9)));
        load().workSeconds += workSeconds;
        load().checkSeconds += checkSeconds;
    }

    Soak &soak_;

  private:
    std::size_t index_;
    int failures_ = 0;

    /// Faults of the device do not end the soak.
    void runGuarded(const TimeLimit &slice) {
        try {
            run(slice);
        } catch (const Error &error) {
            if (error.kind == ErrorKind::LimitExceeded && load().passes == 0) {
                load().lack = error.what();
                return;
            }
            ++failures_;
            ++load().wrongPasses;
            SoakFault fault = newFault(SoakFault::Kind::Device);
            fault.text = error.what();
            soak_.report(std::move(fault));
        }
    }
};

// ---- Films

class FilmLoad : public RunningLoad {
  public:
    FilmLoad(Soak &soak, const Loads &loads, const Load &load, bool isLarge, Backend &backend)
        : RunningLoad(soak, load.name, "rays"), loads_(loads), load_(load), isShared_(!isLarge),
          size_(isLarge ? load.large : load.small), backend_(backend) {}

  protected:
    void run(const TimeLimit &slice) override {
        if (!expected_)
            begin();
        repeat([&] { return goesOn(slice) || open_.has_value(); });
        if (closed_ && !soak_.isStopped())
            conclude(*std::exchange(closed_, std::nullopt));
    }

    void finish() override {
        for (std::optional<SoakFault> *fault : {&open_, &closed_})
            if (*fault)
                soak_.report(std::move(**fault));
    }

  private:
    /// The film as it should be: the device's own, if its hash is the known one, else that of the CPU twin.
    void begin() {
        scene_ = prepareLoad(loads_, load_, size_);
        const auto shouldStop = [this] { return soak_.isStopped(); };
        const BackendResult first = unlessFailed(
            backend_.render(scene_->packed, settings(), Film(scene_->crop), {.shouldStop = shouldStop}));
        expectedRays_ = first.rays;
        expected_ = first.film;
        if (!soak_.isStopped() && filmHash(first.film) != size_.hash) {
            BackendResult right =
                openBackend("cpu", nobody())
                    ->render(scene_->packed, settings(), Film(scene_->crop), {.shouldStop = shouldStop});
            if (!soak_.isStopped() && filmHash(right.film) != size_.hash) {
                giveUp();
                throw Error(
                    ErrorKind::DeviceLost,
                    "the film has the shipped bits neither here nor on this machine's processors: they, or "
                    "this build of the program, compute otherwise");
            }
            expectedRays_ = right.rays;
            expected_ = std::move(right.film);
        }
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

    /// Seconds after which a pass will not end: paths of damaged data may go on for ever.
    [[nodiscard]] double longestPass() const {
        const double passes = static_cast<double>(std::max<std::uint64_t>(load().passes, 1));
        return std::max(minHangSeconds, 50.0 * load().workSeconds / passes);
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
    double readBackSeconds_ = 0.0;
    std::uint64_t explained_ = 0;
    std::optional<SoakFault> open_;   ///< whose replays are under way
    std::optional<SoakFault> closed_; ///< which came in all of them
    std::size_t openIndex_ = 0;       ///< of its pixel
    bool isNew_ = false;              ///< of this pass
    bool isCopyWrong_ = false;        ///< of the expected film, on the device
};

// ---- Memory and arithmetic

std::string_view nameOf(gpu::WordWork work) {
    return work == gpu::WordWork::Memory ? memoryLoad : arithmeticLoad;
}

class WordLoad : public RunningLoad {
  public:
    WordLoad(Soak &soak, gpu::WordWork work, const gpu::DeviceInfo &device)
        : RunningLoad(soak, std::string(nameOf(work)), work == gpu::WordWork::Memory ? "bytes" : "rounds"),
          work_(work), device_(device) {}

  protected:
    void run(const TimeLimit &slice) override {
        const std::uint64_t most = gpu::exercisableBytes(device_);
        gpu::WordExercise exercise(device_, work_,
                                   std::min(soak_.request.maxMemoryBytes.value_or(most), most));
        const auto shouldStop = [this] { return soak_.isStopped(); };
        do {
            const gpu::WordPass pass = exercise.run(load().passes, shouldStop);
            if (soak_.isStopped())
                return;
            const auto words = static_cast<double>(pass.wordCount);
            if (work_ == gpu::WordWork::Memory) // to compare is to read, which is half of the exercise
                countPass(words * 8.0, pass.fillSeconds + pass.compareSeconds, 0.0);
            else
                countPass(words * exercise.rounds(), pass.fillSeconds, pass.compareSeconds);
            if (pass.wrongCount > 0)
                explain(pass);
        } while (goesOn(slice));
    }

  private:
    void explain(const gpu::WordPass &pass) {
        ++load().wrongPasses;
        SoakFault fault = newFault(SoakFault::Kind::Words);
        fault.wrongCount = pass.wrongCount;
        fault.memory = pass.wrong;
        for (const gpu::WrongMemory &word : pass.wrong)
            soak_.verdict.patterns.addBits(word.found, word.expected);
        soak_.report(std::move(fault));
    }

    gpu::WordWork work_;
    gpu::DeviceInfo device_;
};

} // namespace

double SoakLoad::medianSpeed() const {
    const std::vector<double> values(speeds.begin(), speeds.end());
    return values.empty() ? 0.0 : quantile(values, 0.5);
}

std::size_t SoakLoad::slowSlices() const {
    const double slow = slowShareOfMedian * medianSpeed();
    return static_cast<std::size_t>(
        std::ranges::count_if(slices, [slow](const SoakSlice &slice) { return slice.medianSpeed < slow; }));
}

bool SoakVerdict::isSound() const { return faults.empty() && passes() > 0; }

std::uint64_t SoakVerdict::passes() const {
    std::uint64_t sum = 0;
    for (const SoakLoad &load : loads)
        sum += load.passes;
    return sum;
}

std::uint64_t SoakVerdict::wrongPasses() const {
    std::uint64_t sum = 0;
    for (const SoakLoad &load : loads)
        sum += load.wrongPasses;
    return sum;
}

double SoakVerdict::checkShare() const {
    double work = 0.0;
    double check = 0.0;
    for (const SoakLoad &load : loads) {
        work += load.workSeconds;
        check += load.checkSeconds;
    }
    return work + check > 0.0 ? check / (work + check) : 0.0;
}

SoakVerdict soak(Backend &backend, const std::optional<gpu::DeviceInfo> &device, const Loads &loads,
                 const SoakRequest &request, Observer &observer, const SoakEvents &events) {
    Soak soak{request, observer, events, {}};
    soak.verdict.device = backend.name();
    soak.verdict.description = backend.description();
    const auto isWanted = [&](std::string_view name) {
        return request.loads.empty() || std::ranges::find(request.loads, name) != request.loads.end();
    };
    std::vector<std::unique_ptr<RunningLoad>> running;
    for (const Load &load : loads.loads)
        if (isWanted(load.name))
            running.push_back(
                std::make_unique<FilmLoad>(soak, loads, load, device && !device->isSoftware(), backend));
    for (const gpu::WordWork work : {gpu::WordWork::Memory, gpu::WordWork::Arithmetic})
        if (device && isWanted(nameOf(work)))
            running.push_back(std::make_unique<WordLoad>(soak, work, *device));
    const std::optional<double> given = request.limit.secondsLeft();
    const double slice =
        std::clamp(given.value_or(0.0) / (roundsAtLeast * static_cast<double>(running.size())),
                   minSliceSeconds, maxSliceSeconds);
    const auto isUnfinished = [](const auto &load) { return !load->isDone(); };
    while (std::ranges::any_of(running, isUnfinished) && !soak.isStopped())
        for (const std::unique_ptr<RunningLoad> &load : running) {
            if (soak.isStopped())
                break;
            load->runFor(slice);
            addReadings(soak.verdict.sensors, readSensors());
            if (events.onProgress) {
                const double byTime =
                    given ? 1.0 - *request.limit.secondsLeft() / std::max(*given, 1e-9) : 0.0;
                const double byCount =
                    static_cast<double>(running.size() - static_cast<std::size_t>(
                                                             std::ranges::count_if(running, isUnfinished))) /
                    static_cast<double>(running.size());
                events.onProgress(std::max(byTime, byCount));
            }
        }
    for (const std::unique_ptr<RunningLoad> &load : running)
        load->finish();
    soak.verdict.seconds = soak.seconds();
    if (const std::optional<Stop> stop = observer.wantsStop())
        soak.verdict.stoppedBy = stop->by;
    return std::move(soak.verdict);
}

} // namespace hyalite::core
