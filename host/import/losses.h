// Losses: what a reader leaves out of a file, as one warning a kind with a count.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace hyalite::core {

class Losses {
  public:
    /// `text()` is asked for the first of a kind alone, so that a million of them cost little. Kinds are few.
    template <class Text> void add(std::string_view kind, const Text &text) {
        const auto row = std::ranges::find(rows_, kind, &Row::kind);
        if (row != rows_.end())
            ++row->count;
        else
            rows_.push_back({std::string(kind), text(), 1});
    }

    /// In the order in which kinds came first: the text, and " (and 3 more)" where it came more often.
    [[nodiscard]] std::vector<std::string> warnings() const {
        std::vector<std::string> all;
        for (const Row &row : rows_)
            all.push_back(row.count == 1 ? row.text
                                         : fmt::format("{} (and {} more)", row.text, row.count - 1));
        return all;
    }

  private:
    struct Row {
        std::string kind;
        std::string text;
        std::size_t count;
    };
    std::vector<Row> rows_;
};

} // namespace hyalite::core
