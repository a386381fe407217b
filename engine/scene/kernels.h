/*
 * Declarations of the functions that are derived for each scene, and of engine functions compiled with them. Statuses:
 * 0, or the number (from 1) of a constraint equation whose pivot vanished.
 */
#ifndef GUDGEON_KERNELS_H
#define GUDGEON_KERNELS_H

/* prepare: parameters from given values (SI; defaults where is_given is 0). mass_matrix: its diagonal, N_Q. */
void prepare(const double *given, const unsigned char *is_given, Parameters *p);
void mass_matrix(const Parameters *p, double *m);
/* Of joint i with play: radial clearance, m; penetration up to which its laws hold, m; least approach speed, m/s. */
#if N_CLEARANCES
double radial_clearance(const Parameters *p, int i);
double max_valid_penetration(const Parameters *p, int i);
double min_approach_speed(const Parameters *p, int i);
#if LAW_STATES
double breakaway(const Parameters *p, int i);
#endif
#if N_RIGID
double restitution_of(const Parameters *p, int i);
double threshold_of(const Parameters *p, int i);
#endif
#else
static inline double radial_clearance(const Parameters *p, int i) { return (void)p, (void)i, 0.0; }
static inline double max_valid_penetration(const Parameters *p, int i) { return (void)p, (void)i, 0.0; }
static inline double min_approach_speed(const Parameters *p, int i) { return (void)p, (void)i, 0.0; }
#endif
/* Constraint equations: Phi, Phi_q (N_ALL_ROWS x N_Q, by rows; zeros are not written), nu, gamma; values of a start. */
void constraints(double t, const double *q, const Parameters *p, double *phi);
void jacobian(double t, const double *q, const Parameters *p, double *phi_q);
void velocity_rhs(double t, const double *q, const Parameters *p, double *nu);
void acceleration_rhs(double t, const double *q, const double *v, const Parameters *p, double *gamma_rows);
void start_values(const Parameters *p, double *guess, double *set, double *rates);
#ifndef N_ECCENTRICITIES /* starts that set eccentricities e: Phi = -e is stored after `set`, its rate after `rates` */
#define N_ECCENTRICITIES 0
#endif
#if INTEGRATES
int has_equal_start_parameters(const Parameters *p, const Parameters *other);
#endif
/* dynamics: accelerations of all bodies (N_Q) and further outputs. outputs: the results at a sample. */
int dynamics(double t, const double *q, const double *v, const DiscreteState *discrete, const Parameters *p, double *a,
    RhsOutputs *rhs);
void outputs(double t, const double *q, const double *v, const Parameters *p, const double *lambda, double *reactions,
    double *torques, double *series, double *energy);

#if TREE
/* Conversions between tree coordinates s and coordinates q of all bodies. */
void expand(double t, const double *q, const double *v, const Parameters *p, double *all_q, double *all_v);
void reduce_state(double t, const double *q, const double *v, const Parameters *p, double *s, double *s_rate);
void reduce_accelerations(double t, const double *q, const double *v, const double *all_a, const Parameters *p,
    double *a);
/* Equations of motion in tree coordinates; their constraint equations are the closures. */
int reduced_dynamics(double t, const double *q, const double *v, const DiscreteState *discrete, const Parameters *p,
    double *a, RhsOutputs *rhs);
void closures(double t, const double *q, const Parameters *p, double *out);
void closure_rates(double t, const double *q, const double *v, const Parameters *p, double *out);
int reduced_project(double t, const double *q, const double *r, const Parameters *p, double *x);
/* Multipliers of the closures from those of all constraint equations. */
void tree_multipliers(const double *lambda, double *closing);
#endif
#if N_DEPENDENT
void evaluate_loop_directions(
    double t, const double *q, const DiscreteState *discrete, const Parameters *p, double *out);
int compute_loop_step(double t, const double *q, const DiscreteState *discrete, const Parameters *p, double *step,
    double *bend, int *row);
int compute_loop_rates(double t, const double *q, const DiscreteState *discrete, const Parameters *p, double *v);
int compute_third_loop_rates(
    double t, const double *q, const double *v, const DiscreteState *discrete, const Parameters *p, double *out);
void evaluate_loop_switching_functions(
    double t, const double *q, const DiscreteState *discrete, const Parameters *p, double *g);
/*
 * get_loop_step_scale: factor that makes a step of coordinate k dimensionless.
 * turn_directions: directions in q after a step.
 */
double get_loop_step_scale(const Parameters *p, int k);
void turn_directions(double *q, const double *step, const Parameters *p);
/* Solve the driven loops from a guess of their coordinates (N_DEPENDENT). */
void solve_driven_loops(double t, const double *guess, DiscreteState *discrete, const Parameters *p);
#endif

#if INTEGRATES
/* The integrated state (motion/): its rates, conversions from and to the state of all bodies, steps to the closures. */
int compute_motion_rates(double t, const double *y, DiscreteState *discrete, const Parameters *p, double *dy,
    RhsOutputs *rhs);
void convert_integrated_to_absolute(double t, const double *y, const DiscreteState *discrete, const Parameters *p,
    double *absolute_state);
