// The pages of `--help`: paragraphs with a blank line between them, in lines of at most 100 columns.
#pragma once

#include <CLI/CLI.hpp>

#include <string>

namespace hyalite {

/// Without the counts, types and tables of values that CLI11 shows.
class HelpFormatter : public CLI::FormatterBase {
  public:
    [[nodiscard]] std::string make_help(const CLI::App *app, std::string name,
                                        CLI::AppFormatMode mode) const override;
};

} // namespace hyalite
