#include "host/cli/verify_soak.h"

#include "host/base/json_text.h"
#include "host/base/message.h"
#include "host/base/quantities.h"
#include "host/cli/options.h"
#include "host/cli/terminal_observer.h"
#include "host/lab/soak_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <future>
#include <memory>
#include <mutex>
#include <utility>

namespace hyalite::core {

namespace {

constexpr Interval anyMinutes{0.01, 100'000};
constexpr Interval anyPasses{1, 1e12};
constexpr Interval anyMiB{1, 1 << 24};

std::vector<std::string> loadNames(const Loads &loads) {
    std::vector<std::string> names;
    for (const Load &load : loads.loads)
        names.push_back(load.name);
    names.emplace_back(memoryLoad);
    names.emplace_back(arithmeticLoad);
    return names;
}

SoakRequest requestOf(const SoakOptions &options) {
    SoakRequest request;
    if (options.minutes)
        request.limit = TimeLimit(*options.minutes * 60.0);
    request.passes = options.passes.value_or(0);
    if (options.memoryMiB)
        request.maxMemoryBytes = *options.memoryMiB << 20;
    request.loads = options.loads;
    return request;
}

/// Faults as they come, and the share that all devices have finished, of whom each has a thread.
class SoakProgress {
  public:
    SoakProgress(Observer &observer, std::size_t deviceCount)
        : observer_(observer), task_(observer, "verify"), shares_(deviceCount, 0.0) {}

    [[nodiscard]] SoakEvents eventsOf(std::size_t device, const std::string &name) {
        return {.onFault = [this, name](
                               const SoakFault &fault) { observer_.warning(name + ": " + describe(fault)); },
                .onProgress =
                    [this, device](double share) {
                        const std::lock_guard lock(mutex_);
                        shares_[device] = share;
                        task_.update(std::ranges::min(shares_));
                    }};
    }

  private:
    Observer &observer_;
    ObservedTask task_;
    std::mutex mutex_;
    std::vector<double> shares_;
};

/// Several devices at once.
std::vector<SoakVerdict> soakAll(const std::vector<Subject> &subjects, const Loads &loads,
                                 const SoakRequest &request, Observer &observer) {
    std::vector<std::unique_ptr<Backend>> backends; // whose drivers want settings before any thread begins
    backends.reserve(subjects.size());
    for (const Subject &subject : subjects)
        backends.push_back(openBackend(subject.name, observer));
    SoakProgress progress(observer, subjects.size());
    std::vector<std::future<SoakVerdict>> running;
    for (std::size_t i = 0; i < subjects.size(); ++i)
        running.push_back(std::async(std::launch::async, [&, i] {
            return soak(*backends[i], subjects[i].device, loads, request, observer,
                        progress.eventsOf(i, backends[i]->name()));
        }));
    std::vector<SoakVerdict> verdicts;
    verdicts.reserve(running.size());
    for (std::future<SoakVerdict> &each : running)
        verdicts.push_back(each.get());
    return verdicts;
}

void print(const SoakVerdict &verdict, bool isQuiet) {
    printResult("{}\n", verdict.description);
    if (!isQuiet)
        for (const SoakLoad &load : verdict.loads) {
            if (!load.lack.empty()) {
                printResult("  {:<12} not run: {}\n", load.name, load.lack);
                continue;
            }
            printResult("  {:<12} {:>7} passes, {} wrong, {}{}\n", load.name, load.passes, load.wrongPasses,
                        speedText(load),
                        load.slowSlices() > 0
                            ? fmt::format("; slower than 0.8 of that in {} of {}", load.slowSlices(),
                                          countText(load.slices.size(), "turn"))
                            : "");
        }
    for (const SensorRange &sensor : verdict.sensors)
        if (!isQuiet)
            printResult("  {}: {:.0f} to {:.0f} {}\n", sensor.name, sensor.min, sensor.max, sensor.unit);
    constexpr std::size_t mostPrinted = 10;
    for (std::size_t i = 0; i < std::min(mostPrinted, verdict.faults.size()); ++i)
        printResult("  {}\n", describe(verdict.faults[i]));
    if (verdict.faults.size() > mostPrinted)
        printResult("  and {} more\n", verdict.faults.size() - mostPrinted);
    printResult("  {}\n", summaryOf(verdict));
}

} // namespace

void addSoakOptions(CLI::App &command, SoakOptions &options) {
    addNumber(
        command, "--minutes", options.minutes, anyMinutes,
        "compute known results again and again for so long, on all devices at once, and compare all of them")
        ->type_name("M");
    addNumber(command, "--passes", options.passes, anyPasses, "the same, until each load has run so often");
    command
        .add_option("--loads", options.loads,
                    "with these: only these loads, such as materials, divergent, memory and arithmetic")
        ->type_name("NAME,...")
        ->delimiter(',')
        ->expected(1, -1);
    addNumber(command, "--memory", options.memoryMiB, anyMiB,
              "with these: exercise at most so much memory of each device; default: four fifths of a card's, "
              "a quarter "
              "of what the host has free where the device shares it")
        ->type_name("MIB");
    addFile(command, "--expect", options.expect, "FILE.json",
            "with these: speeds below 0.8 of those of an earlier --report count as faults");
}

void requireSoak(const SoakOptions &options) {
    if (!options.isWanted() && (options.memoryMiB || !options.loads.empty() || !options.expect.empty()))
        throw Error(ErrorKind::Usage, "--loads, --memory and --expect need --minutes or --passes");
    const std::vector<std::string> known = loadNames(readLoads());
    const std::vector<std::string_view> words(known.begin(), known.end());
    for (const std::string &name : options.loads)
        if (std::ranges::find(words, name) == words.end())
            refuseValue("--loads", name, quotedList(words) + suggestion(name, words));
}

ExitCode runSoak(const std::vector<Subject> &subjects, const SoakOptions &options, RequestedFile &junit,
                 RequestedFile &report, bool isQuiet, const std::string &commandLine) {
    std::vector<ExpectedSpeed> expected;
    if (!options.expect.empty())
        expected = readExpectedSpeeds(options.expect);
    const Loads loads = readLoads();
    TerminalObserver observer(isQuiet);
    observer.catchSignals();
    std::vector<SoakVerdict> verdicts = soakAll(subjects, loads, requestOf(options), observer);
    for (SoakVerdict &verdict : verdicts) {
        if (!options.expect.empty())
            judgeSpeeds(verdict, expected);
        print(verdict, isQuiet);
    }
    if (junit)
        junit.store(soakToJunit(verdicts));
    if (report)
        report.store(jsonText(soakToJson(loads, verdicts, commandLine)));
    const auto hasFaults = [](const SoakVerdict &verdict) { return !verdict.faults.empty(); };
    if (std::ranges::any_of(verdicts, hasFaults)) {
        printResult("FAULTY\n");
        return ExitCode::AnswerIsNo;
    }
    if (const std::optional<Stop> stop = observer.wantsStop())
        throw Error(stop->kind,
                    fmt::format("stopped by {} before its time; what was compared is right", stop->by));
    for (const SoakVerdict &verdict : verdicts)
        if (!verdict.isSound())
            throw Error(ErrorKind::LimitExceeded,
                        verdict.description + ": no load ended a pass in the time given: it needs more");
    printResult("sound\n");
    return ExitCode::Ok;
}

} // namespace hyalite::core
