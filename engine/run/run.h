/*
 * Types of a run: the state that an integration method advances, and what is recorded meanwhile: contacts, events,
 * peaks and residuals. Each part of the struct Integrator has one owner, named in its comment.
 */
#ifndef GUDGEON_RUN_H
#define GUDGEON_RUN_H
#include "cancellation.h"
#include "audit.h"

/*
 * Rows that a step may append to the list of contacts for each joint with play. Compliant: one separation. Rigid: at
 * the event and at a jump of a drive, N_LISTED_PASSES + 1 = 9 impacts and two separations (run/impacts.c).
 */
#if N_RIGID
enum { MAX_CONTACTS_PER_STEP = 22 };
#else
enum { MAX_CONTACTS_PER_STEP = 1 };
#endif

enum {
    /* lengths of the lists of a run: they count as full from MAX_LISTED entries on; one more step fits */
    LISTED_IMPACTS = N_CLEARANCES ? MAX_LISTED + MAX_CONTACTS_PER_STEP * N_CLEARANCES : 1,
    LISTED_EVENTS = N_USER_EVENTS ? MAX_LISTED + 3 * N_USER_EVENTS : 1
};

/*
 * A contact of a joint with play: times of onset and separation (s, NaN while it lasts), approach speed (m/s), largest
 * force (N), its time (s).
 */
typedef struct {
    double t_on, t_off, deltadot, F_peak, t_peak;
    int joint;
} ContactRecord;

/*
 * A row of the envelope, for plots of all steps in bounded memory. A row covers `stride` successive steps; when the
 * memory is full, each two rows are merged. Columns of each joint with play: smallest and largest force with times,
 * outermost position of the journal with time, position at the end of the row.
 */
typedef struct {
    double t; /* end of the row's last step */
    double joint[AT_LEAST_ONE(N_CLEARANCES)][N_ENVELOPE_COLUMNS];
} EnvelopeRow;

/* Sizes of a step and codes of the methods and of the places where data of a step lie. */
enum {
    /* event functions, in this order */
    N_EVENT_FUNCTIONS = N_CLEARANCES + N_SWITCHES + N_FRICTIONS + N_USER_EVENTS,
    /* values stored at each stage: event functions, then of each joint with play F^2 (N^2), then deltadot (m/s) */
    STAGE_FORCES = N_EVENT_FUNCTIONS,
    STAGE_GAP_RATES = STAGE_FORCES + N_CLEARANCES,
    N_STAGE_VALUES = STAGE_GAP_RATES + N_CLEARANCES,
#if TAYLOR
    N_DENSE = TAYLOR_ORDERS,
#else
    N_DENSE = 7,
#endif
    N_STAGES = 16,
    N_SAMPLES = 16,
    /*
     * methods available in lanes; from METHOD_RODAS5P on they use the Jacobian, from METHOD_RADAU5 on they iterate
     * stages
     */
    METHOD_DOP853 = 0,
    METHOD_RK4,
    METHOD_DOPRI5,
    METHOD_TAYLOR, /* in a library of lanes of its own */
    METHOD_RODAS5P,
    METHOD_RADAU5,
    METHOD_RADAU9,
    N_LANE_METHODS,
    FAILED = -1, /* the dense output could not be computed */
    IN_RUN = 1,
    IN_LANE = 2 /* where a linearization, series or dense output is stored: in the run, in a lane; 0: nowhere */
};

/* Length in s beyond which the end of a run does not limit the shortest sensible step. */
#define MAX_RUN_SCALE_S 1e4
/* Shortest step, relative to the magnitude of the times. */
#define MIN_STEP_FRACTION (16.0 * DBL_EPSILON)
/* Ratio of two step lengths above which they count as equal. */
#define EQUAL_LENGTH_RATIO (1.0 - 1e-9)
/* Weight of the mean length of the steps of a method before the last one. */
#define MEAN_LENGTH_WEIGHT 0.8
/* Relative step length below which a step counts as too short to advance. */
#define SHORT_STEP_FRACTION (256.0 * MIN_STEP_FRACTION)

typedef struct Method Method; /* methods/methods.c */

