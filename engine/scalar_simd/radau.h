/*
 * A trial step of Radau IIA: collocation at 3 or 5 points, of order 5 or 9, L-stable. All stages are found by
 * simplified Newton iterations, which a change of basis splits into one real and one or two complex systems of the size
 * of one stage. The error is that of an embedded formula of order 3 or 5, filtered by the real matrix. E. Hairer, G.
 * Wanner, Solving Ordinary Differential Equations II, Springer (1996), section IV.8; the same, Stiff differential
 * equations solved by Radau methods, J. Comput. Appl. Math. 111 (1999) 93-111.
 */
/* degree of the dense output; its factors 1 - s (Method) */
enum { RADAU_DEGREE = 5, RADAU_REVERSED = 0xA };
enum { RADAU_MAX_STAGES = 5, RADAU_MAX_ITERATIONS = 14, RADAU_MAX_FIXED_ITERATIONS = 60 };
#define RADAU_STAGE_TOL 3e-3   /* of a step's tolerance: error of its stages */
#define RADAU_ROUNDING 4e-16 /* of the state: change by rounding */
#define RADAU5_ERROR_FRACTION 0.85 /* of a step: where the error of the dense output is largest */
#define RADAU9_ERROR_FRACTION 0.74 /* the same for radau9 */
#define RADAU_MAX_NOISE_RATIO 2.5e4   /* to that: largest change by rounding if rates are differences of large forces */

/*
 * The coefficients of a method. Butcher's inverse is T diag(gamma, pairs) T^-1 in real form: after the first, two
 * columns of T (to_stages) and two rows of T^-1 (from_stages) are real and imaginary parts. `dense`: the coefficients
 * of the collocation polynomial.
 */
typedef struct {
    double node[RADAU_MAX_STAGES], gamma, pair[RADAU_MAX_STAGES / 2][2], to_stages[RADAU_MAX_STAGES][RADAU_MAX_STAGES],
        from_stages[RADAU_MAX_STAGES][RADAU_MAX_STAGES], error[RADAU_MAX_STAGES],
        dense[RADAU_MAX_STAGES][RADAU_MAX_STAGES];
} RadauTable;

static const RadauTable RADAU5 = {
    .node = {0.15505102572168219, 0.64494897427831781, 1.0},
    .gamma = 3.6378342527444957, .pair = {{2.6810828736277521, 3.0504301992474106}},
    .to_stages = {
        {0.094438762488975241, -0.28251059004190842, -0.060058388210294849},
        {0.25021312296533331, 0.40825870458759986, 0.76588422551452388},
        {1.0, 2.0, 0.0}},
    .from_stages = {
        {4.1787185915519047, 0.32768282076106239, 0.52337644549944955},
        {-2.0893592957759524, -0.16384141038053119, 0.23831177725027523},
        {-0.25143631747289344, 1.2859634749278027, -0.29801960241411246}},
    .error = {-2.7623054547485994, 0.37993559825272888, -0.091629609865225789},
    .dense = {
        {0.0, 0.0, 1.0},
        {10.048809399827416, -1.3821427331607489, -0.66666666666666667},
        {-15.580782047249224, 8.9141153805825572, -3.3333333333333333}}};

