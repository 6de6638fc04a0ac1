// What a slot waits for. Requests of paths are stages, too.

const uint stageNextSample = 0u; // begin the next sample
const uint stageResume = requestResume;
const uint stageNewRay = requestNearest;
const uint stageNearest = 3u;    // tracing for the nearest hit
const uint stageTurn = requestTurn;
const uint stageNewShadow = requestVisibility;
const uint stageShadow = 6u;     // tracing for anything that blocks the ray
const uint stageSampleDone = requestEnd; // waits for the samples of the pixel's other slots
const uint stageDone = 8u;       // all samples of the pixel are in the film
