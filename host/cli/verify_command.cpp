#include "host/base/json_text.h"
#include "host/base/message.h"
#include "host/cli/commands.h"
#include "host/cli/device_options.h"
#include "host/cli/options.h"
#include "host/cli/requested_file.h"
#include "host/cli/terminal_observer.h"
#include "host/cli/verify_soak.h"
#include "host/cli/verify_subjects.h"
#include "host/engine/tuning.h"
#include "host/gpu/vk/device_list.h"
#include "host/lab/verify_report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace hyalite::core {

namespace {

struct VerifyOptions {
    std::vector<std::string> devices{"all"};
    std::vector<std::string> scenes;  ///< none: all
    std::vector<std::string> kernels; ///< likewise
    std::string junit;
    std::string report;
    bool isQuiet = false;
    SoakOptions soak; ///< to verify again and again, if it is wanted
};

/// Drops the films of all scenes but these. No names: drops none.
void keepScenes(ShippedFilms &shipped, const std::vector<std::string> &names) {
    const std::vector<std::string> known = shipped.sceneNames();
    const std::vector<std::string_view> words(known.begin(), known.end());
    for (const std::string &name : names)
        if (std::ranges::find(known, name) == known.end())
            refuseValue("--scenes", name, quotedList(words) + suggestion(name, words));
    if (!names.empty())
        std::erase_if(shipped.films, [&](const ShippedFilm &film) {
            return std::ranges::find(names, film.scene) == names.end();
        });
}

/// The films of one kernel.
struct Tally {
    std::size_t equal = 0;
    std::size_t rendered = 0;
    double seconds = 0.0;
    std::string lack; ///< why a film was not rendered

