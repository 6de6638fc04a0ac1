#include "assets/tea-table/shapes.h"

#include <algorithm>

namespace tea_table {

using still_life::mix;
using still_life::smoothStep;

namespace {

// Linear factors on the glaze.
constexpr Vec blue{0.10, 0.17, 0.42};
constexpr Vec white{1.0, 1.0, 1.0};

} // namespace

Mesh potBody() {
    Mesh mesh;
    addTurned(mesh, 72, 3, {{0.0, 0.004},   {0.030, 0.004},  {0.043, 0.003}, {0.046, 0.0},    {0.050, 0.001},
                            {0.053, 0.007}, {0.068, 0.020},  {0.083, 0.042}, {0.087, 0.066},  {0.080, 0.090},
                            {0.064, 0.109}, {0.047, 0.119},  {0.044, 0.122}, {0.0445, 0.126}, {0.041, 0.1275},
                            {0.037, 0.128}, {0.034, 0.1315}, {0.022, 0.138}, {0.010, 0.142},  {0.0075, 0.146},
                            {0.009, 0.151}, {0.013, 0.156},  {0.012, 0.163}, {0.006, 0.167},  {0.0, 0.1675}});
    // A glaze that runs darker at the foot, the rim and the knob.
    paint(mesh, [](const Vec &at) {
        const double foot = 1.0 - smoothStep(0.003, 0.022, at[1]);
        const double rim = smoothStep(0.117, 0.123, at[1]) - smoothStep(0.1275, 0.131, at[1]);
        const double knob = smoothStep(0.139, 0.148, at[1]);
        return mix(white, blue, std::max({foot, rim, knob}));
    });
    return mesh;
}

Mesh potSpoutAndHandle() {
    Mesh mesh;
    // Out along the spout, round its lip, and a little way back inside.
    addTube(mesh, 28, 48, {{{0.074, 0.040}, {0.130, 0.040}, {0.098, 0.108}, {0.146, 0.124}}}, [](double v) {
        const double lip = smoothStep(0.70, 0.82, v);
        const double outside = 0.020 - 0.011 * std::min(v / 0.72, 1.0) + 0.0015 * smoothStep(0.60, 0.72, v);
        const double back = std::max(v - 0.78, 0.0);
        return TubePoint{std::min(v / 0.75, 1.0) - back, outside - 0.003 * lip};
    });
    addTube(mesh, 20, 40, {{{-0.066, 0.103}, {-0.150, 0.140}, {-0.160, 0.028}, {-0.078, 0.034}}},
            [](double v) {
                return TubePoint{v, 0.0068 + 0.003 * (2.0 * v - 1.0) * (2.0 * v - 1.0)};
            });
    mesh.uvs.clear();
    paint(mesh, [](const Vec &at) {
        const double tip = smoothStep(0.128, 0.146, at[0]);
        return mix(white, blue, tip);
    });
    return mesh;
}

} // namespace tea_table
