#include "host/report/baseline.h"

#include "host/base/clean_text.h"
#include "host/base/error.h"
#include "host/base/hash.h"
#include "host/base/json_document.h"
#include "host/report/profile_json.h"
#include "host/report/render_report.h"
#include "host/scene/settings_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <concepts>
#include <utility>

namespace hyalite::core {

namespace {

using Json = nlohmann::json;

/// nlohmann::json converts any number to any other, and what does not fit is undefined.
template <std::integral Whole> Whole wholeNumber(const Json &json) {
    const bool fits = json.is_number_unsigned()
                          ? std::in_range<Whole>(json.get<std::uint64_t>())
                          : json.is_number_integer() && std::in_range<Whole>(json.get<std::int64_t>());
    if (!fits)
        throw Error(ErrorKind::BadInput, "found " + excerpt(json.dump()) + " where a whole number is needed");
    return json.get<Whole>();
}

/// Adds all whole numbers below `json`, by their paths: "rays.primary".
void addCounts(const Json &json, const std::string &path, std::vector<ProfileFigures::Count> &counts) {
    if (json.is_number_unsigned()) {
        counts.push_back({path, json.get<std::uint64_t>()});
        return;
    }
    if (!json.is_object())
        throw Error(ErrorKind::BadInput, "an entry of \"work\" is not a count");
    for (const auto &[key, value] : json.items())
        addCounts(value, path.empty() ? key : path + "." + key, counts);
}

ProfileFigures::Times timesOf(const std::string &name, const Json &frameMillis) {
    ProfileFigures::Times times{name, frameMillis.get<std::vector<double>>()};
    if (times.frameMillis.empty() ||
        *std::min_element(times.frameMillis.begin(), times.frameMillis.end()) < 0)
        throw Error(ErrorKind::BadInput, "frameMillis has no times");
    return times;
}

/// The exposure is left out, as it costs nothing.
std::string jobText(const std::string &sceneHash, int width, int height, Json settings) {
    settings.erase("exposure");
    return fmt::format("scene of the hash {}, {}x{}, {}", sceneHash, width, height, settings.dump());
}

/// Throws exceptions of nlohmann::json, or Error, if something is missing or wrong.
ProfileFigures figuresOf(const Json &json) {
    const int version = json.contains("profileVersion") ? wholeNumber<int>(json.at("profileVersion")) : 1;
    if (version != profileVersion && json.contains("frameMillis"))
        throw Error(ErrorKind::BadInput,
                    fmt::format("it has version {}, and {} is compared: measure it anew with this program",
                                version, profileVersion));
    if (json.contains("finishedShare"))
        throw Error(ErrorKind::BadInput, "the time limit ended its only frame, which has no time");
    ProfileFigures figures;
    const Json &device = json.at("device");
    figures.device = device.at("name").get<std::string>() + ", " + device.at("driver").get<std::string>();
    const Json &image = json.at("image");
    figures.scene = json.at("scene").get<std::string>();
    figures.job = jobText(json.at("sceneHash").get<std::string>(), wholeNumber<int>(image.at("width")),
                          wholeNumber<int>(image.at("height")), json.at("settings"));
    for (const Json &kernel : json.at("kernels")) {
        const std::string name = kernel.at("name").get<std::string>();
        figures.kernels.push_back(timesOf(name, kernel.at("frameMillis")));
    }
    if (json.contains("stages"))
        for (const Json &stage : json.at("stages"))
            figures.stages.push_back(timesOf(stage.at("name").get<std::string>(), stage.at("frameMillis")));
    figures.frame = timesOf("frame", json.at("frameMillis"));
    addCounts(json.at("work"), "", figures.work);
    figures.report = json;
    return figures;
}

template <class Entry> const Entry *findNamed(const std::vector<Entry> &entries, const std::string &name) {
    const auto named =
        std::find_if(entries.begin(), entries.end(), [&](const Entry &entry) { return entry.name == name; });
    return named == entries.end() ? nullptr : &*named;
}

/// Calls onBoth(old, now) for what has the same name on both sides, and lists what has not.
template <class Entry, class OnBoth>
void match(const std::vector<Entry> &old, const std::vector<Entry> &now, std::vector<std::string> &unmatched,
           OnBoth &&onBoth) {
    for (const Entry &entry : old)
        if (const Entry *other = findNamed(now, entry.name))
            onBoth(entry, *other);
        else
            unmatched.push_back(entry.name + " (only in the baseline)");
    for (const Entry &entry : now)
        if (findNamed(old, entry.name) == nullptr)
            unmatched.push_back(entry.name + " (not in the baseline)");
}

TimeChange compareTimes(const ProfileFigures::Times &old, const ProfileFigures::Times &now,
                        double maxRegression) {
    TimeChange change;
    change.name = now.name;
    change.oldMillis = quantile(old.frameMillis, 0.5);
    change.newMillis = quantile(now.frameMillis, 0.5);
    if (change.oldMillis > 0.0)
        change.ratio = change.newMillis / change.oldMillis;
    if (old.frameMillis.size() > 1 && now.frameMillis.size() > 1)
        change.noise = std::hypot(relativeSpread(old.frameMillis), relativeSpread(now.frameMillis));
    change.isRegression = change.ratio * (1.0 - change.noise.value_or(0.0)) > 1.0 + maxRegression;
    return change;
}

std::string timeRow(const TimeChange &change, const std::string &verdict) {
    return fmt::format("{:<32}{:>12.3f}{:>12.3f}{:>9.3f}{:>10}  {}\n", change.name, change.oldMillis,
                       change.newMillis, change.ratio,
                       change.noise ? fmt::format("{:.1f} %", *change.noise * 100.0) : "unknown", verdict);
}

} // namespace

Change TimeChange::change() const {
    if (!noise || oldMillis <= 0.0)
        return Change::Unknown;
    if (std::abs(ratio - 1.0) <= noisesOfChange * *noise)
        return Change::None;
    return ratio < 1.0 ? Change::Faster : Change::Slower;
}

ProfileFigures figuresOf(const Profile &profile) { return figuresOf(Json(profileToJson(profile))); }

ProfileFigures readFigures(const std::filesystem::path &file) {
    const Json json = readJsonFile(file);
    try {
        return figuresOf(json);
    } catch (const Json::exception &) { // its words are about the library's own types
        throw Error(
            ErrorKind::BadInput,
            fmt::format("{}: not a profile report: a value is missing or has another type", file.string()),
            Remedy::ProfileReport);
    } catch (const Error &error) {
        throw Error(ErrorKind::BadInput,
                    fmt::format("{}: not a profile report: {}", file.string(), error.what()),
                    Remedy::ProfileReport);
    }
}

void requireSameJob(const ProfileFigures &baseline, const Profile &profile) {
    const std::string job = jobText(hashText(profile.origin.sceneHash), profile.origin.width,
                                    profile.origin.height, Json(settingsToJson(profile.origin.settings)));
    if (baseline.job != job)
        throw Error(
            ErrorKind::BadInput,
            fmt::format("the baseline is of another job: it measured\n  {}: {}\nand this is\n  {}: {}",
                        excerpt(baseline.scene, 400), excerpt(baseline.job, 400), profile.origin.scene, job));
}

BaselineComparison compareWithBaseline(const ProfileFigures &baseline, const ProfileFigures &now,
                                       double maxRegression, Gate gate) {
    BaselineComparison comparison;
    comparison.isSameDevice = baseline.device == now.device;
    match(baseline.kernels, now.kernels, comparison.unmatched, [&](const auto &old, const auto &other) {
        const TimeChange change = compareTimes(old, other, maxRegression);
        if (change.isRegression && comparison.isSameDevice && gate != Gate::Work)
            comparison.isPassed = false;
        comparison.kernels.push_back(change);
    });
    std::vector<std::string> ofOneSide; // devices have stages of their own
    match(baseline.stages, now.stages, ofOneSide, [&](const auto &old, const auto &other) {
        comparison.stages.push_back(compareTimes(old, other, maxRegression));
    });
    comparison.frame = compareTimes(baseline.frame, now.frame, maxRegression);
    match(baseline.work, now.work, comparison.unmatched, [&](const auto &old, const auto &other) {
        ++comparison.comparedCounts;
        if (old.count == other.count)
            return;
        const bool isRegression =
            static_cast<double>(other.count) > static_cast<double>(old.count) * (1.0 + maxRegression);
        if (isRegression && gate != Gate::Times)
            comparison.isPassed = false;
        comparison.work.push_back({other.name, old.count, other.count, isRegression});
    });
    return comparison;
}

std::string comparisonTable(const BaselineComparison &comparison, double maxRegression, Gate gate) {
    std::string text = fmt::format("{:<32}{:>12}{:>12}{:>9}{:>10}\n", "against the baseline", "old ms",
                                   "new ms", "ratio", "noise");
    const bool areTimesGated = comparison.isSameDevice && gate != Gate::Work;
    for (const TimeChange &change : comparison.kernels)
        text += timeRow(change, !change.isRegression ? ""
                                : areTimesGated      ? "SLOWER"
                                                     : "slower, which is not asked");
    text += timeRow(comparison.frame, "not gated");
    for (const CountChange &change : comparison.work)
        text += fmt::format("{:<32}{:>12}{:>12}{:>9.3f}{:>10}  {}\n", change.name, change.oldCount,
                            change.newCount,
                            static_cast<double>(change.newCount) / static_cast<double>(change.oldCount), "",
                            change.isRegression && gate != Gate::Times ? "MORE WORK" : "work changed");
    text += fmt::format("work         {} of {} counts are equal\n",
                        comparison.comparedCounts - comparison.work.size(), comparison.comparedCounts);
    for (const std::string &name : comparison.unmatched)
        text += fmt::format("not compared {}\n", excerpt(name));
    if (!comparison.isSameDevice)
        text +=
            "note         the baseline is of another device or driver: times do not fail the comparison\n";
    return text + fmt::format("{} (limit {:g} %, beyond the noise)\n",
                              comparison.isPassed ? "no regression" : "REGRESSION", maxRegression * 100.0);
}

} // namespace hyalite::core
