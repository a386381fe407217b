/*
 * A run: the state that a method moves forward, and what is watched on the way: onsets and separations of
 * joints with play, peaks, residuals.
 */
#ifndef GUDGEON_RUN_H
#define GUDGEON_RUN_H
#include "cancellation.h"
#include "audit.h"

enum {
    /* what the lists of a run hold: they are full from MAX_LISTED on, and one more step finds its place */
    LISTED_IMPACTS = N_CLEARANCES ? MAX_LISTED + 2 * N_CLEARANCES : 1,
    LISTED_EVENTS = N_USER_EVENTS ? MAX_LISTED + 3 * N_USER_EVENTS : 1
};

typedef struct {
    double t_on, t_off, deltadot, F_peak, t_peak;
    int joint;
} Impact;

/*
 * What a picture needs of every step, in bounded room: a row tells of `stride` steps in a row; where the room is used
 * up, two rows become one. Of each joint with play the least and the largest force and when, where the journal was
 * furthest out and when, and where it was at the end of the row.
 */
typedef struct {
    double t; /* end of the row's last step */
    double joint[AT_LEAST_ONE(N_CLEARANCES)][N_TRACE_COLUMNS];
} EnvelopeRow;

/* A step that was tried: contacts and the sides of corners are held while it is made. */
enum {
    N_EVENT_FUNCTIONS = N_CLEARANCES + N_SWITCHES + N_FRICTIONS + N_USER_EVENTS, /* what may end a step, in this order
                                                                                  */
    /* at a stage: these; of joints with play F^2, N^2, from here on, and deltadot, m/s; so many in all */
    SEEN_FORCES = N_EVENT_FUNCTIONS,
    SEEN_RATES = SEEN_FORCES + N_CLEARANCES,
    N_SEEN = SEEN_RATES + N_CLEARANCES,
#if TAYLOR
    N_DENSE = TAYLOR_ORDERS,
#else
    N_DENSE = 7,
#endif
    N_STAGES = 16,
    N_SAMPLES = 16,
    /* the methods that lanes know; from BY_RODAS5P on they take the Jacobian, from BY_RADAU5 on they find stages */
    BY_DOP853 = 0,
    BY_RK4,
    BY_DOPRI5,
    BY_RODAS5P,
    BY_RADAU5,
    BY_RADAU9,
    KINDS,
    FAILED = -1, /* an interpolant that could not be made */
    HERE = 1,
    ELSEWHERE = 2 /* where equations are linearized, series, interpolant made: in the run, in a lane; 0: no */
};

#define LONG_RUN 1e4 /* s: an end further away than this says nothing about the shortest step that makes sense */
#define LEAST_LENGTH (16.0 * DBL_EPSILON)   /* of how far from zero times are: no step is shorter */
#define SAME_LENGTH (1.0 - 1e-9) /* ratio of the lengths of two steps, above which they count as equal */
#define SHORT_STEP (256.0 * LEAST_LENGTH) /* and so many shorter than this lead nowhere */

typedef struct Method Method; /* methods.c */

typedef struct {
    const Method *method;
    double t, h, error;
    double y[N_Y], dy[N_Y];                  /* at the end */
    RhsOutputs rhs;
    double k[N_STAGES][N_Y];                 /* rates or increments of the stages */
    double dense[N_DENSE][N_Y];
    int dense_ready;                         /* HERE; ELSEWHERE: in dense_lane; FAILED: dense_status says why */
    int dense_status;
    /* where others have tried it: stages, interpolant, what was seen, each number so many further; NULL: here */
    const double *stages_lane, *dense_lane, *seen_lane;
    int lanes;
    int n_seen;                              /* stages so far, their nodes, what they saw, the least margins of them */
    double node[N_STAGES], seen[N_STAGES][AT_LEAST_ONE(N_SEEN)], lowest[AT_LEAST_ONE(N_EVENT_FUNCTIONS)];
    double sample[AT_LEAST_ONE(N_WATCHED)][N_SAMPLES + 1]; /* margins of what is watched, evenly along the step
                                                              (dense_samples.c) */
    unsigned char passed[AT_LEAST_ONE(N_SWITCHES)]; /* corners that this step crosses without harm */
    double harm; /* in tolerances, that the wrong branches of corners change it by at most; infinite: not known */
    /* where a zero of what is watched was found, its values before it and behind it */
    double from[AT_LEAST_ONE(N_WATCHED)], to[AT_LEAST_ONE(N_WATCHED)];
    double above[AT_LEAST_ONE(N_WATCHED)], below[AT_LEAST_ONE(N_WATCHED)];
    double least[2 * N_X + 1], most[2 * N_X + 1];   /* of the state at stages, where something is watched */
    unsigned char near[AT_LEAST_ONE(N_WATCHED)], is_searched;
    double rate[AT_LEAST_ONE(N_CLEARANCES)][2];   /* smallest and largest d delta/dt of the stages */
    double spread[AT_LEAST_ONE(N_TERMS)];         /* of terms of time alone over the step; -1: not known yet */
    int swings;                                   /* whether one may swing between stages (forces.c); -1: not known */
} Step;

