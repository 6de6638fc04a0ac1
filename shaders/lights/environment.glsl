// The environment map, and how it is sampled.
//
// The image maps directions by longitude and latitude: its middle is -z, its top row is around +y. Radiance is
// interpolated between the centres of pixels. A pixel is sampled by integers, the row first. Its weight is the integral
// of the interpolated image over the pixel (host/packing/environment.cpp), so that every direction with radiance can be
// sampled.

const float piSquaredTwice = 19.739208802178716;

struct EnvironmentLight {
    vec3 direction;
    vec3 radiance;
    float pdf; // of the direction, per solid angle; 0: never sampled
};

// Image position of a direction: x from the left and y from the top, in [0, 1].
vec2 environmentPlace(vec3 direction) {
    float squared = direction.x * direction.x + direction.z * direction.z;
    float longitude = squared > 0.0 ? atan2Turns(-direction.x, direction.z) : 0.0;
    float turned = longitude + frame.environmentTurns;
    float back = turned - 1.0;
    float latitude = 2.0 * atan2Turns(squareRoot(squared), direction.y);
    return vec2(turned >= 1.0 ? back : turned, lesser(latitude, 1.0));
}

LookupRow environmentTexel(uint x, uint y) {
    return fetchLookupRow(frame.environmentTexels + y * frame.environmentWidth + x);
}

LookupRow environmentRow(uint y) {
    return fetchLookupRow(frame.environmentTexels + frame.environmentHeight * frame.environmentWidth + y);
}

vec3 environmentRadianceAt(vec2 place) {
    float x = place.x * float(frame.environmentWidth) + 0.5;
    float y = place.y * float(frame.environmentHeight) + 0.5;
    uint right = uint(x);
    uint lower = uint(y);
    float across = x - float(right);
    float down = y - float(lower);
    uint left = right == 0u ? frame.environmentWidth - 1u : right - 1u;
    right = right >= frame.environmentWidth ? right - frame.environmentWidth : right;
    uint upper = lower == 0u ? 0u : lower - 1u;
    lower = min(lower, frame.environmentHeight - 1u);
    vec3 above = mixtureOf(environmentTexel(left, upper).value, environmentTexel(right, upper).value, across);
    vec3 below = mixtureOf(environmentTexel(left, lower).value, environmentTexel(right, lower).value, across);
    return mixtureOf(above, below, down);
}

// The pdf, per solid angle, of a direction in the given pixel; `sine` is that of its angle to the vertical.
float pdfEnvironment(uvec2 pixel, float sine) {
    if (sine <= 0.0)
        return 0.0;
    uint before = pixel.x == 0u ? 0u : environmentTexel(pixel.x - 1u, pixel.y).word;
    uint numbers = environmentTexel(pixel.x, pixel.y).word - before;
    float inRow = floatOf(numbers) * (1.0 / 4294967296.0);
    float chance = inRow * environmentRow(pixel.y).value.x;
    float scaled = chance * (float(frame.environmentWidth) * float(frame.environmentHeight));
    float area = piSquaredTwice * sine;
    return divide(scaled, area);
}

float sineToVertical(vec3 direction) {
    float squared = direction.x * direction.x + direction.z * direction.z;
    return squareRoot(squared);
}

// Radiance and pdf of a direction.
EnvironmentLight environmentFrom(vec3 direction) {
    vec2 place = environmentPlace(direction);
    vec2 position = place * vec2(float(frame.environmentWidth), float(frame.environmentHeight));
    uvec2 pixel = min(uvec2(position), uvec2(frame.environmentWidth - 1u, frame.environmentHeight - 1u));
    return EnvironmentLight(direction, environmentRadianceAt(place), pdfEnvironment(pixel, sineToVertical(direction)));
}

// The first of `count` lookup rows, from `first` on, whose `word` is larger than `bits`, or the last one. Takes at most
// findMSB(count) + 1 steps.
uint searchTexels(uint first, uint count, uint bits) {
    uint found = 0u; // all before it end at or below `bits`
    uint last = count - 1u;
    do {
        uint middle = (found + last) >> 1u;
        bool isBefore = fetchLookupRow(first + middle).word <= bits;
        found = isBefore ? min(middle + 1u, last) : found;
        last = isBefore ? last : middle;
    } while (found < last);
    return found;
}

// Position in a pixel of the random number that selected it, in [0, 1].
float shareOf(uint bits, uint before, uint end) { return divide(floatOf(bits - before), floatOf(end - before)); }

// Samples a direction by two 32-bit random numbers.
EnvironmentLight sampleEnvironment(uvec2 random) {
    uvec2 bits = min(random, uvec2(0xFFFFFFFEu)); // the largest number selects the end of a row or column
    uint texelCount = frame.environmentWidth * frame.environmentHeight;
    uint y = searchTexels(frame.environmentTexels + texelCount, frame.environmentHeight, bits.y);
    uint x = searchTexels(frame.environmentTexels + y * frame.environmentWidth, frame.environmentWidth, bits.x);
    float down = shareOf(bits.y, y == 0u ? 0u : environmentRow(y - 1u).word, environmentRow(y).word);
    float across = shareOf(bits.x, x == 0u ? 0u : environmentTexel(x - 1u, y).word, environmentTexel(x, y).word);
    float u = float(x) + across;
    float v = float(y) + down;
    vec2 place = vec2(divide(u, float(frame.environmentWidth)), divide(v, float(frame.environmentHeight)));
    float turned = place.x - frame.environmentTurns;
    float forward = turned + 1.0;
    SineCosine longitude = sineCosine(turned < 0.0 ? forward : turned);
    float halfLatitude = 0.5 * place.y;
    SineCosine latitude = sineCosine(halfLatitude);
    vec3 direction = vec3(-longitude.sine * latitude.sine, latitude.cosine, longitude.cosine * latitude.sine);
    return EnvironmentLight(direction, environmentRadianceAt(place), pdfEnvironment(uvec2(x, y), latitude.sine));
}
