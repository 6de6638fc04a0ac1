// How the options of `--help` are shown: with their type, and without the counts and tables of values that CLI11 adds.
#pragma once

#include <CLI/CLI.hpp>

#include <string>

namespace hyalite {

class HelpFormatter : public CLI::Formatter {
  public:
    HelpFormatter() { column_width(34); }

    std::string make_option_opts(const CLI::Option *option) const override {
        if (option->get_type_size() == 0)
            return {};
        // CLI11 appends what validators say after a colon.
        const std::string type = option->get_type_name();
        std::string text = " " + type.substr(0, type.find(':'));
        if (!option->get_default_str().empty())
            text += " (" + option->get_default_str() + ")";
        if (option->get_required())
            text += " (required)";
        return text;
    }
};

} // namespace hyalite
