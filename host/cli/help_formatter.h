// Help pages: paragraphs separated by blank lines, at most 100 columns wide.
#pragma once

#include <CLI/CLI.hpp>

#include <string>

namespace hyalite::core {

/// Without the counts, types and tables of values that CLI11 shows.
class HelpFormatter : public CLI::FormatterBase {
  public:
    [[nodiscard]] std::string make_help(const CLI::App *app, std::string name,
                                        CLI::AppFormatMode mode) const override;
};

} // namespace hyalite::core
