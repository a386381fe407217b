/*
 * All functions that Python calls; no other symbol of a library is visible. Python reads these declarations too. Arrays
 * are C-contiguous with the lengths of model.h, parameters `p` are those of gudgeon_prepare(), numbers are SI.
 */
#ifndef GUDGEON_CALLS_H
#define GUDGEON_CALLS_H

#pragma GCC visibility push(protected)

void gudgeon_prepare(const double *given_values, const unsigned char *is_given, double *p);
void gudgeon_prepare_runs(long n_runs, long n_values, const double *given_values, const unsigned char *is_given,
    double *p);

/*
 * Parameters of runs that are repeated with other values, and their conditions. given_values and is_given are those of
 * gudgeon_prepare() for the run, followed by those for its motion if it has other parameters (n_given each).
 */
typedef struct {
    long n_targets;
    const long *targets;                  /* rows: index of a value, index in given_values at which it is written */
    double *given_values;
    const unsigned char *is_given;
    long n_given, n_parameters;
    const double *lower, *upper;          /* limits of all parameters, both included */
    long n_relations;
    const long *relations;                /* rows: Relation, index of a parameter, first and end of its terms */
    const long *terms;                    /* parameters whose sum is the bound */
} ParameterTable;

int gudgeon_set_parameters(const ParameterTable *table, const double *values, double *p, double *p_motion);
void gudgeon_mass(const double *p, double *m);
void gudgeon_phi(double t, const double *q, const double *p, double *phi);
void gudgeon_phi_q(double t, const double *q, const double *p, double *phi_q);
void gudgeon_nu(double t, const double *q, const double *p, double *nu);
void gudgeon_gamma(double t, const double *q, const double *v, const double *p, double *gamma_values);
void gudgeon_start_values(const double *p, double *guesses, double *set_coordinates, double *rates);
int gudgeon_start(double t, const double *parameters, double size, double *q, double *v, double *residual);
int gudgeon_close(double t, const double *parameters, double size, double radius, double *q);
#if INTEGRATES
int gudgeon_has_equal_start(const double *p, const double *other);
#endif
int gudgeon_continuation(double t, const double *parameters, double size, double *q, double *v);
int gudgeon_rhs(double t, const double *y, const double *discrete, const double *p, double *dy);
double gudgeon_time_rhs(long count, double t, const double *y, const double *discrete, const double *p);
int gudgeon_evaluate(long n, const double *t, const double *q, const double *v, const double *discrete,
    const double *parameters, double *a, double *lambda, double *reactions, double *torques, double *clearance,
    double *series, double *friction, double *energy, double *power, double *drift, long *failed_sample);
void gudgeon_audit_samples(long n, const double *t, const double *q, const double *v, const double *discrete,
    const double *parameters, double size, double *relative_errors);

/* A point of a body, or of the ground (-1). x, y: parameters with its components, times the signs; -1: 0. */
typedef struct {
    long body, x, y;
    double sign_x, sign_y;
} BodyPoint;

/*
 * A force on body `second` at point `at`, with the opposite force on body `first`; -1: ground. column: of the result
 * that contains it. from: the other end of a spring. direction: parameters with the direction of a friction force in
 * the frame of body `first`; -1: the number in `component`.
 */
typedef struct {
    int kind;                             /* BodyForceKind */
    long first, second, column;
    BodyPoint at, from;
    long direction[2];
    double component[2];
} BodyForce;

/* All forces of a scene, and of each body whether all forces and moments on it are known. */
typedef struct {
    long n_forces;
    const BodyForce *forces;
    const unsigned char *has_known_forces, *has_known_moments;
    long gravity[2];                      /* parameters with its components; -1: 0 */
} BodyForceTable;

void gudgeon_body_residuals(long n, const BodyForceTable *table, const double *q, const double *parameters,
    const double *a, const double *reactions, const double *torques, const double *clearance, const double *series,
    const double *friction, double *relative_residuals);
int gudgeon_check_samples(long n, const double *t, const double *y, const double *discrete, const double *parameters,
    double *energies, double *contact_forces, const double *audited, const double *limits, double size,
    const double *start, long n_drawn, const long *drawn, const BodyForceTable *bodies);
int gudgeon_evaluate_runs(long n_runs, const long *counts, const double *t, const double *q, const double *v,
    const double *discrete, const double *parameters, long n_parameters, double *a, double *lambda, double *reactions,
    double *torques, double *clearance, double *series, double *friction, double *energy, double *power, double *drift,
    long *failed_sample);

/*
 * A series of the motion: a coordinate of a body's centre of mass or of a point, or its first or second time
 * derivative. body: index of the body's x in q, -1: ground. x, y: parameters with the point's components in the frame
 * of its body, times the signs; -1: 0.
 */
typedef struct {
    int order, axis;                      /* time derivative, 0 to 2; 0: x, 1: y, 2: angle of a body */
    long body, x, y;
    double sign_x, sign_y;
} MotionSeries;

