// Alpha: the background that a sample sees without anything in between but clear glass, where that is wanted, is
// transparent. It adds no radiance; its share goes to the sample's transparency. So does a shadow catcher, which stands
// for a surface of another picture. Both still light the scene: rays that surfaces scatter find them as ever. Twin:
// host/reference/transparency.h.
//
// The transparency of a sample is negative while its path sees through to the background.

void beginTransparency() {
    if (hasAlpha)
        path.transparency = -1.0;
}

bool seesThrough() { return hasAlpha && path.transparency < 0.0; }

// The path has met what is not transparent: it goes on as if there were no alpha.
void endSeeingThrough() {
    if (seesThrough())
        path.transparency = 0.0;
}

// Of a finished sample.
float sampleTransparency() { return hasAlpha ? greater(path.transparency, 0.0) : 0.0; }
