#include "host/report/profile_html.h"

#include "host/report/page.h"
#include "host/report/profile_json.h"
#include "host/report/profile_page.h"

namespace hyalite::core {

std::string profileHtml(const Profile &profile, std::span<const std::byte> png,
                        std::span<const std::byte> heatMapPng, const StagePictures &stagePngs,
                        const BaselineVerdict *comparison) {
    nlohmann::ordered_json report = profileToJson(profile);
    report["picture"] = base64(png);
    if (!heatMapPng.empty())
        report["heatMap"] = base64(heatMapPng);
    for (std::size_t stage = 0; stage < stagePngs.size(); ++stage)
        if (!stagePngs[stage].empty())
            report["stagePictures"][pathStageNames[stage]] = base64(stagePngs[stage]);
    if (comparison != nullptr) {
        report["comparison"] = comparisonToJson(*comparison);
        report["baseline"] = comparison->baseline;
    }
    return filledPage(profile_page::profileHtml, {{R"(id="report">)", scriptJson(report)}});
}

} // namespace hyalite::core
