#include "host/image/flip_opponent.h"

#include <algorithm>
#include <array>
#include <cassert>

namespace hyalite::core {

namespace {

/// destination[x] = the sum over k of kernel[k] * rows[k][x], for whole blocks of columns.
void weighRows(const std::vector<const float *> &rows, const Kernel &kernel, std::size_t stride,
               float *destination) {
    constexpr std::size_t block = OpponentPlanes::blockPixels;
    assert(rows.size() == kernel.size() && stride % block == 0);
    for (std::size_t begin = 0; begin < stride; begin += block) {
        std::array<float, block> sums{};
        for (std::size_t k = 0; k < kernel.size(); ++k) {
            const float weight = kernel[k];
            const float *row = rows[k] + begin;
            for (std::size_t i = 0; i < block; ++i)
                sums[i] += weight * row[i];
        }
        std::copy(sums.begin(), sums.end(), destination + begin);
    }
}

/// Applies separable filters to an image, row by row: first along columns, then along the row. Border pixels repeat
/// beyond the borders.
class RowFilter {
  public:
    explicit RowFilter(const OpponentPlanes &image) : image_(image) {}

    void apply(const std::vector<float> &plane, int y, const Kernel &alongY, const Kernel &alongX,
               std::vector<float> &result) {
        filterColumns(plane, y, alongY);
        filterRow(alongX, result);
    }

    void filterColumns(const std::vector<float> &plane, int y, const Kernel &kernel) {
        const int radius = static_cast<int>(kernel.size() / 2);
        rows_.clear();
        for (int offset = -radius; offset <= radius; ++offset) {
            const int clamped = std::clamp(y + offset, 0, image_.height - 1);
            rows_.push_back(plane.data() + static_cast<std::size_t>(clamped) * image_.stride);
        }
        padding_ = static_cast<std::size_t>(radius);
        // Room for the padding on both sides, and for the last block, which reads past the row.
        padded_.resize(image_.stride + 2 * padding_);
        weighRows(rows_, kernel, image_.stride, padded_.data() + padding_);
        const std::size_t end = padding_ + static_cast<std::size_t>(image_.width);
        std::fill_n(padded_.begin(), padding_, padded_[padding_]);
        std::fill(padded_.begin() + static_cast<std::ptrdiff_t>(end), padded_.end(), padded_[end - 1]);
    }

    /// Filters the result of filterColumns() along the row, with a kernel of the same size.
    void filterRow(const Kernel &kernel, std::vector<float> &result) {
        assert(kernel.size() / 2 == padding_);
        rows_.clear();
        for (std::size_t k = 0; k < kernel.size(); ++k)
            rows_.push_back(padded_.data() + k);
        result.resize(image_.stride);
        weighRows(rows_, kernel, image_.stride, result.data());
    }

  private:
    const OpponentPlanes &image_;
    std::vector<const float *> rows_;
    std::vector<float> padded_;
    std::size_t padding_ = 0;
};

/// A row of an image as the observer sees it: its filtered colours, and its edges and points.
class RowView {
  public:
    RowView(const OpponentPlanes &image, const FlipKernels &kernels)
        : image_(image), kernels_(kernels), filter_(image) {}

    void look(int y) {
        filter_.apply(image_.achromatic, y, kernels_.achromatic, kernels_.achromatic, achromatic_);
        filter_.apply(image_.redGreen, y, kernels_.redGreen, kernels_.redGreen, redGreen_);
        filter_.apply(image_.blueYellow, y, kernels_.blueYellow1, kernels_.blueYellow1, blueYellow1_);
        filter_.apply(image_.blueYellow, y, kernels_.blueYellow2, kernels_.blueYellow2, blueYellow2_);

        filter_.filterColumns(image_.achromatic, y, kernels_.gaussian);
        filter_.filterRow(kernels_.edge, edgeX_);
        filter_.filterRow(kernels_.point, pointX_);
        filter_.apply(image_.achromatic, y, kernels_.edge, kernels_.gaussian, edgeY_);
        filter_.apply(image_.achromatic, y, kernels_.point, kernels_.gaussian, pointY_);
    }

