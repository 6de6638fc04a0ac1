// The BSDF at a hit: what its lobes need, and what evaluating it gives.
//
// All directions are unit vectors in the frame of the surface, whose normal is +z on the side of the viewer: `wo` leads back
// along the path, `wi` towards the light. The lobes stand in a file each: diffuse, opaque_ggx (metal and plastic),
// glass_ggx, and clearcoat; principled.glsl mixes them, and bsdf.glsl chooses among them.

const uint bsdfDiffuse = 0u;
const uint bsdfOpaque = 1u;
const uint bsdfGlass = 2u;

struct Bsdf {
    Frame frame; // its z is the normal on the side of the viewer
    vec3 wo;     // unit length, in the frame; wo.z > 0
    uint kind;   // bsdf...
    float alpha;
    float roughness; // square root of alpha
    float stretchWo; // stretchOf(wo, alpha)
    bool isConductor;
    vec3 index; // of a conductor
    vec3 extinction;
    vec3 reflectance;         // of facets of what is no conductor, head on; the albedo of what is diffuse
    float eta;                // of glass: the refractive index before divided by the one beyond
    vec3 tint;                // of what glass lets pass
    vec3 multiScatter;        // what metal reflects after more than one bounce between facets, before (1 - E(wi)) cos
    vec3 diffuseBase;         // what is reflected from below a plastic surface, before (1 - E(wi)) cos
    float plasticReflectance; // of that surface, head on
    float clearcoat;          // how much of a coat is above
    float clearcoatRoughness;
    float clearcoatEnergy;     // what the coat reflects of wo
    float weight;              // 1 / the probability with which this component was chosen, of its share
    float specularProbability; // that a direction is drawn by facets
};

struct BsdfEval {
    vec3 value; // the BSDF times |cos| of wi to the normal
    float pdf;  // of wi, per solid angle; 0: it cannot be drawn
};

vec3 toLocal(Frame f, vec3 v) { return vec3(dotProduct(f.x, v), dotProduct(f.y, v), dotProduct(f.z, v)); }