void gudgeon_motion_series(const MotionSeries *series, long n_runs, const long *counts, const double *q,
    const double *v, const double *a, const double *parameters, long n_parameters, double *values);
#if TREE
void gudgeon_expand(double t, const double *q, const double *v, const double *p, double *all_q, double *all_v);
void gudgeon_reduce(double t, const double *all_q, const double *all_v, const double *p, double *q, double *v);
int gudgeon_reduced_rhs(double t, const double *q, const double *v, const double *discrete, const double *p, double *a,
    double *lambda, double *power);
void gudgeon_closures(double t, const double *q, const double *v, const double *p, double *phi, double *phi_dot);
int gudgeon_reduced_project(double t, const double *q, const double *r, const double *p, double *x);
double gudgeon_time_reduced(long count, double t, const double *q, const double *v, const double *discrete,
    const double *p);
#endif
#if HAS_ABSOLUTE_FALLBACK
int gudgeon_accelerations_by_absolute_equations(double t, const double *q, const double *v, const double *discrete,
    const double *p, double *a);
#endif
#if N_DEPENDENT
int gudgeon_driven_loops(double t, double *q, const double *p, double *v);
#endif
#if INTEGRATES
int gudgeon_jacobian(double t, const double *y, const double *discrete, const double *p, double *J, double *f_t);
int gudgeon_newton(double t, const double *y, const double *discrete, const double *p, double eta, double s,
    const double *r, double *u);
size_t gudgeon_run_size(void);
void gudgeon_run_start(void *integrator, const double *p, double t, const double *y, const double *discrete);
void gudgeon_run_set_record_buffer(void *integrator, double *rows, long capacity);
long gudgeon_run_recorded(void *integrator);
void gudgeon_run_sample(const void *integrator, const double *p, double *y, double *discrete, signed char *codes);
void gudgeon_run_enable_end_events(void *integrator, int stop);
int gudgeon_run_has_full_buffers(const void *integrator);
int gudgeon_run_count_listed(const void *integrator);
int gudgeon_run_events(void *integrator, int capacity, double *t, int *event, double *y, double *discrete,
    signed char *codes);
int gudgeon_run_impacts(void *integrator, int include_open, int capacity, double *values, int *joints);
int gudgeon_method(const char *name);
void gudgeon_adaptive_setup(void *integrator, int method, int stiff_method, const double *scale,
    const double *min_size, double fixed_step);
int gudgeon_adaptive_run(void *integrator, const double *parameters, long n, const double *t, long max_steps,
    double *y, double *discrete_states, signed char *contact_codes, long *n_stored);
void gudgeon_run_report(const void *integrator, double *t, long *counts, double *residuals, double *peaks);

/*
 * A batch of runs: arrays have a row for each run; `numbers` is the number of doubles of Parameters. Samples of run i
 * begin at row sample_block[i] * samples; runs that have ended may leave their rows to others.
 */
typedef struct {
    long samples, numbers, limit;         /* rows for the samples of a run; doubles of Parameters; steps per call */
    int choice, automatic, stop;          /* arguments of gudgeon_adaptive_setup; whether events end a run */
    int audit;                            /* level: AuditLevel */
    int fixed;                            /* whether steps have a fixed length */
    double *t;
    long time_stride, *n_requested, *sample_block; /* run i: n_requested[i] times from t + i * time_stride; 0: common */
    double *p, *p_motion, *size;          /* parameters of the start, of the motion; extent of the mechanism */
    double *step, *scale, *min_size;       /* fixed steps, s; tolerances as for gudgeon_adaptive_setup */
    double *start;                        /* (q, v) where `started`, else filled here */
    unsigned char *started, *phase;
    double *initial_discrete_states;      /* discrete states at the start, as in a sample */
    signed char *codes;                   /* contact codes of a resumed run */
    double *y, *discrete_states;          /* samples */
    signed char *state;
    long *done, *checked;                 /* samples stored; samples checked to be finite */
    int *status;
    double *t_last, *last, *seconds;      /* time and state at the end; wall time of the time loop, s */
    long *counts;                         /* as in gudgeon_run_report */
    double *residuals, *peaks;
    double *audit_values, *audit_times;   /* largest value of each audit check, -1: none; its time and location */
    int *audit_locations;
    double *time_gain;                    /* time gained by the last steps, s; their number, slowdown; causes */
    long *monitored_steps, *ended;
    double *envelope;                     /* rows of an envelope for each run, envelope_capacity of them; NULL: none */
    long envelope_capacity, *n_envelope_rows; /* written rows */
    int (*is_stop_requested)(void *);     /* polled with `context` every `poll_interval` s; nonzero: cancel; or NULL */
    void *context;
    double poll_interval;
    const volatile int *ending;           /* nonzero: all runs end at once */
} Batch;

int gudgeon_ensemble(const void *batch, void *integrator, long *current, long end);

