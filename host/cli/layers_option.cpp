#include "host/cli/layers_option.h"

#include "host/cli/options.h"
#include "host/scene/names.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>

namespace hyalite {

void addLayersOption(CLI::App &command, std::vector<Integrator> &views) {
    std::array<std::string_view, layerViews.size()> words;
    std::transform(layerViews.begin(), layerViews.end(), words.begin(),
                   [](Integrator view) { return nameOf(view); });
    const auto read = [&views, words](const CLI::results_t &typed) {
        for (const std::string &word : typed) {
            const auto found = std::find(words.begin(), words.end(), word);
            if (found == words.end())
                refuseValue("--layers", word, quotedList(words) + suggestion(word, words));
            const Integrator view = layerViews[static_cast<std::size_t>(found - words.begin())];
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

} // namespace hyalite
