#include "host/lab/soak_report.h"

#include "host/base/error.h"
#include "host/base/json_document.h"
#include "host/base/quantities.h"
#include "host/base/summary.h"
#include "host/lab/comparison_run.h"
#include "host/report/junit.h"
#include "host/report/provenance.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <utility>

namespace hyalite::core {

namespace {

constexpr double leastOfExpected = 0.8;
constexpr std::size_t maxDeviceCount = 1000;

std::string_view nameOf(SoakFault::Kind kind) {
    constexpr std::array<std::string_view, 6> names{"film", "comparison", "rays", "words", "device", "speed"};
    return names[static_cast<std::size_t>(kind)];
}

std::string_view nameOf(Recurrence recurrence) {
    constexpr std::array<std::string_view, 5> names{"unknown", "transient", "intermittent", "permanent",
                                                    "data"};
    return names[static_cast<std::size_t>(recurrence)];
}

std::string bitsText(std::uint32_t found, std::uint32_t expected) {
    std::vector<int> bits;
    for (int bit = 0; bit < 32; ++bit)
        if (((found ^ expected) >> bit & 1) != 0)
            bits.push_back(bit);
    return fmt::format("{:08x}, not {:08x} (bit{} {})", found, expected, bits.size() == 1 ? "" : "s",
                       fmt::join(bits, ", "));
}

std::string recurrenceText(const SoakFault &fault) {
    switch (fault.recurrence) {
    case Recurrence::Unknown:
        return "";
    case Recurrence::Data:
        return fmt::format("; data: it came again in all of {} passes, until the scene was uploaded anew",
                           fault.replays);
    default:
        return fmt::format("; {}: it came again in {} of {} passes", nameOf(fault.recurrence), fault.repeats,
                           fault.replays);
    }
}

std::string describeFilm(const SoakFault &fault) {
    std::string text =
        fault.wrongCount == 1 ? "1 pixel differs" : fmt::format("{} pixels differ", fault.wrongCount);
    if (const auto &dispatch = fault.dispatch)
        text += fmt::format("; tile ({}, {}) of {}x{}", dispatch->tileX, dispatch->tileY, dispatch->tileWidth,
                            dispatch->tileHeight);
    text += fmt::format("; pixel ({}, {})", fault.pixel.x, fault.pixel.y);
    if (!fault.samples.empty())
        text += fmt::format(", sample {}", fmt::join(fault.samples, " or "));
    if (fault.lane)
        text += fmt::format(", lane {}", *fault.lane);
    if (!fault.words.empty())
        text += fmt::format(": {} {}", fault.words.front().name,
                            bitsText(fault.words.front().found, fault.words.front().expected));
    text += recurrenceText(fault);
    if (const auto &divergence = fault.divergence)
        text += fmt::format("; first step: sample {}, bounce {}: {}: {} on the device, {} on the CPU",
                            divergence->sampleIndex, divergence->rayDepth - 1, divergence->quantity,
                            divergence->valueA, divergence->valueB);
    else if (fault.recurrence == Recurrence::Permanent)
        text += "; its path is right where it is traced by itself";
    return text;
}

std::string describeWords(const SoakFault &fault) {
    std::string text = countText(fault.wrongCount, "word") + " wrong";
    if (!fault.memory.empty()) {
        const gpu::WrongMemory &first = fault.memory.front();
        text += fmt::format("; at byte {}: {}", first.word * sizeof(std::uint32_t),
                            bitsText(first.found, first.expected));
    }
    return text;
}

nlohmann::ordered_json toJson(const SoakFault &fault) {
    nlohmann::ordered_json json;
    json["kind"] = nameOf(fault.kind);
    json["load"] = fault.load;
    json["pass"] = fault.pass;
    json["time"] = fault.time;
    json["text"] = describe(fault);
    if (fault.kind == SoakFault::Kind::Words) {
        json["wrongWords"] = fault.wrongCount;
        json["words"] = nlohmann::ordered_json::array();
        for (const gpu::WrongMemory &word : fault.memory)
            json["words"].push_back({{"byte", word.word * sizeof(std::uint32_t)},
                                     {"found", word.found},
                                     {"expected", word.expected}});
    }
    if (fault.wrongCount == 0 || fault.kind == SoakFault::Kind::Words)
        return json;
    json["wrongPixels"] = fault.wrongCount;
    json["pixel"] = {fault.pixel.x, fault.pixel.y};
    if (const auto &dispatch = fault.dispatch)
        json["tile"] = {{"x", dispatch->tileX},
                        {"y", dispatch->tileY},
                        {"width", dispatch->tileWidth},
                        {"height", dispatch->tileHeight}};
    json["words"] = nlohmann::ordered_json::array();
    for (const WrongFilmWord &word : fault.words)
        json["words"].push_back({{"name", word.name}, {"found", word.found}, {"expected", word.expected}});
    json["samples"] = fault.samples;
    if (fault.lane)
        json["lane"] = *fault.lane;
    json["recurrence"] = nameOf(fault.recurrence);
    json["replays"] = fault.replays;
    json["repeats"] = fault.repeats;
    if (fault.divergence)
        json["divergence"] = divergenceToJson(fault.pixel, fault.divergence);
    return json;
}

nlohmann::ordered_json toJson(const SoakLoad &load) {
    nlohmann::ordered_json json;
    json["name"] = load.name;
    json["passes"] = load.passes;
    json["wrongPasses"] = load.wrongPasses;
    json["readBacks"] = load.readBacks;
    if (!load.lack.empty())
        json["lack"] = load.lack;
    if (load.speeds.empty())
        return json;
    const std::vector<double> speeds(load.speeds.begin(), load.speeds.end());
    json["speed"] = {{"unit", load.unit + "/s"},        {"median", load.medianSpeed()},
                     {"p05", quantile(speeds, 0.05)},   {"min", std::ranges::min(speeds)},
                     {"max", std::ranges::max(speeds)}, {"slowSlices", load.slowSlices()}};
    json["slices"] = nlohmann::ordered_json::array();
    for (const SoakSlice &slice : load.slices)
        json["slices"].push_back(
            {{"seconds", slice.seconds}, {"passes", slice.passes}, {"medianSpeed", slice.medianSpeed}});
    return json;
}

/// Those that are not 0, by index.
nlohmann::ordered_json countsToJson(std::span<const std::uint64_t> counts) {
    nlohmann::ordered_json json = nlohmann::ordered_json::object();
    for (std::size_t i = 0; i < counts.size(); ++i)
        if (counts[i] > 0)
            json[std::to_string(i)] = counts[i];
    return json;
}

nlohmann::ordered_json toJson(const WrongPatterns &patterns) {
    nlohmann::ordered_json json;
    json["bits"] = countsToJson(patterns.bits);
    json["words"] = nlohmann::ordered_json::object();
    for (const auto &[name, count] : patterns.words)
        json["words"][std::string(name)] = count;
    json["lanes"] = countsToJson(patterns.lanes);
    return json;
}

TestCase toCase(const SoakVerdict &device, const SoakLoad &load) {
    TestCase test{device.device, load.name, load.workSeconds + load.checkSeconds};
    if (!load.lack.empty())
        test.skipped = load.lack;
    const auto first = std::ranges::find(device.faults, load.name, &SoakFault::load);
    if (first != device.faults.end())
        test.failure =
            fmt::format("{} of {} passes were wrong; {}", load.wrongPasses, load.passes, describe(*first));
    return test;
}

} // namespace

std::string describe(const SoakFault &fault) {
    const std::string place = fmt::format("{}, pass {}: ", fault.load, fault.pass);
    switch (fault.kind) {
    case SoakFault::Kind::Film:
        return place + describeFilm(fault);
    case SoakFault::Kind::Comparison:
        return place +
               (fault.wrongCount == 0
                    ? "the film is right, but the device's comparison says that it is not: what it is "
                      "compared with in the device's memory, or the comparison, is wrong"
                    : "the device's comparison did not find that " + describeFilm(fault));
    case SoakFault::Kind::Rays:
        return place + "the film is right, but the device counted other rays for it";
    case SoakFault::Kind::Words:
        return place + describeWords(fault);
    case SoakFault::Kind::Device:
        return place + fault.text;
    case SoakFault::Kind::Speed:
        break;
    }
    return fmt::format("{}: {}", fault.load, fault.text);
}

std::string summaryOf(const SoakVerdict &verdict) {
    std::string text = !verdict.faults.empty() ? "FAULTY"
                       : verdict.passes() > 0  ? "sound"
                                               : "nothing compared";
    text += fmt::format(": {}, {} in {}", countText(verdict.loads.size(), "load"),
                        countText(verdict.passes(), "pass", "passes"), durationText(verdict.seconds));
    if (verdict.wrongPasses() > 0)
        text += fmt::format(", {} of them wrong", verdict.wrongPasses());
    return text + fmt::format("; {} of the time for checks", percentText(verdict.checkShare()));
}

std::string speedText(const SoakLoad &load) {
    return roundedText(static_cast<std::uint64_t>(load.medianSpeed()), load.unit) + "/s";
}

std::string soakToJunit(std::span<const SoakVerdict> devices) {
    std::vector<TestSuite> suites;
    for (const SoakVerdict &device : devices) {
        TestSuite suite{device.description, {}};
        for (const SoakLoad &load : device.loads)
            suite.cases.push_back(toCase(device, load));
        suites.push_back(std::move(suite));
    }
    return junitText("hyalite verify", suites);
}

nlohmann::ordered_json soakToJson(const Loads &loads, std::span<const SoakVerdict> devices,
                                  const std::string &commandLine) {
    nlohmann::ordered_json json = programToJson(commandLine);
    json["soakVersion"] = soakReportVersion;
    json["loadsVersion"] = loads.version;
    json["devices"] = nlohmann::ordered_json::array();
    for (const SoakVerdict &device : devices) {
        nlohmann::ordered_json entry;
        entry["name"] = device.device;
        entry["description"] = device.description;
        entry["isSound"] = device.isSound();
        entry["summary"] = summaryOf(device);
        entry["seconds"] = device.seconds;
        entry["checkShare"] = device.checkShare();
        if (device.stoppedBy)
            entry["stoppedBy"] = *device.stoppedBy;
        entry["loads"] = nlohmann::ordered_json::array();
        for (const SoakLoad &load : device.loads)
            entry["loads"].push_back(toJson(load));
        entry["faults"] = nlohmann::ordered_json::array();
        for (const SoakFault &fault : device.faults)
            entry["faults"].push_back(toJson(fault));
        entry["patterns"] = toJson(device.patterns);
        entry["sensors"] = nlohmann::ordered_json::array();
        for (const SensorRange &sensor : device.sensors)
            entry["sensors"].push_back(
                {{"name", sensor.name}, {"unit", sensor.unit}, {"min", sensor.min}, {"max", sensor.max}});
        json["devices"].push_back(entry);
    }
    json["isSound"] = std::ranges::all_of(devices, &SoakVerdict::isSound);
    return json;
}

std::vector<ExpectedSpeed> readExpectedSpeeds(const std::string &file) {
    const nlohmann::json document = readJsonFile(file);
    const auto member = [&](const nlohmann::json &json, const char *key) -> const nlohmann::json & {
        if (!json.is_object() || !json.contains(key))
            throw Error(ErrorKind::BadInput,
                        fmt::format("{}: found no \"{}\"; expected a report with the speeds of "
                                    "loads",
                                    file, key));
        return json.at(key);
    };
    if (member(document, "soakVersion") != soakReportVersion)
        throw Error(ErrorKind::BadInput,
                    fmt::format("{}: found soakVersion {}; this program reads version {}", file,
                                document.at("soakVersion").dump(), soakReportVersion));
    std::vector<ExpectedSpeed> speeds;
    for (const nlohmann::json &device : member(document, "devices"))
        for (const nlohmann::json &load : member(device, "loads"))
            if (load.is_object() && load.contains("speed")) {
                const nlohmann::json &median = member(load.at("speed"), "median");
                if (!median.is_number() || !member(device, "name").is_string() ||
                    !member(load, "name").is_string())
                    throw Error(ErrorKind::BadInput, fmt::format("{}: found {}; expected a number", file,
                                                                 median.dump().substr(0, 80)));
                speeds.push_back({device.at("name"), load.at("name"), median.get<double>()});
            }
    return speeds;
}

void judgeSpeeds(SoakVerdict &verdict, std::span<const ExpectedSpeed> expected) {
    bool isKnown = false;
    for (const ExpectedSpeed &wanted : expected) {
        if (wanted.device != verdict.device)
            continue;
        isKnown = true;
        const auto load = std::ranges::find(verdict.loads, wanted.load, &SoakLoad::name);
        if (load == verdict.loads.end() || load->passes == 0 ||
            load->medianSpeed() >= leastOfExpected * wanted.speed)
            continue;
        SoakFault fault;
        fault.kind = SoakFault::Kind::Speed;
        fault.load = load->name;
        fault.text = fmt::format("{}, which is {:.2f} of the expected {}/s", speedText(*load),
                                 load->medianSpeed() / wanted.speed,
                                 roundedText(static_cast<std::uint64_t>(wanted.speed), load->unit));
        verdict.faults.push_back(std::move(fault));
    }
    if (!isKnown)
        throw Error(ErrorKind::BadInput,
                    fmt::format("the report to compare speeds with has none of {}", verdict.device));
}

} // namespace hyalite::core
