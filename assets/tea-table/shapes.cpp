#include "assets/tea-table/shapes.h"

#include "assets/tea-table/turns.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tea_table {

using still_life::mix;
using still_life::smoothStep;

namespace {

Mesh turnedMesh(int columns, int rowsPerPoint, const std::vector<ProfilePoint> &profile) {
    Mesh mesh;
    addTurned(mesh, columns, rowsPerPoint, profile);
    return mesh;
}

/// A mesh that wears no texture.
Mesh bareMesh(int columns, int rowsPerPoint, const std::vector<ProfilePoint> &profile) {
    Mesh mesh = turnedMesh(columns, rowsPerPoint, profile);
    mesh.uvs.clear();
    return mesh;
}

} // namespace

Mesh cloth() {
    constexpr double tableRadius = 0.40;
    constexpr double edgeRadius = 0.012;
    constexpr double bend = edgeRadius * std::numbers::pi / 2.0;
    constexpr double hang = 0.16;
    constexpr double reach = tableRadius + bend + hang;
    Mesh mesh;
    // Rows lie close where the cloth bends. v goes from the hem inwards, so that the sheet faces up.
    addSheet(mesh, 132, 36, [&](double u, double v) {
        const double inwards = v < 0.75 ? (hang + bend + 0.01) * v / 0.75
                                        : hang + bend + 0.01 + (tableRadius - 0.01) * (v - 0.75) / 0.25;
        const double walked = reach - inwards; // from the middle
        const double turned = std::clamp((walked - tableRadius) / bend, 0.0, 1.0) * 0.25;
        const double hung = std::max(walked - tableRadius - bend, 0.0);
        const double fold = 0.5 + 0.35 * sinTurns(11.0 * u) + 0.15 * sinTurns(17.0 * u + 0.3);
        const double radius = std::min(walked, tableRadius) + edgeRadius * sinTurns(turned) + 0.16 * hung +
                              0.42 * hung * smoothStep(0.0, 0.1, hung) * fold;
        const double height = edgeRadius * (cosTurns(turned) - 1.0) - 0.95 * hung;
        return Vec{radius * sinTurns(u), height, radius * cosTurns(u)};
    });
    layFlat(mesh, reach);
    return mesh;
}

Mesh saucer() {
    return bareMesh(64, 2,
                    {{0.0, 0.002},
                     {0.026, 0.002},
                     {0.029, 0.0},
                     {0.032, 0.001},
                     {0.048, 0.006},
                     {0.066, 0.0135},
                     {0.0675, 0.0150},
                     {0.066, 0.0160},
                     {0.048, 0.0090},
                     {0.034, 0.0055},
                     {0.018, 0.0050},
                     {0.0, 0.0050}});
}

Mesh teaGlass() {
    return bareMesh(72, 3,
                    {{0.0, 0.0008},
                     {0.019, 0.0008},
                     {0.024, 0.0},
                     {0.0265, 0.002},
                     {0.0280, 0.010},
                     {0.0300, 0.030},
                     {0.0325, 0.055},
                     {0.0350, 0.080},
                     {0.0357, 0.0870},
                     {0.0348, 0.0880},
                     {0.0338, 0.0870},
                     {0.0330, 0.080},
                     {0.0305, 0.055},
                     {0.0280, 0.030},
                     {0.0258, 0.013},
                     {0.0225, 0.0085},
                     {0.012, 0.0075},
                     {0.0, 0.0075}});
}

Mesh tea() {
    constexpr double gap = 0.0002;
    return bareMesh(64, 2,
                    {{0.0, 0.0075 + gap},
                     {0.012, 0.0075 + gap},
                     {0.0225 - gap, 0.0085 + gap},
                     {0.0258 - gap, 0.013},
                     {0.0280 - gap, 0.030},
                     {0.0305 - gap, 0.055},
                     {0.0318 - gap, 0.0675},
                     {0.0319 - gap, 0.0682},
                     {0.0312 - gap, 0.0683},
                     {0.029, 0.0680},
                     {0.015, 0.0680},
                     {0.0, 0.0680}});
}

