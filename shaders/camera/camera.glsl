// Primary rays.

// Image position of `offset` from the top left of `pixel`, in pixels from the middle of the image, y up.
vec2 fromMiddle(uvec2 pixel, vec2 offset, uvec2 size) {
    float x = float(pixel.x) + offset.x - 0.5 * float(size.x);
    float y = 0.5 * float(size.y) - (float(pixel.y) + offset.y);
    return vec2(x, y);
}

vec3 onImagePlane(vec2 position, vec3 right, vec3 up, vec3 middle) {
    return right * position.x + up * position.y + middle;
}

// Unit direction of a pinhole camera's primary ray through `offset` in [0,1)^2 inside `pixel`; see FrameRecord.
vec3 primaryDirection(uvec2 pixel, vec2 offset) {
    vec2 position = fromMiddle(pixel, offset, uvec2(frame.imageWidth, frame.imageHeight));
    return unitVector(onImagePlane(position, frame.pixelRight, frame.pixelUp, frame.imagePlane));
}

struct PrimaryRay {
    vec3 origin;
    vec3 direction; // unit length
};

// Thin lens: the ray from a point of the lens, sampled by `u` in [0,1)^2, to the point that a pinhole camera would show
// at the focus distance. Cook, Porter and Carpenter, "Distributed Ray Tracing", SIGGRAPH 1984.
PrimaryRay throughLens(uvec2 pixel, vec2 offset, vec2 u) {
    vec2 position = fromMiddle(pixel, offset, uvec2(frame.imageWidth, frame.imageHeight));
    vec3 straight = onImagePlane(position, frame.pixelRight, frame.pixelUp, frame.imagePlane);
    float radius = squareRoot(u.x) * frame.lensScale;
    SineCosine angle = sineCosine(u.y);
    vec2 onLens = vec2(radius * angle.cosine, radius * angle.sine);
    vec3 aside = frame.pixelRight * onLens.x + frame.pixelUp * onLens.y;
    vec3 direction = straight * frame.focusDistance - aside;
    return PrimaryRay(frame.eye + aside, unitVector(direction));
}

// Orthographic: rays are parallel to the view direction.
PrimaryRay alongView(uvec2 pixel, vec2 offset) {
    vec2 position = fromMiddle(pixel, offset, uvec2(frame.imageWidth, frame.imageHeight));
    return PrimaryRay(onImagePlane(position, frame.pixelRight, frame.pixelUp, frame.eye), unitVector(frame.imagePlane));
}

// Panorama, by longitude and latitude: the middle of the image is the view direction, its top row is up.
PrimaryRay allAround(uvec2 pixel, vec2 offset) {
    float x = float(pixel.x) + offset.x;
    float y = float(pixel.y) + offset.y;
    SineCosine longitude = sineCosine(divide(x, float(frame.imageWidth)));
    float latitudeTurns = 0.5 * divide(y, float(frame.imageHeight));
    SineCosine latitude = sineCosine(latitudeTurns);
    float right = -longitude.sine * latitude.sine;
    float forward = -longitude.cosine * latitude.sine;
    vec3 direction = frame.pixelRight * right + frame.pixelUp * latitude.cosine + frame.imagePlane * forward;
    return PrimaryRay(frame.eye, unitVector(direction));
}

// Quantile `u` of the pixel filter, in one dimension. Ernst, Stamminger and Greiner, "Filter Importance Sampling",
// 2006: samples that are distributed like the filter have equal weights, and each contributes to one pixel only.
float filterQuantile(float u) {
    float x = u * float(filterCellCount);
    uint cell = uint(x);
    LookupRow texel = fetchLookupRow(frame.filterTexels + cell);
    return texel.value.x + texel.value.y * (x - float(cell));
}

// Position of a sample from the top left of its pixel: in [0,1)^2, or around it with a wider filter.
vec2 sampleOffset(uvec2 pixel, uint sampleIndex) {
    vec2 offset = samplePixel(pixel, sampleIndex, frame.seed);
    if (samplerKind == samplerFiltered)
        offset = vec2(filterQuantile(offset.x), filterQuantile(offset.y));
    return offset;
}

// The primary ray through `offset`, for each kind of camera.
PrimaryRay primaryRayThrough(uvec2 pixel, vec2 offset, uint sampleIndex) {
    if ((camera & kindOfCamera) == cameraLens)
        return throughLens(pixel, offset, unitFloats(sampleBits(pairKeys(pixel, frame.seed, lensPair), sampleIndex)));
    if ((camera & kindOfCamera) == cameraOrthographic)
        return alongView(pixel, offset);
    if ((camera & kindOfCamera) == cameraPanorama)
        return allAround(pixel, offset);
    return PrimaryRay(frame.eye, primaryDirection(pixel, offset));
}

// The rest of the straight way from the eye to the origin of a primary ray, from a point of it.
struct WayToOrigin {
    vec3 direction; // unit length; 0 where there is no way
    float distance;
};

WayToOrigin wayToOrigin(vec3 from, vec3 origin) {
    vec3 way = origin - frame.eye;
    float whole = vectorLength(way);
    vec3 direction = whole > 0.0 ? way * divide(1.0, whole) : vec3(0.0);
    return WayToOrigin(direction, dotProduct(origin - from, direction));
}

// The primary ray of a sample.
PrimaryRay primaryRay(uvec2 pixel, uint sampleIndex) {
    return primaryRayThrough(pixel, sampleOffset(pixel, sampleIndex), sampleIndex);
}
