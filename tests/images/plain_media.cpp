#include "tests/images/plain_media.h"

#include <glm/exponential.hpp>
#include <glm/geometric.hpp>

namespace hyalite::core::testing::plain {

Media::Media(const Scene &scene) : scene_(&scene), counts_(scene.materials.size(), 0) {
    for (const Sphere &sphere : scene.spheres)
        if (holdsMedium(scene.materials[sphere.materialIndex]) &&
            glm::distance(scene.camera.position, sphere.centre) < sphere.radius)
            counts_[sphere.materialIndex] += sphere.inwardNormal ? -1 : 1;
}

const Material *Media::around() const {
    const Material *found = nullptr;
    for (std::size_t i = 0; i < counts_.size(); ++i)
        if (counts_[i] > 0 && (found == nullptr || scene_->materials[i].priority > found->priority))
            found = &scene_->materials[i];
    return found;
}

double Media::index() const {
    const Material *const glass = around();
    if (glass == nullptr)
        return 1.0;
    const double index = glass->refractiveIndex;
    if (!wavelength_ || glass->dispersion == 0.0f)
        return index;
    // Cauchy's equation, from the indices of three lines that make Abbe's number.
    const auto squaredNumber = [](double wavelength) { return 1.0 / (wavelength * wavelength); };
    const double abbe = 20.0 / glass->dispersion;
    const double slope = (index - 1.0) / abbe / (squaredNumber(0.48613) - squaredNumber(0.65627));
    return index + slope * (squaredNumber(*wavelength_) - squaredNumber(0.58756));
}

Vec Media::transmittance(double distance) const {
    const Material *const glass = around();
    if (glass == nullptr || glass->absorption == glm::vec3(0.0f))
        return Vec(1.0);
    return glm::exp(-distance * Vec(glass->absorption));
}

Crossing crossing(const Media &around, std::uint32_t materialIndex, bool isEntering) {
    Crossing result{around, around};
    if (isEntering)
        result.beyond.enter(materialIndex);
    else if (around.isIn(materialIndex))
        result.beyond.leave(materialIndex);
    return result;
}

} // namespace hyalite::core::testing::plain
