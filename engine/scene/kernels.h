/*
 * Functions that are derived for each scene (in files beside model.h), as the engine calls them, and those of the
 * engine that are compiled together with them. Statuses: 0, or the number (from 1) of a row whose pivot vanished.
 */
#ifndef GUDGEON_KERNELS_H
#define GUDGEON_KERNELS_H

/* Parameters from what is given (SI; where is_given is 0 the default); masses and moments of inertia, N_Q. */
void prepare(const double *given, const unsigned char *is_given, Parameters *p);
void mass_matrix(const Parameters *p, double *m);
/* Of joint i with play: its radial clearance, the penetration beyond which laws mean nothing, an impact's velocity. */
#if N_CLEARANCES
double radial_clearance(const Parameters *p, int i);
double deepest(const Parameters *p, int i);
double slowest_impact(const Parameters *p, int i);
#if LAW_STATES
double breakaway(const Parameters *p, int i);
#endif
#if N_RIGID
double restitution_of(const Parameters *p, int i);
double threshold_of(const Parameters *p, int i);
#endif
#else
static inline double radial_clearance(const Parameters *p, int i) { return (void)p, (void)i, 0.0; }
static inline double deepest(const Parameters *p, int i) { return (void)p, (void)i, 0.0; }
static inline double slowest_impact(const Parameters *p, int i) { return (void)p, (void)i, 0.0; }
#endif
/* Of the closed linkage: Phi, Phi_q (N_ALL_ROWS x N_Q, by rows; zeros stay), nu, gamma; what a start sets. */
void constraints(double t, const double *q, const Parameters *p, double *phi);
void jacobian(double t, const double *q, const Parameters *p, double *phi_q);
void velocity_rhs(double t, const double *q, const Parameters *p, double *nu);
void acceleration_rhs(double t, const double *q, const double *v, const Parameters *p, double *gamma_rows);
void start_values(const Parameters *p, double *guess, double *set, double *rates);
#if INTEGRATES
int same_start(const Parameters *p, const Parameters *other);
#endif
/* Accelerations of all bodies and all that comes with them; results at a sample. */
int dynamics(double t, const double *q, const double *v, const DiscreteState *discrete, const Parameters *p, double *a,
    RhsOutputs *rhs);
void outputs(double t, const double *q, const double *v, const Parameters *p, const double *lambda, double *reactions,
    double *torques, double *series, double *energy);

#if TREE
/* Between coordinates of the tree and those of all bodies. */
void expand(double t, const double *q, const double *v, const Parameters *p, double *all_q, double *all_v);
void reduce_state(double t, const double *q, const double *v, const Parameters *p, double *s, double *s_rate);
void reduce_accelerations(double t, const double *q, const double *v, const double *all_a, const Parameters *p,
    double *a);
/* The same motion in coordinates of the tree: closures are its rows. */
int reduced_dynamics(double t, const double *q, const double *v, const DiscreteState *discrete, const Parameters *p,
    double *a, RhsOutputs *rhs);
void closures(double t, const double *q, const Parameters *p, double *out);
void closure_rates(double t, const double *q, const double *v, const Parameters *p, double *out);
int reduced_project(double t, const double *q, const double *r, const Parameters *p, double *x);
/* Multipliers of the closures from those of the absolute rows. */
void tree_multipliers(const double *lambda, double *closing);
#endif
#if N_CHAIN
void chain_directions(double t, const double *q, const DiscreteState *discrete, const Parameters *p, double *out);
int chain_step(double t, const double *q, const DiscreteState *discrete, const Parameters *p, double *step,
    double *bend, int *row);
int chain_rates(double t, const double *q, const DiscreteState *discrete, const Parameters *p, double *v);
int chain_third(
    double t, const double *q, const double *v, const DiscreteState *discrete, const Parameters *p, double *out);
void loop_switches(double t, const double *q, const DiscreteState *discrete, const Parameters *p, double *g);
/* What a step of coordinate k is multiplied by to be a number; directions in q turned by a step of the coordinates. */
double chain_share(const Parameters *p, int k);
void turn_directions(double *q, const double *step, const Parameters *p);
/* Positions of the chains from which they are looked for: `guess`, N_CHAIN. */
void seat_chains(double t, const double *guess, DiscreteState *discrete, const Parameters *p);
#endif

#if INTEGRATES
/* What is integrated (motion/): its rates, the way from all bodies and to them, back onto its rows. */
int motion(double t, const double *y, DiscreteState *discrete, const Parameters *p, double *dy, RhsOutputs *rhs);
void to_absolute(double t, const double *y, const DiscreteState *discrete, const Parameters *p, double *all);
void from_absolute(double t, const double *all, DiscreteState *discrete, const Parameters *p, double *y);
int closing_of_state(double t, const double *y, DiscreteState *discrete, const Parameters *p, double *dq, double *dv,
    double *worst);
