#include "host/cli/manual.h"

#include "host/base/version.h"
#include "host/cli/option_words.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <vector>

namespace hyalite::core {

namespace {

/// Text for a line of its own: no character of it is a command of roff.
std::string roffText(const std::string &text) {
    std::string escaped = text.starts_with('.') || text.starts_with('\'') ? "\\&" : "";
    for (const char letter : text)
        escaped += letter == '\\' ? "\\e" : letter == '-' ? "\\-" : std::string(1, letter);
    return escaped;
}

std::string entry(const std::string &name, const std::string &explanation) {
    return fmt::format(".TP\n.B {}\n{}\n", roffText(name), roffText(explanation));
}

std::string section(const CLI::App &command) {
    std::string usage = "hyalite " + command.get_name() + " [OPTIONS]";
    std::string entries;
    for (const CLI::Option *positional : positionalsOf(command)) {
        usage += " " + positionalName(*positional);
        entries += entry(positionalName(*positional), positional->get_description());
    }
    for (const CLI::Option *option : shownOptions(command))
        entries += entry(nameWithValue(*option), explanationOf(*option));
    std::string text = fmt::format(".SS \"{}\"\n{}\n.PP\n.B {}\n{}", roffText(command.get_name()),
                                   roffText(command.get_description()), roffText(usage), entries);
    if (!command.get_footer().empty())
        text += fmt::format(".PP\n{}\n", roffText(command.get_footer()));
    return text;
}

/// The words that the value of an option is one of: those of "gamma|srgb".
std::vector<std::string> choicesOf(const CLI::Option &option) {
    const std::string type = option.get_type_name();
    if (type.find('|') == std::string::npos)
        return {};
    return CLI::detail::split(type.substr(0, type.find(',')), '|');
}

std::vector<std::string> longAndShortNames(const CLI::Option &option) {
    std::vector<std::string> names;
    for (const std::string &name : option.get_snames())
        names.push_back("-" + name);
    for (const std::string &name : option.get_lnames())
        names.push_back("--" + name);
    return names;
}

} // namespace

std::string manualPage(const CLI::App &app) {
    std::string page =
        fmt::format(".TH HYALITE 1 \"\" \"hyalite {}\" \"User commands\"\n"
                    ".SH NAME\nhyalite \\- a headless Vulkan ray tracer whose pixels can be checked\n"
                    ".SH SYNOPSIS\n.B hyalite\n.I COMMAND\n[\\fIOPTIONS\\fR] [\\fIARGUMENTS\\fR]\n"
                    ".SH DESCRIPTION\n{}\n.SH COMMANDS\n",
                    HYALITE_VERSION, roffText(app.get_description()));
    for (const CLI::App *command : app.get_subcommands({}))
        page += section(*command);
    return page + fmt::format(".SH EXIT STATUS\n{}\n", roffText(app.get_footer()));
}

std::string bashCompletion(const CLI::App &app) {
    std::vector<std::string> commands;
    std::string values;
    std::string options;
    std::vector<std::string> ofScenes; // commands whose argument is a scene
    for (const CLI::App *command : app.get_subcommands({})) {
        commands.push_back(command->get_name());
        if (std::ranges::any_of(positionalsOf(*command), [](const CLI::Option *positional) {
                return positionalName(*positional).find("SCENE") != std::string::npos;
            }))
            ofScenes.push_back(command->get_name());
        std::vector<std::string> names;
        for (const CLI::Option *option : shownOptions(*command))
            for (const std::string &name : longAndShortNames(*option)) {
                names.push_back(name);
                if (const std::vector<std::string> choices = choicesOf(*option); !choices.empty())
                    values += fmt::format("    '{} {}') words='{}' ;;\n", command->get_name(), name,
                                          fmt::join(choices, " "));
            }
        options += fmt::format("    {}) words='{}' ;;\n", command->get_name(), fmt::join(names, " "));
    }
    return fmt::format(R"(# bash completion for hyalite {}, made from its options
_hyalite() {{
    local words='' files='' current=${{COMP_WORDS[COMP_CWORD]}} command=${{COMP_WORDS[1]}}
    local previous=${{COMP_WORDS[COMP_CWORD - 1]}}
    case "$command $previous" in
{}    *)
        if [ "$COMP_CWORD" -eq 1 ]; then
            words='{} --help --version'
        elif [[ $current == -* ]]; then
            case $command in
{}            esac
        elif [[ $previous != -* ]]; then
            case $command in
            {})
                words=$("${{COMP_WORDS[0]}}" --scene-names 2>/dev/null)
                files=$(compgen -f -- "$current")
                compopt -o filenames 2>/dev/null
                ;;
            esac
        fi
        ;;
    esac
    mapfile -t COMPREPLY < <(compgen -W "$words" -- "$current"; printf '%s' "$files")
}}
complete -o default -F _hyalite hyalite
)",
                       HYALITE_VERSION, values, fmt::join(commands, " "), options,
                       fmt::join(ofScenes, " | "));
}

} // namespace hyalite::core
