// Numbers of what a primitive belongs to, for views.

// The index of a primitive's place.
uint placeOf(uint primitive) {
    uint place = 0u; // it begins at `primitive` or before
    for (int bit = findMSB(placeCount); bit >= 0; --bit) {
        uint next = place + (1u << bit);
        if (next < placeCount && fetchPlace(next).firstPrimitive <= primitive)
            place = next;
    }
    return place;
}

// What `view`, one of those that show numbers, shows of a primitive.
uint numberOf(uint view, uint primitive, uint materialIndex) {
    if (view == viewMaterial)
        return fetchMaterial(materialIndex).number;
    uint place = placeOf(primitive);
    if (view == viewPlace)
        return place + 1u;
    PlaceRecord record = fetchPlace(place);
    return view == viewAsset ? record.asset : record.object;
}
