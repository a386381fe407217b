/*
 * Text in this folder is compiled twice: for one run, where it is made of these, and for several runs side by side
 * (batch/lanes.h), where a number is a vector of theirs and a truth a mask. Lane by lane the operations are the same,
 * in the same order, so that a run is the same, to the last bit, alone and among others.
 */
#ifndef GUDGEON_ONE_H
#define GUDGEON_ONE_H

enum { /* bytes that the processor holds side by side: longer vectors go through memory */
#if defined __AVX512F__
    REGISTER = 64
#elif defined __AVX__
    REGISTER = 32
#else
    REGISTER = 16
#endif
};

#define Real double
#define Mask int
#define IntegratorOf Integrator
#define DiscreteStateOf DiscreteState
#define RhsOutputsOf RhsOutputs
#define ClearanceOf Clearance
#define ParametersOf Parameters
#define StepOf Step
#define NormOf ErrorNorm
#define ComplexLinearOf ComplexLinear

/* a where it is true, else b. */
static inline double pick(int mask, double a, double b) { return mask ? a : b; }
static inline int is_not(int mask) { return !mask; }
static inline int any_of(int mask) { return mask != 0; }
static inline int is_closed(const ContactState *contact) { return contact->closed; }
static inline double real_of(double x) { return x; }
static inline double real_max(double x, double y) { return max_of(x, y); }
static inline double real_min(double x, double y) { return min_of(x, y); }
static inline double real_abs(double x) { return fabs(x); }
static inline double real_sqrt(double x) { return sqrt(x); }
static inline double real_exp2(double x) { return rough_exp2(x); }
static inline double real_log2(double x) { return rough_log2(x); }

#endif
