#include "host/cli/help_formatter.h"

#include "host/cli/option_words.h"

#include <sstream>
#include <string_view>
#include <vector>

namespace hyalite::core {

namespace {

constexpr std::size_t pageWidth = 100;
constexpr std::size_t textColumn = 32; ///< column of the explanations, right of the names

/// Appends the words of `text` to the last line of `page`, and wraps to new lines indented by `indent`.
void appendWrapped(std::string &page, const std::string &text, std::size_t indent) {
    std::istringstream words(text);
    for (std::string word; words >> word;) {
        const std::size_t lineStart = page.rfind('\n') + 1; // npos + 1 is 0
        const std::size_t column = page.size() - lineStart;
        if (column > indent && column + 1 + word.size() > pageWidth)
            page += "\n" + std::string(indent, ' ');
        else if (column > indent)
            page += ' ';
        page += word;
    }
    page += '\n';
}

std::string paragraph(const std::string &text) {
    std::string page;
    if (!text.empty())
        appendWrapped(page, text, 0);
    return page;
}

/// The text, on several lines where it is too long, each but the last with a bar at its end.
std::string brokenAtBars(std::string text) {
    for (std::size_t lineStart = 0; text.size() - lineStart > pageWidth;) {
        const std::size_t bar = text.rfind('|', lineStart + pageWidth - 1);
        if (bar == std::string::npos || bar <= lineStart)
            break;
        text.insert(bar + 1, "\n    ");
        lineStart = bar + 2;
    }
    return text;
}

/// A name and its explanation beside it, or below it where the name is long.
std::string row(const std::string &name, const std::string &explanation) {
    std::string page = brokenAtBars("  " + name);
    if (page.size() + 2 > textColumn)
        page += '\n';
    page.resize(page.rfind('\n') == std::string::npos ? textColumn : page.size() + textColumn, ' ');
    appendWrapped(page, explanation, textColumn);
    return page;
}

std::string optionRow(const CLI::Option &option) { return row(nameWithValue(option), explanationOf(option)); }

std::string usage(const CLI::App &app, const std::string &name,
                  const std::vector<const CLI::Option *> &positionals, bool hasCommands) {
    std::string line = "Usage: " + name;
    if (!app.get_options([](const CLI::Option *option) { return option->nonpositional(); }).empty())
        line += " [OPTIONS]";
    for (const CLI::Option *positional : positionals)
        line += " " + positionalName(*positional);
    return line + (hasCommands ? " COMMAND\n" : "\n");
}

} // namespace

std::string HelpFormatter::make_help(const CLI::App *app, std::string name, CLI::AppFormatMode) const {
    const std::vector<const CLI::Option *> positionals = positionalsOf(*app);
    const std::vector<const CLI::App *> commands = app->get_subcommands({});
    std::vector<std::string> paragraphs{paragraph(app->get_description()),
                                        usage(*app, name, positionals, !commands.empty())};
    const auto addGroup = [&](const std::string &title, const auto &members, const auto &rowOf) {
        std::string group = members.empty() ? "" : title + ":\n";
        for (const auto *member : members)
            group += rowOf(*member);
        paragraphs.push_back(group);
    };
    addGroup("Arguments", positionals,
             [](const CLI::Option &option) { return row(positionalName(option), option.get_description()); });
    for (const std::string &title : app->get_groups())
        if (!title.empty()) // options without a group are hidden
            addGroup(title, app->get_options([&](const CLI::Option *option) {
                return option->get_group() == title && option->nonpositional();
            }),
                     optionRow);
    addGroup("Commands", commands,
             [](const CLI::App &command) { return row(command.get_name(), command.get_description()); });
    paragraphs.push_back(paragraph(app->get_footer()));

    std::string page;
    for (const std::string &text : paragraphs)
        page += (page.empty() || text.empty() ? "" : "\n") + text;
    return page;
}

} // namespace hyalite::core
