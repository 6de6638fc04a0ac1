#include "host/import/gltf/animation.h"

#include "host/import/gltf/accessor.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>

namespace hyalite::core::gltf {
namespace {

enum class Interpolation { Linear, Step, CubicSpline };
enum class Path { Translation, Rotation, Scale, Weights };

constexpr auto interpolations =
    std::to_array<std::pair<std::string_view, Interpolation>>({{"LINEAR", Interpolation::Linear},
                                                               {"STEP", Interpolation::Step},
                                                               {"CUBICSPLINE", Interpolation::CubicSpline}});
constexpr auto paths = std::to_array<std::pair<std::string_view, Path>>({{"translation", Path::Translation},
                                                                         {"rotation", Path::Rotation},
                                                                         {"scale", Path::Scale},
                                                                         {"weights", Path::Weights}});

/// A sampler of an animation.
class Curve {
  public:
    Curve(Buffers &buffers, const JsonObject &sampler)
        : times_(buffers, buffers.document().reference(sampler.at("input"), "accessors")),
          values_(buffers, buffers.document().reference(sampler.at("output"), "accessors")),
          interpolation_(sampler.choice("interpolation", interpolations, Interpolation::Linear)) {
        times_.requireType("SCALAR");
    }

    /// The numbers at that time, `count` of them.
    [[nodiscard]] std::vector<double> at(double seconds, std::size_t count, bool isRotation) const {
        const std::size_t perKey = interpolation_ == Interpolation::CubicSpline ? 3 : 1;
        if (values_.count() * values_.componentCount() != times_.count() * perKey * count)
            JsonObject(values_.node())
                .at("count")
                .refuse(fmt::format("{} numbers for each of {} keys", perKey * count, times_.count()));
        const std::size_t next = keyBehind(seconds);
        if (next == 0)
            return value(0, count);
        if (next == times_.count() || interpolation_ == Interpolation::Step)
            return value(next - 1, count);
        const double begin = static_cast<double>(times_.number(next - 1, 0));
        const double length = static_cast<double>(times_.number(next, 0)) - begin;
        const double share = length > 0.0 ? (seconds - begin) / length : 0.0;
        if (interpolation_ == Interpolation::CubicSpline)
            return spline(next - 1, share, length, count);
        return isRotation ? slerp(value(next - 1, count), value(next, count), share)
                          : mix(value(next - 1, count), value(next, count), share);
    }

    [[nodiscard]] std::size_t numbersPerKey() const {
        const std::size_t perKey = interpolation_ == Interpolation::CubicSpline ? 3 : 1;
        return values_.count() * values_.componentCount() / (times_.count() * perKey);
    }

  private:
    /// The first key whose time is later.
    [[nodiscard]] std::size_t keyBehind(double seconds) const {
        std::size_t low = 0;
        std::size_t high = times_.count();
        while (low < high) {
            const std::size_t middle = low + (high - low) / 2;
            if (static_cast<double>(times_.number(middle, 0)) <= seconds)
                low = middle + 1;
            else
                high = middle;
        }
        return low;
    }

    /// Of a spline, `part` 0 is the tangent that leads to the value, 2 the one that leaves it.
    [[nodiscard]] std::vector<double> value(std::size_t key, std::size_t count, std::size_t part = 1) const {
        const bool isSpline = interpolation_ == Interpolation::CubicSpline;
        const std::size_t first = (isSpline ? 3 * key + part : key) * count;
        std::vector<double> numbers;
        for (std::size_t i = first; i < first + count; ++i)
            numbers.push_back(static_cast<double>(
                values_.number(i / values_.componentCount(), i % values_.componentCount())));
        return numbers;
    }

    static std::vector<double> mix(std::vector<double> a, const std::vector<double> &b, double share) {
        for (std::size_t i = 0; i < a.size(); ++i)
            a[i] += share * (b[i] - a[i]);
        return a;
    }

