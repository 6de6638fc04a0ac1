#include "assets/still-life/mesh.h"

#include <cstdio>
#include <memory>

namespace still_life {

namespace {

constexpr double step = 1e-4; // of u and v, for differences

struct Close {
    void operator()(std::FILE *file) const { std::fclose(file); }
};

} // namespace

void addSheet(Part &part, int columns, int rows, const std::function<Vec(double u, double v)> &at) {
    const std::size_t first = part.vertices.size();
    const auto width = static_cast<std::size_t>(columns) + 1;
    for (int row = 0; row <= rows; ++row)
        for (int column = 0; column <= columns; ++column) {
            const double u = static_cast<double>(column) / columns;
            const double v = static_cast<double>(row) / rows;
            const Vec alongU = add(at(u + step, v), scale(at(u - step, v), -1.0));
            const Vec alongV = add(at(u, v + step), scale(at(u, v - step), -1.0));
            part.vertices.push_back({at(u, v), normalise(cross(alongU, alongV)), u, v});
        }
    for (std::size_t row = 0; row < static_cast<std::size_t>(rows); ++row)
        for (std::size_t column = 0; column < static_cast<std::size_t>(columns); ++column) {
            const std::size_t corner = first + row * width + column;
            part.faces.push_back({corner, corner + 1, corner + width + 1, corner + width});
        }
}

void addTurned(Part &part, int columns, int rows, const Vec &offset,
               const std::function<Profile(double v)> &profile) {
    addSheet(part, columns, rows, [&](double u, double v) {
        const Profile at = profile(v);
        const double angle = 2.0 * pi * (u - 0.5);
        return add(offset, {at.radius * std::sin(angle), at.height, at.radius * std::cos(angle)});
    });
}

bool writeObj(const std::filesystem::path &file, const std::string &library, const std::vector<Part> &parts) {
    const std::unique_ptr<std::FILE, Close> stream(std::fopen(file.c_str(), "wb"));
    if (!stream)
        return false;
    std::FILE *const out = stream.get();
    std::fprintf(out, "# Written by make_still_life.\nmtllib %s\n", library.c_str());
    std::size_t before = 0;
    for (const Part &part : parts) {
        std::fprintf(out, "usemtl %s\n", part.material.c_str());
        for (const Vertex &vertex : part.vertices) {
            std::fprintf(out, "v %.5f %.5f %.5f\n", vertex.position[0], vertex.position[1],
                         vertex.position[2]);
            std::fprintf(out, "vn %.4f %.4f %.4f\n", vertex.normal[0], vertex.normal[1], vertex.normal[2]);
            std::fprintf(out, "vt %.5f %.5f\n", vertex.u, vertex.v);
        }
        for (const std::vector<std::size_t> &face : part.faces) {
            std::fputs("f", out);
            for (const std::size_t vertex : face) {
                const std::size_t number = before + vertex + 1;
                std::fprintf(out, " %zu/%zu/%zu", number, number, number);
            }
            std::fputs("\n", out);
        }
        before += part.vertices.size();
    }
    return std::fflush(out) == 0 && std::ferror(out) == 0;
}

} // namespace still_life
