// Random dimensions: the table of the pairs of random numbers that a sample takes. Other files call them by these
// names; none has a number of a pair. pairKeys() makes the hash keys of a pair.
//
// | pairs     | name                             | taken by                                                         |
// |-----------|----------------------------------|------------------------------------------------------------------|
// | 0         | pixelPair                        | every sample: its position in the pixel                          |
// | 1         | occlusionPair                    | view `ao`: the direction to the sky                              |
// | 1 to 96   | vertexPair(depth, pair...)       | path: three at each vertex; views: at a shadow catcher, at glass |
// | 97 to 128 | lobePair(depth)                  | path: a lobe, at a vertex that scatters                         |
// | 129       | wavelengthPair                   | path: its wavelength, where dispersion asks for one              |
// | 1024      | lensPair                         | cameras with a lens: the point on the lens                       |
// | 24295     | alphaTestPair                    | alpha tests: beside the primitive and the ray, a key of its own  |
//
// Rows of one integrator do not overlap (tests/shaders/dimensions_test.cpp); a view has one of them. A new
// use takes pairs that no row has: another number, or a pair taken twice, changes every picture.

const uint pixelPair = 0u;

const uint occlusionPair = 1u;

const uint pairChoice = 0u; // an emitter, or a side of an interface; and whether the path survives
const uint pairLight = 1u;
const uint pairScatter = 2u;
const uint pairsPerVertex = 3u;

// `depth`, from 1 to maxPathDepth, is the number of the segment that ends at the vertex.
uint vertexPair(uint depth, uint pair) { return 1u + pairsPerVertex * (depth - 1u) + pair; }

uint lobePair(uint depth) { return 1u + pairsPerVertex * maxPathDepth + depth - 1u; }

const uint wavelengthPair = 1u + (pairsPerVertex + 1u) * maxPathDepth;

const uint lensPair = 1024u;

const uint alphaTestPair = 0x5EE7u;
