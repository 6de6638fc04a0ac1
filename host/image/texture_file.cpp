#include "host/image/texture_file.h"

#include "host/base/content_guess.h"
#include "host/image/hdr.h"
#include "host/image/jpeg.h"
#include "host/image/png.h"
#include "host/image/webp.h"

#include <utility>
#include <vector>

namespace hyalite::core {

namespace {

constexpr std::size_t headBytes = 12;

Texture readHdrTexture(const InputFile &file) {
    Image image = readHdr(file);
    Texture texture;
    texture.name = file.path().string();
    texture.width = image.width();
    texture.height = image.height();
    texture.values = std::move(image.pixels());
    return texture;
}

} // namespace

bool isTextureFile(const std::filesystem::path &path) {
    const std::vector<std::byte> head = InputFile(path).head(headBytes);
    return isPng(head) || isJpeg(head) || isWebp(head) || isHdr(head);
}

Texture readTexture(const std::filesystem::path &path) { return readTexture(InputFile(path)); }

Texture readTexture(const InputFile &file) {
    const std::vector<std::byte> head = file.head(headBytes);
    if (isPng(head))
        return readPngTexture(file);
    if (isJpeg(head))
        return readJpeg(file);
    if (isWebp(head))
        return readWebp(file);
    if (isHdr(head))
        return readHdrTexture(file);
    throw file.bad(foreignContent(
        file, "it is no PNG, JPEG, WebP or Radiance (HDR) file, which textures are read from"));
}

} // namespace hyalite::core