void convert_absolute_to_integrated(double t, const double *absolute_state, DiscreteState *discrete,
    const Parameters *p, double *y);
int compute_correction(double t, const double *y, DiscreteState *discrete, const Parameters *p, double *dq, double *dv,
    double *residual);
/*
 * Rates and steps at the state itself, without continuation; NEAR_SINGULAR: the motion is to be continued from both
 * sides.
 */
int evaluate_rhs(double t, const double *y, DiscreteState *discrete, const Parameters *p, double *dy, RhsOutputs *rhs);
/* Contacts of joints with play at a state: gaps, their rates, forces of laws. */
int evaluate_contacts(double t, const double *y, DiscreteState *discrete, const Parameters *p, RhsOutputs *rhs);
int compute_projection_step(double t, const double *y, DiscreteState *discrete, const Parameters *p, double *dq,
    double *dv, double *residual);
/*
 * Accept a state, with `rhs` of compute_motion_rates() there: update the maxima of |Phi| and |Phi_dot|; follow driven
 * loops from it.
 */
int accept_state(double t, const double *y, DiscreteState *discrete, const Parameters *p, const RhsOutputs *rhs,
    double *phi_max, double *phi_dot_max);
#if TAYLOR
/* Coefficients c[0] ... c[order] of the motion's series in powers of time from a state on. */
int compute_taylor_series(double t, const double *y, const Parameters *p, int order, double (*c)[TAYLOR_Y]);
#endif
/* Newton's matrix: linearize at a state with rates of compute_motion_rates(), factorize for a step, solve. */
int linearize_state(double t, const double *y, DiscreteState *discrete, const Parameters *p, const double *a,
    const RhsOutputs *rhs, Linear *lin);
void linearize(double t, const double *q, const double *v, const DiscreteState *discrete, const Parameters *p,
    const double *a, const RhsOutputs *rhs, Linear *lin);
/* One Newton step dq, dv of the projection onto the constraints, to be subtracted; *residual: the largest |Phi|. */
int compute_closure_step(double t, const double *q, const double *v, const DiscreteState *discrete, const Parameters *p,
    double *dq, double *dv, double *residual);
int newton_factor(double eta, Linear *lin);
void newton_substitute(const Linear *lin, double *x);
void newton_solve(const Linear *lin, double eta, double s, const double *r, double *u);
#if IMPLICIT_STAGES
/* Newton's matrix at a complex eta, without f_t (scalar_simd/radau.h). */
int newton_factor_complex(double eta, double eta_i, ComplexLinear *lin);
void newton_solve_complex(const ComplexLinear *lin, double eta, double eta_i, const double *r, double *u);
#endif
#else
/* Kinematic positions: a step of Newton's method, and velocities and accelerations at its end. */
#if POSITIONS_IN_TREE
int close_step(double t, const double *q, const Parameters *p, double *step, double *rates, double *residual);
int compute_body_motion(double t, const double *q, const double *v, const Parameters *p, double *a, double *all_q,
    double *all_v, double *all_a, double *residual);
#else
int project(double t, const double *q, const double *r, const Parameters *p, double *x);
#endif
#endif

/* Equations with a vanishing pivot: in absolute coordinates (singular.c), in tree coordinates
 * (motion/absolute_fallback.c). */
int solve_dependent_equations(double t, const double *q, const Parameters *p, const double *force, const double *rhs,
    double *a, double *lambda, int pivot, const DiscreteState *discrete);
int solve_by_absolute_equations(double t, const double *q, const double *v, const DiscreteState *discrete,
    const Parameters *p, double *a, RhsOutputs *rhs);
/* Factorization and solution of a small dense block (block.c). */
int factor_block(int n, double *A, int *pivot_rows);
void solve_block(int n, const double *A, const int *pivot_rows, double *x);

/* For the audit (audit_samples.c). */
/*
 * Accelerations (N_Q) by the equations of all bodies, at a state `all` (q, v, work) of theirs, and the largest force of
 * constraints and of friction, N. Returns a status.
 */
int compute_absolute_accelerations(double t, const double *all, const DiscreteState *discrete, const Parameters *p,
    double *a,
    double *force);
/* Return whether the first or second rate of a drive jumps within `interval` (s) of time t. */
int has_drive_jump(double t, double interval, const double *q, const double *v, const Parameters *p);
/* Phi_q v - nu, and nu, of all constraint equations; Phi_q v is the difference of Phi over h (s) before and after. */
void compute_velocity_residuals(double t, const double *q, const double *v, double h, const Parameters *p,
    double *missed,
    double *nu);

#if N_TERMS || KNOWN_BOUNDS
#include "../watch/ranges.h"

/* Monitored functions of a step; their bounds, and those of terms of time, over ranges of time and state. */
void monitored_functions(double t, const double *q, const double *v, const DiscreteState *discrete, const Parameters *p,
    RhsOutputs *rhs);
void bound_monitored_functions(
    Interval t, const Interval *q, const Interval *v, const DiscreteState *discrete, const Parameters *p,
    Interval *out);
void time_terms(Interval t, const Parameters *p, Interval *out);
#endif

/* Read the discrete state of a sample (calls.c). */
void read_discrete_state(const double *sample, DiscreteState *discrete);

#endif
