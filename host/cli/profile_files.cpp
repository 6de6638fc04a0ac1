#include "host/cli/profile_files.h"

#include "host/base/json_text.h"
#include "host/image/png.h"
#include "host/report/profile_csv.h"
#include "host/report/profile_html.h"
#include "host/report/profile_json.h"
#include "host/report/trace_json.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace hyalite::core {

namespace {

std::vector<Attribute> originOf(const Profile &profile) {
    std::vector<Attribute> attributes = attributesOf(provenanceToJson(profile.origin, profile.device));
    if (!profile.leftOut.empty())
        attributes.emplace_back("leftOut", fmt::format("{}", fmt::join(profile.leftOut, "; ")));
    return attributes;
}

std::vector<std::byte> pngOf(const Drawing &drawing, const Profile &profile) {
    return encodePng(drawing.width, drawing.height, drawing.rgb, originOf(profile));
}

} // namespace

std::vector<NamedFile> namedFiles(const ProfilePaths &paths) {
    return {{"--output", paths.output}, {"--report", paths.report}, {"--csv", paths.csv},
            {"--trace", paths.trace},   {"--html", paths.html},     {"--heatmap", paths.heatMap}};
}

ProfileFiles::ProfileFiles(const ProfilePaths &paths) : paths_(paths) {
    if (!paths.heatMap.empty() && imageFormatOf(paths.heatMap) != ImageFormat::Png)
        throw Error(ErrorKind::Usage,
                    fmt::format("--heatmap {}: the heat map must be a .png file", paths.heatMap));
    if (!paths.output.empty())
        format_ = imageFormatOf(paths.output);
    open(image_, paths.output);
    open(report_, paths.report);
    open(csv_, paths.csv);
    open(trace_, paths.trace);
    open(html_, paths.html);
    open(heatMap_, paths.heatMap);
}

void ProfileFiles::open(std::optional<AtomicFile> &file, const std::string &path) {
    if (!path.empty())
        file.emplace(path);
}

void ProfileFiles::store(std::optional<AtomicFile> &file, const std::string &text) {
    if (!file)
        return;
    file->write(text);
    file->commit();
}

void ProfileFiles::requireSizes(int width, int height) const {
    if (image_ && format_ == ImageFormat::Png)
        requirePngSize(paths_.output, width, height);
    if (html_)
        requirePngSize(paths_.html, width, height);
}

bool ProfileFiles::wantsHeatMap(const PreparedScene &scene) const {
    return heatMap_ || (html_ && scene.packed.hasTriangles);
}

void ProfileFiles::writeImage(Measurement &measurement) {
    if (!image_)
        return;
    Profile &profile = measurement.profile;
    Stopwatch watch;
    const Image image = measurement.film.toImage();
    Picture picture(image);
    picture.attributes = originOf(profile);
    writeFilm(*image_, format_, measurement.film, picture, profile.origin.settings);
    image_->commit();
    profile.hostStages.push_back({"write", watch.lap()});
}

void ProfileFiles::writeFigures(const Measurement &measurement, const BaselineVerdict *comparison) {
    const Profile &profile = measurement.profile;
    std::vector<std::byte> heatMap;
    if (measurement.heatMap)
        heatMap = pngOf(*measurement.heatMap, profile);
    store(report_, jsonText(profileToJson(profile)));
    store(csv_, profileCsv(profile));
    store(trace_, jsonText(profileToTrace(profile)));
    StagePictures stages;
    for (std::size_t stage = 0; html_ && stage < measurement.stagePictures.size(); ++stage)
        stages[stage] = pngOf(measurement.stagePictures[stage], profile);
    if (html_)
        store(html_, profileHtml(profile, pngOf(drawFilm(measurement.film, profile.origin.settings), profile),
                                 heatMap, stages, comparison));
    if (heatMap_) {
        heatMap_->write(heatMap);
        heatMap_->commit();
    }
}

} // namespace hyalite::core
