#include "host/image/tone_curve.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace hyalite::core {
namespace {

constexpr ToneCurve allCurves[] = {ToneCurve::Gamma, ToneCurve::Srgb, ToneCurve::Aces, ToneCurve::Agx};

double shown(double grey, ToneCurve curve) { return displayed(glm::dvec3(grey), curve).y; }

TEST(ToneCurve, SrgbIsThatOfTheStandard) {
    EXPECT_EQ(srgbEncoded(0.0), 0.0);
    EXPECT_NEAR(srgbEncoded(0.0031308), 0.04045, 1e-5);
    EXPECT_NEAR(srgbEncoded(0.21404114), 0.5, 1e-7);
    EXPECT_NEAR(srgbEncoded(1.0), 1.0, 1e-15);
    for (double c = 0.0; c <= 1.0; c += 1.0 / 1024.0) {
        const double expected = c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1.0 / 2.4) - 0.055;
        EXPECT_NEAR(srgbEncoded(c), expected, 1e-14) << c;
    }
}

TEST(ToneCurve, GammaIsThatOfTheLevels) {
    Image image(256, 1);
    for (int x = 0; x < 256; ++x)
        image.at(x, 0) = glm::vec3(static_cast<float>(x) / 200.0f);
    const std::vector<std::uint8_t> levels = toneMap(image, 0.5);
    for (int x = 0; x < 256; ++x)
        EXPECT_NEAR(levels[static_cast<std::size_t>(3 * x)],
                    255.0 * shown(static_cast<double>(image.at(x, 0).x) * std::sqrt(2.0), ToneCurve::Gamma),
                    0.500001);
}

TEST(ToneCurve, GreyStaysGreyAndGetsNoDarker) {
    for (const ToneCurve curve : allCurves) {
        double before = 0.0;
        for (double stops = -20.0; stops <= 20.0; stops += 0.01) {
            const glm::dvec3 grey = displayed(glm::dvec3(std::exp2(stops)), curve);
            // The matrices are printed with as many digits as make a level of 8 bits safe.
            EXPECT_NEAR(grey.x, grey.y, 0.002);
            EXPECT_NEAR(grey.z, grey.y, 0.002);
            EXPECT_GE(grey.y, before) << stops;
            before = grey.y;
        }
    }
}

TEST(ToneCurve, BlackIsBlackAndBrightIsWhite) {
    Image image(3, 1);
    image.at(1, 0) = glm::vec3(1e6f);
    image.at(2, 0) = glm::vec3(std::numeric_limits<float>::infinity());
    for (const ToneCurve curve : allCurves) {
        const std::vector<std::uint8_t> levels = toneMap(image, 0.0, curve);
        for (std::size_t i = 0; i < 3; ++i) {
            EXPECT_EQ(levels[i], 0);
            EXPECT_EQ(levels[3 + i], 255);
            EXPECT_EQ(levels[6 + i], 255);
        }
    }
}

TEST(ToneCurve, MiddleGreyIsWhereThePublishedCurvesPutIt) {
    EXPECT_NEAR(shown(0.18, ToneCurve::Gamma), std::pow(0.18, 1.0 / 2.2), 1e-12);
    EXPECT_NEAR(shown(0.18, ToneCurve::Srgb), 0.4614, 1e-4);
    // The fit at 0.18 is 0.036734 / 0.347885 = 0.10559, for the rows of both matrices add up to 1.
    EXPECT_NEAR(shown(0.18, ToneCurve::Aces), srgbEncoded(0.10559), 2e-4);
    // (log2 0.18 + 12.47393) / 16.5 = 0.60606, and the polynomial of it: 0.76812 - 3.28213 + 4.31192 - 1.52889 +
    // 0.15787 + 0.07218 - 0.00232.
    EXPECT_NEAR(shown(0.18, ToneCurve::Agx), 0.49675, 2e-4);
}

TEST(ToneCurve, WhatIsNoColourIsBlack) {
    constexpr double notANumber = std::numeric_limits<double>::quiet_NaN();
    for (const ToneCurve curve : allCurves) {
        EXPECT_EQ(displayed({notANumber, notANumber, -1.0}, curve), displayed(glm::dvec3(0.0), curve));
        EXPECT_EQ(displayed({notANumber, 0.5, -1.0}, curve), displayed({0.0, 0.5, 0.0}, curve));
    }
}

TEST(ToneCurve, EveryColourIsShownWithinRange) {
    std::mt19937 random(2);
    std::uniform_real_distribution<double> stops(-15.0, 15.0);
    for (const ToneCurve curve : allCurves)
        for (int i = 0; i < 20000; ++i) {
            const glm::dvec3 c = displayed(
                {std::exp2(stops(random)), std::exp2(stops(random)), std::exp2(stops(random))}, curve);
            for (int channel = 0; channel < 3; ++channel)
                EXPECT_TRUE(c[channel] >= 0.0 && c[channel] <= 1.0);
        }
}

TEST(ToneCurve, HuesKeepTheirOrder) {
    // What is most red is shown as most red, and so on. Aces turns saturated blue to purple: there only a channel that
    // leads by two stops keeps the lead.
    std::mt19937 random(3);
    std::uniform_real_distribution<double> stops(-6.0, 6.0);
    for (const ToneCurve curve : allCurves)
        for (int i = 0; i < 20000; ++i) {
            const glm::dvec3 c{std::exp2(stops(random)), std::exp2(stops(random)), std::exp2(stops(random))};
            const glm::dvec3 d = displayed(c, curve);
            const double most = std::max({c.x, c.y, c.z});
            for (int a = 0; a < 3; ++a)
                for (int b = 0; b < 3; ++b)
                    if (c[a] > c[b] && (curve != ToneCurve::Aces || (c[a] == most && c[a] > 4.0 * c[b]))) {
                        EXPECT_GE(d[a], d[b] - 0.005)
                            << static_cast<int>(curve) << ": " << c.x << ' ' << c.y << ' ' << c.z;
                    }
        }
}

TEST(ToneCurve, FilmicCurvesTakeBrightColoursToWhite) {
    const glm::dvec3 red{1.0, 0.1, 0.05};
    for (const ToneCurve curve : {ToneCurve::Aces, ToneCurve::Agx}) {
        const auto saturation = [&](double scale) {
            const glm::dvec3 d = displayed(red * scale, curve);
            return (d.x - d.z) / d.x;
        };
        EXPECT_GT(saturation(0.5), saturation(8.0));
        EXPECT_GT(saturation(8.0), saturation(64.0));
        EXPECT_LT(saturation(1000.0), 0.05);
    }
    EXPECT_EQ(displayed(red * 4.0, ToneCurve::Gamma).x, 1.0); // clipped; the others keep the hue for longer
    EXPECT_LT(displayed(red * 4.0, ToneCurve::Agx).x, 0.98);
}

} // namespace
} // namespace hyalite::core