Mesh sugarBowl() {
    return turnedMesh(64, 3,
                      {{0.0, 0.003},
                       {0.020, 0.003},
                       {0.024, 0.0},
                       {0.026, 0.0015},
                       {0.024, 0.005},
                       {0.030, 0.010},
                       {0.042, 0.019},
                       {0.050, 0.032},
                       {0.053, 0.044},
                       {0.0555, 0.048},
                       {0.0555, 0.0495},
                       {0.0540, 0.0495},
                       {0.051, 0.044},
                       {0.048, 0.032},
                       {0.040, 0.021},
                       {0.028, 0.0125},
                       {0.014, 0.010},
                       {0.0, 0.0095}});
}

Mesh cakeStand() {
    return bareMesh(64, 2,
                    {{0.0, 0.004},
                     {0.030, 0.004},
                     {0.038, 0.0},
                     {0.041, 0.002},
                     {0.034, 0.007},
                     {0.016, 0.013},
                     {0.012, 0.021},
                     {0.018, 0.029},
                     {0.060, 0.034},
                     {0.098, 0.038},
                     {0.102, 0.042},
                     {0.100, 0.044},
                     {0.097, 0.0432},
                     {0.094, 0.042},
                     {0.060, 0.042},
                     {0.0, 0.042}});
}

Mesh bellJar() {
    return bareMesh(64, 3,
                    {{0.0820, 0.0},
                     {0.0822, 0.020},
                     {0.0822, 0.050},
                     {0.0815, 0.080},
                     {0.0745, 0.106},
                     {0.0580, 0.127},
                     {0.0330, 0.140},
                     {0.0130, 0.1445},
                     {0.0070, 0.147},
                     {0.0065, 0.151},
                     {0.0105, 0.156},
                     {0.0125, 0.162},
                     {0.0090, 0.169},
                     {0.0, 0.1715}});
}

Mesh doily(double radius) {
    Mesh mesh = turnedMesh(64, 2, {{radius, 0.0}, {0.5 * radius, 0.0}, {0.0, 0.0}});
    layFlat(mesh, radius);
    return mesh;
}

Mesh pearl() {
    constexpr double radius = 0.0036;
    constexpr int pointCount = 12;
    std::vector<ProfilePoint> profile;
    for (int i = 0; i <= pointCount; ++i)
        profile.push_back({i == pointCount ? 0.0 : radius * sinTurns(0.5 * i / pointCount),
                           radius * (1.0 - cosTurns(0.5 * i / pointCount))});
    return bareMesh(20, 1, profile);
}

Mesh sugarCube() {
    Mesh mesh;
    addRoundedCube(mesh, sugarHalf, 0.2);
    return mesh;
}

Mesh macaron(const Vec &shellColour, const Vec &fillingColour) {
    Mesh mesh = bareMesh(40, 2,
                         {{0.0, 0.0},
                          {0.014, 0.0002},
                          {0.0195, 0.003},
                          {0.0200, 0.0060},
                          {0.0206, 0.0068},
                          {0.0208, 0.008},
                          {0.0203, 0.0090},
                          {0.0188, 0.0092},
                          {0.0190, 0.0115},
                          {0.0188, 0.0138},
                          {0.0203, 0.0140},
                          {0.0208, 0.0150},
                          {0.0206, 0.0162},
                          {0.0200, 0.0170},
                          {0.0195, 0.0195},
                          {0.0155, 0.0222},
                          {0.0080, 0.0229},
                          {0.0, 0.0230}});
    paint(mesh, [&](const Vec &at) {
        const double fromMiddle = std::abs(at[1] - 0.5 * macaronHeight);
        const double shell = smoothStep(0.0019, 0.0026, fromMiddle);
        const double foot = 1.0 - smoothStep(0.0046, 0.0054, fromMiddle);
        return mix(fillingColour, mix(shellColour, Vec{0.85, 0.75, 0.65}, 0.35 * foot), shell);
    });
    return mesh;
}

Mesh steamPlume() {
    constexpr double height = 0.13;
    Mesh mesh;
    for (const double facing : {0.06, 0.31})
        addSheet(mesh, 6, 30, [&](double u, double v) {
            const double sway = 0.010 * v * sinTurns(1.1 * v + facing);
            const double across = (u - 0.5) * 0.07;
            return Vec{across * cosTurns(facing) + sway, height * v, -across * sinTurns(facing) + 0.5 * sway};
        });
    return mesh;
}

} // namespace tea_table
