#include "host/render/render_session.h"

namespace hyalite {

void RenderSession::prepare(const RenderRequest &request) {
    const auto beginOpening = [&](const SceneOutline &outline) {
        opening_ = beginOpeningRenderers(request.devices, processorsFor(request.threadCount, outline),
                                         renderConfigFor(request.deviceOptions));
    };
    scene_ = prepareScene(request.scene, Source::Dropped, request.isQuiet, beginOpening);
}

void RenderSession::replaceScene(const SceneOptions &options, bool isQuiet) {
    scene_.reset(); // the memory first
    scene_ = prepareScene(options, Source::Dropped, isQuiet);
}

void RenderSession::open() {
    if (opening_.valid())
        opened_ = opening_.get();
}

} // namespace hyalite
