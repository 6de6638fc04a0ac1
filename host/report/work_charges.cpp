#include "host/report/work_charges.h"

#include "host/base/quantities.h"
#include "host/report/figure_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <span>

namespace hyalite::core {

namespace {

constexpr std::array<const char *, lobeNames.size()> lobeWords{
    "diffuse",    "diffuse transmission", "glossy",  "sheen",
    "thin glass", "rough glass",          "mirrors", "clear glass"};

std::vector<WorkCharge> chargesOf(const std::vector<WorkByStage> &account,
                                  const std::vector<std::string> &names) {
    std::vector<WorkCharge> charges;
    for (std::size_t number = 0; number < account.size(); ++number)
        if (sumOf(account[number]).rays > 0)
            charges.push_back({number == 0 ? "" : names.at(number - 1), account[number]});
    std::ranges::stable_sort(charges, [](const WorkCharge &a, const WorkCharge &b) {
        const ChargedWork ofA = sumOf(a.work);
        const ChargedWork ofB = sumOf(b.work);
        return ofA.tests() != ofB.tests() ? ofA.tests() > ofB.tests() : ofA.rays > ofB.rays;
    });
    return charges;
}

nlohmann::ordered_json workToJson(const WorkByStage &work) {
    nlohmann::ordered_json json;
    for (std::size_t stage = 0; stage < work.size(); ++stage)
        json[pathStageNames[stage]] = {{"rays", work[stage].rays},
                                       {"boxesTested", work[stage].boxes},
                                       {"trianglesTested", work[stage].triangles}};
    return json;
}

nlohmann::ordered_json shadingToJson(const ShadingCounts &shading) {
    nlohmann::ordered_json lobes;
    for (std::size_t lobe = 0; lobe < lobeNames.size(); ++lobe)
        lobes[lobeNames[lobe]] = shading.lobes[lobe];
    return {{"lobes", lobes},
            {"lightSamples", shading.lightSamples},
            {"lightNodesRead", shading.lightNodesRead},
            {"textureReads", shading.textureReads},
            {"filmSamples", shading.filmSamples}};
}

nlohmann::ordered_json rowsToJson(std::span<const WorkCharge> charges, std::size_t maxRows) {
    const std::size_t rowCount = std::min(charges.size(), maxRows);
    nlohmann::ordered_json json{{"rows", nlohmann::ordered_json::array()}};
    for (const WorkCharge &charge : charges.first(rowCount)) {
        nlohmann::ordered_json row;
        if (!charge.name.empty())
            row["name"] = charge.name;
        row["work"] = workToJson(charge.work);
        json["rows"].push_back(std::move(row));
    }
    if (rowCount == charges.size())
        return json;
    WorkByStage others{};
    for (const WorkCharge &charge : charges.subspan(rowCount))
        for (std::size_t stage = 0; stage < others.size(); ++stage)
            others[stage] += charge.work[stage];
    json["otherCount"] = charges.size() - rowCount;
    json["others"] = workToJson(others);
    return json;
}

} // namespace

WorkCharges chargesOf(const WorkLedger &ledger, std::uint32_t samplesPerPixel,
                      const std::vector<std::string> &objects, const std::vector<std::string> &materials) {
    return {samplesPerPixel, ledger.totals(), ledger.shading, chargesOf(ledger.objects, objects),
            chargesOf(ledger.materials, materials)};
}

std::string dearestText(const WorkCharges &charges) {
    const bool isTested = sumOf(charges.totals).tests() > 0;
    const auto valueOf = [&](const WorkByStage &work) {
        const ChargedWork sum = sumOf(work);
        return static_cast<double>(isTested ? sum.tests() : sum.rays);
    };
    std::string text;
    std::size_t count = 0;
    for (const WorkCharge &object : charges.objects)
        if (!object.name.empty() && count++ < 3)
            text += fmt::format("{}{} {}", text.empty() ? "" : ", ", object.name,
                                shareText(valueOf(object.work) / std::max(valueOf(charges.totals), 1.0)));
    return text.empty() ? "no object is met"
                        : fmt::format("{} of the {}", text, isTested ? "box and triangle tests" : "rays");
}

std::string shadingText(const ShadingCounts &shading) {
    const std::uint64_t shaded =
        std::accumulate(shading.lobes.begin(), shading.lobes.end(), std::uint64_t{0});
    std::string text;
    for (std::size_t lobe = 0; lobe < lobeNames.size(); ++lobe)
        if (shading.lobes[lobe] > 0)
            text += fmt::format(
                "{}{} {}", text.empty() ? ": " : ", ", lobeWords[lobe],
                shareText(static_cast<double>(shading.lobes[lobe]) / static_cast<double>(shaded)));
    text = roundedText(shaded, "surfaces") + text + "; " + roundedText(shading.lightSamples, "light samples");
    if (shading.lightNodesRead > 0)
        text += ", " + roundedText(shading.lightNodesRead, "nodes of the light tree");
    if (shading.textureReads > 0)
        text += ", " + roundedText(shading.textureReads, "texture reads");
    return text;
}

nlohmann::ordered_json chargesToJson(const WorkCharges &charges, std::size_t maxRows) {
    return {{"samplesPerPixel", charges.samplesPerPixel},
            {"stages", workToJson(charges.totals)},
            {"shading", shadingToJson(charges.shading)},
            {"objects", rowsToJson(charges.objects, maxRows)},
            {"materials", rowsToJson(charges.materials, maxRows)}};
}

} // namespace hyalite::core
