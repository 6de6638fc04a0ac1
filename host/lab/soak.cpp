#include "host/lab/soak.h"

#include "host/base/summary.h"
#include "host/lab/film_load.h"
#include "host/lab/word_load.h"

#include <algorithm>
#include <memory>
#include <utility>

namespace hyalite::core {

namespace {

constexpr double slowShareOfMedian = 0.8;
constexpr double maxSliceSeconds = 10.0;
constexpr double minSliceSeconds = 0.5;
constexpr double roundsAtLeast = 3.0;

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
            running.push_back(newFilmLoad(soak, loads, load, device && !device->isSoftware(), backend));
    for (const gpu::WordWork work : {gpu::WordWork::Memory, gpu::WordWork::Arithmetic})
        if (device && isWanted(nameOfWork(work)))
            running.push_back(newWordLoad(soak, work, *device));
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