static const RadauTable RADAU9 = {
    .node = {0.057104196114517682, 0.27684301363812383, 0.58359043236891682, 0.86024013565621945, 1.0},
    .gamma = 6.2867047517292766, .pair = {{5.7009532986717894, 3.2102656003085499}, {3.6556943254635723,
        6.5437368993600773}},
    .to_stages = {
        {0.013576867344947943, -0.022957030510459029, -0.028039717785750821, -0.020484095635817654,
         0.095347754580591448},
        {0.0016179004017190875, -0.015337661498360326, 0.049417156853037054, 0.10034572903474212, -0.18866363836322287},
        {0.079157853347447208, 0.038796927997657902, 0.16360070740750234, -0.46107906808683589, 0.2054060907602518},
        {0.41225608268046145, 0.81520234256039813, 0.39936485577360505, 0.7557878044977225, 0.93348826066498872},
        {1.0, 2.0, 0.0, 2.0, 0.0}},
    .from_stages = {
        {27.697693775684088, 12.783337911304406, 3.2084893867134299, -0.95149041224891622, 0.7415504960259896},
        {-16.5209401067595, -8.6884767395317835, -0.086064531627002781, -0.049584888991271321, 0.26561405791915333},
        {-4.305721989937646, 4.8499957047644041, 0.95736431984843714, 1.20934600304247, -0.52373174396766871},
        {2.6720932189174558, 2.2968077838795805, -1.5181801617297121, 0.52533009511572943, -0.13638930593214814},
        {1.8740299037199024, -1.9924828681719423, -0.5222078208040094, 0.59204928406897424, -0.22495888507839018}},
    .error = {-4.4189977167963817, 0.57923485225667005, -0.19923756095346801, 0.094167483691945489,
        -0.031813168885493824},
    .dense = {
        {0.0, 0.0, 0.0, 0.0, 1.0},
        {27.780933944064637, -3.6414784980492132, 1.2525477211691187, -0.59200316718454287, -0.8},
        {-36.193358167658926, 10.611734614705874, -10.029661925319592, 18.811285478272644, -11.2},
        {-144.05356518917777, 63.630162942362741, -17.885204671340986, -5.2913930818439813, 5.6},
        {199.88739542347736, -127.022853068795, 92.10283313613322, -64.167375490815583, 25.2}}};

/*
 * Compute the coefficients d of the dense output of a step, without accelerations at its ends: the collocation
 * polynomial through its stages. values: those of the stages, the last one the change over the step.
 */
static inline void compute_collocation_polynomial(const RadauTable *table, int stages, const Real *const *values,
    Real (*d)[N_Y])
{
    for (int k = 0; k < RADAU_MAX_STAGES; k++)
        for (int i = 0; i < N_Y; i++)
            d[k][i] = make_real(0.0);
    for (int k = 0; k < stages; k++)
        for (int s = 0; s < stages; s++) {
            const double factor = table->dense[k][s];
            for (int i = 0; i < N_Y; i++)
                d[k][i] += factor * values[s][i];
        }
}

/*
 * Compute the state y (N_Y) at fraction s of a step, by the dense output of degree 5 in nested form: y = y0 + s (d0 + r
 * (d1 + s (d2 + r (d3 + s d4)))), r = 1 - s. y0: state at the beginning; dense_coefficients: d0 to d4, as
 * compute_collocation_polynomial() returns them. Called for dense output, by single runs and by lanes.
 */
static inline void evaluate_collocation_polynomial(
    const Real *y0, const Real (*dense_coefficients)[N_Y], double s, Real *y)
{
    const double r = 1.0 - s;
    const Real (*const d)[N_Y] = dense_coefficients;
    for (int i = 0; i < N_Y; i++)
        y[i] = y0[i] + s * (d[0][i] + r * (d[1][i] + s * (d[2][i] + r * (d[3][i] + s * d[4][i]))));
}

/* Rates of the dense output of each method at the ends of a step. */
static const EndRateWeights radau5_end_rates = {
    .begin = {10.048809399827416, -1.3821427331607489}, .n_begin = 2, .begin_weight_of_end = 1.0 / 3.0,
    .end = {5.5319726474218083, -7.5319726474218083}, .n_end = 2, .end_weight_of_end = 5.0};
static const EndRateWeights radau9_end_rates = {
    .begin = {27.780933944064637, -3.6414784980492132, 1.2525477211691187, -0.59200316718454287}, .n_begin = 4,
    .begin_weight_of_end = 0.2,
    .end = {8.4124242235942887, -6.970256115656661, 8.7771142041504732, -18.219282311088101}, .n_end = 4,
    .end_weight_of_end = 13.0};

#define RADAU_STAGES 3
#define RADAU(name) radau5_##name
#define RADAU_TABLE RADAU5
#include "radau_step.h"
#undef RADAU_STAGES
#undef RADAU
#undef RADAU_TABLE

#define RADAU_STAGES 5
#define RADAU(name) radau9_##name
#define RADAU_TABLE RADAU9
#include "radau_step.h"
