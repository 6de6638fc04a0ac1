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

Coordinates coordinatesAt(uint row) {
    vec4 first = uintBitsToFloat(textureWords(row));
    return Coordinates(vec2(first), vec2(first.z, first.w), uintBitsToFloat(uvec2(textureWords(row + 1u))));
}

// The first of what textures have of a triangle: see layout.h.
uint triangleRow(uint triangleRecord) { return firstCoordinateRow + rowsPerTriangle(texturing) * triangleRecord; }

Coordinates fetchCoordinates(uint triangleRecord) { return coordinatesAt(triangleRow(triangleRecord)); }

Coordinates fetchSecondCoordinates(uint triangleRecord) {
    return coordinatesAt(triangleRow(triangleRecord) + rowsPerCoordinates);
}

// Interpolated as trianglePoint does.
vec2 triangleUv(Coordinates at, float u, float v) {
    float w = 1.0 - u - v;
    return at.uv0 * u + at.uv1 * v + at.uv2 * w;
}

// Texture coordinates at a point of a surface.
struct SurfaceUv {
    vec2 first;
    vec2 second;
};

SurfaceUv triangleUvs(uint triangleRecord, float u, float v) {
    vec2 first = triangleUv(fetchCoordinates(triangleRecord), u, v);
    if ((texturing & texturesSecondUv) == 0u)
        return SurfaceUv(first, first);
    return SurfaceUv(first, triangleUv(fetchSecondCoordinates(triangleRecord), u, v));
}

