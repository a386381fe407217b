/* A batch of runs, as many.c and Python know it. */
enum {
    NOT_CLOSED = -9,                      /* status, beside those of run.c: the start is left to Python */
    NEW = 0, BEGUN = 1, OVER = 2,         /* phase of a run */
    ALL_OVER = 0, LISTS = 1, RUN_OVER = 2, GOES_ON = 3
};

#define GLANCE 0.02 /* s between two looks at whether the batch is ending */

/* Arrays with a row for each run; `numbers` are the doubles of Parameters, `samples` the times of t. */
typedef struct {
    long samples, numbers, limit;         /* steps after which a call returns */
    int choice, stop;                     /* of gudgeon_adaptive_setup, -1: rk4; whether events end a run */
    double fixed, *t;
    double *p, *p_motion, *size;          /* parameters of the start, of the motion; extent of the mechanism */
    double *step, *scale, *least;         /* rk4's step; tolerances as gudgeon_adaptive_setup takes them */
    double *start;                        /* (q, v) where `started`, else filled here */
    unsigned char *started, *phase;
    double *y, *latched;                  /* samples */
    signed char *state;
    long *done;                           /* samples stored */
    int *status;
    double *t_last, *last, *seconds;      /* time and state at the end; spent in the time loop */
    long *counts;                         /* as gudgeon_run_report has them */
    double *residuals, *peaks;
    const volatile int *ending;           /* not 0: all runs end where they are */
} Batch;


/* What is carried from one step of rk4 to the next: that of one run, or (lanes.c) of several side by side. */
typedef struct {
    double t, steps, evaluations, y[N_Y], dy[N_Y];
    double phi_max, phi_dot_max, ratio_min, ratio_max, ratio_outside;
    struct MovingLatch {
        double closed, deltadot_minus, compressing; /* 0 or 1, m/s, 0 or 1 */
        double e, delta, deltadot, F_peak, t_peak, e_max;
        double F_open, t_open;                      /* peak of the contact that goes on */
    } latch[2];
    double event_side[1];
} Moving;

/* What one run does by itself, for those who move several at once. */
typedef struct {
    int (*begin)(const Batch *b, long i, void *run);
    int (*steps)(const Batch *b, long i, long limit, void *run);
    void (*samples)(const Batch *b, long i, const Moving *before, void *run); /* of a step that is made */
    void (*end)(const Batch *b, long i, int status, void *run);
    void (*give)(const void *run, Moving *state);
    void (*take)(void *run, const Moving *state);
} Single;

