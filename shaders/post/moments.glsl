// The sums of a regression over the neighbours of an anchor. All is written out, for each feature m and those up to it:
// drivers take seconds to unroll loops in loops.
#define UP_TO_0(DO, m) DO(m, 0)
#define UP_TO_1(DO, m) UP_TO_0(DO, m) DO(m, 1)
#define UP_TO_2(DO, m) UP_TO_1(DO, m) DO(m, 2)
#define UP_TO_3(DO, m) UP_TO_2(DO, m) DO(m, 3)
#define UP_TO_4(DO, m) UP_TO_3(DO, m) DO(m, 4)
#define UP_TO_5(DO, m) UP_TO_4(DO, m) DO(m, 5)
#define UP_TO_6(DO, m) UP_TO_5(DO, m) DO(m, 6)
#define UP_TO_7(DO, m) UP_TO_6(DO, m) DO(m, 7)
#define ROWS_BELOW_1(ROW) ROW(0, UP_TO_0)
#define ROWS_BELOW_2(ROW) ROWS_BELOW_1(ROW) ROW(1, UP_TO_1)
#define ROWS_BELOW_3(ROW) ROWS_BELOW_2(ROW) ROW(2, UP_TO_2)
#define ROWS_BELOW_4(ROW) ROWS_BELOW_3(ROW) ROW(3, UP_TO_3)
#define ROWS_BELOW_5(ROW) ROWS_BELOW_4(ROW) ROW(4, UP_TO_4)
#define ROWS_BELOW_6(ROW) ROWS_BELOW_5(ROW) ROW(5, UP_TO_5)
#define ROWS_BELOW_7(ROW) ROWS_BELOW_6(ROW) ROW(6, UP_TO_6)
#define ROWS(ROW) ROWS_BELOW_7(ROW) ROW(7, UP_TO_7)

struct Moments {
    float products[productCount]; // of features m and l at m (m + 1) / 2 + l
    vec3 sums[featureCount];      // of products with colours
};

#define CLEAR_PRODUCT(m, l) moments.products[m * (m + 1) / 2 + l] = 0.0;
#define CLEAR_ROW(m, UP_TO_M) UP_TO_M(CLEAR_PRODUCT, m) moments.sums[m] = vec3(0.0);

Moments noMoments() {
    Moments moments;
    ROWS(CLEAR_ROW)
    return moments;
}

#define ADD_PRODUCT(m, l) moments.products[m * (m + 1) / 2 + l] += weighted * features[l];
#define ADD_ROW(m, UP_TO_M) \
    weighted = weight * features[m]; \
    UP_TO_M(ADD_PRODUCT, m) \
    moments.sums[m] += weighted * colour;

void add(inout Moments moments, float weight, float features[featureCount], vec3 colour) {
    float weighted;
    ROWS(ADD_ROW)
}

#define LOAD_PIVOT(m, l) pivot[l] = moments.products[m * (m + 1) / 2 + l];
#define SUBTRACT_PRODUCT(l, k) moments.products[l * (l + 1) / 2 + k] -= factor * pivot[k];
#define SUBTRACT_ROW(l, UP_TO_L) \
    factor = pivot[l] * inverse; \
    UP_TO_L(SUBTRACT_PRODUCT, l) \
    moments.sums[l] -= factor * pivotSum;
#define ELIMINATE(m, UP_TO_M, ROWS_BELOW_M) \
    UP_TO_M(LOAD_PIVOT, m) \
    pivotSum = moments.sums[m]; \
    inverse = divide(1.0, greater(pivot[m] + ridge, 1e-7)); \
    inverses[m] = inverse; \
    ROWS_BELOW_M(SUBTRACT_ROW)
#define SUBTRACT_KNOWN(m, l) moments.sums[m] -= moments.products[m * (m + 1) / 2 + l] * moments.sums[l];
#define SUBSTITUTE(m, UP_TO_BELOW_M) \
    UP_TO_BELOW_M(SUBTRACT_KNOWN, m) \
    moments.sums[m] = moments.sums[m] * inverses[m];

// Coefficients of the features in place of the sums: elimination from the last feature to the constant, and back.
void solve(inout Moments moments) {
    float ridge = moments.products[0] * 1e-5;
    float pivot[featureCount];
    vec3 pivotSum;
    float inverse;
    float inverses[featureCount];
    float factor;
    ELIMINATE(7, UP_TO_7, ROWS_BELOW_7)
    ELIMINATE(6, UP_TO_6, ROWS_BELOW_6)
    ELIMINATE(5, UP_TO_5, ROWS_BELOW_5)
    ELIMINATE(4, UP_TO_4, ROWS_BELOW_4)
    ELIMINATE(3, UP_TO_3, ROWS_BELOW_3)
    ELIMINATE(2, UP_TO_2, ROWS_BELOW_2)
    ELIMINATE(1, UP_TO_1, ROWS_BELOW_1)
    moments.sums[0] = moments.sums[0] * divide(1.0, greater(moments.products[0], 1e-7));
    SUBSTITUTE(1, UP_TO_0)
    SUBSTITUTE(2, UP_TO_1)
    SUBSTITUTE(3, UP_TO_2)
    SUBSTITUTE(4, UP_TO_3)
    SUBSTITUTE(5, UP_TO_4)
    SUBSTITUTE(6, UP_TO_5)
    SUBSTITUTE(7, UP_TO_6)
}