/* Parameters from which the tolerances of a run follow, with constants of adaptive.py and sizes.py. */
typedef struct {
    long n_points, n_clearances, n_coordinates;
    const long *points;                   /* rows: parameters with the coordinates of a point, or a length; -1: 0 */
    const long *clearances;               /* rows: parameter of a clearance, of its first contour depth, n depths */
    const unsigned char *is_angle;        /* of each integrated coordinate */
    double rtol, max_film_speed_error, min_relative_clearance; /* INFINITY: no film */
} ToleranceTable;

/*
 * A run that is repeated with other parameter values in rows of `batch`, and what is returned of it. Evaluated
 * quantities are those of gudgeon_evaluate() in its order.
 */
typedef struct {
    const Batch *batch;
    const ParameterTable *parameters;
    const ToleranceTable *tolerances;
    const double *x;                      /* parameter values of the next run */
    int is_resumed;                       /* whether runs resume from batch->start */
    double max_violation;                 /* of positions to resume from, m per m of the size, or rad */
    double drawn[8], limit[4];            /* of the audit: fractions of the run at which samples are drawn; limits */
    long max_calls_of_short_run;          /* right-hand sides of a run of which every second sample is drawn */
    long n_series, n_skipped;             /* samples that are skipped before those in `values` */
    const double *const *columns;         /* rows as in batch: first sample of each series; NULL: Python computes it */
    const long *strides;                  /* doubles from a sample to the next */
    double *values;                       /* (n_series, samples - n_skipped) */
    int is_read, is_evaluated;            /* whether C stores `values`, and evaluates samples for them */
    double *evaluated[10];
} RepeatedRun;

int gudgeon_compute_tolerances(const ToleranceTable *table, const double *p, double *scale, double *min_size,
    double *size);
int gudgeon_set_repeated_run(const RepeatedRun *repeated, long i, const double *x);
int gudgeon_repeat_run(const RepeatedRun *repeated, void *integrator, long i, int stage);
void gudgeon_resume_from_end(const RepeatedRun *repeated);
#endif
#if HAS_LANES
const void *gudgeon_single_run_functions(void);
#endif
#if !INTEGRATES
size_t gudgeon_kinematic_size(void);
void gudgeon_kinematic_begin(
    void *analysis, double max_correction, double extent, double t_end, int (*poll)(void *), void *context,
    double poll_interval);
void gudgeon_kinematic_set_recording(void *analysis, double *rows, long capacity);
long gudgeon_kinematic_fetch_records(void *analysis);
void gudgeon_kinematic_restart(void *analysis);
void gudgeon_kinematic_progress(const void *analysis, double *t, double *advanced_time, long *steps);
long gudgeon_kinematic_count_interpolated(const void *analysis, double *t);
int gudgeon_kinematic(void *analysis, long n, const double *t, const double *p, double *q, double *v, double *a,
    double *phi_max, double *phi_dot_max, long *steps, long *done);
int gudgeon_kinematic_works(void *analysis, long n, const double *t, const double *p, const double *q,
    const double *v, double *work, long *done);

/*
 * A batch of kinematic runs: arrays have a row for each run, as in Batch. Of the audit: fractions of the run at which
 * samples are drawn, and the limits of its checks. is_suspect: whether Python must check the run.
 */
typedef struct {
    long samples, numbers;                /* rows for the samples of a run; doubles of Parameters */
    double max_correction;                /* as in gudgeon_kinematic_begin */
    const double *t;
    long time_stride;                     /* run i: n_requested[i] times from t + i * time_stride; 0: common */
    const long *n_requested, *sample_block; /* samples of run i begin at row sample_block[i] * samples */
    const double *p, *size;               /* parameters; size of the mechanism, m */
    double *start;                        /* (q, v) where `started`, else filled here */
    unsigned char *started, *phase, *is_suspect;
    double *y, *a;                        /* samples: q, v, works; accelerations */
    long *done;                           /* samples stored */
    int *status;
    double *t_last, *seconds;             /* time at the end; wall time, s */
    long *counts;                         /* as in gudgeon_run_report */
    double *residuals;
    long *n_interpolated;                 /* samples at or near a change point; the time of the first, s */
    double *t_interpolated;
    int must_be_short;                    /* whether a run ends as STOPPED at the first poll, after 0.02 s */
    long n_drawn;
    double drawn[8], limit[4];
    long n_series;                        /* series that are stored: values[k][i * samples + j] of sample j of run i */
    const MotionSeries *series;
    double *const *values;
    int has_states, has_works;            /* states: 0: only of audited samples and the last; works: 0: not computed */
    double *largest_a;                    /* largest |a| of each sample, in rows as y */
    const volatile int *ending;           /* nonzero: all runs end at once */
} KinematicBatch;

void gudgeon_kinematic_ensemble(const void *batch, void *analysis, long n, const long *indices);
#endif
#if !INTEGRATES && N_USER_EVENTS
int gudgeon_kinematic_events(void *analysis, long n, const double *t, const double *parameters, const double *q,
    const double *v, double run_begin, int can_stop, signed char *last_sign, long capacity, double *event_time,
    int *event, long *n_found, long *n_done);
#endif

#pragma GCC visibility pop

#endif
