/* The record of a run's audit: for each check the largest value as a multiple of its limit, and where it was found. */
#ifndef GUDGEON_AUDIT_H
#define GUDGEON_AUDIT_H

#ifndef AUDITS
#define AUDITS 1 /* 0: a program that never switches the audit on, as a page in a browser, is compiled without it */
#endif

/* The largest violation that one check has found. */
typedef struct {
    double max_ratio, t; /* largest value/limit, < 0: not checked; its time, s */
    int index; /* number of the joint, constraint row, body coordinate, switching function or event; -1: none */
} AuditRecord;

/*
 * The state of the audit of a run.
 * Written by: run/audit.c, run/audit_state.c, methods/audit_error.c, methods/audit_step.c.
 * Copied by: batch/lane_controlled_steps.c.
 */
typedef struct {
    int level, status;             /* level: AuditLevel; status: AUDITED once a check failed */
    long next_audited_step;          /* number of steps after which the next drawn step is checked */
    long n_drawn;                  /* drawn steps so far; if even, the next is checked inside, else as a whole */
    long n_long_steps;             /* steps checked because they were much longer than others */
    double longest_measured;       /* longest step whose error was measured, s */
    double n_measured, error_sum, change_sum; /* measured steps; sums of errors, changes of rates, tolerances */
    double mechanism_size;         /* m */
    unsigned random;               /* state of the random generator of steps and points in them */
    double phi_start;              /* largest |Phi| at the start */
    double switch_scale[AT_LEAST_ONE(N_SWITCHES)], event_scale[AT_LEAST_ONE(N_USER_EVENTS)]; /* largest magnitudes */
    unsigned char n_wrong_steps[AT_LEAST_ONE(N_SWITCHES)]; /* successive steps that ended on the wrong branch */
    int end_event;                 /* event that ends the step, -1: none */
    double event_before[AT_LEAST_ONE(N_USER_EVENTS)];   /* values at the beginning of the step */
    unsigned char has_zero[AT_LEAST_ONE(N_USER_EVENTS)]; /* whether the event function has a zero in the step */
    /* whether it exceeded rounding since its last event */
    unsigned char was_nonzero_since_event[AT_LEAST_ONE(N_USER_EVENTS)];
    int n_rounding_events[AT_LEAST_ONE(N_USER_EVENTS)];    /* successive events without that */
    AuditRecord record[N_CHECKS];
} Audit;

#endif
