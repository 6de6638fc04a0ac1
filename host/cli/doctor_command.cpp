#include "host/base/atomic_file.h"
#include "host/base/json_text.h"
#include "host/base/message.h"
#include "host/base/quantities.h"
#include "host/base/version.h"
#include "host/cli/commands.h"
#include "host/cli/device_options.h"
#include "host/cli/options.h"
#include "host/cli/terminal_observer.h"
#include "host/lab/doctor_json.h"
#include "host/lab/known_machines.h"
#include "host/process/apart.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace hyalite::core {

namespace {

struct DoctorOptions {
    ExaminationRequest request;
    std::optional<double> timeLimitSeconds;
    std::string report;
    bool isQuiet = false;
};

void printMachine(const Machine &machine) {
    printResult("system      {}; {}, {}, {}{}\n", machine.system.empty() ? "unknown" : machine.system,
                machine.kernel, machine.architecture, machine.libc,
                machine.isContainer ? ", in a container" : "");
    printResult("processor   {}, {}, {}\n", machine.processor.empty() ? "unknown" : machine.processor,
                countText(machine.threadCount, "thread"),
                machine.memoryBytes ? sizeText(*machine.memoryBytes) : "memory unknown");
    for (const GraphicsCard &card : machine.cards)
        printResult("card        {} {:04x}:{:04x}, {}\n", card.address, card.vendorId, card.deviceId,
                    card.kernelDriver.empty() ? "without a driver of the kernel"
                                              : "driver " + card.kernelDriver);
    if (!machine.nvidiaModule.empty())
        printResult("module      NVIDIA {}\n", machine.nvidiaModule);
    for (const DeviceNode &node : machine.nodes)
        printResult("node        {}, group {}, {}\n", node.file.string(), node.group,
                    node.isAccessible ? "accessible" : "NOT accessible");
    for (const auto &[name, value] : machine.variables)
        printResult("variable    {}={}\n", name, value);
    for (const DriverFile &driver : machine.drivers)
        printResult("driver      {}{}\n", driver.manifest.string(),
                    driver.fault.empty() ? "" : ": NOT loaded: " + driver.fault);
}

std::string ratesText(const std::vector<SpeedFigure> &speed) {
    std::string text;
    for (const Trial &trial : trials) {
        const auto figure = std::ranges::find(speed, trial.scene, &SpeedFigure::scene);
        text += figure != speed.end() ? fmt::format(" {:>11.3g}", figure->megaraysPerSecond)
                                      : fmt::format(" {:>11}", "");
    }
    return text;
}

void printPatient(const Patient &patient) {
    const auto &facts = patient.facts;
    printResult("\ndevice {}  {}\n", patient.name,
                facts.at(patient.isVulkan() ? "name" : "type").get<std::string>());
    if (patient.isVulkan())
        printResult("  {}, {}, Vulkan {}\n", facts.at("type").get<std::string>(),
                    facts.at("driver").get<std::string>(), facts.at("apiVersion").get<std::string>());
    if (!patient.isUsable())
        printResult("  NOT usable: {}\n", facts.at("rejection").get<std::string>());
    else
        printResult("  equal bits: {}\n", facts.at("equalBits").get<std::string>());
    if (const auto &bits = patient.bits)
        printResult("  films: {} of {} have the shipped bits, {:.0f} s{}\n", bits->equalCount,
                    bits->renderedCount, bits->seconds,
                    bits->isWhole ? "" : "; there was no time for the others: `hyalite verify` renders all");
    if (!patient.failure.empty())
        printResult("  FAILED: {}\n", patient.failure);
}

/// Of this machine, and of others below them.
void printSpeeds(const Examination &examination) {
    if (std::ranges::all_of(examination.patients,
                            [](const Patient &patient) { return patient.speed.empty(); }))
        return;
    std::string head;
    for (const Trial &trial : trials)
        head += fmt::format(" {:>11}", trial.scene);
    printResult("\nMray/s    {}\n", head);
    for (const Patient &patient : examination.patients)
        if (!patient.speed.empty())
            printResult("here      {}  {}\n", ratesText(patient.speed),
                        patient.facts.at("name").get<std::string>());
    for (const KnownMachine &known : readKnownMachines())
        printResult("{}{}  {}, {}; {}; hyalite {}\n", known.date, ratesText(known.speed), known.device,
                    known.driver, known.machine, known.program);
}

void printFindings(const std::vector<Finding> &findings) {
    printResult("\n");
    for (const Finding &finding : findings) {
        printResult("{}: {}\n", finding.isProblem ? "problem" : "note", finding.what);
        if (!finding.remedy.empty())
            printResult("  -> {}\n", finding.remedy);
    }
}

/// The result, in words and as an exit code.
ExitCode conclude(const Examination &examination) {
    const auto isUsable = [](const Patient &patient) { return patient.isVulkan() && patient.isUsable(); };
    if (std::ranges::any_of(examination.patients, &Patient::isIll)) {
        printResult("a device fails or computes other bits\n");
        return ExitCode::AnswerIsNo;
    }
    if (examination.wantsVulkan && std::ranges::none_of(examination.patients, isUsable)) {
        printResult("no Vulkan device can be used; --device cpu renders without, to the same bits\n");
        return ExitCode::NoDevice;
    }
    printResult("ready to render\n");
    return ExitCode::Ok;
}

ExitCode runDoctor(DoctorOptions options, const std::string &commandLine) {
    std::optional<AtomicFile> report;
    if (!options.report.empty())
        report.emplace(options.report);
    if (options.timeLimitSeconds)
        options.request.timeLimitSeconds = *options.timeLimitSeconds;
    TerminalObserver observer(options.isQuiet);
    const Examination examination = examine(options.request, observer, inOwnProcess);
    printResult("hyalite {}, {}\n", HYALITE_VERSION, examination.date);
    printMachine(examination.machine);
    std::ranges::for_each(examination.patients, printPatient);
    printSpeeds(examination);
    printFindings(examination.findings);
    if (report) {
        report->write(jsonText(examinationToJson(examination, commandLine)));
        report->commit();
    }
    return conclude(examination);
}

} // namespace

void addDoctorCommand(CLI::App &app, CommandContext &context) {
    CLI::App *command = app.add_subcommand(
        "doctor",
        "examine this machine: which devices can be used, and if not, why; their bits and their speed");
    const auto options = std::make_shared<DoctorOptions>();
    command->footer(
        "It takes at most five minutes, and changes nothing. To ask for help, send what it prints and the "
        "file of --report. The exit code is 1 if a device fails or has other bits, and 4 if no Vulkan "
        "device can be used.");
    addDevicesOption(
        *command, options->request.devices,
        "what to examine: all devices and the CPU renderer; cpu; or a device, by index or part of its "
        "name. May be repeated")
        ->default_str("all");
    addTimeLimit(*command, options->timeLimitSeconds, "check bits and measure speeds for about this time")
        ->default_str("240");
    addOutput(*command, "--report", options->report, "FILE.json", "write all of it as JSON, to be sent");
    command->add_flag("--quiet", options->isQuiet, "show no progress");
    command->callback([options, &context] { context.exitCode = runDoctor(*options, context.commandLine); });
}

} // namespace hyalite::core