/* A tried step: contacts and branches of switching functions are frozen while it is computed. */
typedef struct {
    const Method *method;
    double t, h, error;
    double y[N_Y], dy[N_Y];                  /* at the end */
    RhsOutputs rhs;
    double k[N_STAGES][N_Y];                 /* rates or increments of the stages */
    double dense[N_DENSE][N_Y];
    int dense_ready;                         /* IN_RUN; IN_LANE: in dense_lane; FAILED: dense_status is the cause */
    int dense_status;
    /* of a step computed in lanes: stages, dense output, stage values, with a stride of `lanes` numbers; NULL: here */
    const double *stages_lane, *dense_lane, *stage_values_lane;
    int lanes;
    /* of a step computed in lanes: largest |Phi| and |Phi_dot| of the closures at its end; with Radau, error of film
     * forces at its ends (scalar_simd/film_error.h) */
    double residual[2], film_error;
    /* stages so far; their nodes, stored values (N_STAGE_VALUES), smallest event functions */
    int n_stored_stages;
    double node[N_STAGES], stage_values[N_STAGES][AT_LEAST_ONE(N_STAGE_VALUES)];
    double min_event_value[AT_LEAST_ONE(N_EVENT_FUNCTIONS)];
    /* monitored event functions at equidistant points of the step (watch/dense_samples.c) */
    double sample[AT_LEAST_ONE(N_MONITORED)][N_SAMPLES + 1];
    unsigned char is_ignored[AT_LEAST_ONE(N_SWITCHES)]; /* switching points crossed within the tolerance */
    double branch_error; /* largest effect of wrong branches on the step, in tolerances; infinite: not known */
    /* bracket of a zero of each monitored function: its ends, and the values there */
    double bracket_begin[AT_LEAST_ONE(N_MONITORED)], bracket_end[AT_LEAST_ONE(N_MONITORED)];
    double value_at_begin[AT_LEAST_ONE(N_MONITORED)], value_at_end[AT_LEAST_ONE(N_MONITORED)];
    double min_state[2 * N_X + 1], max_state[2 * N_X + 1]; /* range of the state at the stages, if monitored */
    unsigned char may_be_zero[AT_LEAST_ONE(N_MONITORED)], has_zero_bracket;
    double gap_rate_range[AT_LEAST_ONE(N_CLEARANCES)][2];   /* smallest and largest d delta/dt of the stages */
    double term_range[AT_LEAST_ONE(N_TERMS)];     /* range of terms of time alone over the step; -1: unknown */
    int may_force_oscillate;                      /* whether a force may oscillate between stages (watch/forces.c) */
} Step;

enum { N_DENSE_SAMPLES = 16 };

/*
 * Recent samples of a step's dense output (watch/roots.c): event functions at fractions of the step (with
 * has_gaps_only, of joints with play only). beyond, y, dy, rhs: last sample with a negative requested event function.
 * Valid for one step with its discrete state.
 */
typedef struct {
    int n, has_gaps_only[N_DENSE_SAMPLES];
    double fraction[N_DENSE_SAMPLES], event_function[N_DENSE_SAMPLES][AT_LEAST_ONE(N_EVENT_FUNCTIONS)];
    double slope[N_DENSE_SAMPLES][AT_LEAST_ONE(N_CLEARANCES)]; /* of joints, by the fraction */
    double negative_fraction, y[N_Y], dy[N_Y];
    RhsOutputs rhs;
} DenseSamples;

/* The attempts at one step until a step is accepted (methods/step_length.c). */
typedef struct {
    double h, first_h, remaining_time; /* s: length tried now; of the first attempt; time to the end of the run */
    double time_magnitude, rejected_h; /* s: magnitude of the times; length of the last rejected attempt */
    double error, film_error_norm, end;     /* its error norm; error of its film forces; end of a fixed step, s */
    int is_open, lane_method, was_rejected; /* whether attempts continue; method in lanes; whether one was rejected */
    int n_shortened, n_drift_rejections, methods_failed; /* attempts unresolved, or off the constraints; both failed */
} Attempt;

/* Destination of the samples of a run: n times t (s), rows of states, discrete states and codes, number stored. */
typedef struct {
    long n, *done;
    const double *t;
    double *y, *discrete_states;
    signed char *contact_codes;
} Samples;

/* The step record: states that Python fetches; rows NULL: nothing is recorded. Written by: run/step_record.c. */
typedef struct {
    double *rows;
    long n, capacity;
    int jumped; /* something changed since the last row */
} StepRecord;

/* Time, state and rates at the beginning of a step. */
typedef struct {
    double t, y[N_Y], dy[N_Y];
} StepStart;

/*
 * Contacts of joints with play, their peaks, and the list of ended contacts until Python fetches it.
 * Written by: run/contacts.c, run/joint_maxima.h. Copied by: batch/lane_controlled_steps.c.
 */
typedef struct {
    ContactRecord ongoing[AT_LEAST_ONE(N_CLEARANCES)]; /* contact that lasts in each joint: closed, not yet listed */
    int is_compressing[AT_LEAST_ONE(N_CLEARANCES)];   /* from the onset until the penetration first stops growing */
    int is_rising[AT_LEAST_ONE(N_CLEARANCES)];        /* whether a joint's force rose at the end of the last step */
    double F_peak[AT_LEAST_ONE(N_CLEARANCES)], t_peak[AT_LEAST_ONE(N_CLEARANCES)], e_max[AT_LEAST_ONE(N_CLEARANCES)];
    ContactRecord records[LISTED_IMPACTS + N_CLEARANCES]; /* contacts that last at the end of the run follow */
    int n_records, ongoing_listed;
    long onsets;
    double ratio_min, ratio_max, ratio_outside;    /* of deltadot/deltadot_minus; how often it is outside [-1, 1] */
} Contacts;