/*
 * Where a step has been looked at (roots.c): margins of the last so many shares (those of joints with play alone where
 * no more was asked for), and the whole state at the last one at which the margin that was asked for was below zero. It
 * holds while the step and what it holds fixed do.
 */
enum { N_DENSE_SAMPLES = 16 };
typedef struct {
    int n, joints_alone[N_DENSE_SAMPLES];
    double fraction[N_DENSE_SAMPLES], event_function[N_DENSE_SAMPLES][AT_LEAST_ONE(N_EVENT_FUNCTIONS)];
    double slope[N_DENSE_SAMPLES][AT_LEAST_ONE(N_CLEARANCES)]; /* of those of joints with play, by shares */
    double beyond, y[N_Y], dy[N_Y];
    RhsOutputs rhs;
} DenseSamples;

/*
 * The step that is tried now, until one is accepted (step_length.c): its length, the first one, what was left of the
 * run, how far from zero its times are, the last one that was refused, its error and that of its films' forces, where a
 * fixed one ends; by which method, whether one was refused, how often it did not resolve something, or ended far from
 * its rows, whether both methods were given up.
 */
typedef struct {
    double h, longest, left, far, refused, error, of_films, end;
    int open, lane, again, shortened, strayed, given_up;
} Attempt;

/* Where samples go: their times, their rows, and how many are stored. */
typedef struct {
    long n, *done;
    const double *t;
    double *y, *latched;
    signed char *state;
} Samples;

/* States that Python fetches; rows NULL: none are. Written by: run/step_record.c. */
typedef struct {
    double *rows;
    long n, capacity;
    int jumped; /* something changed since the last row */
} StepRecord;

/* What a step began with. */
typedef struct {
    double t, y[N_Y], dy[N_Y];
} Beginning;

/*
 * Contacts of joints with play, and their list until it is fetched.
 * Written by: run/contacts.c, run/joint_maxima.h.
 */
typedef struct {
    Impact open[AT_LEAST_ONE(N_CLEARANCES)];       /* the contact that lasts in each joint */
    int compressing[AT_LEAST_ONE(N_CLEARANCES)];   /* from the onset until the penetration first stops growing */
    int rising[AT_LEAST_ONE(N_CLEARANCES)];        /* whether a joint's force rose at the end of the last step */
    double F_peak[AT_LEAST_ONE(N_CLEARANCES)], t_peak[AT_LEAST_ONE(N_CLEARANCES)], e_max[AT_LEAST_ONE(N_CLEARANCES)];
    Impact impacts[LISTED_IMPACTS + N_CLEARANCES]; /* after them those that last at the end of the run */
    int n_impacts, open_listed;
    long onsets;
    double ratio_min, ratio_max, ratio_outside;    /* of deltadot/deltadot_minus; how often it is outside [-1, 1] */
} Contacts;

/* Events of the user that were found, until they are fetched. Written by: run/user_events.c. */
typedef struct {
    double t[LISTED_EVENTS];
    int number[LISTED_EVENTS], n;
    int stop; /* whether they may end the run */
    int pole; /* whether the event that ends a step is no zero but a pole (watch/events.c) */
    unsigned char no_number[AT_LEAST_ONE(N_USER_EVENTS)]; /* whether an event was reported to be no number */
} EventList;

/* The envelope of forces and paths; rows NULL: none is recorded. Written by: run/envelope.c. */
typedef struct {
    EnvelopeRow *rows;
    long row, n_rows;   /* the row that is being filled, of so many */
    long steps, stride; /* in that row; in a row that is complete */
} Envelope;

/*
 * Errors of films' forces: the last one that was measured, that step's length, steps before it; the least mass of a
 * body that has one, kg. Written by: methods/defect.c.
 */
typedef struct {
    double error, h, lightest;
    long steps;
} FilmErrors;

/* Singular positions. Written by: methods/singular_policy.c. */
typedef struct {
    long unlooked, in_vain;
} NearSingular;

/* What is counted on the way. Written by: run/step_log.h. Copied by: batch/. */
typedef struct {
    long steps, evaluations, switches, rejected, jacobians, stiff_steps;
} Counts;

/* The largest residuals of the constraint equations. Written by: run/run.c, run/step_log.h. Copied by: batch/. */
typedef struct {
    double phi_max, phi_dot_max;
} Residuals;

/*
 * Whether time still advances: its pace, steps that each margin ended since the pace was taken.
 * Written by: run/step_log.h, run/cancellation.c. Copied by: batch/lane_quiet.c.
 */
typedef struct {
    ProgressMonitor monitor;
    long ended[N_EVENT_FUNCTIONS + 1];
    int no_advance, short_steps;
} Progress;

/*
 * Which method makes the next step: `auto` changes to the stiff one and back.
 * Written by: methods/step_length.c, both/distance.h. Copied by: batch/lane_exchange.c, batch/lane_quiet.c.
 */
typedef struct {
    const Method *method, *implicit; /* of the next step; which of the stiff ones `auto` takes */
    double stability; /* h rho of the last step that was tried: its length times the largest rate of the motion */
    double rate; /* rho, 1/s, where `auto` returned to the explicit method */
    int automatic, n_against, patience, since;
} MethodChoice;

