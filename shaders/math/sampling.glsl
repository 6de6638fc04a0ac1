// Directions and points drawn from two numbers in [0, 1), and the densities that they have.

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

// Around `normal` with the density cos / pi per solid angle: a point of the unit disc, projected up (Malley).
vec3 sampleCosine(vec3 normal, vec2 u) {
    float radius = squareRoot(u.x);
    SineCosine angle = sineCosine(u.y);
    float below = 1.0 - u.x;
    return unitVector(toWorld(makeOrthonormalBasis(normal), vec3(radius * angle.cosine, radius * angle.sine, squareRoot(below))));
}

float pdfCosine(float cosine) { return cosine * inversePi; }

// Weights of a triangle's first and second vertex, uniform over its area: PBRT, section 6.5.4, before it was made one
// with less distortion.
vec2 sampleTriangle(vec2 u) {
    float root = squareRoot(u.x);
    float first = 1.0 - root;
    float second = u.y * root;
    return vec2(first, second);
}

// The cone of directions from a point that meet a sphere, `squaredDistance` from the point to its centre, more than the
// squared radius: 1 - cos of the half angle, written so that it does not cancel for small cones.
float coneHeight(float squaredRadius, float squaredDistance) {
    float squaredSine = divide(squaredRadius, squaredDistance);
    float squaredCosine = 1.0 - squaredSine;
    float above = 1.0 + squareRoot(greater(squaredCosine, 0.0));
    return divide(squaredSine, above);
}

// Uniform over the solid angle of the cone around `axis` with this height.
vec3 sampleCone(vec3 axis, float height, vec2 u) {
    float below = u.x * height;
    float cosine = 1.0 - below;
    float squaredSine = below * (1.0 + cosine);
    float sine = squareRoot(squaredSine);
    SineCosine angle = sineCosine(u.y);
    return unitVector(toWorld(makeOrthonormalBasis(axis), vec3(sine * angle.cosine, sine * angle.sine, cosine)));
}

float pdfCone(float height) { return divide(0.5 * inversePi, height); }

// On the unit sphere, uniform over its area.
vec3 sampleSphere(vec2 u) {
    float z = 1.0 - 2.0 * u.x;
    float squaredRadius = 1.0 - z * z;
    float radius = squareRoot(greater(squaredRadius, 0.0));
    SineCosine angle = sineCosine(u.y);
    return unitVector(vec3(radius * angle.cosine, radius * angle.sine, z));
}

// The share of a sample drawn with density `a` where another way of sampling has density `b`: Veach's power heuristic
// with exponent 2, "Optimally Combining Sampling Techniques for Monte Carlo Rendering", SIGGRAPH 1995, by the quotient
// of the smaller to the larger, as squares may leave the range of floats.
float powerHeuristic(float a, float b) {
    float quotient = divide(lesser(a, b), greater(a, b));
    float squared = quotient * quotient;
    float sum = 1.0 + squared;
    float larger = divide(1.0, sum);
    return a < b ? squared * larger : larger;
}