    [[nodiscard]] glm::vec3 huntLab(std::size_t x) const {
        const glm::vec3 rgb =
            linearFromOpponent({achromatic_[x], redGreen_[x], blueYellow1_[x] + blueYellow2_[x]});
        return huntLabFromLinear({clampToUnit(rgb.x), clampToUnit(rgb.y), clampToUnit(rgb.z)});
    }

    [[nodiscard]] float edgeStrength(std::size_t x) const { return lengthOf(edgeX_[x], edgeY_[x]); }
    [[nodiscard]] float pointStrength(std::size_t x) const { return lengthOf(pointX_[x], pointY_[x]); }

  private:
    [[nodiscard]] static float lengthOf(float x, float y) { return std::sqrt(x * x + y * y); }

    const OpponentPlanes &image_;
    const FlipKernels &kernels_;
    RowFilter filter_;
    std::vector<float> achromatic_, redGreen_, blueYellow1_, blueYellow2_;
    std::vector<float> edgeX_, edgeY_, pointX_, pointY_;
};

constexpr float colourExponent = 0.7f;  // q_c
constexpr float featureExponent = 0.5f; // q_f

/// Compresses large colour differences: those above 0.4 of the maximum map to [0.95, 1] (HPG 2020, section 4.1.3).
float redistribute(float poweredDistance, float poweredMax) {
    constexpr float kneeFraction = 0.4f; // p_c
    constexpr float kneeError = 0.95f;   // p_t
    const float knee = kneeFraction * poweredMax;
    return poweredDistance < knee
               ? kneeError / knee * poweredDistance
               : kneeError + (poweredDistance - knee) / (poweredMax - knee) * (1.0f - kneeError);
}

} // namespace

OpponentPlanes::OpponentPlanes(int imageWidth, int imageHeight)
    : width(imageWidth), height(imageHeight),
      stride((static_cast<std::size_t>(imageWidth) + blockPixels - 1) / blockPixels * blockPixels),
      achromatic(stride * static_cast<std::size_t>(imageHeight)), redGreen(achromatic.size()),
      blueYellow(achromatic.size()) {
    assert(width > 0 && height > 0);
}

ErrorMap flipOfOpponents(const OpponentPlanes &reference, const OpponentPlanes &test,
                         const FlipKernels &kernels) {
    assert(reference.width == test.width && reference.height == test.height);
    const glm::vec3 green = huntLabFromLinear({0.0f, 1.0f, 0.0f});
    const glm::vec3 blue = huntLabFromLinear({0.0f, 0.0f, 1.0f});
    const float poweredMax = std::pow(hyabDistance(green, blue), colourExponent);

    ErrorMap map{reference.width, reference.height, {}};
    map.errors.reserve(static_cast<std::size_t>(map.width) * static_cast<std::size_t>(map.height));
    RowView referenceRow(reference, kernels);
    RowView testRow(test, kernels);
    for (int y = 0; y < map.height; ++y) {
        referenceRow.look(y);
        testRow.look(y);
        for (std::size_t x = 0; x < static_cast<std::size_t>(map.width); ++x) {
            const float distance = hyabDistance(referenceRow.huntLab(x), testRow.huntLab(x));
            const float colourError = redistribute(std::pow(distance, colourExponent), poweredMax);
            const float featureDifference =
                std::max(std::abs(referenceRow.edgeStrength(x) - testRow.edgeStrength(x)),
                         std::abs(referenceRow.pointStrength(x) - testRow.pointStrength(x)));
            const float featureError = std::pow(featureDifference / std::sqrt(2.0f), featureExponent);
            // Different features make a colour difference more visible (HPG 2020, equation 15).
            map.errors.push_back(clampToUnit(std::pow(colourError, 1.0f - featureError)));
        }
    }
    return map;
}

} // namespace hyalite::core
