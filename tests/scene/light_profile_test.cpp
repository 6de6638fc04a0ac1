// Profiles of lights: flux and lit angles against closed forms.
#include "host/scene/light_profile.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

namespace hyalite::core {
namespace {

constexpr double degree = std::numbers::pi / 180.0;

/// In steps of 1 degree of gamma and 10 of C.
LightProfile made(const std::function<double(double, double)> &share, double low = 0.0, double high = 180.0) {
    LightProfile profile;
    for (double gamma = low; gamma <= high; gamma += 1.0)
        profile.gammas.push_back(gamma);
    for (double plane = 0.0; plane <= 360.0; plane += 10.0)
        profile.planes.push_back(plane);
    for (const double plane : profile.planes)
        for (const double gamma : profile.gammas)
            profile.shares.push_back(static_cast<float>(share(gamma * degree, plane * degree)));
    profile.candela = 100.0;
    return profile;
}

TEST(LightProfile, FluxIsThatOfClosedForms) {
    const auto uniform = made([](double, double) { return 1.0; });
    EXPECT_NEAR(meanShare(uniform), 1.0, 1e-9);
    EXPECT_NEAR(lumensOf(uniform), 400.0 * std::numbers::pi, 1e-6);
    const auto lambert = made([](double gamma, double) { return std::max(std::cos(gamma), 0.0); });
    EXPECT_NEAR(meanShare(lambert), 0.25, 1e-4);
    EXPECT_NEAR(lumensOf(lambert), 100.0 * std::numbers::pi, 0.05);
    const auto turned =
        made([](double gamma, double c) { return std::sin(gamma) * (0.5 + 0.5 * std::cos(c)); });
    EXPECT_NEAR(meanShare(turned), 0.5 * std::numbers::pi / 4.0, 1e-4);
}

TEST(LightProfile, ConesCutTheFlux) {
    const auto uniform = made([](double, double) { return 1.0; });
    for (const double angle : {0.5, 10.0, 33.3, 90.0, 150.0})
        EXPECT_NEAR(meanShare(uniform, angle), 0.5 * (1.0 - std::cos(angle * degree)), 1e-9) << angle;
    const auto lambert = made([](double gamma, double) { return std::max(std::cos(gamma), 0.0); });
    EXPECT_NEAR(meanShare(lambert, 30.0), 0.25 * 0.25, 1e-4);
    const auto upward = made([](double gamma, double) { return gamma > 100.0 * degree ? 1.0 : 0.0; });
    EXPECT_EQ(meanShare(upward, 90.0), 0.0);
    EXPECT_GT(meanShare(upward, 100.5), 0.0);
}

TEST(LightProfile, ATinyBeamHasSomeFlux) {
    LightProfile beam{"beam", {0.0, 1e-6, 90.0}, {0.0}, {1.0f, 0.0f, 0.0f}, 1.0};
    EXPECT_GT(meanShare(beam), 0.0);
    beam.shares = {0.0f, 0.0f, 1e-20f};
    EXPECT_GT(meanShare(beam), 0.0);
    EXPECT_EQ(meanShare(beam, 1e-7), 0.0);
}

TEST(LightProfile, LitAnglesHoldAllLight) {
    const auto lit = [](const std::vector<float> &shares) {
        const LitAngles angles = litAnglesOf({"", {0, 30, 60, 90, 120}, {0.0}, shares, 1.0});
        return std::pair(angles.low, angles.high);
    };
    EXPECT_EQ(lit({1, 1, 1, 1, 1}), std::pair(0.0, 120.0));
    EXPECT_EQ(lit({1, 0, 0, 0, 0}), std::pair(0.0, 30.0));
    EXPECT_EQ(lit({0, 0, 0.5f, 0, 0}), std::pair(30.0, 90.0));
    EXPECT_EQ(lit({0, 0, 0, 0, 1}), std::pair(90.0, 120.0));
    EXPECT_EQ(lit({0, 0, 0, 0, 0}), std::pair(0.0, 0.0));
    const LitAngles planes = litAnglesOf({"", {0, 90, 180}, {0, 180, 360}, {1, 0, 0, 0, 0, 1, 1, 0, 0}, 1.0});
    EXPECT_EQ(planes.low, 0.0);
    EXPECT_EQ(planes.high, 180.0);
}

TEST(LightProfile, C0IsAcrossTheLight) {
    for (const glm::dvec3 &direction : {glm::dvec3(0, -1, 0), glm::dvec3(3, 0, 0), glm::dvec3(-1, 1e-9, 0)})
        EXPECT_FALSE(isParallel(direction, defaultC0(direction)));
    EXPECT_TRUE(isParallel({1, 2, 3}, {-2, -4, -6}));
}

} // namespace
} // namespace hyalite::core
