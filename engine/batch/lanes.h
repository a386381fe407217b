/*
 * Several runs side by side: a number of each in the lanes of one vector (extensions of gcc and clang). Lane by lane
 * the operations are those of a single run, in the same order, so that the results are the same to the last bit;
 * functions that only the library has are called for one lane after the other.
 */
#ifndef GUDGEON_LANES_H
#define GUDGEON_LANES_H

#if defined(__AVX512F__)
enum { LANES = 8 };
#elif defined(__AVX__)
enum { LANES = 4 };
#else
enum { LANES = 2 };
#endif
typedef double Lanes __attribute__((vector_size(8 * LANES)));
typedef long long LaneBits __attribute__((vector_size(8 * LANES)));

static inline Lanes all_of(double x) { return x - (Lanes){0.0}; }

/* a where the mask is set, else b. */
static inline Lanes pick(LaneBits mask, Lanes a, Lanes b)
{
    return (Lanes)(((LaneBits)a & mask) | ((LaneBits)b & ~mask));
}

static inline LaneBits is_not(LaneBits mask) { return ~mask; }

static inline int any_of(LaneBits mask)
{
    long long some = 0;
    for (int k = 0; k < LANES; k++)
        some |= mask[k];
    return some != 0;
}

/* As max_of, min_of, sign_of: a NaN in x stays. */
static inline Lanes lanes_max_of(Lanes x, Lanes y) { return pick(x < y, y, x); }
static inline Lanes lanes_min_of(Lanes x, Lanes y) { return pick(x > y, y, x); }
static inline Lanes lanes_sign_of(Lanes x) { return pick(x > 0.0, all_of(1.0), pick(x < 0.0, all_of(-1.0), x)); }
static inline Lanes lanes_fabs(Lanes x) { return (Lanes)((LaneBits)x & 0x7fffffffffffffffLL); }

/* As mod_of, mod_on, period_side. */
static inline Lanes lanes_mod_of(Lanes a, Lanes b)
{
    for (int k = 0; k < LANES; k++)
        a[k] = mod_of(a[k], b[k]);
    return a;
}
static inline Lanes lanes_mod_on(Lanes a, Lanes b, Lanes side)
{
    for (int k = 0; k < LANES; k++)
        a[k] = mod_on(a[k], b[k], side[k]);
    return a;
}
static inline Lanes lanes_period_side(Lanes a, Lanes b)
{
    for (int k = 0; k < LANES; k++)
        a[k] = period_side(a[k], b[k]);
    return a;
}

/* As just_ahead, just_behind, finite_slope. */
static inline Lanes lanes_just_ahead(Lanes x) { return x + 1e-9 * (1.0 + lanes_fabs(x)); }
static inline Lanes lanes_just_behind(Lanes x) { return x - 1e-9 * (1.0 + lanes_fabs(x)); }
static inline Lanes lanes_finite_slope(Lanes derivative, Lanes ahead, Lanes behind, Lanes way)
{
    return pick(lanes_fabs(derivative) < INFINITY, derivative, (ahead - behind) / way);
}

static inline Lanes lanes_sqrt(Lanes x)
{
#if defined(__GNUC__) && !defined(__clang__) && defined(__AVX512F__)
    return (Lanes)__builtin_ia32_sqrtpd512_mask(x, x, (char)-1, 4);
#elif defined(__GNUC__) && !defined(__clang__) && defined(__AVX__)
    return (Lanes)__builtin_ia32_sqrtpd256(x);
#elif defined(__GNUC__) && !defined(__clang__) && defined(__SSE2__)
    return (Lanes)__builtin_ia32_sqrtpd(x);
#else
    Lanes y;
    for (int k = 0; k < LANES; k++)
        y[k] = sqrt(x[k]);
    return y;
#endif
}

#define LANE_AFTER_LANE(function) \
    static inline Lanes lanes_##function(Lanes x) \
    { \
        Lanes y = {0.0}; \
        for (int k = 0; k < LANES; k++) \
            y[k] = function(x[k]); \
        return y; \
    }
#define LANE_AFTER_LANE_OF_TWO(function) \
    static inline Lanes lanes_##function(Lanes a, Lanes b) \
    { \
        Lanes y = {0.0}; \
        for (int k = 0; k < LANES; k++) \
            y[k] = function(a[k], b[k]); \
        return y; \
    }
LANE_AFTER_LANE_OF_TWO(pow)
LANE_AFTER_LANE_OF_TWO(atan2)
LANE_AFTER_LANE(sin)
LANE_AFTER_LANE(cos)
LANE_AFTER_LANE(tan)
LANE_AFTER_LANE(asin)
LANE_AFTER_LANE(acos)
LANE_AFTER_LANE(atan)
LANE_AFTER_LANE(sinh)
LANE_AFTER_LANE(cosh)
LANE_AFTER_LANE(tanh)
LANE_AFTER_LANE(exp)
LANE_AFTER_LANE(log)

/* As scene/trigonometry.h; lanes whose angle is so large that there the library is asked are marked as rare. */
static inline void sines_and_cosines(Lanes angle, Lanes *sine, Lanes *cosine, LaneBits *rare)
{
#define SINES_OF Lanes
#define SINES_BITS LaneBits
#include "../scene/sines.h"
#undef SINES_OF
#undef SINES_BITS
    *rare |= ~small;
}

/* What the text in both/ is made of here. */
#define Real Lanes
#define Truth LaneBits
#define RunOf LaneRun
#define MemoryOf LaneMemory
#define AsideOf LaneAside
#define ClearanceOf LaneClearance
#define ParametersOf LaneParameters
static inline Lanes real_max(Lanes x, Lanes y) { return lanes_max_of(x, y); }
static inline Lanes real_abs(Lanes x) { return lanes_fabs(x); }
static inline Lanes real_sqrt(Lanes x) { return lanes_sqrt(x); }

/* As Latch, Memory, PinForce, Clearance, Aside of a single run. */
typedef struct {
    Lanes closed, deltadot_minus;
#if LAW_STATES
    Lanes state[LAW_STATES];
#endif
} LaneLatch;

typedef struct {
    LaneLatch latch[AT_LEAST_ONE(N_CLEARANCES)];
    Lanes event_side[AT_LEAST_ONE(N_USER_EVENTS)];
    LaneBits rare; /* lanes whose step the single runs are to make */
} LaneMemory;

typedef struct {
    Lanes n, t, M_i, M_j;
#if LAW_STATES
    Lanes state_rate[LAW_STATES];
#endif
} LanePinForce;

typedef struct {
    Lanes Fx, Fy, F_n, F_t, e, deltadot, delta, moment_first, moment_second, power;
#if LAW_STATES
    Lanes state_rate[LAW_STATES];
#endif
} LaneClearance;

typedef struct {
    Lanes lambda[N_LOOPS + 1], power[N_WORK], event[AT_LEAST_ONE(N_USER_EVENTS)];
    LaneClearance clearance[AT_LEAST_ONE(N_CLEARANCES)];
} LaneAside;

static inline LaneBits is_closed(const LaneLatch *latch) { return latch->closed > 0.0; }

#define Number Lanes
#define Flag LaneBits
typedef struct {
#include "moving.h"
    LaneMemory memory; /* Moving ends before what is rare */
    LaneAside aside;
} LaneRun;
#undef Number
#undef Flag

#endif
