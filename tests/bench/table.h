// The figures as Markdown, in the form in which tests/bench/README.md holds them.
#pragma once

#include "host/gpu/vk/device_list.h"

#include <benchmark/benchmark.h>

#include <map>
#include <string>
#include <vector>

namespace hyalite::core::bench {

/// Shows benchmarks on the console as they finish, and gathers them into tables. A benchmark is called
/// TABLE/ROW/COLUMN. Its counters make the cell: "ns/ray" alone, or "Mray/s" or else "seconds", "seconds in all", and
/// the first one called "of RIVAL", which is the rival's time divided by this one's.
class TableReporter : public benchmark::ConsoleReporter {
  public:
    TableReporter();

    void ReportRuns(const std::vector<Run> &runs) override;

    /// Machine and date, and all tables.
    [[nodiscard]] std::string markdown(const gpu::DeviceInfo &device) const;
    /// Whether a benchmark was given up, as its results were wrong or something was missing.
    [[nodiscard]] bool hasFailures() const;

  private:
    struct Table {
        std::string name;
        std::vector<std::string> rows;    ///< in the order in which they came
        std::vector<std::string> columns; ///< likewise
        std::map<std::pair<std::string, std::string>, std::string> cells;
        bool hasFailures = false;
    };

    [[nodiscard]] Table &findTable(const std::string &name);
    [[nodiscard]] static std::string format(const Table &table);

    std::vector<Table> tables_;
    double largestEmbreeDifference_ = 0.0;
};

} // namespace hyalite::core::bench
