// Sampling of directions and points from two numbers in [0, 1), and the pdfs.

const float inversePi = 0.31830988618379067;

// Two unit vectors that make a right-handed frame with the unit vector `n`: Duff et al., "Building an Orthonormal
// Basis, Revisited", JCGT 6(1), 2017.
struct Frame {
    vec3 x;
    vec3 y;
    vec3 z;
};

Frame makeOrthonormalBasis(vec3 n) {
    float side = n.z < 0.0 ? -1.0 : 1.0;
    float height = side + n.z;
    float a = divide(-1.0, height);
    float b = n.x * n.y * a;
    float xx = 1.0 + side * (n.x * n.x * a);
    float yy = side + n.y * n.y * a;
    return Frame(vec3(xx, side * b, -side * n.x), vec3(b, yy, -n.y), n);
}

vec3 toWorld(Frame f, vec3 v) {
    return f.x * v.x + f.y * v.y + f.z * v.z;
}

// A direction around z with the pdf cos / pi per solid angle: a point of the unit disc, projected up (Malley).
vec3 sampleCosine(vec2 u) {
    float radius = squareRoot(u.x);
    SineCosine angle = sineCosine(u.y);
    float below = 1.0 - u.x;
    return vec3(radius * angle.cosine, radius * angle.sine, squareRoot(below));
}

// The same around `normal`.
vec3 sampleCosine(vec3 normal, vec2 u) { return unitVector(toWorld(makeOrthonormalBasis(normal), sampleCosine(u))); }

float pdfCosine(float cosine) { return cosine * inversePi; }

// Barycentric weights of the first and second vertex, uniform over the area of a triangle: the square-root map, which
// PBRT, section 6.5.4, has since replaced by one with less distortion.
vec2 sampleTriangle(vec2 u) {
    float root = squareRoot(u.x);
    float first = 1.0 - root;
    float second = u.y * root;
    return vec2(first, second);
}

// The cone of directions from a point to a sphere: 1 - cos of its half angle, in a form that does not cancel for small
// cones. `squaredDistance` from the point to the centre is larger than the squared radius.
float coneHeight(float squaredRadius, float squaredDistance) {
    float squaredSine = divide(squaredRadius, squaredDistance);
    float squaredCosine = 1.0 - squaredSine;
    float above = 1.0 + squareRoot(greater(squaredCosine, 0.0));
    return divide(squaredSine, above);
}

// A direction in the cone around `axis` with this height, uniform over its solid angle.
vec3 sampleCone(vec3 axis, float height, vec2 u) {
    float below = u.x * height;
    float cosine = 1.0 - below;
    float squaredSine = below * (1.0 + cosine);
    float sine = squareRoot(squaredSine);
    SineCosine angle = sineCosine(u.y);
    return unitVector(toWorld(makeOrthonormalBasis(axis), vec3(sine * angle.cosine, sine * angle.sine, cosine)));
}

float pdfCone(float height) { return divide(0.5 * inversePi, height); }

// A point of the unit sphere, uniform over its area.
vec3 sampleSphere(vec2 u) {
    float z = 1.0 - 2.0 * u.x;
    float squaredRadius = 1.0 - z * z;
    float radius = squareRoot(greater(squaredRadius, 0.0));
    SineCosine angle = sineCosine(u.y);
    return unitVector(vec3(radius * angle.cosine, radius * angle.sine, z));
}

// Multiple importance weight of a sample with the pdf `a`, where another technique has the pdf `b`: the power heuristic
// with exponent 2, Veach and Guibas, "Optimally Combining Sampling Techniques for Monte Carlo Rendering", SIGGRAPH
// 1995. It uses the quotient of the smaller to the larger pdf, because squares may leave the range of floats.
float powerHeuristic(float a, float b) {
    float quotient = divide(lesser(a, b), greater(a, b));
    float squared = quotient * quotient;
    float sum = 1.0 + squared;
    float larger = divide(1.0, sum);
    return a < b ? squared * larger : larger;
}
