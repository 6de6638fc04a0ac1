// Layers of light of a sample. Twin: shaders/integrators/light_layers.glsl, whose file says what they are.
#pragma once

#include "host/leaves/leaves.h"
#include "host/packing/light_planes.h"
#include "shaders/layout/layout.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace hyalite::core::reference {
using namespace leaves;

template <class Real> class LightLayers {
  public:
    explicit LightLayers(const LightPlanes &planes) : classes_(planes.classes), ofGroups_(planes.groups) {}

    [[nodiscard]] bool areKept() const { return classes_ != 0 || !ofGroups_.empty(); }

    /// Of the finished sample, in the order of the film's planes.
    [[nodiscard]] std::vector<Vec3<Real>> planes() const {
        const Vec3<Real> none(Real(0));
        const Vec3<Real> diffuse = withoutTiny<Real>(indirect_ * ofPath_.diffuse);
        const Vec3<Real> other = withoutTiny<Real>(indirect_ - diffuse);
        const std::array<Vec3<Real>, layout::lightClassCount> ofClasses{
            seenClass_ == layout::lightEmission ? seen_ : none,
            seenClass_ == layout::lightBackground ? seen_ : none,
            direct_.diffuse,
            diffuse,
            direct_.glossy,
            ofPath_.isTransmitted ? none : other,
            direct_.transmitted,
            ofPath_.isTransmitted ? other : none};
        std::vector<Vec3<Real>> planes;
        for (std::size_t i = 0; i < ofClasses.size(); ++i)
            if ((classes_ >> i & 1u) != 0)
                planes.push_back(ofClasses[i]);
        planes.insert(planes.end(), ofGroups_.begin(), ofGroups_.end());
        return planes;
    }

    /// A path begins.
    void begin() {
        scatterings_ = 0;
        ofPath_ = {};
        seen_ = indirect_ = Vec3<Real>(Real(0));
        direct_ = {};
        std::ranges::fill(ofGroups_, Vec3<Real>(Real(0)));
    }

    /// A surface scatters the path: `diffuse` is the share of its value that is, and the rest is glossy or transmitted.
    void scatter(const Vec3<Real> &diffuse, bool isTransmitted) {
        if (scatterings_ == 0)
            ofPath_ = {diffuse, isTransmitted};
        scatterings_ = std::min(scatterings_ + 1, 2u);
    }

    /// Adds what the path has met; `seen`, layout::light..., is its class where nothing has scattered the path.
    void addMet(const Vec3<Real> &added, std::uint32_t seen, std::uint32_t group) {
        addToGroup(added, group);
        if (scatterings_ == 1) {
            addDirect(added, ofPath_);
        } else if (scatterings_ == 2) {
            indirect_ = indirect_ + added;
        } else {
            seenClass_ = seen;
            seen_ = seen_ + added;
        }
    }

    /// Adds what a shadow ray has brought to a surface that has not scattered the path yet; `diffuse` and
    /// `isTransmitted` as for scatter().
    void addSampled(const Vec3<Real> &added, const Vec3<Real> &diffuse, bool isTransmitted,
                    std::uint32_t group) {
        addToGroup(added, group);
        if (scatterings_ == 0)
            addDirect(added, {diffuse, isTransmitted});
        else
            indirect_ = indirect_ + added;
    }

  private:
    struct Way {
        Vec3<Real> diffuse{Real(0)};
        bool isTransmitted = false;
    };
    struct Direct {
        Vec3<Real> diffuse{Real(0)};
        Vec3<Real> glossy{Real(0)};
        Vec3<Real> transmitted{Real(0)};
    };

    void addToGroup(const Vec3<Real> &added, std::uint32_t group) {
        if (group < ofGroups_.size())
            ofGroups_[group] = ofGroups_[group] + added;
    }

    void addDirect(const Vec3<Real> &added, const Way &way) {
        const Vec3<Real> diffuse = withoutTiny<Real>(added * way.diffuse);
        Vec3<Real> &other = way.isTransmitted ? direct_.transmitted : direct_.glossy;
        direct_.diffuse = direct_.diffuse + diffuse;
        other = other + withoutTiny<Real>(added - diffuse);
    }

    std::uint32_t classes_;         ///< bits 1 << layout::light...
    std::uint32_t scatterings_ = 0; ///< of the path: 0, 1, or more
    Way ofPath_;                    ///< after its first scattering
    std::uint32_t seenClass_ = layout::lightEmission;
    Vec3<Real> seen_{Real(0)};
    Direct direct_;
    Vec3<Real> indirect_{Real(0)};
    std::vector<Vec3<Real>> ofGroups_;
};

} // namespace hyalite::core::reference
