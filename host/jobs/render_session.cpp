#include "host/jobs/render_session.h"

#include "host/engine/shared_backend.h"
#include "host/report/render_report.h"

#include <utility>

namespace hyalite::core {

ImageFormat formatOf(const RenderRequest &request) {
    if (request.part)
        return ImageFormat::Exr;
    return request.isInClip ? ImageFormat::Png : imageFormatOf(request.output);
}

void RenderSession::prepare(const RenderRequest &request, Source source) {
    const auto beginOpening = [&](const SceneOutline &outline) {
        opening_ =
            beginOpeningRenderers(request.devices, observer_, processorsFor(request.threadCount, outline),
                                  renderConfigFor(request.deviceOptions));
    };
    scene_ = prepareScene(request.scene, source, observer_, beginOpening);
}

void RenderSession::replaceScene(const SceneOptions &options) {
    scene_.reset(); // the memory first
    scene_ = prepareScene(options, Source::Dropped, nobody());
}

void RenderSession::open() {
    isFirstPicture_ = opening_.valid();
    if (!isFirstPicture_)
        return;
    opened_ = opening_.get();
    if (pool_ == nullptr)
        return;
    std::vector<std::unique_ptr<Backend>> members = pool_->backends(*scene_, *opened_.backend, opened_.notes);
    if (members.empty())
        return;
    members.insert(members.begin(), std::move(opened_.backend));
    opened_.backend = shareBackends(std::move(members));
}

std::vector<Attribute> attributesOfSeveral(const RenderSession &session, const std::string &commandLine) {
    const PreparedScene &scene = session.scene();
    nlohmann::ordered_json origin =
        provenanceToJson(provenanceOf(scene, commandLine),
                         session.backend().identity(scene.packed, scene.loaded.settings.integrator));
    origin.erase("sceneHash");
    return attributesOf(origin);
}

} // namespace hyalite::core