    /// glTF 2.0, appendix C.4.
    static std::vector<double> slerp(const std::vector<double> &a, std::vector<double> b, double share) {
        double cosine = 0.0;
        for (std::size_t i = 0; i < a.size(); ++i)
            cosine += a[i] * b[i];
        if (cosine < 0.0) // the shorter way round
            for (double &number : b)
                number = -number;
        const double angle = std::acos(std::min(std::abs(cosine), 1.0));
        if (angle < 1e-6)
            return mix(a, b, share);
        std::vector<double> turned = a;
        for (std::size_t i = 0; i < a.size(); ++i)
            turned[i] =
                (std::sin((1.0 - share) * angle) * a[i] + std::sin(share * angle) * b[i]) / std::sin(angle);
        return turned;
    }

    /// glTF 2.0, appendix C.5.
    [[nodiscard]] std::vector<double> spline(std::size_t key, double t, double length,
                                             std::size_t count) const {
        const std::vector<double> from = value(key, count);
        const std::vector<double> leaving = value(key, count, 2);
        const std::vector<double> to = value(key + 1, count);
        const std::vector<double> arriving = value(key + 1, count, 0);
        const double t2 = t * t;
        const double t3 = t2 * t;
        std::vector<double> numbers(count);
        for (std::size_t i = 0; i < count; ++i)
            numbers[i] = (2.0 * t3 - 3.0 * t2 + 1.0) * from[i] + length * (t3 - 2.0 * t2 + t) * leaving[i] +
                         (3.0 * t2 - 2.0 * t3) * to[i] + length * (t3 - t2) * arriving[i];
        return numbers;
    }

    Accessor times_;
    Accessor values_;
    Interpolation interpolation_;
};

/// Turns, shifts or scales.
void move(const Curve &curve, const JsonNode &node, Path path, double seconds, Trs &trs) {
    if (path == Path::Rotation) {
        const std::vector<double> q = curve.at(seconds, 4, true);
        trs.rotation = {q[0], q[1], q[2], q[3]};
        if (!(glm::length(trs.rotation) > 1e-3))
            node.fail(fmt::format("has a rotation of length 0 at {} s", seconds));
        return;
    }
    const std::vector<double> numbers = curve.at(seconds, 3, false);
    (path == Path::Translation ? trs.translation : trs.scale) =
        glm::dvec3(numbers[0], numbers[1], numbers[2]);
}

void move(const Curve &curve, const JsonNode &node, Path path, double seconds, Pose &pose) {
    if (path == Path::Weights) {
        pose.weights = curve.at(seconds, curve.numbersPerKey(), false);
        return;
    }
    auto *const trs = std::get_if<Trs>(&pose.place);
    if (trs == nullptr)
        node.fail("the node has a matrix; allowed: translation, rotation and scale for nodes that move");
    move(curve, node, path, seconds, *trs);
}

} // namespace

void animate(Buffers &buffers, double seconds, std::vector<Pose> &poses) {
    const Document &document = buffers.document();
    std::set<std::pair<std::size_t, Path>> moved;
    for (const JsonNode &animation : elementsOf(document.top(), "animations")) {
        const JsonObject object(animation);
        const Elements samplers = elementsOf(object, "samplers");
        for (const JsonNode &channelNode : elementsOf(object, "channels")) {
            const JsonObject channel(channelNode);
            const JsonObject target(channel.at("target"));
            const std::optional<std::size_t> node = document.reference(target, "node", "nodes");
            const JsonNode samplerNode = channel.at("sampler");
            if (samplers.empty())
                samplerNode.refuse("an index of samplers, of which there are none");
            const auto sampler = static_cast<std::size_t>(
                samplerNode.wholeNumber({0.0, static_cast<double>(samplers.size() - 1)}));
            if (!node) // what it moves is said by an extension
                continue;
            const Path path = target.choice("path", paths);
            if (moved.emplace(*node, path).second)
                move(Curve(buffers, JsonObject(samplers[sampler])), document.at("nodes", *node), path,
                     seconds, poses[*node]);
        }
    }
}

std::vector<bool> animatedNodes(const Document &document) {
    std::vector<bool> moved(elementsOf(document.top(), "nodes").size());
    for (const JsonNode &animation : elementsOf(document.top(), "animations"))
        for (const JsonNode &channel : elementsOf(JsonObject(animation), "channels"))
            if (const std::optional<std::size_t> node =
                    document.reference(JsonObject(JsonObject(channel).at("target")), "node", "nodes"))
                moved[*node] = true;
    return moved;
}

} // namespace hyalite::core::gltf
