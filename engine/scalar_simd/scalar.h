/*
 * Types and operations with which the functions of this folder are compiled for one run. The same text is compiled for
 * several runs in lanes (batch/lanes.h), where a number is a vector and a condition is a mask. The operations and their
 * order are the same, so that a run gives the same bits alone and among others.
 */
#ifndef GUDGEON_ONE_H
#define GUDGEON_ONE_H

enum { /* bytes of a vector register */
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

/* Return a if the mask is true, else b; in lanes, the choice is made for each lane. */
static inline double select_value(int mask, double a, double b) { return mask ? a : b; }
/* Return the negation of a mask. */
static inline int invert_mask(int mask) { return !mask; }
/* Return whether a mask is true for any run. */
static inline int any_of(int mask) { return mask != 0; }
/* Return whether a contact is closed; in lanes, the mask of the lanes in which it is. */
static inline int is_closed(const ContactState *contact) { return contact->closed; }
/* Convert a constant to Real; in lanes, the constant in all lanes. */
static inline double make_real(double x) { return x; }
/* Return the maximum of two numbers; NaN if x is NaN. */
static inline double real_max(double x, double y) { return max_of(x, y); }
/* Return the minimum of two numbers; NaN if x is NaN. */
static inline double real_min(double x, double y) { return min_of(x, y); }
/* Return |x|. */
static inline double real_abs(double x) { return fabs(x); }
/* Return the square root of x. */
static inline double real_sqrt(double x) { return sqrt(x); }
/* Return 2^x with a relative error of 1e-4. */
static inline double real_exp2(double x) { return approx_exp2(x); }
/* Return log2 x with an error of 1e-4. */
static inline double real_log2(double x) { return approx_log2(x); }

#endif
