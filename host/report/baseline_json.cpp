#include "host/report/baseline_json.h"

namespace hyalite::core {

namespace {

const char *changeText(Change change) {
    switch (change) {
    case Change::Faster:
        return "faster";
    case Change::Slower:
        return "slower";
    case Change::None:
        return "within the noise";
    case Change::Unknown:
        break;
    }
    return "unknown";
}

nlohmann::ordered_json timeToJson(const TimeChange &change) {
    nlohmann::ordered_json json{
        {"name", change.name}, {"oldMillis", change.oldMillis}, {"newMillis", change.newMillis}};
    if (change.oldMillis > 0.0)
        json["ratio"] = change.ratio;
    if (change.noise)
        json["noise"] = *change.noise;
    json["change"] = changeText(change.change());
    json["isRegression"] = change.isRegression;
    return json;
}

nlohmann::ordered_json timesToJson(const std::vector<TimeChange> &changes) {
    nlohmann::ordered_json json = nlohmann::ordered_json::array();
    for (const TimeChange &change : changes)
        json.push_back(timeToJson(change));
    return json;
}

} // namespace

nlohmann::ordered_json comparisonToJson(const BaselineVerdict &verdict) {
    const BaselineComparison &comparison = verdict.comparison;
    nlohmann::ordered_json json{{"limit", verdict.maxRegression},
                                {"areTimesGated", comparison.isSameDevice && verdict.gate != Gate::Work},
                                {"areCountsGated", verdict.gate != Gate::Times},
                                {"isPassed", comparison.isPassed},
                                {"isSameDevice", comparison.isSameDevice},
                                {"noisesOfChange", noisesOfChange}};
    json["frame"] = timeToJson(comparison.frame);
    json["stages"] = timesToJson(comparison.stages);
    json["kernels"] = timesToJson(comparison.kernels);
    json["comparedCounts"] = comparison.comparedCounts;
    json["counts"] = nlohmann::ordered_json::array();
    for (const CountChange &change : comparison.work)
        json["counts"].push_back({{"name", change.name},
                                  {"old", change.oldCount},
                                  {"new", change.newCount},
                                  {"isRegression", change.isRegression}});
    json["unmatched"] = comparison.unmatched;
    return json;
}

} // namespace hyalite::core
