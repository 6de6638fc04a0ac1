#include "assets/tea-table/images.h"

#include "assets/still-life/noise.h"
#include "assets/tea-table/turns.h"

namespace tea_table {

using namespace still_life;

namespace {

// The colours of the pot.
constexpr Vec cream{0.95, 0.92, 0.85};
constexpr Vec cobalt{0.13, 0.22, 0.52};
constexpr Vec sage{0.36, 0.50, 0.42};
constexpr Vec rose{0.82, 0.38, 0.36};
constexpr Vec pollen{0.93, 0.72, 0.25};

/// 1 within the distance, 0 beyond, and smooth over `edge` in between.
double within(double x, double y, double radius, double edge) {
    return 1.0 - smoothStep(radius - edge, radius + edge, std::sqrt(x * x + y * y));
}

/// A point turned about the origin.
std::array<double, 2> turned(double x, double y, double turns) {
    const double c = cosTurns(turns);
    const double s = sinTurns(turns);
    return {c * x - s * y, s * x + c * y};
}

} // namespace

Picture clothColour() {
    constexpr Vec ground{0.20, 0.39, 0.42};
    constexpr Vec stripe{0.80, 0.80, 0.72};
    return draw(256, 256, [&](double u, double v) {
        const auto cover = [](double x) {
            const double fromMiddle = std::fabs(x - 0.5);
            const double wide = 1.0 - smoothStep(0.10, 0.11, fromMiddle);
            const double fine = smoothStep(0.15, 0.155, fromMiddle) - smoothStep(0.17, 0.175, fromMiddle);
            return 0.45 * wide + 0.5 * fine;
        };
        const double share = 1.0 - (1.0 - cover(u)) * (1.0 - cover(v));
        const double threads = 0.9 + 0.2 * noise({u * 128.0, v * 16.0, 0.5}, {128, 16, 0}) *
                                         noise({u * 16.0, v * 128.0, 7.5}, {16, 128, 0});
        return Pixel{scale(mix(ground, stripe, share), threads)};
    });
}

Picture clothNormals() {
    constexpr int threadCount = 8;
    return drawNormals(128, 128, [](double u, double v) {
        const auto arch = [](double x) {
            const double t = x - std::floor(x);
            return 4.0 * t * (1.0 - t);
        };
        // Warp and weft pass over each other in turn.
        const double over = 0.5 + 0.5 * sinTurns(0.5 * threadCount * u) * sinTurns(0.5 * threadCount * v);
        const double warp = arch(u * threadCount) * over;
        const double weft = arch(v * threadCount) * (1.0 - over);
        return 0.26 / threadCount * (warp + weft);
    });
}

Picture potColour() {
    constexpr double round = 0.54; // metres around the belly
    constexpr double up = 0.36;    // metres along the profile
    constexpr double middle = 0.48 * up;
    constexpr int flowerCount = 7;
    constexpr double edge = 0.0006;
    const auto vineAt = [](double x) { return middle + 0.010 * sinTurns(x * flowerCount / round); };
    return draw(512, 256, [&](double u, double v) {
        const double x = u * round;
        const double y = v * up;
        Vec colour = cream;
        const auto cover = [&](const Vec &with, double share) { colour = mix(colour, with, share); };
        for (const double line : {middle - 0.048, middle - 0.043, middle + 0.043, middle + 0.048})
            cover(cobalt, 1.0 - smoothStep(0.0009, 0.0018, std::fabs(y - line)));
        cover(sage, 1.0 - smoothStep(0.0008, 0.0016, std::fabs(y - vineAt(x))));
        for (int i = -1; i <= 2 * flowerCount; ++i) { // leaves: one on either side of the vine, in turn
            const double at = (0.5 * i + 0.1) * round / flowerCount;
            const double side = (i & 1) != 0 ? 1.0 : -1.0;
            const auto [a, b] = turned(x - at, y - vineAt(at) - side * 0.009, -side * 0.12);
            cover(sage, within(a / 2.6, b, 0.0042, edge));
            cover(scale(sage, 0.7), within(a / 2.2, b * 9.0, 0.004, edge));
        }
        for (int i = 0; i < flowerCount; ++i) {
            const double at = (i + 0.5) * round / flowerCount;
            const double rise = (i & 1) != 0 ? 0.009 : -0.009;
            const double dx = x - at;
            const double dy = y - middle - rise;
            const Vec petal = (i & 1) != 0 ? rose : cobalt;
            for (int leaf = 0; leaf < 6; ++leaf) {
                const auto [a, b] = turned(dx, dy, leaf / 6.0 + 0.04);
                const double shade = 0.75 + 0.25 * smoothStep(0.002, 0.018, a);
                cover(scale(petal, shade), within((a - 0.011) / 1.4, b, 0.0055, edge));
            }
            cover(pollen, within(dx, dy, 0.0045, edge));
        }
        return Pixel{scale(colour, 0.96 + 0.04 * layeredNoise({u * 24.0, v * 16.0, 3.5}, 3, {24, 0, 0}))};
    });
}

Picture lace() {
    constexpr double edge = 0.004;
    return draw(320, 320, [](double u, double v) {
        const double x = u - 0.5;
        const double y = v - 0.5;
        double cover = within(x, y, laceScallopRadius, edge);
        for (int i = 0; i < laceScallopCount; ++i) {
            const auto [a, b] = turned(x, y, static_cast<double>(i) / laceScallopCount);
            cover = std::fmax(cover, within(a - laceScallopRadius, b, 0.046, edge));
        }
        const auto pierce = [&](int count, double distance, double radius, double stretch, double shift) {
            for (int i = 0; i < count; ++i) {
                const auto [a, b] = turned(x, y, (i + shift) / count);
                cover = std::fmin(cover, 1.0 - within((a - distance) / stretch, b, radius, edge));
            }
        };
        pierce(laceScallopCount, laceScallopRadius + 0.006, 0.021, 1.0, 0.0);
        pierce(laceScallopCount, 0.385, 0.014, 1.6, 0.5);
        pierce(2 * laceScallopCount, 0.345, 0.009, 1.0, 0.0);
        pierce(laceScallopCount, 0.290, 0.017, 1.9, 0.0);
        return Pixel{{0.93, 0.91, 0.86}, cover};
    });
}

Picture sugarNormals() {
    return drawNormals(128, 128, [](double u, double v) {
        return 0.028 * layeredNoise({u * 24.0, v * 24.0, 0.5}, 2, {24, 24, 0});
    });
}

Picture steam() {
    return draw(64, 192, [](double u, double v) {
        const double drift = 0.22 * sinTurns(0.9 * v) * v;
        const double across = (u - 0.5 - drift) / (0.12 + 0.22 * v);
        const double column = clamp01(1.0 - across * across);
        const double along = smoothStep(0.0, 0.12, v) * (1.0 - smoothStep(0.35, 0.98, v));
        const double wisps = layeredNoise({u * 5.0 + 2.0 * v, v * 5.0, 1.5}, 4);
        return Pixel{{1.0, 1.0, 1.0}, 0.9 * column * column * along * smoothStep(0.25, 0.75, wisps)};
    });
}

} // namespace tea_table