    void add(const FilmVerdict &film) {
        equal += film.isSkipped() || film.isFaulty() ? 0u : 1u;
        rendered += film.isSkipped() ? 0u : 1u;
        seconds += film.seconds;
        if (film.isSkipped())
            lack = film.lack;
    }
};

void print(const DeviceVerdict &verdict) {
    printResult("{}\n", verdict.description);
    std::vector<std::pair<std::string, Tally>> kernels;
    for (const FilmVerdict &film : verdict.films) {
        if (kernels.empty() || std::ranges::find(kernels, film.kernel, [](const auto &entry) {
                                   return entry.first;
                               }) == kernels.end())
            kernels.emplace_back(film.kernel, Tally{});
        for (auto &[kernel, tally] : kernels)
            if (kernel == film.kernel)
                tally.add(film);
    }
    for (const auto &[kernel, tally] : kernels) {
        if (tally.rendered > 0)
            printResult("  {:<13} {} of {} films equal, {:.1f} s\n", kernel.empty() ? "cpu" : kernel,
                        tally.equal, tally.rendered, tally.seconds);
        if (!tally.lack.empty())
            printResult("  {:<13} {}not run: {}\n", kernel, tally.rendered > 0 ? "the others were " : "",
                        tally.lack);
    }
    for (const FilmVerdict &film : verdict.films)
        if (film.isFaulty())
            printResult("  {}{}: {}\n", nameOf(film.film), film.kernel.empty() ? "" : ", " + film.kernel,
                        film.difference ? describe(*film.difference) : film.failure);
}

/// Throws Error{Usage} for a word that is none of a kernel.
void requireKernels(const std::vector<std::string> &names) {
    std::vector<std::string_view> words(gpu::kernelTable.size());
    std::ranges::transform(gpu::kernelTable, words.begin(), &gpu::KernelRow::name);
    for (const std::string &name : names)
        if (std::ranges::find(words, name) == words.end())
            refuseValue("--kernels", name, quotedList(words) + suggestion(name, words));
}

/// Keeps the outcome with the device's tuning, which decides whether its bits count as measured.
void keep(const gpu::DeviceInfo &device, bool isPassed, Observer &observer) {
    Tuning tuning = readTuning(device, observer);
    if (!isPassed && tuning.verifiedDate.empty())
        return;
    tuning.verifiedDate = isPassed ? today() : std::string();
    try {
        storeTuning(device, tuning, observer);
    } catch (const Error &error) {
        printMessage("note: that {} was verified is not kept: {}\n", device.name, error.what());
    }
}

DeviceVerdict verifyWithProgress(const Subject &subject, const ShippedFilms &shipped,
                                 const VerifyOptions &options, Observer &observer) {
    ObservedTask progress(observer, "verify " + (subject.device ? subject.device->name : subject.name));
    return verifyDevice(subject.name, shipped, observer, options.kernels,
                        [&](const FilmVerdict &, double share) { progress.update(share); });
}

ExitCode runVerify(const VerifyOptions &options, const std::string &commandLine) {
    requireDistinctFiles({{"--junit", options.junit}, {"--report", options.report}},
                         {{"--expect", options.soak.expect}});
    RequestedFile junit(options.junit);
    RequestedFile report(options.report);
    ShippedFilms shipped = readShippedFilms();
    keepScenes(shipped, options.scenes);
    requireKernels(options.kernels);
    requireSoak(options.soak);
    const std::vector<Subject> subjects = subjectsOf(options.devices);
    if (options.soak.isWanted()) {
        if (!options.scenes.empty() || !options.kernels.empty())
            throw Error(ErrorKind::Usage,
                        "--scenes and --kernels choose films of one run; with --minutes or --passes "
                        "--loads chooses what is run again and again");
        return runSoak(subjects, options.soak, junit, report, options.isQuiet, commandLine);
    }
    if (!options.kernels.empty() &&
        std::ranges::none_of(subjects, [](const Subject &subject) { return subject.device.has_value(); }))
        throw Error(ErrorKind::Usage, "--kernels: found --device cpu, which has none to choose from");
    if (!options.isQuiet)
        printResult("{} films of {}, version {}\n", shipped.films.size(),
                    fmt::join(shipped.sceneNames(), ", "), shipped.version);

    TerminalObserver observer(options.isQuiet);
    std::vector<DeviceVerdict> verdicts;
    for (const Subject &subject : subjects) {
        verdicts.push_back(verifyWithProgress(subject, shipped, options, observer));
        const DeviceVerdict &verdict = verdicts.back();
        if (subject.device && options.scenes.empty() && options.kernels.empty())
            keep(*subject.device, verdict.isPassed(), observer);
        if (!options.isQuiet || !verdict.isPassed())
            print(verdict);
        std::fflush(stdout); // a later device may take long, or crash its driver
    }
    if (junit)
        junit.store(verificationToJunit(verdicts));
    if (report)
        report.store(jsonText(verificationToJson(shipped, verdicts, commandLine)));
    const bool isPassed = std::ranges::all_of(verdicts, &DeviceVerdict::isPassed);
    printResult("{}\n", isPassed ? "equal, bit for bit" : "NOT equal");
    return isPassed ? ExitCode::Ok : ExitCode::AnswerIsNo;
}

} // namespace

void addVerifyCommand(CLI::App &app, CommandContext &context) {
    CLI::App *command = app.add_subcommand(
        "verify", "render small shipped scenes, and compare their films with shipped hashes");
    const auto options = std::make_shared<VerifyOptions>();
    command->footer(
        "The scenes reach every kernel, material, light and camera; a device renders them with every "
        "kernel that it can run. The hashes are the same for all devices and machines. The exit "
        "code is 0 only if all films of all devices have the shipped bits, and 1 if not.");
    addDevicesOption(
        *command, options->devices,
        "what to verify: all devices and the CPU renderer; cpu; or a device, by index or part of its name. "
        "May be repeated")
        ->default_str("all");
    command->add_option("--scenes", options->scenes, "only these of the shipped scenes")
        ->type_name("NAME,...")
        ->delimiter(',')
        ->expected(1, -1);
    command->add_option("--kernels", options->kernels, "only these kernels of devices")
        ->type_name("NAME,...")
        ->delimiter(',')
        ->expected(1, -1)
        ->transform(presentKernelWord);
    addOutput(*command, "--junit", options->junit, "FILE.xml", "write the verdicts as JUnit XML, for CI");
    addOutput(*command, "--report", options->report, "FILE.json", "write the verdicts and all hashes");
    command->add_flag("--quiet", options->isQuiet, "print what differs, and the result only");
    addSoakOptions(*command, options->soak);
    command->callback([options, &context] { context.exitCode = runVerify(*options, context.commandLine); });
}

} // namespace hyalite::core
