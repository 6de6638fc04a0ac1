// Bsdf: the parameters of all lobes at a hit. BsdfEval: a value with its pdf.
//
// All directions are unit vectors in the frame of the surface, whose +z is the normal on the side of the viewer: `wo`
// leads back along the path, `wi` towards the light. Each lobe has a file: diffuse, opaque_ggx (metal and plastic),
// glass_ggx, clearcoat, and sheen; iridescence.glsl is a film on facets. principled.glsl and gltf.glsl mix them, and
// bsdf.glsl chooses among them.

const uint bsdfDiffuse = 0u;
const uint bsdfOpaque = 1u;
const uint bsdfGlass = 2u;
const uint bsdfSheen = 3u;

struct Bsdf {
    Frame frame; // its z is the normal on the side of the viewer
    vec3 wo;     // unit length, in the frame; wo.z > 0
    uint kind;   // bsdf...
    float alpha;
    vec2 alphas;     // along x and y, where there is anisotropy
    float roughness; // square root of alpha
    float stretchWo; // stretchOf(wo, alpha)
    bool isConductor;
    vec3 index; // of a conductor
    vec3 extinction;
    vec3 reflectance;         // of facets at normal incidence, unless a conductor; of a diffuse surface its albedo
    float grazing;            // of facets at grazing angles
    float eta;                // of glass: refractive index on the side of wo divided by that on the other side
    vec3 tint;                // of light that passes glass
    vec3 multiScatter;        // multiple scattering between facets of metal, without the factor (1 - E(wi)) cos
    vec3 diffuseBase;         // diffuse reflection below a plastic surface, without the factor (1 - E(wi)) cos
    float plasticReflectance; // of that surface, at normal incidence
    float plasticGrazing;     // at grazing angles
    vec3 thinTint;            // of thin glass: of light that passes, with what facets lose of it
    float thinProbability;    // of sampling a facet that lets light pass
    vec3 diffuseTransmission; // as diffuseBase, of what leaves on the other side
    float diffuseTransmissionProbability; // of sampling it
    float weight; // share of the chosen component divided by the probability of choosing it; of glass by its energy too
    float specularProbability; // of sampling a facet instead of the diffuse part
    Iridescence iridescence;
};

bool hasFilm(Bsdf bsdf) { return (scattering & scattersAtIridescent) != 0u && bsdf.iridescence.share > 0.0; }

struct BsdfEval {
    vec3 value; // the BSDF times |cos| of wi to the normal
    float pdf;  // of wi, per solid angle; 0: never sampled
};

vec3 toLocal(Frame f, vec3 v) { return vec3(dotProduct(f.x, v), dotProduct(f.y, v), dotProduct(f.z, v)); }

// The smallest cosine of the viewer to the normal. Lobes divide by it.
const float minViewCosine = 1e-6;

// wo of a viewer in the direction `toViewer`, a unit vector not below the surface.
vec3 viewerInFrame(Frame f, vec3 toViewer) {
    vec3 wo = toLocal(f, toViewer);
    return vec3(vec2(wo), greater(wo.z, minViewCosine));
}

// The random number of a choice in [0, 1) that was not below `share`, spread over [0, 1) again.
float choiceBeyond(float choice, float share) {
    float above = choice - share;
    float rest = 1.0 - share;
    return lesser(divide(above, rest), 16777215.0 / 16777216.0);
}