/* User-defined events that were located, until Python fetches them. Written by: run/user_events.c. */
typedef struct {
    double t[LISTED_EVENTS];
    int number[LISTED_EVENTS], n;
    int stop; /* whether events may end the run */
    int pole; /* whether the event that ends a step is a pole instead of a zero (watch/events.c) */
    unsigned char is_nan_reported[AT_LEAST_ONE(N_USER_EVENTS)]; /* whether an event function was reported as NaN */
} EventList;

/* The envelope of forces and paths; rows NULL: none is recorded. Written by: run/envelope.c. */
typedef struct {
    EnvelopeRow *rows;
    long row, n_rows;   /* index of the row that is being filled; number of rows */
    long steps, stride; /* steps in that row; steps in a complete row */
} Envelope;

/*
 * Error of film forces: last measured error, length of that step (s), steps before it; smallest mass of a body with a
 * film, kg. Written by: methods/defect.c. Copied by: batch/lane_exchange.c, batch/lane_controlled_steps.c.
 */
typedef struct {
    double error, h, lightest_mass;
    long steps;
} FilmErrors;

/* Counts of steps near singular positions: not tested, tested in vain. Written by: methods/singular_policy.c. */
typedef struct {
    long n_steps_without_detection, n_failed;
} NearSingular;

/* Counts of a run for its report. Written by: run/step_log.h. Copied by: batch/. */
typedef struct {
    long steps, evaluations, switches, rejected, jacobians, stiff_steps;
} Counts;

/* The largest residuals of the constraint equations. Written by: run/run.c, run/step_log.h. Copied by: batch/. */
typedef struct {
    double phi_max, phi_dot_max;
} Residuals;

/*
 * Progress of time: the monitor, and the number of steps that each event function ended since the last check.
 * Written by: run/step_log.h, run/cancellation.c. Copied by: batch/lane_local_steps.c.
 */
typedef struct {
    ProgressMonitor monitor;
    long n_steps_ended[N_EVENT_FUNCTIONS + 1];
    int no_advance, short_steps;
} Progress;

/*
 * Choice of the method of the next step: `auto` changes to the stiff method and back.
 * Written by: methods/step_length.c, methods/step.c, scalar_simd/distance.h.
 * Copied by: batch/lane_exchange.c, batch/lane_local_steps.c, batch/lane_controlled_steps.c.
 */
typedef struct {
    const Method *method, *explicit, *implicit; /* method of the next step; explicit and stiff method of `auto` */
    double h_rho; /* h rho of the last tried step: its length times the largest rate of the motion */
    double rho; /* largest rate of the motion, 1/s, where `auto` returned to the explicit method */
    double mean_length[2]; /* s: of recent steps of the explicit and of the stiff method; 0: none */
    double opposing_length; /* s: of the first of the successive steps against the method */
    int automatic; /* whether the run may change between both methods */
    int n_opposing_steps, steps_since_change; /* successive steps against the method; steps since the last change */
    int n_unstable_steps; /* rejected unstable steps since the last change of a contact or of the method */
    int return_steps, max_opposing_steps; /* steps against the stiff, and the explicit method until the change */
} MethodChoice;

/*
 * Control of the step length.
 * Written by: methods/step.c, methods/step_length.c, methods/first_step.c.
 * Copied by: batch/lane_exchange.c, batch/lane_local_steps.c, batch/lane_controlled_steps.c.
 */
typedef struct {
    Attempt attempt;
    double fixed; /* length of fixed steps, s, 0: step-size control */
    double max_accepted_error; /* largest error norm of an accepted step */
    double fixed_steps_origin, n_grid_steps; /* start of the grid of fixed steps, s; number of grid points passed */
    double last_step; /* length of the last step up to an event, s */
    double h, h_stiff, error_before, observed_order;
    double rejected_length, rejected_end; /* s: last length rejected for its error; the time at its end */
    /*
     * First step lengths after a contact begins or ends (by the number of closed contacts), and after a switching point
     * by branch; the length that the next step updates; order of the error of such a step (0: that of the method).
     */
    double after_contact[N_CLEARANCES + 1][2], after_switch[AT_LEAST_ONE(N_SWITCHES)][2];
    double *stored_first_length, first_step_order;
    /* error of straight motion in a fitting first step, tolerances, explicit and stiff; that error per s, now */
    double onset[2], onset_error_per_s;
} StepControl;

