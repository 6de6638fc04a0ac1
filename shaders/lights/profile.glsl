// Profiles of lamps: their intensity by direction, as it was measured (IESNA LM-63, type C).
//
// gamma is the angle to the light's direction, C the angle around it, counter-clockwise for who looks against it. Between
// the angles of the profile the intensity is bilinear in both. Where the rows are: layout.h.

// An interval between two angles of a profile, and where in it an angle is.
struct ProfilePlace {
    uint interval;
    float share; // from 0 at its lower end to 1
};

// `first` is the row of the first of `count` intervals.
ProfilePlace profilePlace(uint first, uint count, float turns) {
    uint interval = searchTexels(first, count, numberBelow(turns));
    LookupRow row = fetchLookupRow(first + interval);
    float inside = (turns - row.value.x) * row.value.y;
    return ProfilePlace(interval, greater(lesser(inside, 1.0), 0.0));
}

// The intensity of a light with a profile towards a point, as a share of its greatest one. `index` is its own among those
// lights, `toLight` leads from the point to it, `axis` is its direction; both have unit length.
float profileShare(uint index, vec3 toLight, vec3 axis) {
    LookupRow light = fetchLookupRow(frame.lightProfiles + index);
    uint table = frame.lightProfiles + light.word;
    float x = -dotProduct(toLight, light.value);
    float y = -dotProduct(toLight, crossProduct(light.value, axis));
    float squared = x * x + y * y;
    bool isOnAxis = !(squared > 1e-30); // C does not matter there
    float sine = isOnAxis ? 0.0 : squareRoot(squared);
    float around = isOnAxis ? 0.0 : atan2Turns(y, x);
    float gamma = atan2Turns(sine, -dotProduct(toLight, axis));
    uint counts = fetchLookupRow(table).word;
    uint gammas = counts & 0xFFFFu;
    uint planes = counts >> 16u;
    ProfilePlace across = profilePlace(table + 1u, gammas, gamma);
    ProfilePlace along = profilePlace(table + 1u + gammas, planes, around);
    uint cell = table + 1u + gammas + planes + along.interval * gammas + across.interval;
    return cellMixture(fetchLookupRow(cell), across.share, along.share);
}
