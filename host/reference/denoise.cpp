#include "host/reference/denoise.h"

namespace hyalite::core::reference {

Image denoise(const NoisyPicture &picture, int) {
    Image image(picture.width, picture.height);
    for (std::size_t i = 0; i < picture.pixels.size(); ++i)
        image.pixels()[i] = picture.pixels[i].colour;
    return image;
}

} // namespace hyalite::core::reference
