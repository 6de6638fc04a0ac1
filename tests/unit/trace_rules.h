// What the Trace Event Format asks of a trace: see host/report/trace_json.h.
#pragma once

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace hyalite::testing {

/// A thread of a process.
using TraceTrack = std::pair<int, int>;

/// Expects the keys that every event needs, and those that its phase needs.
inline void expectTraceEvent(const nlohmann::json &event) {
    ASSERT_TRUE(event.is_object());
    for (const char *key : {"name", "ph"})
        EXPECT_TRUE(event.contains(key) && event.at(key).is_string()) << key << ": " << event;
    for (const char *key : {"pid", "tid"})
        EXPECT_TRUE(event.contains(key) && event.at(key).is_number_integer()) << key << ": " << event;
    const std::string phase = event.at("ph");
    if (phase == "M") {
        const std::set<std::string> known{"process_name", "thread_name", "process_sort_index",
                                          "thread_sort_index", "process_labels"};
        EXPECT_TRUE(known.contains(event.at("name"))) << event;
        EXPECT_TRUE(event.at("args").is_object()) << event;
        return;
    }
    ASSERT_TRUE(event.contains("ts") && event.at("ts").is_number()) << event;
    EXPECT_GE(event.at("ts").get<double>(), 0.0) << event;
    if (phase == "X") {
        ASSERT_TRUE(event.contains("dur") && event.at("dur").is_number()) << event;
        EXPECT_GE(event.at("dur").get<double>(), 0.0) << event;
        EXPECT_TRUE(event.at("cat").is_string()) << event;
    } else if (phase == "C") {
        ASSERT_FALSE(event.at("args").empty()) << event;
        for (const auto &[series, value] : event.at("args").items())
            EXPECT_TRUE(value.is_number()) << series << ": " << event;
    } else {
        ADD_FAILURE() << "a phase that we do not write: " << event;
    }
}

/// Expects events in the order of their times, and slices of a track to contain each other or to lie apart.
inline void expectTrace(const nlohmann::json &trace) {
    ASSERT_TRUE(trace.is_object());
    ASSERT_TRUE(trace.at("traceEvents").is_array());
    EXPECT_TRUE(trace.at("displayTimeUnit") == "ms" || trace.at("displayTimeUnit") == "ns");
    constexpr double roundingMicros = 1e-3;
    std::map<TraceTrack, double> lastTime;
    std::map<TraceTrack, std::vector<double>> openEnds;
    std::set<TraceTrack> named;
    std::set<int> namedProcesses;
    for (const nlohmann::json &event : trace.at("traceEvents")) {
        expectTraceEvent(event);
        const TraceTrack track{event.at("pid").get<int>(), event.at("tid").get<int>()};
        if (event.at("name") == "thread_name")
            named.insert(track);
        if (event.at("name") == "process_name")
            namedProcesses.insert(track.first);
        if (event.at("ph") == "M")
            continue;
        EXPECT_TRUE(named.contains(track) && namedProcesses.contains(track.first)) << event;
        const double begin = event.at("ts");
        EXPECT_GE(begin, lastTime[track]) << "goes back in time: " << event;
        lastTime[track] = begin;
        if (event.at("ph") != "X")
            continue;
        const double end = begin + event.at("dur").get<double>();
        std::vector<double> &ends = openEnds[track];
        while (!ends.empty() && ends.back() <= begin + roundingMicros)
            ends.pop_back();
        if (!ends.empty()) {
            EXPECT_LE(end, ends.back() + roundingMicros) << "overlaps another slice: " << event;
        }
        ends.push_back(end);
    }
}

/// The slices of a category.
[[nodiscard]] inline std::vector<nlohmann::json> traceSlices(const nlohmann::json &trace,
                                                             const std::string &category) {
    std::vector<nlohmann::json> slices;
    for (const nlohmann::json &event : trace.at("traceEvents"))
        if (event.at("ph") == "X" && event.at("cat") == category)
            slices.push_back(event);
    return slices;
}

} // namespace hyalite::testing
