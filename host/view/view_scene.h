// The scene of a viewer: prepared, moved to other views, and loaded again when its files change.
#pragma once

#include "host/engine/observer.h"
#include "host/engine/prepare.h"
#include "host/engine/scene_options.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <shared_mutex>
#include <string>
#include <vector>

namespace hyalite::core {

/// Changes of the options that the scene was opened with, by the names of settings and options; the last of each counts.
using ViewChanges = std::map<std::string, OptionValue, std::less<>>;

/// Renderers read it while they hold `mutex()` shared; one thread changes it.
class ViewScene {
  public:
    /// Throws as prepareScene().
    ViewScene(SceneOptions options, Observer &observer);

    [[nodiscard]] std::shared_mutex &mutex() { return mutex_; }
    /// Called before the mutex is taken for a change: the time to tell renderers that they should end.
    std::function<void()> beforeChange = [] {};
    /// Under the mutex, or by the thread that changes it.
    [[nodiscard]] const PreparedScene &prepared() const { return *prepared_; }

    /// The options with these changes. Throws OverrideError, also for an option that names a file: what a page asks for
    /// does not reach the file system.
    [[nodiscard]] SceneOptions optionsWith(const ViewChanges &changes) const;

    /// Gives the scene the view of these options, at `share` of its size, in (0, 1]. It is loaded again only if it must
    /// be. Throws as prepareScene(), and then leaves the scene that was there, which has to be shown anew.
    void show(const SceneOptions &options, double share, Observer &observer);

    /// Loads it again, with the options shown last. Throws as prepareScene(), and then leaves the scene that was there.
    void reload(Observer &observer);

    /// Whether a file of the scene has changed since it was loaded, or since this was asked, and is no longer being
    /// written.
    [[nodiscard]] bool haveFilesChanged();

  private:
    using Stamps = std::map<std::string, std::pair<std::filesystem::file_time_type, std::uintmax_t>>;

    void replaceBy(PreparedScene &&scene, const SceneOptions &options);
    [[nodiscard]] Stamps stampsNow() const;

    std::shared_mutex mutex_;
    SceneOptions given_;
    SceneOptions shown_; ///< what `prepared_` has, but for its size
    std::optional<PreparedScene> prepared_;
    std::vector<std::string> files_;
    Stamps stamps_;
    std::optional<Stamps> changing_; ///< seen once
};

} // namespace hyalite::core
