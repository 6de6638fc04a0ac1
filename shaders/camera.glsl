// Primary rays. Twin: host/reference/camera.h.

// The unit direction of the primary ray through `offset` in [0,1)^2 inside of `pixel`; see FrameRecord.
vec3 primaryDirection(uvec2 pixel, vec2 offset) {
    precise float x = float(pixel.x) + offset.x - 0.5 * float(frame.imageWidth);
    precise float y = 0.5 * float(frame.imageHeight) - (float(pixel.y) + offset.y);
    precise vec3 direction = frame.pixelRight * x + frame.pixelUp * y + frame.imagePlane;
    return unitVector(direction);
}
