// Texture lookups.
//
// The bilinear filter is our own: samplers have weights of 8 bits, and their rounding is not specified.

// Texture coordinates at the corners of a triangle.
struct Coordinates {
    vec2 uv0;
    vec2 uv1;
    vec2 uv2;
};

uvec4 textureWords(uint row) {
    TextureRow words = fetchTextureRow(row);
    return uvec4(words.x, words.y, words.z, words.w);
}

Coordinates fetchCoordinates(uint triangleRecord) {
    uint row = firstCoordinateRow + rowsPerCoordinates * triangleRecord;
    vec4 first = uintBitsToFloat(textureWords(row));
    return Coordinates(vec2(first), vec2(first.z, first.w), uintBitsToFloat(uvec2(textureWords(row + 1u))));
}

// Interpolated as trianglePoint does.
vec2 triangleUv(Coordinates at, float u, float v) {
    float w = 1.0 - u - v;
    return at.uv0 * u + at.uv1 * v + at.uv2 * w;
}

// Texture coordinates of a sphere, at the point in direction `outward`, of any length, from its centre: by longitude
// and latitude like the environment, seen from outside. The middle of the image is at +z.
vec2 sphereUv(vec3 outward) {
    float squared = outward.x * outward.x + outward.z * outward.z;
    float longitude = squared > 0.0 ? atan2Turns(-outward.x, -outward.z) : 0.0;
    float latitude = 2.0 * atan2Turns(squareRoot(squared), -outward.y);
    return vec2(longitude, latitude);
}

// The fractional part of a number, in [0, 1). It is 0 for infinities and NaN, and where it would be rounded to 1.
float fractionOf(float x) {
    float fraction = x - floor(x);
    return fraction >= 0.0 && fraction < 1.0 ? fraction : 0.0;
}

uint wordOf(uvec4 words, uint index) {
    uint low = (index & 1u) != 0u ? words.y : words.x;
    uint high = (index & 1u) != 0u ? words.w : words.z;
    return (index & 2u) != 0u ? high : low;
}

float decodeLevel(uint tableRow, uint level) {
    return uintBitsToFloat(wordOf(textureWords(tableRow + (level >> 2u)), level));
}

vec3 textureTexel(uvec4 description, uint x, uint y) {
    uint index = y * (description.y & 0xFFFFu) + x;
    if ((texturing & texturesLevels) == 0u || (description.z & textureIsFloat) != 0u)
        return uintBitsToFloat(uvec3(textureWords(description.x + index)));
    uint levels = wordOf(textureWords(description.x + (index >> 2u)), index);
    if ((description.z & textureIsAlpha) != 0u)
        levels = (levels >> 24u) * 0x010101u;
    uint table = (description.z & textureIsSrgb) != 0u ? srgbTableRow : linearTableRow;
    return vec3(decodeLevel(table, levels & 255u), decodeLevel(table, (levels >> 8u) & 255u),
                decodeLevel(table, (levels >> 16u) & 255u));
}

// Bilinear lookup; the image repeats. `row` is that of a TextureRecord.
vec3 lookUpTexture(uint row, vec2 uv) {
    uvec4 description = textureWords(row);
    vec4 placement = uintBitsToFloat(textureWords(row + 1u));
    uint width = description.y & 0xFFFFu;
    uint height = description.y >> 16u;
    vec2 placed = uv * vec2(placement) + vec2(placement.z, placement.w);
    float x = fractionOf(placed.x) * float(width) + 0.5;
    float y = (1.0 - fractionOf(placed.y)) * float(height) + 0.5;
    uint right = uint(x);
    uint lower = uint(y);
    float across = x - float(right);
    float down = y - float(lower);
    uint left = right == 0u ? width - 1u : right - 1u;
    uint upper = lower == 0u ? height - 1u : lower - 1u;
    right = right >= width ? right - width : right;
    lower = lower >= height ? lower - height : lower;
    vec3 above = mixtureOf(textureTexel(description, left, upper), textureTexel(description, right, upper), across);
    vec3 below = mixtureOf(textureTexel(description, left, lower), textureTexel(description, right, lower), across);
    return mixtureOf(above, below, down);
}

uint textureRow(uint textures, uint slot) { return textures + rowsPerTexture * slot; }

// Whether a material with textures has one in the slot.
bool hasTexture(uint textures, uint slot) { return textureWords(textureRow(textures, slot)).y != 0u; }

// Lookup of one number: the red channel, times the factor of the texture.
float lookUpNumber(uint row, vec2 uv) {
    return lookUpTexture(row, uv).x * uintBitsToFloat(textureWords(row).w);
}

// Alpha of GGX. Roughness has a minimum, so that float32 resolves the peak of the reflection.
float alphaOf(float roughness) {
    float used = greater(roughness, 0.04);
    return used * used;
}

// Whether the opacity texture cuts out the point of a triangle with these weights.
bool isCutAway(uint materialIndex, uint triangleRecord, float u, float v) {
    uint row = textureRow(fetchMaterial(materialIndex).textures, slotOpacity);
    return lookUpNumber(row, triangleUv(fetchCoordinates(triangleRecord), u, v)) < 0.5;
}

// The material with its textures applied at (u, v).
MaterialRecord texturedMaterial(MaterialRecord material, vec2 uv) {
    uint textures = material.textures;
    if (textures == 0u)
        return material;
    if ((texturing & texturesBaseColour) != 0u && hasTexture(textures, slotBaseColour))
        material.albedo *= lookUpTexture(textureRow(textures, slotBaseColour), uv);
    if ((texturing & texturesEmission) != 0u && hasTexture(textures, slotEmission))
        material.emission *= lookUpTexture(textureRow(textures, slotEmission), uv);
    if ((texturing & texturesRoughness) != 0u && hasTexture(textures, slotRoughness))
        material.alpha = alphaOf(lookUpNumber(textureRow(textures, slotRoughness), uv));
    if ((texturing & texturesMetallic) != 0u && hasTexture(textures, slotMetallic))
        material.metallic = lookUpNumber(textureRow(textures, slotMetallic), uv);
    return material;
}
