// Alpha: the background that a sample sees without anything in between but clear glass, where that is wanted, is
// transparent. It adds no radiance; its share goes to the sample's transparency. So does a shadow catcher, which stands
// for a surface of another picture. Both still light the scene: rays that surfaces scatter find them as ever. Twin:
// host/reference/transparency.h.
//
// The transparency of a sample is negative while its path sees through to the background.

const bool hasAlpha = alphaKind != alphaOfNothing;
const uint recordsPerSample = hasAlpha ? 2u : 1u; // SampleRecord

void beginTransparency(uint slot) {
    if (hasAlpha)
        path[slot].transparency = -1.0;
}

bool seesThrough(uint slot) { return hasAlpha && path[slot].transparency < 0.0; }

// The path has met what is not transparent: it goes on as if there were no alpha.
void endSeeingThrough(uint slot) {
    if (seesThrough(slot))
        path[slot].transparency = 0.0;
}

// The path has arrived where the picture is transparent.
void becomeTransparent(uint slot, vec3 throughput) { path[slot].transparency = meanComponent(throughput); }

// Of a finished sample.
float sampleTransparency(uint slot) { return hasAlpha ? greater(path[slot].transparency, 0.0) : 0.0; }
