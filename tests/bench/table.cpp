#include "tests/bench/table.h"

#include "tests/bench/embree.h"
#include "tests/bench/parallel.h"
#include "tests/bench/race.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <unistd.h>

#include <algorithm>
#include <fstream>

namespace hyalite::core::bench {

namespace {

/// What a table's figures are.
const std::map<std::string, std::string> captions{
    {"rays", "Mray/s, and how many times as fast as Embree's calls for one ray:"},
    {"frames",
     "Seconds for a whole image, in vectors as wide as `render` has them: of all dispatches, and of the "
     "process from start to end; and how many times as fast another driver's dispatches are:"},
    {"size", "Nanoseconds of all dispatches a ray, by how many of what a scene has:"},
    {"noise", "Seconds until pixels have a standard deviation of 5 % of the image's mean, and how many times "
              "sooner that is:"},
    {"start-up", "Seconds from start to end of the process, and how many times as fast another driver is:"},
    {"trees", "Seconds to build a tree, and how many times as fast as Embree on as many threads:"},
    {"reading", "Seconds to read an OBJ file, and how many times as fast as tinyobjloader:"},
    {"brute force", "Mray/s, and how many times as fast as testing all triangles:"},
};

std::string cpuName() {
    std::ifstream stream("/proc/cpuinfo");
    for (std::string line; std::getline(stream, line);)
        if (line.starts_with("model name"))
            return line.substr(std::min(line.find(':') + 2, line.size()));
    return "an unknown CPU";
}

/// Three digits.
std::string figure(double value) {
    return fmt::format("{:.{}f}", value, value < 10.0 ? 2 : value < 100.0 ? 1 : 0);
}

std::string secondsText(double seconds) {
    return seconds < 0.1 ? figure(1000.0 * seconds) + " ms" : figure(seconds) + " s";
}

std::string cellText(const benchmark::UserCounters &counters) {
    if (const auto perRay = counters.find("ns/ray"); perRay != counters.end())
        return figure(perRay->second.value) + " ns";
    const auto rate = counters.find("Mray/s");
    std::string text =
        rate != counters.end() ? figure(rate->second.value) : secondsText(counters.at("seconds").value);
    if (const auto all = counters.find("seconds in all"); all != counters.end())
        text += ", " + secondsText(all->second.value);
    const auto rival = std::find_if(counters.begin(), counters.end(),
                                    [](const auto &counter) { return counter.first.starts_with("of "); });
    if (rival != counters.end())
        text += fmt::format(" ({})", figure(rival->second.value));
    return text;
}

/// Google Benchmark 1.8 renamed the flag of a run that SkipWithError ended.
template <class Run> bool hasFailed(const Run &run) {
    if constexpr (requires { run.error_occurred; })
        return run.error_occurred;
    else
        return run.skipped != 0;
}

void addOnce(std::vector<std::string> &names, const std::string &name) {
    if (std::find(names.begin(), names.end(), name) == names.end())
        names.push_back(name);
}

} // namespace

TableReporter::TableReporter() : ConsoleReporter(isatty(STDOUT_FILENO) != 0 ? OO_Color : OO_None) {}

TableReporter::Table &TableReporter::findTable(const std::string &name) {
    const auto found =
        std::find_if(tables_.begin(), tables_.end(), [&](const Table &table) { return table.name == name; });
    if (found != tables_.end())
        return *found;
    tables_.push_back({name, {}, {}, {}, false});
    return tables_.back();
}

void TableReporter::ReportRuns(const std::vector<Run> &runs) {
    ConsoleReporter::ReportRuns(runs);
    for (const Run &run : runs) {
        if (run.run_type != Run::RT_Iteration)
            continue;
        const std::string &name = run.run_name.function_name;
        const std::size_t first = name.find('/');
        const std::size_t second = name.find('/', first + 1);
        const std::string row = name.substr(first + 1, second - first - 1);
        const std::string column = name.substr(second + 1);
        Table &table = findTable(name.substr(0, first));
        addOnce(table.rows, row);
        addOnce(table.columns, column);
        table.cells[{row, column}] = hasFailed(run) ? "failed" : cellText(run.counters);
        table.hasFailures = table.hasFailures || hasFailed(run);
        if (const auto share = run.counters.find("Embree differs"); share != run.counters.end())
            largestEmbreeDifference_ = std::max(largestEmbreeDifference_, share->second.value);
    }
}

std::string TableReporter::markdown(const gpu::DeviceInfo &device) const {
    std::string text = fmt::format("{:%Y-%m-%d}, {}, {} threads; {}, driver {}; Embree {}.\n",
                                   fmt::localtime(std::time(nullptr)), cpuName(), threadCount(), device.name,
                                   device.driver, embreeVersion());
    if (areProcessorSecondsCounted())
        text += "Seconds are the processor's on all threads together, of images those of the whole process; "
                "rates are those of one thread.\n";
    for (const Table &table : tables_) {
        text += format(table);
        if (table.name == "rays" && !table.hasFailures)
            text +=
                fmt::format("\nNo hit differs from the reference's in any bit, and {:.0f} in a million from "
                            "Embree's.\n",
                            1e6 * largestEmbreeDifference_);
    }
    if (hasFailures())
        text += "\nWhat failed says why where it was measured.\n";
    return text;
}

bool TableReporter::hasFailures() const {
    return std::any_of(tables_.begin(), tables_.end(), [](const Table &table) { return table.hasFailures; });
}

std::string TableReporter::format(const Table &table) {
    const auto caption = captions.find(table.name);
    std::string text = fmt::format("\n{}\n\n| |", caption != captions.end() ? caption->second : table.name);
    for (const std::string &column : table.columns)
        text += fmt::format(" {} |", column);
    text += "\n|---|";
    for (std::size_t i = 0; i < table.columns.size(); ++i)
        text += "---|";
    for (const std::string &row : table.rows) {
        text += fmt::format("\n| {} |", row);
        for (const std::string &column : table.columns) {
            const auto cell = table.cells.find({row, column});
            text += fmt::format(" {} |", cell != table.cells.end() ? cell->second : "");
        }
    }
    return text + "\n";
}

} // namespace hyalite::core::bench
