#include "assets/cat/implicit.h"

#include <algorithm>
#include <cassert>

namespace hyalite::cat {
namespace {

// Rounding in a field of this size stays far below this.
constexpr double roundingSlack = 1e-9;

// The cubic smooth minimum: min(a, b) where |a - b| >= blend, else lower by at most blend / 6, with continuous
// curvature (I. Quilez, "Smooth minimum").
double smoothMin(double a, double b, double blend) {
    const double low = a < b ? a : b;
    const double high = a < b ? b : a;
    const double gap = high - low;
    if (gap >= blend)
        return low;
    const double h = (blend - gap) / blend;
    return low - h * h * h * blend * (1.0 / 6.0);
}

FieldSample smoothMin(const FieldSample &a, const FieldSample &b, double blend) {
    const FieldSample &low = a.value < b.value ? a : b;
    const FieldSample &high = a.value < b.value ? b : a;
    const double gap = high.value - low.value;
    if (gap >= blend)
        return low;
    const double h = (blend - gap) / blend;
    const double share = 0.5 * h * h;
    return {low.value - h * h * h * blend * (1.0 / 6.0),
            low.gradient * (1.0 - share) + high.gradient * share};
}

FieldSample negate(const FieldSample &a) { return {-a.value, -a.gradient}; }
double negate(double a) { return -a; }

// `Number` is double or FieldSample.
template <typename Number>
Number combineParts(Combine combine, const Number &before, const Number &part, double blend) {
    switch (combine) {
    case Combine::unite:
        return smoothMin(before, part, blend);
    case Combine::subtract:
        return negate(smoothMin(negate(before), part, blend));
    case Combine::intersect:
        return negate(smoothMin(negate(before), negate(part), blend));
    }
    assert(false);
    return before;
}

// What a part alone contributes when nothing before it has a say.
template <typename Number> Number startWith(Combine combine, const Number &part) {
    return combine == Combine::subtract ? negate(part) : part;
}

} // namespace

// The nearest point of the shape, in the plane through the axis: distance and how to rebuild the gradient.
struct Primitive::Closest {
    double distance = 0.0; // local, before scaling
    Vec3 direction;        // local gradient is direction * directionScale + axis * axisScale
    double directionScale = 0.0;
    double axisScale = 0.0;
};

Primitive Primitive::taperedCapsule(const Ball &a, const Ball &b, const Vec3 &stretch, const Frame &axes) {
    Primitive p;
    p.rows_ = {axes.axisX * (1.0 / stretch.x), axes.axisY * (1.0 / stretch.y),
               axes.axisZ * (1.0 / stretch.z)};
    p.scale_ = std::min({stretch.x, stretch.y, stretch.z});
    p.start_ = p.toLocal(a.centre);
    p.startRadius_ = a.radius;
    p.endRadius_ = b.radius;
    const Vec3 span = p.toLocal(b.centre) - p.start_;
    const double distance = hyalite::cat::length(span);
    const double taper = a.radius - b.radius;
    if (distance <= std::abs(taper)) {
        if (taper < 0.0) {
            p.start_ = p.toLocal(b.centre);
            p.startRadius_ = b.radius;
        }
        return p;
    }
    p.length_ = distance;
    p.axis_ = span * (1.0 / distance);
    p.slopeSine_ = taper / distance;
    p.slopeCosine_ = std::sqrt(1.0 - p.slopeSine_ * p.slopeSine_);
    p.slopeTangent_ = p.slopeSine_ / p.slopeCosine_;
    return p;
}

Primitive Primitive::halfSpace(const Vec3 &normal, double offset) {
    Primitive p;
    p.isHalfSpace_ = true;
    p.axis_ = normal;
    p.startRadius_ = offset;
    return p;
}

Vec3 Primitive::toLocal(const Vec3 &p) const {
    return {dot(rows_[0], p), dot(rows_[1], p), dot(rows_[2], p)};
}

Primitive::Closest Primitive::closest(const Vec3 &p) const {
    const Vec3 offset = toLocal(p) - start_;
    const double along = dot(offset, axis_);
    const Vec3 across = offset - axis_ * along;
    const double radial = hyalite::cat::length(across);
    // The foot on the axis of the line that meets the cone at a right angle.
    const double foot = along - radial * slopeTangent_;
    Closest result;
    if (length_ == 0.0 || foot <= 0.0) {
        const double distance = hyalite::cat::length(offset);
        result = {distance - startRadius_, offset, distance > 0.0 ? 1.0 / distance : 0.0, 0.0};
    } else if (foot >= length_) {
        const Vec3 toEnd = offset - axis_ * length_;
        const double distance = hyalite::cat::length(toEnd);
        result = {distance - endRadius_, toEnd, distance > 0.0 ? 1.0 / distance : 0.0, 0.0};
    } else {
        result = {radial * slopeCosine_ + along * slopeSine_ - startRadius_, across,
                  radial > 0.0 ? slopeCosine_ / radial : 0.0, slopeSine_};
    }
    return result;
}

double Primitive::value(const Vec3 &p) const {
    if (isHalfSpace_)
        return dot(axis_, p) - startRadius_;
    return closest(p).distance * scale_;
}

FieldSample Primitive::sample(const Vec3 &p) const {
    if (isHalfSpace_)
        return {dot(axis_, p) - startRadius_, axis_};
    const Closest c = closest(p);
    const Vec3 local = c.direction * (c.directionScale * scale_) + axis_ * (c.axisScale * scale_);
    return {c.distance * scale_, rows_[0] * local.x + rows_[1] * local.y + rows_[2] * local.z};
}

Selection Field::selectAll() const {
    Selection all;
    for (std::uint32_t part = 0; part < parts_.size(); ++part) {
        const auto first = static_cast<std::uint32_t>(all.primitives.size());
        const auto count = static_cast<std::uint32_t>(parts_[part].primitives.size());
        assert(count > 0);
        for (std::uint32_t i = 0; i < count; ++i)
            all.primitives.push_back(i);
        all.parts.push_back({part, first, count});
    }
    return all;
}

Selection Field::select(const Selection &from, const Ball &ball) const {
    // Two fields that differ by more than this at the centre differ by more than the blend in the whole ball.
    const double reach = 2.0 * ball.radius + roundingSlack;
    Selection kept;
    double before = 0.0;
    for (const Selection::PartRange &range : from.parts) {
        const Part &part = parts_[range.part];
        const auto first = static_cast<std::uint32_t>(kept.primitives.size());
        double united = 0.0;
        for (std::uint32_t i = 0; i < range.count; ++i) {
            const std::uint32_t index = from.primitives[range.first + i];
            const double value = part.primitives[index].value(ball.centre);
            if (kept.primitives.size() == first) {
                united = value;
            } else if (value - united >= reach + part.innerBlend) {
                continue;
            } else {
                if (united - value >= reach + part.innerBlend)
                    kept.primitives.resize(first);
                united = smoothMin(united, value, part.innerBlend);
            }
            kept.primitives.push_back(index);
        }
        const auto count = static_cast<std::uint32_t>(kept.primitives.size()) - first;
        if (kept.parts.empty()) {
            before = startWith(part.combine, united);
        } else {
            const double own = startWith(part.combine, united);
            // How far the part is from having a say, and the parts before it likewise.
            const double excess = part.combine == Combine::unite ? own - before : before - own;
            if (excess >= reach + part.outerBlend) {
                kept.primitives.resize(first);
                continue;
            }
            if (-excess >= reach + part.outerBlend) {
                kept.parts.clear();
                kept.primitives.erase(kept.primitives.begin(), kept.primitives.begin() + first);
                kept.parts.push_back({range.part, 0, count});
                before = own;
                continue;
            }
            before = combineParts(part.combine, before, united, part.outerBlend);
        }
        kept.parts.push_back({range.part, first, count});
    }
    return kept;
}

double Field::value(const Selection &selection, const Vec3 &p) const {
    double result = 0.0;
    bool isFirst = true;
    for (const Selection::PartRange &range : selection.parts) {
        const Part &part = parts_[range.part];
        const std::uint32_t *index = selection.primitives.data() + range.first;
        double united = part.primitives[index[0]].value(p);
        for (std::uint32_t i = 1; i < range.count; ++i)
            united = smoothMin(united, part.primitives[index[i]].value(p), part.innerBlend);
        result = isFirst ? startWith(part.combine, united)
                         : combineParts(part.combine, result, united, part.outerBlend);
        isFirst = false;
    }
    return result;
}

FieldSample Field::sample(const Selection &selection, const Vec3 &p) const {
    FieldSample result;
    bool isFirst = true;
    for (const Selection::PartRange &range : selection.parts) {
        const Part &part = parts_[range.part];
        const std::uint32_t *index = selection.primitives.data() + range.first;
        FieldSample united = part.primitives[index[0]].sample(p);
        for (std::uint32_t i = 1; i < range.count; ++i)
            united = smoothMin(united, part.primitives[index[i]].sample(p), part.innerBlend);
        result = isFirst ? startWith(part.combine, united)
                         : combineParts(part.combine, result, united, part.outerBlend);
        isFirst = false;
    }
    return result;
}

} // namespace hyalite::cat