/* The same as they are computed at a state itself (NEAR: not there, but from both sides). */
int motion_here(double t, const double *y, DiscreteState *discrete, const Parameters *p, double *dy, RhsOutputs *rhs);
/* What joints with play tell of a state, and no more: gaps, their rates, forces of laws. */
int play_here(double t, const double *y, DiscreteState *discrete, const Parameters *p, RhsOutputs *rhs);
int closing_here(double t, const double *y, DiscreteState *discrete, const Parameters *p, double *dq, double *dv,
    double *worst);
/* An accepted state, with `rhs` of motion() there: the largest |Phi| and |Phi_dot| so far; chains go on from it. */
int accept_state(double t, const double *y, DiscreteState *discrete, const Parameters *p, const RhsOutputs *rhs,
    double *phi_max, double *phi_dot_max);
#if TAYLOR
/* Coefficients c[0] ... c[order] of the motion's series in powers of time from a state on. */
int taylor_series(double t, const double *y, const Parameters *p, int order, double (*c)[TAYLOR_Y]);
#endif
/* Newton's matrix: linearized at a state whose rates motion() told, factorized for a step, solved. */
int linearize_state(double t, const double *y, DiscreteState *discrete, const Parameters *p, const double *a,
    const RhsOutputs *rhs, Linear *lin);
void linearize(double t, const double *q, const double *v, const DiscreteState *discrete, const Parameters *p,
    const double *a, const RhsOutputs *rhs, Linear *lin);
int closing_step(double t, const double *q, const double *v, const DiscreteState *discrete, const Parameters *p,
    double *dq, double *dv, double *worst);
int newton_factor(double eta, Linear *lin);
void newton_substitute(const Linear *lin, double *x);
void newton_solve(const Linear *lin, double eta, double s, const double *r, double *u);
#if IMPLICIT_STAGES
/* The same at complex eta, without f_t (both/radau.h). */
int newton_factor_complex(double eta, double eta_i, ComplexLinear *lin);
void newton_solve_complex(const ComplexLinear *lin, double eta, double eta_i, const double *r, double *u);
#endif
#else
/* Positions: a step of Newton's method, and what follows where it has come to its end. */
#if POSITIONS_IN_TREE
int close_step(double t, const double *q, const Parameters *p, double *step, double *rates, double *worst);
int arrive(double t, const double *q, const double *v, const Parameters *p, double *a, double *all_q, double *all_v,
    double *all_a, double *worst);
#else
int project(double t, const double *q, const double *r, const Parameters *p, double *x);
#endif
#endif

/* The rows where a pivot (nearly) vanishes: of the absolute formulation (singular.c), of the tree (motion/rescue.c). */
int solve_dependent(double t, const double *q, const Parameters *p, const double *force, const double *rhs, double *a,
    double *lambda, int pivot, const DiscreteState *discrete);
int solve_by_absolute(double t, const double *q, const double *v, const DiscreteState *discrete, const Parameters *p,
    double *a, RhsOutputs *rhs);
/* Rows that are solved together (block.c). */
int factor_block(int n, double *A, int *order);
void solve_block(int n, const double *A, const int *order, double *x);

/* For the audit (audit_samples.c). */
/*
 * Accelerations (N_Q) by the equations of all bodies, at a state `all` (q, v, work) of theirs, and the largest force of
 * constraints and of friction, N. Returns a status.
 */
int absolute_accelerations(double t, const double *all, const DiscreteState *discrete, const Parameters *p, double *a,
    double *force);
/* Whether what a drive prescribes jumps, in its first or second rate, at a time. */
int drives_jump(double t, const double *q, const double *v, const Parameters *p);
/* Phi_q v - nu, and nu, of all rows: Phi_q v by differences of Phi over times h (s) before and after. */
void velocity_residuals(double t, const double *q, const double *v, double h, const Parameters *p, double *missed,
    double *nu);

#if N_TERMS || KNOWN_BOUNDS
#include "../watch/ranges.h"

/* What is watched along a step; bounds over ranges of time and state: of it, of terms of time. */
void watched_functions(double t, const double *q, const double *v, const DiscreteState *discrete, const Parameters *p,
    RhsOutputs *rhs);
void watched_ranges(
    Range t, const Range *q, const Range *v, const DiscreteState *discrete, const Parameters *p, Range *out);
void time_terms(Range t, const Parameters *p, Range *out);
#endif

/* The memory of a sample (calls.c). */
void read_discrete_state(const double *sample, DiscreteState *discrete);

#endif
