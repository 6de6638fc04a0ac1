// Memory layout shared by host and shaders: every record that both sides read or write.
//
// Compiled as C++ (with GLM) and as GLSL. All structs are made of 16-byte rows (vec3 + scalar, or four scalars), so
// that C++, std140 and std430 agree without padding rules. No bool, no matrix.
#ifndef HYALITE_LAYOUT_H
#define HYALITE_LAYOUT_H

#ifdef __cplusplus
#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>

namespace hyalite::core::layout {
using glm::vec3;
using uint = std::uint32_t;
#define HYALITE_INLINE inline
#else
#define HYALITE_INLINE
#endif

// ---- Limits

// As many are tested by every ray, from a uniform buffer; others are in the tree.
const uint maxUnrolledSpheres = 16u;
const uint maxUniformLights = 16u;   // the first ones are in a uniform buffer, too
const uint maxListedTriangles = 32u; // of a tree that skip lists do without: a bit each in a word
const uint maxPathDepth = 32u;
const uint maxTreeDepth = 64u; // and the size of a traversal stack: builders keep every tree below it

// ---- Primitives
//
// A primitive's id orders all primitives of a scene: spheres first, then triangles, both by their index in the input.
// Of two hits at the same distance, the one with the smaller id is the nearest. Triangles count from
// FrameRecord::firstTriangleId on: from the same number in all scenes with few spheres, so that one more of them does
// not change the colours of a view of ids.

const uint noPrimitive = 0xFFFFFFFFu;
const uint minFirstTriangleId = 64u;

// Most shading reads only the first row: on lavapipe, reading a row takes as long as testing a sphere.
struct SphereRecord {
    vec3 centre;          // world space
    uint materialAndSide; // see materialIndexOf, normalSignOf
    float radius;
    uint isTransmissive; // 1 for a dielectric: it dims light instead of blocking it
    uint emitter;        // of the light tree: the index of its emitter
    uint primitiveId;    // its index in the input
};

const uint sphereFacesInward = 0x80000000u;

HYALITE_INLINE uint materialIndexOf(SphereRecord sphere) {
    return sphere.materialAndSide & ~sphereFacesInward;
}

// +1: the normal points outward, -1: towards the centre.
HYALITE_INLINE float normalSignOf(SphereRecord sphere) {
    return (sphere.materialAndSide & sphereFacesInward) != 0u ? -1.0f : 1.0f;
}

// A primitive of the tree: a triangle, or a sphere whose other properties are in the SphereRecord with its id as index.
struct TriangleRecord {
    // World space; counter-clockwise seen from outside. Of a sphere: v0 is its centre, v1.x its radius.
    vec3 v0;
    uint primitiveId;
    vec3 v1;
    uint materialIndex;
    vec3 v2;
    uint flags;
};

const uint triangleIsTransmissive = 1u; // a dielectric: it dims light instead of blocking it
const uint triangleEndsLeaf = 2u;       // the last triangle of its leaf
const uint triangleIsAlphaTested = 4u;  // its material is not there for every ray: see anyHit...
const uint triangleIsSphere = 8u;
const uint triangleIsCulled = 16u;    // it is not there for rays from behind
const uint triangleEmitterShift = 5u; // the other bits: of the light tree, the index of its emitter

// Two triangles of a scene with few: v0 v1 v2, and v0 v2 v3 unless `second` is 0.
struct TrianglePair {
    vec3 v0;
    uint first; // the bit of its index
    vec3 v1;
    uint second;
    vec3 v2;
    uint pad0;
    vec3 v3;
    uint pad1;
};

// Shading normals of the triangle with the same index. Zero vectors mean: use the geometric normal.
struct NormalRecord {
    vec3 n0;
    float pad0;
    vec3 n1;
    float pad1;
    vec3 n2;
    float pad2;
};

// ---- Instances
//
// An instance is a mesh that is stored once, in its own space, and placed many times. Its triangle records come after
// those of the scene, and their primitiveId is the index in the mesh. Each coordinate of a vertex in world space is
// ((m.x x + m.y y) + m.z z) + t, where every operation rounds: the host flattens instances by the same operations
// (host/scene/instances.h), so that an instance and its flattened copy are hit alike, bit for bit.

const uint noInstance = 0xFFFFFFFFu;

struct InstanceRecord {
    vec3 toX; // m, for the x coordinate
    float offsetX;
    vec3 toY;
    float offsetY;
    vec3 toZ;
    float offsetZ;
    // The same map from the grid of the mesh's skip lists, in halves of a cell.
    vec3 gridToX;
    float gridOffsetX;
    vec3 gridToY;
    float gridOffsetY;
    vec3 gridToZ;
    float gridOffsetZ;
    vec3 slack;          // bound on the rounding of vertices and boxes, in world space (box.glsl)
    uint firstPrimitive; // id of its first triangle
    uint tree;           // index of the mesh among the meshes with instances
    uint root;           // of the mesh's tree: a node pair
    uint listBegin;      // of the mesh's tree in each of the two skip lists; or of its triangles, for ray queries
    uint listEnd;
};

// ---- Places
//
// A place is a sphere, a mesh or an instance: primitives whose ids follow each other. Records are in the order of their
// first ids; the number of a place is its index + 1. Objects, assets and materials are numbered by their names from 1
// on (host/scene/scene_names.h), so that things of one name have one number.

struct PlaceRecord {
    uint firstPrimitive; // id
    uint object;         // number
    uint asset;          // number
    uint pad0;
};

const uint maxNumber = 1u << 24u; // floats have all integers up to it

// ---- The tree
//
// An inner node holds the boxes of both children, so that one fetch decides about two subtrees. A child is an inner
// node (its index in the node array), a leaf (leafFlag | index of its first triangle; triangleEndsLeaf marks the last
// one), an instance (leafFlag | instanceFlag | its index), or nothing (noNode). Node 0 is the root; every scene has
// one. The trees of meshes with instances come after it.

const uint leafFlag = 0x80000000u;
const uint instanceFlag = 0x40000000u; // beside leafFlag
const uint noNode = 0xFFFFFFFFu;
const uint leaveInstance = 0xFFFFFFFEu; // on a traversal stack: back to the scene's own tree

// Whether a reference is that of an instance.
HYALITE_INLINE bool isInstance(uint reference) {
    return reference >= (leafFlag | instanceFlag) && reference < leaveInstance;
}

HYALITE_INLINE uint instanceOf(uint reference) { return reference & ~(leafFlag | instanceFlag); }

struct NodePair {
    vec3 leftLower;
    uint left;
    vec3 leftUpper;
    uint pad0;
    vec3 rightLower;
    uint right;
    vec3 rightUpper;
    uint pad1;
};

// The same tree with up to eight children a node (host/packing/wide_tree.h). The boxes of children are bytes of a grid that
// begins at `origin`: byte b is at origin + cell * b. `grid` has the biased exponents of the cell along x, y and z in its
// lower bytes, and a bit for each child that is there in the upper one. Words such as lowerX0 are for children 0 to 3, and
// lowerX1 for 4 to 7. A child's word is a reference as those of NodePair are.
struct WideNode {
    vec3 origin;
    uint grid;
    uint lowerX0;
    uint lowerX1;
    uint lowerY0;
    uint lowerY1;
    uint lowerZ0;
    uint lowerZ1;
    uint upperX0;
    uint upperX1;
    uint upperY0;
    uint upperY1;
    uint upperZ0;
    uint upperZ1;
    uint child0;
    uint child1;
    uint child2;
    uint child3;
    uint child4;
    uint child5;
    uint child6;
    uint child7;
};

const uint wideNodeWords = 24u;
const uint wideNodeChildren = 16u; // the word of child 0
const uint maxWideNodes = 0xFFFFFEu; // a traversal stack has a node and eight bits in a word, below leaveInstance

// Skip list: the same tree for traversal without a stack. Nodes are in depth-first order, each followed by its subtree,
// and know where a ray continues that misses them. There are two lists: lower siblings come first in one, upper
// siblings in the other. Boxes are rounded outward to a grid over all triangles, whose planes are signed 16-bit
// integers: the low half of a word is the lower plane, the high half the upper one.
//
// `link` of an inner node is the index to continue at; of a leaf it is leafFlag | index of its first triangle, and
// traversal continues with the next node. Where scenes have pairs, the link of a leaf of two triangles with a common
// edge, whose ids follow each other and which are alike except for emitters, also says where the edge is: it begins at
// the first one's corner number `leafFirstCorner`, and runs the other way in the second one, there from corner
// `leafSecondCorner` - 1.
struct SkipNode {
    uint x;
    uint y;
    uint z;
    uint link;
};

const uint leafRecordBits = 26u; // of the link, where scenes have pairs
const uint leafFirstCorner = 26u;
const uint leafSecondCorner = 28u; // 0: no pair

HYALITE_INLINE uint leafRecordOf(uint link) { return link & ((1u << leafRecordBits) - 1u); }
HYALITE_INLINE uint firstCornerOf(uint link) { return link >> leafFirstCorner & 3u; }
HYALITE_INLINE bool isPairOfTriangles(uint link) { return (link >> leafSecondCorner & 3u) != 0u; }
HYALITE_INLINE uint secondCornerOf(uint link) { return (link >> leafSecondCorner & 3u) - 1u; }

// ---- Materials and lights

const uint materialDiffuse = 0u;
const uint materialMirror = 1u;
const uint materialDielectric = 2u;
const uint materialConductor = 3u;
const uint materialPrincipled = 4u;
const uint materialGltf = 5u;
const uint noMaterial = 0xFFFFFFFFu;

// Dielectrics come first among the materials, in order of falling priority. Where several overlap, the one of the
// highest priority is there (shaders/bsdf/media.glsl).
const uint maxMedia = 8u;   // dielectrics that the path integrator tells apart
const uint mediumBits = 4u; // of the count of each of them in a word (shaders/bsdf/media.glsl)

struct MaterialRecord {
    vec3 albedo;       // conductor: reflectance at normal incidence; principled: base colour
    uint kindAndSides; // see kindOf, isTwoSided
    vec3 segmentTint;  // Whitted: factor on the radiance that a segment inside this dielectric returns
    float refractiveIndex;
    vec3 emission; // radiance on the side of the normal, on both if two-sided
    // path: pdf of a light sample at a point of the emitter, per unit of area
    float emitterPdf;
    vec3 absorption; // path: of this dielectric, per unit of length
    uint number;     // of its name, from 1 on
    // The rest is read only where constantScattering asks for it.
    vec3 conductorIndex;      // real part of the refractive index
    float alpha;              // of GGX: roughness squared; 0: smooth
    vec3 conductorExtinction; // imaginary part of the refractive index
    float metallic;
    // cosine-weighted average of a conductor's Fresnel reflectance: the loss of a second reflection
    vec3 averageReflectance;
    float transmission;
    float normalReflectance; // principled, dielectric part: reflectance at normal incidence
    float clearcoat;
    float clearcoatAlpha;
    uint textures; // row of its first texture, see below; 0: none
    // glTF: of the dielectric part, a factor on its reflectance at normal incidence, and one at all angles
    vec3 dielectricColour;
    float dielectricWeight;
    vec3 sheenColour;
    float sheenAlpha;       // of Charlie's distribution: roughness squared
    float anisotropy;       // strength
    float anisotropyCosine; // of its rotation from the tangent along u
    float anisotropySine;
    float alphaCutoff; // the surface is not there where its opacity is below; or alphaBlended
    float opacity;     // a factor on those of textures and vertices
    float clearcoatNormalStrength;
    uint lightGroup;  // of what it emits: among the layers of light
    float dispersion; // path: how the refractive index grows with 1 / wavelength^2, in micrometre^2
    // glTF: share of the surface that has an iridescent film, its refractive index, and its thickness in nanometres,
    // which a texture mixes with the minimum
    float iridescence;
    float iridescenceIndex;
    float iridescenceThickness;
    float iridescenceThicknessMinimum;
    // glTF: share of the base that light leaves on the other side, and the colour that it has there
    vec3 diffuseTransmissionColour;
    float diffuseTransmission;
};

// Flags of MaterialRecord::kindAndSides.
const uint materialIsTwoSided = 0x80000000u;       // reflects on both sides
const uint materialEmitsBehind = 0x40000000u;      // emits on both sides
const uint materialIsThin = 0x20000000u;           // glTF: what it transmits is not refracted
const uint materialIsSpecularGlossy = 0x10000000u; // glTF: textures of roughness have glossiness
const uint materialIsUnlit = 0x08000000u;          // glTF: shows its base colour
const uint materialCatchesShadows = 0x04000000u;   // see alpha.glsl
const uint materialKindMask = 0xFFu;

const float alphaBlended = -1.0f; // of alphaCutoff: the surface is there with the probability of its opacity

HYALITE_INLINE uint kindOf(MaterialRecord material) { return material.kindAndSides & materialKindMask; }

HYALITE_INLINE bool isTwoSided(MaterialRecord material) {
    return (material.kindAndSides & materialIsTwoSided) != 0u;
}

HYALITE_INLINE bool emitsBehind(MaterialRecord material) {
    return (material.kindAndSides & materialEmitsBehind) != 0u;
}

HYALITE_INLINE bool isThin(MaterialRecord material) { return (material.kindAndSides & materialIsThin) != 0u; }

HYALITE_INLINE bool isUnlit(MaterialRecord material) {
    return (material.kindAndSides & materialIsUnlit) != 0u;
}

HYALITE_INLINE bool catchesShadows(MaterialRecord material) {
    return (material.kindAndSides & materialCatchesShadows) != 0u;
}

// Needs of the scene's materials: bits of constantScattering.
const uint scattersAtConductors = 1u; // conductors, smooth or rough
const uint scattersAtRoughConductors = 2u;
const uint scattersAtRoughGlass = 4u; // dielectrics, and principled materials that transmit
const uint scattersAtPrincipled = 8u;
const uint scattersAtGltf = 16u;
const uint scattersAtRough = 30u; // any of those that need microfacets
// Features of glTF materials.
const uint scattersAtSheen = 32u;
const uint scattersAtAnisotropic = 64u;
const uint scattersAtThin = 128u;
const uint scattersAtCoatNormals = 256u; // a clear coat's normals differ from those below
const uint scattersAtUnlit = 512u;
const uint scattersAtIridescent = 1024u; // films
const uint scattersAtDiffuseTransmission = 2048u;
const uint scattersAtDispersion = 4096u; // glass that bends waves apart

// Any-hit tests: bits of constantAnyHit. A hit does not count
const uint anyHitCutOut = 1u;  // where the opacity of a surface is below a threshold
const uint anyHitBlended = 2u; // by chance, the more often the less opaque a surface is
const uint anyHitAlpha = 3u;   // any of those
const uint anyHitCulled = 4u;  // at triangles from behind

// Lookup tables, in rows of four numbers: the energy of microfacets (shaders/bsdf/energy.glsl), where
// constantScattering needs it; the environment; the pixel filter.
struct LookupRow {
    vec3 value;
    uint word; // another float, or an integer
};

// Textures, in rows of four words:
// - two tables with the values of the levels 0 to 255 of 8-bit images, four floats a row;
// - from firstCoordinateRow, rowsPerTriangle() rows for each triangle record: texture coordinates, u and v of v0 and
//   v1, then of v2; and where constantTexturing asks for them, second texture coordinates alike, then a row with the
//   colour of each corner, then one with the tangent of each corner;
// - for each material with textures, a TextureRecord for each of its parameters;
// - the texels of the images, from the top row down: one a row, as floats; or four a row, with 8 bits each for red,
//   green, blue and alpha from the lowest bits up.
struct TextureRow {
    uint x;
    uint y;
    uint z;
    uint w;
};

const uint rowsPerTable = 64u;
const uint srgbTableRow = 0u;
const uint linearTableRow = 64u;
const uint firstCoordinateRow = 128u;
const uint rowsPerCoordinates = 2u;

struct TextureRecord {
    uint firstRow; // of its texels
    uint size;     // of the image in pixels: width + height * 2^16; 0: there is no texture
    uint format;   // bits of textureIs...
    float factor;  // on roughness and metallic; of a normal map its strength
    float scaleU;  // coordinates are multiplied by scale, then moved by offset
    float scaleV;
    float offsetU;
    float offsetV;
    float shearU; // u' = scaleU u + shearU v + offsetU
    float shearV; // v' = shearV u + scaleV v + offsetV
    uint pad0;
    uint pad1;
};

const uint rowsPerTexture = 3u;
// Bits of TextureRecord::format.
const uint textureIsFloat = 1u;
const uint textureIsSrgb = 2u;
const uint textureChannelShift = 2u; // two bits: the channel that is read instead of all; 0: all
const uint textureChannelMask = 3u;
const uint textureIsAlpha = 12u; // channel 3
const uint textureUsesSecondUv = 16u;
const uint textureIsNearest = 32u;
const uint textureWrapShiftU = 6u; // two bits: wrap...
const uint textureWrapShiftV = 8u;
const uint textureWrapMask = 3u;

const uint wrapRepeat = 0u;
const uint wrapMirror = 1u;
const uint wrapClamp = 2u;

const uint slotBaseColour = 0u;
const uint slotEmission = 1u;
const uint slotRoughness = 2u;
const uint slotMetallic = 3u;
const uint slotNormal = 4u;
const uint slotOpacity = 5u;
const uint slotTransmission = 6u;
const uint slotClearcoat = 7u;
const uint slotClearcoatRoughness = 8u;
const uint slotClearcoatNormal = 9u;
const uint slotDielectricWeight = 10u;
const uint slotDielectricColour = 11u;
const uint slotSheenColour = 12u;
const uint slotSheenRoughness = 13u;
const uint slotAnisotropy = 14u; // red and green: a direction; blue: a factor on the strength
const uint slotIridescence = 15u;
const uint slotIridescenceThickness = 16u;
const uint slotDiffuseTransmission = 17u;
const uint slotDiffuseTransmissionColour = 18u;
const uint textureSlotCount = 19u;

// Bits of constantTexturing: the slots in which materials of the scene have textures, whether any texels have 8 bits,
// and what triangles and lookups need beyond one pair of coordinates and repeated images.
const uint texturesBaseColour = 1u;
const uint texturesEmission = 2u;
const uint texturesRoughness = 4u;
const uint texturesMetallic = 8u;
const uint texturesNormal = 16u;
const uint texturesOpacity = 32u;
const uint texturesLevels = 1u << textureSlotCount;
const uint texturesSecondUv = texturesLevels << 1u;
const uint texturesColours = texturesLevels << 2u;  // of vertices
const uint texturesTangents = texturesLevels << 3u; // of vertices
const uint texturesPlaced = texturesLevels << 4u; // images that are turned, mirrored, clamped or not filtered
// A channel that is not the red one, where one number is wanted.
const uint texturesChannels = texturesLevels << 5u;
// Triangles have texture coordinates. Without this bit their rows may be missing, where nothing else needs them.
const uint texturesCoordinates = texturesLevels << 6u;
const uint texturesTransmission = 1u << slotTransmission;
const uint texturesClearcoatNormal = 1u << slotClearcoatNormal;
const uint texturesAnisotropy = 1u << slotAnisotropy;
const uint texturesIridescence = (1u << slotIridescence) + (1u << slotIridescenceThickness);
const uint texturesDiffuseTransmission = (1u << slotDiffuseTransmission) + (1u << slotDiffuseTransmissionColour);
// Slots that change the material.
const uint texturesMaterials =
    texturesLevels - 1u - texturesNormal - texturesClearcoatNormal - texturesOpacity;
// Of these, the slots that only materials with lobes have.
const uint texturesOfLobes = texturesMaterials & ~(texturesBaseColour | texturesEmission);
// Slots whose levels are sRGB.
const uint texturesSrgb = texturesBaseColour + texturesEmission + (1u << slotDielectricColour) +
                          (1u << slotSheenColour) + (1u << slotDiffuseTransmissionColour);

HYALITE_INLINE uint rowsPerTriangle(uint texturing) {
    return rowsPerCoordinates + ((texturing & texturesSecondUv) != 0u ? rowsPerCoordinates : 0u) +
           ((texturing & texturesColours) != 0u ? 3u : 0u) + ((texturing & texturesTangents) != 0u ? 3u : 0u);
}

const uint energyCosines = 32u; // nodes of the table over the cosine, and over the roughness
const uint energyRoughnesses = 32u;
const uint energyCellCount = (energyCosines - 1u) * (energyRoughnesses - 1u);
const uint energyTexelCount = 2u * energyCellCount + energyRoughnesses - 1u;
const uint energyIndices = 20u; // nodes over the refractive index of rough glass, for each of its sides
const uint glassTexelCount = 2u * energyIndices * energyCellCount; // they follow, in scenes with rough glass
const uint sheenTexelCount = energyCellCount; // of scenes with sheen, from FrameRecord::sheenTexels on

// Lights without size, for the Whitted and the path integrator.
const uint lightPoint = 0u;
const uint lightSpot = 1u;
const uint lightDirectional = 2u;
const uint lightProfiled = 3u; // a point or a spot with the profile of a lamp: see lightKindOf, profileOf

struct LightRecord {
    vec3 position;
    uint kind; // with the index of its profile
    // radiant intensity, power / (4 pi), of a spot on its axis; irradiance of a directional light
    vec3 intensity;
    float cosineOuter; // of a spot: it is dark beyond this angle to its axis
    vec3 axis;         // unit direction in which light leaves
    // Of a spot: 1 / (cosine where it begins to fade - cosineOuter); negative: it fades by a square.
    float falloffScale;
};

const uint lightKindBits = 2u;

HYALITE_INLINE uint lightKindOf(LightRecord light) { return light.kind & ((1u << lightKindBits) - 1u); }

// A light's index among those with a profile.
HYALITE_INLINE uint profileOf(LightRecord light) { return light.kind >> lightKindBits; }

// A point light with a profile is a spot whose cone holds all directions.
const float cosineOfNoCone = -2.0f;
const float scaleOfNoCone = 2.0f;

// Profiles of lights (shaders/lights/profile.glsl), among the lookup rows from FrameRecord::lightProfiles on:
// - a row for each light with a profile: the direction where C is 0, and where its table begins, counted from there on;
// - each table: a row with the numbers of its intervals, those of gamma + those of C * 2^16; then a row for each interval
//   of gamma, and for each of C, with its lower end in turns, 1 / its length, and its upper end as a random number is
//   compared (word); then for each interval of C, and in it for each of gamma, a row with the shares at its four corners.

// Emitters: targets of the path integrator's shadow rays. Each shadow ray chooses one, with a probability in proportion
// to its power, or by the light tree. They are in the order of the input: lights, spheres, triangles, the environment.
// Where there is a light tree, directional lights and the environment, which are not in it, come before the others.
const uint emitterPoint = 0u;
const uint emitterSphere = 1u;
const uint emitterTriangle = 2u;
const uint emitterSpot = 3u;
const uint emitterDirectional = 4u;
const uint emitterEnvironment = 5u;
const uint emitterProfiled = 6u; // a point or a spot with a profile

struct EmitterRecord {
    vec3 position; // of a point light or a spot
    uint kind;
    vec3 emission; // radiance of a surface; intensity of a light, as above
    float probability;
    uint cumulative; // of 2^32 random numbers, those below it choose this emitter or one before it
    uint record;     // index among the sphere or the triangle records, or among the lights with a profile
    // of a triangle or a sphere, per unit of area, and in the light tree if it is chosen; of a spot its falloffScale
    float pdf;
    uint sidesAndGroup; // see isTwoSided, lightGroupOf
    vec3 axis;         // of a spot, a directional light, or one with a profile
    float cosineOuter; // of a spot
};

HYALITE_INLINE bool isTwoSided(EmitterRecord emitter) {
    return (emitter.sidesAndGroup & 1u) != 0u;
}

HYALITE_INLINE uint lightGroupOf(EmitterRecord emitter) {
    return emitter.sidesAndGroup >> 1u;
}

const uint noEmitter = 0x07FFFFFFu;

// A cluster of emitters with places: a child in the light tree (shaders/lights/light_tree.glsl). Siblings follow each
// other, the first two at index 0. `cumulative` of these emitters is the way to them: a bit for each node, 1 for the
// right child, from the lowest one on.
struct LightNode {
    vec3 centre;         // of a sphere around the emitters
    float share;         // of its parent's intensity
    vec3 axis;           // normals are within an angle of this direction; or, if two-sided, of its opposite
    float cosineNormals; // of that angle
    float squaredRadius;
    float cosineEmission; // of the angle to a normal within which light leaves
    float sineNormals;
    uint reference; // of its first child, or leafFlag | its emitter; with lightNodeIsTwoSided
};

const uint lightNodeIsTwoSided = 0x40000000u;
const uint maxLightTreeDepth = 32u;

// Bits of constantLighting, 1 << kind of emitter: what lights the scene. Emitting surfaces are included for the path
// integrator only.
const uint lightsByPoints = 1u << emitterPoint;
const uint lightsBySpheres = 1u << emitterSphere;
const uint lightsByTriangles = 1u << emitterTriangle;
const uint lightsBySpots = 1u << emitterSpot;
const uint lightsByDirections = 1u << emitterDirectional;
const uint lightsByEnvironment = 1u << emitterEnvironment; // an image around the scene
const uint lightsByProfiles = 1u << emitterProfiled;

// ---- Cameras

const uint cameraPinhole = 0u;
const uint cameraLens = 1u;         // a thin lens
const uint cameraOrthographic = 2u; // parallel rays
const uint cameraPanorama = 3u;     // all directions, by longitude and latitude
const uint kindOfCamera = 3u;
// Beside the kind: origins of primary rays may lie on both sides of glass.
const uint cameraOriginsMeetGlass = 4u;

// Views: what they show of the first hit.
const uint viewNormal = 0u; // for shading, from [-1, 1] to [0, 1]
const uint viewDepth = 1u;  // distance from the eye
const uint viewAlbedo = 2u; // base colour, or the reflectance of a metal; 1 for glass and mirrors
const uint viewId = 3u;     // a colour for each primitive
const uint viewOcclusion = 4u;
const uint viewCoordinates = 5u; // fractional parts of the texture coordinates
const uint viewShadow = 6u; // of shadow catchers: 1, a light sample, and what of it is blocked
// Of the denoiser: albedo, and beside it, in place of squares and transparency, what the views of normals and depths
// show.
const uint viewFeatures = 7u;
// From here on numbers, from 1 on; 0 for nothing.
const uint viewObject = 8u;
const uint viewMaterial = 9u;
const uint viewAsset = 10u;
const uint viewPlace = 11u;

// ---- Frame constants: the same for a whole render

const uint samplerCentre = 0u;
const uint samplerSobol = 1u;
const uint samplerFiltered = 2u; // Sobol points, distributed like the pixel filter

// Quantiles of the pixel filter, for samplerFiltered: [0, 1) in equal cells, a lookup row each, with the position in
// the pixel where the cell begins, and its width.
const uint filterCellCount = 256u;

struct FrameRecord {
    vec3 eye;
    uint imageWidth; // of the whole image, in pixels
    // The primary ray through the image position (x, y), in pixels with y down, has the direction
    //     pixelRight * (x - imageWidth/2) + pixelUp * (imageHeight/2 - y) + imagePlane
    // An orthographic camera adds the first two terms to the eye instead. For a panorama all three vectors have unit
    // length.
    vec3 pixelRight;
    uint imageHeight;
    vec3 pixelUp;
    uint seed;
    vec3 imagePlane;
    uint lightCount;
    vec3 background; // radiance
    float shadowThroughGlass;
    vec3 boundsLower; // of all primitives in the tree
    uint triangleCount;
    vec3 boundsUpper;
    uint maxDepth;       // maximum number of path segments, the primary ray included
    vec3 gridMiddle;     // of the skip lists' boxes: plane q is at gridMiddle + gridScale * q
    uint skipListLength; // nodes of one list
    vec3 gridScale;
    float occlusionDistance; // occluders further away are ignored
    // The environment: its texels, row by row from the top, and then a lookup row for each row of texels. `word` is the
    // cumulative distribution in units of 2^-32: over the texels of a row from the left, and over rows from the top;
    // value.x of a row is its probability.
    uint environmentTexels; // the first one
    uint environmentWidth;
    uint environmentHeight;
    float environmentTurns;       // about +y
    float environmentProbability; // of choosing it among all emitters
    float lensScale;              // the lens' radius in units of pixelRight and pixelUp
    float focusDistance;          // along the view direction
    float radianceLimit; // path: bound per channel on each contribution from the second hit on; or infinity
    uint filterTexels;   // the first one
    // Nodes of the scene's own tree in each skip list, or its triangles for ray queries; those of meshes with instances
    // follow.
    uint topListLength;
    uint firstTriangleId; // of the triangle with input index 0
    uint sheenTexels;     // the first one
    uint mediaAtEye;      // the glass around the eye (shaders/bsdf/media.glsl)
    uint mediumAtEye;     // the one that is there, or noMaterial: kernels do not branch on uniform values
    uint environmentGroup; // of light: of the environment, or the background
    uint lightProfiles; // the first lookup row of profiles
};

// ---- Dispatch constants
//
// A dispatch works on one tile of the film, with `samplesInFlight` paths for each pixel. `stepBudget` bounds the
// loop iterations of a path, and `workBudget` the work of all paths together: one that starts after it is spent
// makes only one pass. Unfinished ones wait in the path buffer for a dispatch with `isResumed` set.
struct DispatchConstants {
    uint cropX; // pixel of the whole image where the film begins, unless it is gathered
    uint cropY;
    uint filmWidth; // pixels, as the device has them (host/gpu/film_layout.h)
    uint filmHeight;
    uint tileX; // pixel of the film where the tile begins
    uint tileY;
    uint tileWidth; // pixels, a multiple of 8; the film may end inside the tile
    uint tileHeight;
    uint sampleBegin; // samples [sampleBegin, sampleEnd) are added to the film
    uint sampleEnd;
    uint stepBudget;
    uint isResumed; // 0: start the samples of the tile; 1: continue the waiting slots
    // Workgroup g works on block g % (count/interleave) * interleave + g / (count/interleave) of the tile. So a driver
    // that gives each thread one range of workgroups still spreads every part of the image over all threads.
    uint interleave;
    uint traceCapacity;  // events in the trace buffer
    uint workBudget;     // of DispatchProgress::workDone
    uint samplesPerSlot; // the mean number that are taken one after another
    uint isGathered;     // 1: the film's pixels are from anywhere in the image
    uint fit;            // of the denoiser
    uint pad0;
    uint pad1;
};

// The buffer of a gathered film has its pixels, and then a word for each of them: its position in the whole image.
const uint noPosition = 0xFFFFFFFFu; // there is no pixel

HYALITE_INLINE uint packPosition(uint x, uint y) { return x | y << 16u; }

// ---- Results

// Of the samples' radiance and transparency. Sums are compensated (shaders/math/sums.glsl): what is summed is a sum
// with its rest.
struct FilmPixel {
    vec3 sum;
    uint sampleCount;
    vec3 sumRest;
    float pad0;
    vec3 sumOfSquares;
    float transparency; // the sum of the samples'; 0 where the background is not transparent
    vec3 squaresRest;
    float transparencyRest;
};

// Where constantTallies is set, the words of a FilmPixel count samples by their numbers instead: they are pairs of a
// number and its count, in the order in which the numbers come first, with zeros for those that are free. The pair
// tallyOthers has the count of samples whose numbers found no pair, then the count of all samples. Samples of number 0
// are in no other count.
const uint tallyPairs = 8u;
const uint tallyOthers = 1u;
const uint tallyNumbers = tallyPairs - 1u; // that a pixel keeps apart

// ---- Layers of light: the radiance of samples by the way that it came, and by the emitters that it comes from

const uint lightEmission = 0u;   // seen as it is
const uint lightBackground = 1u; // likewise
const uint lightDiffuseDirect = 2u; // by the first surface that scatters: from an emitter, or indirectly
const uint lightDiffuseIndirect = 3u;
const uint lightGlossyDirect = 4u;
const uint lightGlossyIndirect = 5u;
const uint lightTransmissionDirect = 6u;
const uint lightTransmissionIndirect = 7u;
const uint lightClassCount = 8u;

const uint lightWordsPerPlane = 6u; // of a pixel: three sums of samples, three rests
const uint maxLightGroups = 16u;
const uint lightStateWords = 23u; // of a path that waits, beside three for each group

// A sample that waits to be added to the film: two records where its transparency is wanted, the second one with that
// as `radiance.x`.
struct SampleRecord {
    vec3 radiance;
    uint finished; // 0: it is not; else the counts of its rays (shaders/drive/places.glsl)
};

const uint bitsPerCount = 7u; // at most maxPathDepth of each
const uint countMask = 127u;
const uint sampleIsFinished = 1u << 28u;

// Counters of one dispatch, summed over all slots.
struct DispatchProgress {
    uint unfinishedSlots;
    uint stackOverflows; // subtrees that did not fit on the stack: 0 with any valid tree
    uint finishedSamples;
    uint traceEvents; // including those that did not fit into the trace buffer
    uint primaryRays; // rays of samples that are in the film
    uint shadowRays;
    uint reflectionRays;
    uint refractionRays;
    uint bounceRays; // scattered by surfaces that are not specular
    // roughly in traversal steps: of the busiest lane of each subgroup, or of each lane
    uint workDone;
    // The rest is counted only where constantIsCounting is set.
    uint traversalPasses; // of subgroups through the loops of the traversal
    uint busySlots;       // slots with a node or a triangle to test, summed over passes
    uint nodesVisited;
    uint boxesTested;
    uint trianglesTested;
    uint deepestStack; // the maximum of all slots, not a sum
};

// ---- Trace: what a path did, step by step, to find where two renderers differ

const uint traceRayOrigin = 0u;
const uint traceRayDirection = 1u;
const uint traceHit = 2u; // integer: the primitive's id; value: distance, u, v
const uint traceSurfacePosition = 3u;
const uint traceSurfaceNormal = 4u;
const uint traceThroughput = 5u;  // of the segment at its hit, tint included
const uint traceReflectance = 6u; // at glass; integer: 1 where reflection is total; value: reflectance
const uint traceVisibility = 7u;  // integer: 0 unlit, 1 blocked, 2 dimmed by glass, 3 clear
const uint traceRadiance = 8u;    // of the sample so far, after light was added to it
const uint traceScatter = 9u;     // integer: bits of the pdf; value: direction of the scattered ray
const uint traceQuantityCount = 10u;

const uint visibilityUnlit = 0u;
const uint visibilityBlocked = 1u;
const uint visibilityDimmed = 2u;
const uint visibilityClear = 3u;

struct TraceEvent {
    uint quantity;
    uint sampleIndex;
    uint rayDepth; // segment number of the ray
    uint integer;
    vec3 value;
    uint pad0;
};

// ---- Paths, as they wait between two dispatches

const uint seenFromBehind = 0x80000000u; // against the normal of the input

const uint waitingIsDimmed = 1u;    // the shadow ray has passed glass
const uint waitingIsDispersed = 2u; // see dispersion.glsl

struct PathRecord {
    vec3 rayOrigin;
    uint stage;
    vec3 rayDirection;
    float rayLength; // nearest hit so far, or the distance to the light
    vec3 throughput;
    uint rayExcluded; // the primitive at the ray's origin, which it cannot hit
    float hitU;       // weights of v0 and v1 at the nearest hit so far
    float hitV;
    uint hitPrimitive; // its id
    uint hitRecord;    // its index among the sphere or the triangle records
    vec3 surfacePosition;
    uint surfacePrimitive;
    vec3 surfaceNormal;
    uint lightIndex;
    vec3 surfaceGeometricNormal;
    uint rayDepth;      // segment number of the current ray: 1 for a primary ray
    vec3 surfaceWeight; // what the light adds if it is visible; whitted: throughput * albedo / pi
    uint rayMedium;     // material of the glass around the ray, or noMaterial
    vec3 surfaceError;  // bound on the rounding error of surfacePosition
    uint sampleIndex;
    vec3 sampleRadiance;
    uint pendingCount;   // rays in the pending buffer
    uint cursorNode;     // the inner node to visit next, or noNode
    uint cursorTriangle; // the triangle of the leaf to test next, in skip lists as a link has it, or noNode
    uint stackSize;      // subtrees in the stack buffer
    uint flags;          // waiting...
    uint cursorInstance; // whose tree the cursor is in, or noInstance
    uint cursorReturn;   // skip lists: the node after the instance's own
    uint hitInstance;    // of the triangle at the nearest hit so far, or noInstance
    float transparency;  // of the sample, see alpha.glsl
    // Of the path integrator:
    vec3 scatterDirection; // of the ray that leaves the surface
    float scatterPdf;      // of the current ray's direction, per solid angle; 0: a specular direction
    uint rayTarget;        // the primitive at which the shadow ray is aimed
    uint mediaInside;      // the glass around the current ray, see media.glsl
    // Rays of samples that are not in the film yet:
    uint primaryRays;
    uint shadowRays;
    uint reflectionRays;
    uint refractionRays;
    uint bounceRays;
    uint surfaceMaterial; // where constantScattering needs it; with seenFromBehind
};

const uint pathRecordWords = 60u;

// A ray that glass has split off, to be traced later: at most one for each level of depth.
struct PendingRay {
    vec3 origin;
    uint excluded;
    vec3 direction;
    uint depth;
    vec3 throughput;
    uint medium;
};

const uint maxPendingInRegisters = 8u;

// ---- Specialization constants: features that a scene does not use cost nothing

const uint constantWorkgroupSize = 0u;
const uint constantSphereCount = 1u;
const uint constantHasTriangles = 2u;
const uint constantHasSpecular = 3u; // mirrors or dielectrics
const uint constantHasDielectric = 4u;
const uint constantSampler = 5u;
const uint constantStackSize = 6u;
const uint constantIsTracing = 7u;       // path 0 writes into the trace buffer
const uint constantExactDivision = 8u;   // the device's own / and sqrt are correctly rounded
const uint constantSamplesInFlight = 9u; // slots of one pixel: a power of two, at most the subgroup's size
const uint constantIsResumable = 10u;    // unfinished slots wait in the path buffer
const uint constantLightCount = 11u;
const uint constantPendingInRegisters = 12u; // pending rays in registers; 0: they are in the buffer
const uint constantIsCounting = 13u;         // count the work of the traversal
const uint constantEmitterCount = 14u;
const uint constantHasEmission = 15u; // materials of primitives that emit
const uint constantView = 16u;        // which view
const uint constantShowsCost = 17u;   // a sample is its work: nodes, boxes, triangles
const uint constantScattering = 18u;  // path: bits scattersAt...
const uint constantLighting = 19u;
const uint constantCamera = 20u;
const uint constantTexturing = 21u;
const uint constantHasInstances = 22u;
const uint constantTreeSpheres = 23u; // what the tree holds
const uint constantHasLightTree = 24u;
const uint constantInfiniteEmitters = 25u; // of a scene with a light tree: emitters that are not in it
const uint constantAnyHit = 26u;
const uint constantTrianglePairs = 27u;    // skip lists: all triangles in turn, as so many pairs; 0: the tree
const uint constantPathRegeneration = 28u; // slots go from sample to sample: path_regeneration.glsl
const uint constantBroadcasts = 29u;       // subgroups of broadcastLanes exchange values by broadcasts
const uint constantHasPairs = 30u;         // skip lists: leaves may be pairs of triangles
const uint constantHasNormals = 31u;       // of corners of triangles
const uint constantAlpha = 32u;            // which background is transparent: alpha...
const uint constantPlaceCount = 33u;
const uint constantTallies = 34u;      // the film counts samples by their numbers
const uint constantLooksThrough = 35u; // views: through mirrors and glass
const uint constantLightClasses = 36u; // bits 1 << light...: planes of the film
const uint constantLightGroups = 37u;  // how many groups have planes, behind those of classes
const uint constantCount = 38u;

const uint broadcastLanes = 16u;

const uint alphaOfNothing = 0u;
const uint alphaOfBackground = 1u;
const uint alphaThroughGlass = 2u;

const uint treeHasTriangles = 0u;
const uint treeHasSpheresToo = 1u;
const uint treeHasSpheresOnly = 2u;

#ifdef __cplusplus
static_assert(sizeof(SphereRecord) == 32 && offsetof(SphereRecord, radius) == 16);
static_assert(sizeof(TriangleRecord) == 48 && offsetof(TriangleRecord, flags) == 44);
static_assert(sizeof(TrianglePair) == 64 && offsetof(TrianglePair, v3) == 48);
static_assert(sizeof(NormalRecord) == 48 && offsetof(NormalRecord, n2) == 32);
static_assert(sizeof(InstanceRecord) == 128 && offsetof(InstanceRecord, slack) == 96);
static_assert(sizeof(PlaceRecord) == 16);
static_assert(sizeof(SkipNode) == 16);
static_assert(sizeof(NodePair) == 64 && offsetof(NodePair, right) == 44);
static_assert(sizeof(MaterialRecord) == 224 && offsetof(MaterialRecord, iridescence) == 192);
static_assert(sizeof(LookupRow) == 16);
static_assert(sizeof(TextureRow) == 16);
static_assert(sizeof(TextureRecord) == rowsPerTexture * sizeof(TextureRow));
static_assert(firstCoordinateRow == linearTableRow + rowsPerTable &&
              linearTableRow == srgbTableRow + rowsPerTable);
static_assert(sizeof(EmitterRecord) == 64 && offsetof(EmitterRecord, sidesAndGroup) == 44);
static_assert(sizeof(LightNode) == 48 && offsetof(LightNode, reference) == 44);
static_assert(sizeof(LightRecord) == 48 && offsetof(LightRecord, intensity) == 16);
static_assert(sizeof(FrameRecord) == 208 && offsetof(FrameRecord, boundsUpper) == 96);
static_assert(sizeof(DispatchConstants) == 80, "push constants: at most 128 bytes everywhere");
static_assert(sizeof(SampleRecord) == 16);
static_assert(countMask >= maxPathDepth && sampleIsFinished >= 1u << 4u * bitsPerCount);
static_assert(sizeof(FilmPixel) == 64 && offsetof(FilmPixel, sumOfSquares) == 32);
static_assert(sizeof(FilmPixel) == tallyPairs * 2 * sizeof(uint) &&
              offsetof(FilmPixel, sampleCount) == (2 * tallyOthers + 1) * sizeof(uint));
static_assert(sizeof(DispatchProgress) == 64);
static_assert(sizeof(TraceEvent) == 32 && offsetof(TraceEvent, value) == 16);
static_assert(sizeof(PathRecord) == pathRecordWords * sizeof(uint) && offsetof(PathRecord, rayTarget) == 208);
static_assert(sizeof(PendingRay) == 48 && offsetof(PendingRay, medium) == 44);
} // namespace hyalite::core::layout
#endif
#undef HYALITE_INLINE
#endif