/*
 * The norm of errors: error weights, and the scales to which tolerances are relative.
 * Written by: scalar_simd/error_weights.h, scalar_simd/speed.h, methods/begin.c.
 * Copied by: batch/lane_exchange.c, batch/lane_local_steps.c.
 */
typedef struct {
    double inverse_scale[2 * N_X + 1], min_size[2]; /* 1/tolerances; smallest relevant length (m), angle */
    double speed[2], speed_floor[2], speed_rounded[2];
    double weight[N_Y]; /* error weights: 1/tolerance */
    double work_scale, energy_scale; /* tolerance of works relative to the energy throughput (J) */
} ErrorNorm;

/*
 * Newton's matrix and, for methods with iterated stages, the data of their initial guesses.
 * Written by: methods/rodas5p.c, run/iteration_history.h, scalar_simd/radau_step.h.
 * Copied by: batch/lane_exchange.c, batch/lane_local_steps.c, batch/lane_controlled_steps.c, batch/lane_tries.c.
 */
typedef struct {
    Linear linear;
    int ready; /* where the linearization at the run's state is stored: IN_RUN, IN_LANE, 0 */
#if IMPLICIT_STAGES
    /* beginnings of this step and the step before, their distance (s); rate of convergence of the last iterations */
    StepStart current_start;
    long n_recorded_steps;
    double previous_t, previous_y[N_Y], previous_dy[N_Y], last_h, convergence_rate, film_force_tol;
    int can_extrapolate;
#endif
} NewtonIteration;

/*
 * Root finding: the tolerance of located zeros of event functions, and the switching function crossed last.
 * Written by: watch/roots.c, watch/events.c.
 */
typedef struct {
    double time_resolution; /* s: resolution of the times of events; smaller in a short run */
    int crossed, suppressed_switch; /* last crossed switching function; not monitored in the next step; -1: none */
    double t_crossed, suppression_length; /* s: time of that crossing; step length after which it is monitored again */
    DenseSamples samples;
} RootFinding;

#if TAYLOR
/*
 * Taylor series of the motion at the run's state.
 * Written by: methods/taylor.c, scalar_simd/taylor.h.
 * Copied by: batch/lane_exchange.c, batch/lane_local_steps.c, batch/lane_series.c.
 */
typedef struct {
    int order, ready;   /* ready: where the series is stored, as in NewtonIteration */
    double strictness, defect_weight; /* 1 / (the allowed last terms; the allowed defect at the end), in tolerances */
    const double *lane; /* IN_LANE: its terms, with a stride of `lanes` numbers */
    int lanes;
    /* longest step of the series, s; rounding errors of the sums y, at the beginning and at the end of a step */
    double max_step, rounding_errors[N_Y], end_rounding_errors[N_Y];
    double growth; /* 1/s: order times ratio of the last two terms; the largest rate of stiff motion */
    double terms[TAYLOR_ORDERS + 1][TAYLOR_Y];
} Series;
#endif

/*
 * The integrator of a run. Only the files named in the head comment of a part write that part
 * (tests/engine/test_owners.py); all files may change the state.
 * State: t, y, dy, rhs, discrete, ready, run_number, step.
 */
typedef struct {
    double t, y[N_Y], dy[N_Y];
    RhsOutputs rhs;
    DiscreteState discrete;
    Contacts contacts;
    EventList events;
    Envelope envelope;
    FilmErrors films;
    NearSingular near_singular;
    Counts counts;
    Residuals residuals;
    Progress progress;
    MethodChoice choice;
    StepControl control;
    ErrorNorm norm;
    NewtonIteration newton;
    RootFinding roots;
#if TAYLOR
    Series series;
#endif
    Cancellation cancellation;
    int ready;
    StepRecord step_record;
    long run_number; /* 1 + index of the run of a batch started last in this memory; 0: none */
    Step step;
    Audit audit;
} Integrator;

/* Return whether the contact law of any joint with play has a lubricant film, whose force acts without a contact. */
static inline int has_films(void)
{
    int has_any = 0;
    for (int i = 0; i < N_CLEARANCES; i++)
        has_any |= has_film(i);
    return has_any;
}

#include "step_log.h"
#if IMPLICIT_STAGES
#include "iteration_history.h"
#endif

#if N_USER_EVENTS
/* States at the user-defined events of the list, in the layout of samples; stored after the Integrator. */
typedef struct {
    double y[LISTED_EVENTS][N_S], discrete_states[LISTED_EVENTS][AT_LEAST_ONE(N_DISCRETE)];
    signed char contact_codes[LISTED_EVENTS][AT_LEAST_ONE(N_CLEARANCES)];
} EventStates;

/*
 * Return the states at the listed user-defined events. They follow the Integrator in memory (gudgeon_run_size()), in
 * scenes with user-defined events only.
 */
static inline EventStates *get_event_states(Integrator *run) { return (EventStates *)(run + 1); }
#endif

#endif
