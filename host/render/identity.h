// What decides the pixels of a render, in short: to tell whether two renders may share samples.
#pragma once

#include "host/film/checkpoint.h"
#include "host/render/backend.h"

namespace hyalite {

/// Of the crop, too, but neither of the tree nor of the samples per pixel: a film may get more of them.
[[nodiscard]] RenderIdentity identityOf(const PreparedScene &scene, const Backend &backend);

} // namespace hyalite
