#include "host/view/view_scene.h"

#include <fmt/format.h>

#include <mutex>
#include <system_error>
#include <utility>

namespace hyalite::core {

namespace {

/// Page and program have no more than this, whatever a scene file says.
constexpr std::int64_t maxPixels = std::int64_t{4096} * 4096;

void requireSize(const PreparedScene &scene) {
    const Camera &camera = scene.loaded.scene.camera;
    if (std::int64_t{camera.width} * camera.height > maxPixels)
        throw OverrideError("width", refusalText(fmt::format("{} x {} pixels", camera.width, camera.height),
                                                 fmt::format("at most {} in a viewer", maxPixels)));
}

SceneOptions atShare(SceneOptions options, double share) {
    if (share < 1.0)
        options.sizeShare = options.sizeShare.value_or(1.0) * share;
    return options;
}

} // namespace

ViewScene::ViewScene(SceneOptions options, Observer &observer) : given_(std::move(options)), shown_(given_) {
    PreparedScene scene = prepareScene(given_, Source::Dropped, observer);
    requireSize(scene);
    replaceBy(std::move(scene), given_);
}

SceneOptions ViewScene::optionsWith(const ViewChanges &changes) const {
    SceneOptions options = given_;
    for (const auto &[name, value] : changes) {
        if (namesFile(name))
            throw OverrideError(name, "found a file; allowed: those that the viewer was started with");
        setSceneOption(options, name, value);
    }
    return options;
}

void ViewScene::show(const SceneOptions &options, double share, Observer &observer) {
    const SceneOptions wanted = atShare(options, share);
    if (!isOtherView(*prepared_, shown_, wanted)) {
        PreparedScene scene = prepareScene(wanted, Source::Dropped, observer);
        requireSize(scene);
        replaceBy(std::move(scene), options);
        return;
    }
    beforeChange();
    const std::unique_lock lock(mutex_);
    changeView(*prepared_, wanted);
    requireSize(*prepared_);
    shown_ = options;
}

void ViewScene::reload(Observer &observer) {
    PreparedScene scene = prepareScene(shown_, Source::Dropped, observer);
    requireSize(scene);
    replaceBy(std::move(scene), shown_);
}

void ViewScene::replaceBy(PreparedScene &&scene, const SceneOptions &options) {
    beforeChange();
    {
        const std::unique_lock lock(mutex_);
        prepared_.emplace(std::move(scene));
        shown_ = options;
    }
    files_ = prepared_->loaded.inputFiles;
    stamps_ = stampsNow();
    changing_.reset();
}

ViewScene::Stamps ViewScene::stampsNow() const {
    Stamps stamps;
    for (const std::string &file : files_) {
        std::error_code error; // a file that is missing has no time and no size
        auto &[time, size] = stamps[file];
        time = std::filesystem::last_write_time(file, error);
        size = std::filesystem::file_size(file, error);
    }
    return stamps;
}

bool ViewScene::haveFilesChanged() {
    Stamps now = stampsNow();
    if (now == stamps_) {
        changing_.reset();
        return false;
    }
    if (changing_ != now) {
        changing_ = std::move(now);
        return false;
    }
    stamps_ = std::move(now);
    changing_.reset();
    return true;
}

} // namespace hyalite::core
