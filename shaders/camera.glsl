// Primary rays. Twin: host/reference/camera.h.

// Where `offset` in [0,1)^2 inside of `pixel` lies, in pixels from the middle of an image of this size, y up.
vec2 fromMiddle(uvec2 pixel, vec2 offset, uvec2 size) {
    precise float x = float(pixel.x) + offset.x - 0.5 * float(size.x);
    precise float y = 0.5 * float(size.y) - (float(pixel.y) + offset.y);
    return vec2(x, y);
}

vec3 onImagePlane(vec2 position, vec3 right, vec3 up, vec3 middle) {
    precise vec3 point = right * position.x + up * position.y + middle;
    return point;
}

// The unit direction of the primary ray through `offset` in [0,1)^2 inside of `pixel`; see FrameRecord.
vec3 primaryDirection(uvec2 pixel, vec2 offset) {
    vec2 position = fromMiddle(pixel, offset, uvec2(frame.imageWidth, frame.imageHeight));
    return unitVector(onImagePlane(position, frame.pixelRight, frame.pixelUp, frame.imagePlane));
}
