// make_studio --output FILE: writes the light of a photographer's studio as an environment image, a PFM of 512x256 pixels by
// longitude and latitude: its middle is -z, its top +y. Runs while Hyalite is built.
//
// Three soft boxes hang in a dim room: a large key light at the upper left, a cool strip at the right, and a warm one behind.
#include <array>
#include <bit>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <numbers>
#include <string>
#include <vector>

namespace {

static_assert(std::endian::native == std::endian::little, "the PFM says so");

constexpr int width = 512;
constexpr int height = 256;
constexpr int samplesAcross = 4; // of a pixel, each way: edges of lights are smooth
constexpr int exitUsage = 2;
constexpr int exitOutput = 7;

using Vec = std::array<double, 3>;

double dot(const Vec &a, const Vec &b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Vec cross(const Vec &a, const Vec &b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Vec normalise(const Vec &v) {
    const double length = std::sqrt(dot(v, v));
    return {v[0] / length, v[1] / length, v[2] / length};
}

/// From 0 to 1 between the edges.
double smoothStep(double from, double to, double x) {
    const double t = std::fmin(std::fmax((x - from) / (to - from), 0.0), 1.0);
    return t * t * (3.0 - 2.0 * t);
}

/// A rectangle that faces the middle of the room from a unit's distance.
class SoftBox {
  public:
    SoftBox(const Vec &towards, double halfWidth, double halfHeight, const Vec &radiance)
        : forward_(normalise(towards)), right_(normalise(cross({0.0, 1.0, 0.0}, forward_))),
          up_(cross(forward_, right_)), halfWidth_(halfWidth), halfHeight_(halfHeight), radiance_(radiance) {}

    void addTo(Vec &sum, const Vec &direction) const {
        const double along = dot(direction, forward_);
        if (along <= 0.0)
            return;
        const double x = std::abs(dot(direction, right_)) / (along * halfWidth_);
        const double y = std::abs(dot(direction, up_)) / (along * halfHeight_);
        // A little brighter in the middle, as cloth before a lamp is.
        const double cover = (1.0 - smoothStep(0.96, 1.0, x)) * (1.0 - smoothStep(0.96, 1.0, y));
        const double brightness = cover * (1.0 - 0.35 * std::fmin(x * x + y * y, 1.0));
        for (std::size_t channel = 0; channel < 3; ++channel)
            sum[channel] += brightness * radiance_[channel];
    }

  private:
    Vec forward_;
    Vec right_;
    Vec up_;
    double halfWidth_;
    double halfHeight_;
    Vec radiance_;
};

Vec radianceFrom(const Vec &direction) {
    static const std::array<SoftBox, 3> boxes{SoftBox({-0.9, 1.0, 0.65}, 0.55, 0.4, {13.0, 12.4, 11.4}),
                                              SoftBox({1.0, 0.35, 0.25}, 0.16, 0.7, {5.0, 6.2, 8.0}),
                                              SoftBox({0.35, 0.8, -1.0}, 0.5, 0.12, {9.0, 6.6, 4.2})};
    const double upward = smoothStep(-0.3, 0.9, direction[1]);
    Vec sum{0.05 + 0.11 * upward, 0.05 + 0.12 * upward, 0.055 + 0.14 * upward};
    for (const SoftBox &box : boxes)
        box.addTo(sum, direction);
    return sum;
}

Vec directionAt(double x, double y) {
    const double longitude = (2.0 * x - 1.0) * std::numbers::pi; // 0 is -z, a quarter to the right +x
    const double latitude = (0.5 - y) * std::numbers::pi;
    return {std::cos(latitude) * std::sin(longitude), std::sin(latitude),
            -std::cos(latitude) * std::cos(longitude)};
}

Vec pixelAt(int column, int row) {
    Vec sum{};
    for (int j = 0; j < samplesAcross; ++j) {
        for (int i = 0; i < samplesAcross; ++i) {
            const Vec radiance = radianceFrom(directionAt((column + (i + 0.5) / samplesAcross) / width,
                                                          (row + (j + 0.5) / samplesAcross) / height));
            for (std::size_t channel = 0; channel < 3; ++channel)
                sum[channel] += radiance[channel] / (samplesAcross * samplesAcross);
        }
    }
    return sum;
}

/// From the last row to the first, as the format wants it.
std::vector<float> drawStudio() {
    std::vector<float> values;
    for (int row = height - 1; row >= 0; --row)
        for (int column = 0; column < width; ++column)
            for (const double value :
                 pixelAt(column, row)) // in steps that no rounding of sines and cosines reaches
                values.push_back(static_cast<float>(std::round(value * 4096.0) / 4096.0));
    return values;
}

} // namespace

int main(int argumentCount, char **arguments) {
    if (argumentCount != 3 || std::strcmp(arguments[1], "--output") != 0) {
        std::fputs("usage: make_studio --output FILE\n", stderr);
        return exitUsage;
    }
    const std::vector<float> values = drawStudio();
    std::FILE *file = std::fopen(arguments[2], "wb");
    const bool isWritten = file != nullptr && std::fprintf(file, "PF\n%d %d\n-1.0\n", width, height) > 0 &&
                           std::fwrite(values.data(), sizeof(float), values.size(), file) == values.size();
    if (file == nullptr || std::fclose(file) != 0 || !isWritten) {
        std::fprintf(stderr, "make_studio: %s could not be written\n", arguments[2]);
        return exitOutput;
    }
    return 0;
}
