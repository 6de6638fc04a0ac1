#include "host/reference/scene_view.h"

#include "tests/fixtures/geometry_fixture.h"

namespace hyalite::core::reference {
namespace {

using hyalite::core::testing::Random;
using hyalite::core::testing::Tally;

/// A ray that meets a surface with unit normal `facing` at the given angle.
struct Incidence {
    glm::dvec3 facing;
    glm::dvec3 direction;

    Incidence(Random &random, double angle) : facing(random.direction()) {
        const glm::dvec3 tangent = glm::normalize(glm::cross(facing, random.direction()));
        direction = tangent * std::sin(angle) - facing * std::cos(angle);
    }

    template <class Real> [[nodiscard]] Refraction<Real> refract(double index, bool isEntering) const {
        return refractRay<Real>(Vec3<Real>(direction), Vec3<Real>(facing), static_cast<Real>(index),
                                isEntering);
    }
};

TEST(Dielectric, ObeysSnellsLaw) {
    Random random(501);
    Tally wrong("refracted rays unlike Snell's law", random.seed());
    Tally length("refracted rays not of unit length", random.seed());
    Tally plane("refracted rays outside of the plane of incidence", random.seed());
    for (int i = 0; i < 500'000; ++i) {
        const double index = random.uniform(1.0, 4.0);
        const bool isEntering = random.coin();
        const double critical = isEntering ? std::numbers::pi / 2 : std::asin(1.0 / index);
        const double angle = random.uniform(0.0, 0.98 * critical);
        const Incidence incidence(random, angle);
        const Refraction<float> refraction = incidence.refract<float>(index, isEntering);
        const glm::dvec3 out(refraction.direction);
        const double sine = glm::length(glm::cross(out, incidence.facing));
        const double expected = isEntering ? std::sin(angle) / index : std::sin(angle) * index;
        wrong.check(!refraction.isTotal && std::abs(sine - expected) < 4e-6 &&
                        glm::dot(out, incidence.facing) < 0.0,
                    [&] { return fmt::format("index {}, angle {}, entering {}", index, angle, isEntering); });
        length.check(std::abs(glm::length(out) - 1.0) < 3e-7);
        plane.check(
            std::abs(glm::dot(out, glm::normalize(glm::cross(incidence.facing, incidence.direction)))) <
            1e-6 / std::max(std::sin(angle), 1e-3));
        const Refraction<double> wide = incidence.refract<double>(index, isEntering);
        wrong.check(std::abs(glm::length(glm::cross(wide.direction, incidence.facing)) - expected) < 1e-12);
    }
    wrong.expectNone();
    length.expectNone();
    plane.expectNone();
}

TEST(Dielectric, KnownAngles) {
    // 45 degrees into glass of index sqrt(2): 30 degrees, and back.
    Random random(502);
    const double index = std::numbers::sqrt2;
    const Incidence into(random, std::numbers::pi / 4);
    EXPECT_NEAR(-glm::dot(into.refract<double>(index, true).direction, into.facing), std::sqrt(3.0) / 2,
                1e-12);
    const Incidence out(random, std::numbers::pi / 6);
    EXPECT_NEAR(-glm::dot(out.refract<double>(index, false).direction, out.facing), std::numbers::sqrt2 / 2,
                1e-12);
}

TEST(Dielectric, RefractionIsReversible) {
    Random random(503);
    for (int i = 0; i < 10'000; ++i) {
        const double index = random.uniform(1.0, 3.0);
        const Incidence into(random, random.uniform(0.0, 1.55));
        const Refraction<double> inside = into.refract<double>(index, true);
        const Refraction<double> back = refractRay<double>(-inside.direction, -into.facing, index, false);
        EXPECT_FALSE(back.isTotal) << "seed " << random.seed();
        EXPECT_LT(glm::distance(back.direction, -into.direction), 1e-7) << "seed " << random.seed();
        // The same pair of directions reflects the same share from both sides.
        EXPECT_NEAR(back.reflectance, inside.reflectance, 1e-7) << "seed " << random.seed();
    }
}

TEST(Dielectric, ReflectanceIsSchlicksAndStaysInTheUnitInterval) {
    Random random(504);
    Tally wrong("reflectances unlike the formula", random.seed());
    Tally range("reflectances outside of [0, 1]", random.seed());
    for (int i = 0; i < 1'000'000; ++i) {
        const double index = i % 8 == 0 ? 1.0 : random.uniform(1.0, 10.0);
        const bool isEntering = random.coin();
        const double angle = i % 16 == 1 ? 0.0 : std::acos(random.uniform());
        const Incidence incidence(random, angle);
        const Refraction<float> refraction = incidence.refract<float>(index, isEntering);
        // As products of (1-R)s the rounding below 0 at cosines above 1 would not matter; it is below 1e-30.
        range.check(refraction.reflectance >= -1e-30f && refraction.reflectance <= 1.0f, [&] {
            return fmt::format("index {}, angle {}: {:a}", index, angle, refraction.reflectance);
        });
        if (refraction.isTotal)
            continue;
        const double normalReflectance = std::pow((1.0 - index) / (1.0 + index), 2.0);
        const double inner = isEntering ? angle : std::asin(std::min(1.0, std::sin(angle) * index));
        const double expected =
            normalReflectance + (1.0 - normalReflectance) * std::pow(1.0 - std::cos(inner), 5.0);
        // Next to the critical angle the cosine is the root of a difference.
        const double slack =
            isEntering ? 4e-6 : 4e-6 + 1e-5 * index * index / std::max(std::cos(inner), 1e-2);
        wrong.check(std::abs(static_cast<double>(refraction.reflectance) - expected) < slack, [&] {
            return fmt::format("index {}, angle {}, entering {}: {} not {}", index, angle, isEntering,
                               refraction.reflectance, expected);
        });
    }
    wrong.expectNone();
    range.expectNone();
}

TEST(Dielectric, HeadOnReflectanceIsFresnels) {
    Random random(505);
    for (const double index : {1.0, 1.33, 1.5, 2.4, 10.0}) {
        const double expected = std::pow((index - 1.0) / (index + 1.0), 2.0);
        for (const bool isEntering : {true, false}) {
            const Incidence incidence(random, 0.0);
            EXPECT_NEAR(incidence.refract<double>(index, isEntering).reflectance, expected, 1e-12);
            EXPECT_NEAR(incidence.refract<float>(index, isEntering).reflectance, expected, 1e-6);
        }
    }
    EXPECT_NEAR(Incidence(random, 0.0).refract<double>(1.5, true).reflectance, 0.04, 1e-12);
}

TEST(Dielectric, ReflectanceRisesToOneAtGrazingAndAtTheCriticalAngle) {
    Random random(506);
    for (const double index : {1.1, 1.5, 2.4}) {
        const double critical = std::asin(1.0 / index);
        for (const bool isEntering : {true, false}) {
            const double limit = isEntering ? std::numbers::pi / 2 : critical;
            double last = 0.0;
            for (int i = 0; i <= 1000; ++i) {
                const double angle = limit * i / 1000.0 * (1.0 - 1e-12);
                const double reflectance =
                    Incidence(random, angle).refract<double>(index, isEntering).reflectance;
                EXPECT_GE(reflectance, last - 1e-9) << "index " << index << ", angle " << angle;
                last = reflectance;
            }
            EXPECT_NEAR(last, 1.0, 2e-5) << "index " << index << ", entering " << isEntering;
        }
    }
}

TEST(Dielectric, ReflectionIsTotalExactlyBeyondTheCriticalAngle) {
    Random random(507);
    Tally wrong("total reflection on the wrong side of the critical angle", random.seed());
    for (int i = 0; i < 200'000; ++i) {
        const double index = random.uniform(1.05, 4.0);
        const double critical = std::asin(1.0 / index);
        const double gap = random.logUniform(1e-5, 0.1);
        const auto isTotal = [&](double angle) {
            return Incidence(random, angle).refract<float>(index, false).isTotal;
        };
        const auto isTotalInDouble = [&](double angle) {
            return Incidence(random, angle).refract<double>(index, false).isTotal;
        };
        const double above = critical + gap;
        if (above < std::numbers::pi / 2) {
            wrong.check(isTotal(above), [&] { return fmt::format("index {}, {} above", index, gap); });
            wrong.check(isTotalInDouble(critical + gap * 1e-8));
        }
        wrong.check(!isTotal(critical - gap), [&] { return fmt::format("index {}, {} below", index, gap); });
        wrong.check(!isTotalInDouble(critical - gap * 1e-8));
        const Refraction<float> entering =
            Incidence(random, random.uniform(0.0, std::numbers::pi / 2)).refract<float>(index, true);
        wrong.check(!entering.isTotal);
    }
    wrong.expectNone();
}

TEST(Dielectric, IndexOneDoesNotBend) {
    Random random(508);
    Tally bent("rays bent by an index of 1", random.seed());
    for (int i = 0; i < 200'000; ++i) {
        const Incidence incidence(random, random.uniform(0.0, 1.5));
        const bool isEntering = random.coin();
        const Refraction<float> refraction = incidence.refract<float>(1.0, isEntering);
        bent.check(!refraction.isTotal &&
                   glm::distance(glm::dvec3(refraction.direction), incidence.direction) < 1e-5);
    }
    bent.expectNone();
    EXPECT_LE(std::abs(Incidence(random, 0.0).refract<float>(1.0, true).reflectance), 1e-30f);
    // Away from the normal, Schlick's formula reflects (1 - cos)^5 at an index of 1 where Fresnel's equations reflect
    // nothing: that is the model's, and what it says is what is returned.
    EXPECT_NEAR(Incidence(random, std::numbers::pi / 3).refract<double>(1.0, true).reflectance, 1.0 / 32.0,
                1e-12);
}

} // namespace
} // namespace hyalite::core::reference
