#include "host/cli/layers_option.h"

#include "host/cli/options.h"
#include "host/scene/names.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string_view>

namespace hyalite::core {

void addLayersOption(CLI::App &command, std::vector<Integrator> &views) {
    std::vector<std::string_view> words;
    for (const IntegratorRow &row : integratorTable)
        if (!row.layerChannels.empty())
            words.push_back(row.name);
    const auto read = [&views, words](const CLI::results_t &typed) {
        for (const std::string &word : typed) {
            if (std::ranges::find(words, word) == words.end())
                refuseValue("--layers", word, quotedList(words) + suggestion(word, words));
            const Integrator view =
                std::ranges::find(integratorTable, word, &IntegratorRow::name)->integrator;
            if (std::find(views.begin(), views.end(), view) == views.end())
                views.push_back(view);
        }
        return true;
    };
    command
        .add_option("--layers", CLI::callback_t(read),
                    "layers of an .exr, beside its colours: views of primary hits")
        ->delimiter(',')
        ->expected(1, -1)
        ->type_name(fmt::format("{},...", fmt::join(words, "|")));
}

} // namespace hyalite::core