/*
 * The lengths of steps.
 * Written by: methods/step.c, methods/step_length.c, methods/first_step.c.
 * Copied by: batch/lane_exchange.c, batch/lane_quiet.c.
 */
typedef struct {
    Attempt attempt;
    double fixed, accept; /* the length of all steps, s, 0: they are chosen; the largest error of an accepted one */
    double grid, on_grid; /* where fixed steps began, s; how many ends of their grid are passed */
    double last_step; /* s, up to an event where one ended it */
    double h, h_stiff, error_before, steep;
    double too_long, too_long_until; /* the last length refused for its error, s; the time to which it would have led */
    /*
     * Lengths that fit a first step: after a contact begins or ends (others being closed), at a side of a corner; the
     * one that the next step tells, and of which power of its length such a step's error is (0: the method's).
     */
    double after_contact[N_CLEARANCES + 1][2], after_switch[AT_LEAST_ONE(N_SWITCHES)][2], *first, rough;
    /* by how many tolerances straight motion misses an onset in a step that fits, explicit or stiff; in 1 s, now */
    double onset[2], onset_share;
} StepControl;

/*
 * The norm of errors: what tolerances are relative to.
 * Written by: both/error_weights.h, both/speed.h, methods/begin.c.
 * Copied by: batch/lane_exchange.c, batch/lane_quiet.c.
 */
typedef struct {
    double inverse_scale[2 * N_X + 1], least[2]; /* 1 / tolerances; the smallest length, m, and angle that matter */
    double speed[2], speed_floor[2], speed_rounded[2];
    double weight[N_Y]; /* what errors are multiplied by: 1 / tolerance */
    double work_scale, energy_scale; /* tolerance of works as a share of the energy (J) that was turned over so far */
} ErrorNorm;

/*
 * Newton's matrix and, of methods whose stages are iterated, what their iterations begin with.
 * Written by: methods/rodas5p.c, run/iteration_history.h, both/radau_step.h.
 * Copied by: batch/lane_exchange.c, batch/lane_quiet.c, batch/lane_tries.c.
 */
typedef struct {
    Linear linear;
    int ready; /* where the equations are linearized at the run's state: HERE, ELSEWHERE, 0 */
#if IMPLICIT_STAGES
    /* where this step and the one before began, how far they are apart; how fast iterations ended last */
    Beginning now;
    long seen_steps;
    double before_t, before_y[N_Y], before_dy[N_Y], last_h, falls, force_found;
    int continues;
#endif
} NewtonIteration;

/*
 * Root finding: how near zeros of event functions are located, and the switch that was crossed last.
 * Written by: watch/roots.c, watch/events.c.
 */
typedef struct {
    double time_resolution; /* s, to which times of events are told apart; less where the whole run is short */
    int crossed, skip; /* the switch that was crossed last; one that the next step does not watch, -1: none */
    double t_crossed, monitor; /* s: when it was; the length with which steps start again that do not watch it */
    DenseSamples samples;
} RootFinding;

#if TAYLOR
/*
 * Taylor series of the motion at the run's state.
 * Written by: methods/taylor.c, both/taylor.h.
 * Copied by: batch/lane_exchange.c, batch/lane_quiet.c, batch/lane_series.c.
 */
typedef struct {
    int order, ready;   /* where it is made, as of NewtonIteration */
    const double *lane; /* ELSEWHERE: its terms, of which each is `lanes` numbers further */
    int lanes;
    double reach, terms[TAYLOR_ORDERS + 1][TAYLOR_Y]; /* the longest step that it is good for, s */
} Series;
#endif

/*
 * The integrator: parts, of which each is written by the files alone that its struct's head comment names
 * (tests/engine/test_owners.py), and what all files may change.
 * State: t, y, dy, rhs, discrete, ready, began, step.
 */
typedef struct {
    double t, y[N_Y], dy[N_Y];
    RhsOutputs rhs;
    DiscreteState discrete;
    Contacts contacts;
    EventList events;
    Envelope envelope;
    FilmErrors films;
    NearSingular near;
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
    long began; /* 1 + the run of a batch that this memory began last; 0: none */
    Step step;
    Audit audit;
} Integrator;

/* Whether the law of a joint with play has a film. */
static inline int has_films(void)
{
    int found = 0;
    for (int i = 0; i < N_CLEARANCES; i++)
        found |= has_film(i);
    return found;
}

#include "step_log.h"
#if IMPLICIT_STAGES
#include "iteration_history.h"
#endif

#if N_USER_EVENTS
/* States at the user events of a run's list, as samples have them: they lie behind the Integrator. */
typedef struct {
    double y[LISTED_EVENTS][N_S], latched[LISTED_EVENTS][AT_LEAST_ONE(N_DISCRETE)];
    signed char state[LISTED_EVENTS][AT_LEAST_ONE(N_CLEARANCES)];
} EventStates;

static inline EventStates *event_states(Integrator *run) { return (EventStates *)(run + 1); }
#endif

#endif