// The colour of the vertices, interpolated: a factor on base colour and opacity.
vec4 triangleColour(uint triangleRecord, float u, float v) {
    uint row = triangleRow(triangleRecord) + rowsPerCoordinates;
    if ((texturing & texturesSecondUv) != 0u)
        row += rowsPerCoordinates;
    float w = 1.0 - u - v;
    vec4 c0 = uintBitsToFloat(textureWords(row));
    vec4 c1 = uintBitsToFloat(textureWords(row + 1u));
    vec4 c2 = uintBitsToFloat(textureWords(row + 2u));
    return c0 * u + c1 * v + c2 * w;
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

// Word `index` of those that follow each other from the row on.
uint textureWord(uint row, uint index) { return fetchTextureWord(4u * row + index); }

float decodeLevel(uint tableRow, uint level) { return uintBitsToFloat(textureWord(tableRow, level)); }

vec3 decodedTexel(uvec4 words, uint format) {
    uint channel = (format >> textureChannelShift) & textureChannelMask;
    if ((texturing & texturesChannels) != 0u && channel != 0u)
        return vec3(uintBitsToFloat(channel == 1u ? words.y : (channel == 2u ? words.z : words.w)));
    return uintBitsToFloat(uvec3(words));
}

vec3 textureTexel(uvec4 description, uint x, uint y) {
    uint index = y * (description.y & 0xFFFFu) + x;
    if ((texturing & texturesLevels) == 0u || (description.z & textureIsFloat) != 0u)
        return decodedTexel(textureWords(description.x + index), description.z);
    uint levels = textureWord(description.x, index);
    if ((texturing & texturesChannels) != 0u) {
        uint channel = (description.z >> textureChannelShift) & textureChannelMask;
        levels = channel != 0u ? ((levels >> (8u * channel)) & 255u) * 0x010101u : levels;
    }
    uint table = (description.z & textureIsSrgb) != 0u ? srgbTableRow : linearTableRow;
    return vec3(decodeLevel(table, levels & 255u), decodeLevel(table, (levels >> 8u) & 255u),
                decodeLevel(table, (levels >> 16u) & 255u));
}

// A coordinate of an image, in [0, 1].
float wrapped(float x, uint wrap) {
    float folded = 2.0 * fractionOf(0.5 * x);
    float mirrored = folded > 1.0 ? 2.0 - folded : folded;
    float clamped = greater(lesser(x, 1.0), 0.0);
    return wrap == wrapRepeat ? fractionOf(x) : (wrap == wrapMirror ? mirrored : clamped);
}

// Where a lookup reads: the two texels beside it along an axis, and the weight of the second one.
struct TexelPair {
    uint low;
    uint high;
    float share;
};

// `x` counts texels, from the edge of the image, and a half; `repeats`: beyond an edge the image begins anew, otherwise
// the texel at the edge goes on.
TexelPair texelPair(float x, uint size, bool repeats) {
    uint high = uint(x);
    float share = x - float(high);
    uint low = high == 0u ? (repeats ? size - 1u : 0u) : high - 1u;
    high = high >= size ? (repeats ? high - size : size - 1u) : high;
    return TexelPair(low, high, share);
}

// Bilinear lookup. `row` is that of a TextureRecord.
vec3 lookUpTexture(uint row, SurfaceUv at) {
    uvec4 description = textureWords(row);
    vec4 placement = uintBitsToFloat(textureWords(row + 1u));
    uint format = description.z;
    uint width = description.y & 0xFFFFu;
    uint height = description.y >> 16u;
    vec2 uv = at.first;
    if ((texturing & texturesSecondUv) != 0u && (format & textureUsesSecondUv) != 0u)
        uv = at.second;
    vec2 placed = uv * vec2(placement);
    uint wrapU = wrapRepeat;
    uint wrapV = wrapRepeat;
    if ((texturing & texturesPlaced) != 0u) {
        vec2 shear = uintBitsToFloat(uvec2(textureWords(row + 2u)));
        placed += vec2(uv.y, uv.x) * shear;
        wrapU = (format >> textureWrapShiftU) & textureWrapMask;
        wrapV = (format >> textureWrapShiftV) & textureWrapMask;
    }
    placed += vec2(placement.z, placement.w);
    TexelPair across = texelPair(wrapped(placed.x, wrapU) * float(width) + 0.5, width, wrapU == wrapRepeat);
    TexelPair down = texelPair((1.0 - wrapped(placed.y, wrapV)) * float(height) + 0.5, height, wrapV == wrapRepeat);
    if ((texturing & texturesPlaced) != 0u && (format & textureIsNearest) != 0u) {
        across.share = across.share < 0.5 ? 0.0 : 1.0;
        down.share = down.share < 0.5 ? 0.0 : 1.0;
    }
    vec3 above = mixtureOf(textureTexel(description, across.low, down.low),
                           textureTexel(description, across.high, down.low), across.share);
    vec3 below = mixtureOf(textureTexel(description, across.low, down.high),
                           textureTexel(description, across.high, down.high), across.share);
    return mixtureOf(above, below, down.share);
}

uint textureRow(uint textures, uint parameter) { return textures + rowsPerTexture * parameter; }

// Whether a material with textures has one for this parameter.
bool hasTexture(uint textures, uint parameter) { return textureWords(textureRow(textures, parameter)).y != 0u; }

// Lookup of one number: a channel, times the factor of the texture.
float lookUpNumber(uint row, SurfaceUv at) {
    return lookUpTexture(row, at).x * uintBitsToFloat(textureWords(row).w);
}

// Alpha of GGX. Roughness has a minimum, so that float32 resolves the peak of the reflection.
float alphaOf(float roughness) {
    float used = greater(roughness, 0.04);
    return used * used;
}

// Opacity at the point of a triangle with these weights: that of material, texture and vertices.
float opacityAt(MaterialRecord material, uint triangleRecord, float u, float v) {
    float opacity = material.opacity;
    if ((texturing & texturesOpacity) != 0u && material.textures != 0u && hasTexture(material.textures, slotOpacity))
        opacity *= lookUpNumber(textureRow(material.textures, slotOpacity), triangleUvs(triangleRecord, u, v));
    if ((texturing & texturesColours) != 0u)
        opacity *= triangleColour(triangleRecord, u, v).w;
    return opacity;
}

// The share of rays for which an alpha-tested triangle is there at the point with these weights.
float presenceAt(MaterialRecord material, uint triangleRecord, float u, float v) {
    float opacity = opacityAt(material, triangleRecord, u, v);
    if ((anyHit & anyHitBlended) != 0u && material.alphaCutoff == alphaBlended)
        return opacity;
    return opacity < material.alphaCutoff ? 0.0 : 1.0;
}

// Whether a ray passes through it. `choice`, in [0, 1), is alphaTestNumber().
bool isPassed(uint materialIndex, uint triangleRecord, float u, float v, float choice) {
    return choice >= presenceAt(fetchMaterial(materialIndex), triangleRecord, u, v);
}

// Direction of the anisotropy that a texture turns, and a factor on its strength: KHR_materials_anisotropy.
MaterialRecord anisotropicMaterial(MaterialRecord material, vec3 texel) {
    vec2 turned = 2.0 * vec2(texel) - 1.0;
    float squared = turned.x * turned.x + turned.y * turned.y;
    float scale = squared > 1e-12 ? divide(1.0, squareRoot(squared)) : 0.0;
    float cosine = squared > 1e-12 ? turned.x * scale : 1.0;
    float sine = turned.y * scale;
    float c = material.anisotropyCosine;
    float s = material.anisotropySine;
    material.anisotropyCosine = c * cosine - s * sine;
    material.anisotropySine = s * cosine + c * sine;
    material.anisotropy *= texel.z;
    return material;
}

bool isTextured(uint textures, uint parameter) {
    return (texturing & (1u << parameter)) != 0u && hasTexture(textures, parameter);
}

// Whether a lookup in `parameter` is one in `other`, which scenes without such textures know beforehand.
bool isSlot(uint parameter, uint other) { return (texturing & (1u << other)) != 0u && parameter == other; }

// The material with the texture of a parameter that materials with lobes have; `factor` is that of the texture.
MaterialRecord wornMaterial(MaterialRecord material, uint parameter, vec3 texel, float factor) {
    if (isSlot(parameter, slotRoughness)) {
        float roughness = texel.x * factor;
        bool isGlossiness =
            (scattering & scattersAtGltf) != 0u && (material.kindAndSides & materialIsSpecularGlossy) != 0u;
        material.alpha = alphaOf(isGlossiness ? 1.0 - roughness : roughness);
    }
    if (isSlot(parameter, slotMetallic))
        material.metallic = texel.x * factor;
    if (isSlot(parameter, slotTransmission))
        material.transmission *= texel.x;
    if (isSlot(parameter, slotClearcoat))
        material.clearcoat *= texel.x;
    if (isSlot(parameter, slotClearcoatRoughness))
        material.clearcoatAlpha = alphaOf(texel.x * factor);
    if (isSlot(parameter, slotDielectricWeight))
        material.dielectricWeight *= texel.x;
    if (isSlot(parameter, slotDielectricColour))
        material.dielectricColour *= texel;
    if (isSlot(parameter, slotSheenColour))
        material.sheenColour *= texel;
    if (isSlot(parameter, slotSheenRoughness))
        material.sheenAlpha = sheenAlphaOf(texel.x * factor);
    if (isSlot(parameter, slotIridescence))
        material.iridescence *= texel.x;
    if (isSlot(parameter, slotIridescenceThickness))
        material.iridescenceThickness =
            mixture(material.iridescenceThicknessMinimum, material.iridescenceThickness, texel.x);
    if (isSlot(parameter, slotDiffuseTransmission))
        material.diffuseTransmission *= texel.x;
    if (isSlot(parameter, slotDiffuseTransmissionColour))
        material.diffuseTransmissionColour *= texel;
    if (isSlot(parameter, slotAnisotropy))
        return anisotropicMaterial(material, texel);
    return material;
}

// A material that has textures, with those of `slots` applied at `at`. Those that materials with lobes have are looked
// up in a loop: inlined for each parameter, lookups would be most of the kernel.
MaterialRecord texturedMaterial(MaterialRecord material, uint slots, SurfaceUv at) {
    uint textures = material.textures;
    if ((slots & texturesBaseColour) != 0u && isTextured(textures, slotBaseColour))
        material.albedo *= lookUpTexture(textureRow(textures, slotBaseColour), at);
    if ((slots & texturesEmission) != 0u && isTextured(textures, slotEmission))
        material.emission *= lookUpTexture(textureRow(textures, slotEmission), at);
    for (uint left = slots & texturing & texturesOfLobes; left != 0u; left &= left - 1u) {
        uint parameter = uint(findLSB(left));
        uint row = textureRow(textures, parameter);
        if (hasTexture(textures, parameter))
            material = wornMaterial(material, parameter, lookUpTexture(row, at), uintBitsToFloat(textureWords(row).w));
    }
    return material;
}

// The material with the colour of the vertices applied.
MaterialRecord colouredMaterial(MaterialRecord material, uint triangleRecord, float u, float v) {
    vec4 colour = triangleColour(triangleRecord, u, v);
    material.albedo *= vec3(colour.x, colour.y, colour.z);
    return material;
}
