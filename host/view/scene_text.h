// The text of a scene file with another camera.
#pragma once

#include "host/engine/prepare.h"

#include <string>

namespace hyalite::core {

/// A scene file that shows what `scene` shows, by its present camera, to lie beside its file: that file with another camera,
/// or one around it, if it is a model. Throws Error{BadInput} where the file cannot be read again.
[[nodiscard]] std::string sceneWithCamera(const PreparedScene &scene);

} // namespace hyalite::core
