// Everything that integrators use: leaf functions, memory, and traversals.
#include "shaders/memory/scene_data.glsl"
#include "shaders/memory/counters.glsl"
#include "shaders/math/arithmetic.glsl"
#include "shaders/leaves.glsl"
#include "shaders/trace/preloaded.glsl"
#include "shaders/trace/ray.glsl"
#include "shaders/trace/trace.glsl"
#include "shaders/trace/begin.glsl"
#include "shaders/integrators/path_state.glsl"
#if SPLITS_RAYS
#include "shaders/integrators/pending_rays.glsl"
#endif
#include "shaders/integrators/light_layers.glsl"
#include "shaders/integrators/alpha.glsl"
#include "shaders/integrators/media_at_origin.glsl"
#include "shaders/integrators/next.glsl"
