/*
 * The record of a run's audit: of each check the largest value as a multiple of its limit, and where it was found.
 */
#ifndef GUDGEON_AUDIT_H
#define GUDGEON_AUDIT_H

#ifndef AUDITS
#define AUDITS 1 /* 0: a program that never switches the audit on, as a page in a browser, is compiled without it */
#endif

typedef struct {
    double worst, t; /* multiple of the limit, < 0: not checked; s */
    int where;       /* number of the joint, constraint row, body coordinate, switching function or event; -1: none */
} AuditRecord;

/* Written by: run/audit.c, run/audit_state.c, methods/audit_error.c, methods/audit_step.c. */
typedef struct {
    int level, status;             /* one of those above; AUDITED once a check failed */
    long due;                      /* number of steps after which a step is checked inside next */
    long turns;                    /* drawn steps so far; where even, the next is checked inside, else as a whole */
    long longer;                   /* steps that were checked since they were much longer than others */
    double longest;                /* length of the longest step whose error was measured, s */
    double measured, errors, changes; /* steps whose error was measured; sums of errors and of changes, tolerances */
    double size;                   /* of the mechanism, m */
    unsigned random;               /* state of the generator that draws steps and places in them */
    double phi_start;              /* largest |Phi| at the start */
    double switch_scale[AT_LEAST_ONE(N_SWITCHES)], event_scale[AT_LEAST_ONE(N_USER_EVENTS)]; /* largest magnitudes */
    unsigned char wrong[AT_LEAST_ONE(N_SWITCHES)];      /* steps in a row that ended on the wrong side */
    int ended;                     /* the event that ends the step, -1: none */
    double event_before[AT_LEAST_ONE(N_USER_EVENTS)];   /* values at the beginning of the step */
    unsigned char crossed[AT_LEAST_ONE(N_USER_EVENTS)]; /* whether the expression has a zero inside the step */
    unsigned char away[AT_LEAST_ONE(N_USER_EVENTS)];    /* whether it was above rounding since its last event */
    int noise[AT_LEAST_ONE(N_USER_EVENTS)];             /* events in a row between which it was not */
    AuditRecord record[N_CHECKS];
} Audit;

#endif
