#include "host/cli/option_words.h"

#include <algorithm>
#include <cctype>

namespace hyalite::core {

std::string positionalName(const CLI::Option &option) {
    std::string name = option.get_name(true);
    std::transform(name.begin(), name.end(), name.begin(),
                   [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    return name;
}

std::string nameWithValue(const CLI::Option &option) {
    const bool takesValue = option.get_items_expected_max() > 0;
    return option.get_name(false, true) + (takesValue ? " " + option.get_type_name() : std::string());
}

std::string explanationOf(const CLI::Option &option) {
    std::string explanation = option.get_description();
    if (option.get_required())
        explanation += " (required)";
    if (!option.get_default_str().empty())
        explanation += " (default: " + option.get_default_str() + ")";
    return explanation;
}

std::vector<const CLI::Option *> shownOptions(const CLI::App &app) {
    return app.get_options(
        [](const CLI::Option *option) { return option->nonpositional() && !option->get_group().empty(); });
}

std::vector<const CLI::Option *> positionalsOf(const CLI::App &app) {
    return app.get_options([](const CLI::Option *option) { return option->get_positional(); });
}

} // namespace hyalite::core
