/*
 * Step-size control, and the choice between the explicit and the stiff method.
 *
 * After a step with the error e, in tolerances, and one with the error e' before it, the next length is
 *     h SAFETY e^(-ERROR_EXPONENT power) e'^(LAST_ERROR_EXPONENT power),   power = 1 / (order of the estimate + 1).
 * This is the PI controller of K. Gustafsson, ACM Trans. Math. Softw. 17 (1991), 533-554, in the form of E. Hairer,
 * G. Wanner, Solving ODEs II (1996), section IV.2. Gustafsson recommends 0.7 and 0.4 for explicit methods.
 *
 * [1] E. Hairer, S. P. Norsett, G. Wanner, Solving ODEs I (1993), section II.4, and its code DOP853; [2] the code
 * RADAU5 of II, section IV.8. Constants without a source are gudgeon's own.
 */
#define SAFETY 0.9              /* [1] */
#define SAFETY_ONSET 0.8        /* the same for the first step of a contact, whose error has a lower order */
#define ERROR_EXPONENT 0.8      /* integral gain 0.6 + proportional gain 0.2 */
#define LAST_ERROR_EXPONENT 0.2 /* proportional gain */
#define MIN_LAST_ERROR 1e-4     /* tolerances: e' is at least as large, also before the first step [1] */
#define MIN_ERROR 1e-12         /* tolerances: e is at least as large */
#define MIN_GROWTH 0.3          /* smallest ratio of the lengths of two accepted steps; 0.333 in [1] */
#define MAX_GROWTH 6.0          /* largest ratio [1] */
#define MAX_GROWTH_EVENTS 2.0   /* largest ratio if a watched function may have a zero in the step */
#define MAX_GROWTH_FIRST 5.0    /* largest ratio for the stored length of first steps after an event */
#define STABLE_GROWTH 1.1       /* largest ratio of the next length to the longest stable one */
#define MIN_SHRINK 0.1          /* smallest ratio of the lengths of an attempt and the rejected one before */
#define MAX_SHRINK 0.9          /* largest ratio */
#define MIN_ORDER_SEEN 2.0      /* smallest order inferred from the errors of two rejected attempts */
#define SHRINK_NEWTON 0.5       /* ratio if Newton's iteration failed [2] */
#define SHRINK_FAILED 0.25      /* ratio if a stage is not finite */
#define SHRINK_UNRESOLVED 0.25  /* ratio if the motion between the stages is not resolved */
#define FLIGHT_STEP_SLACK 1.5        /* times flight_step_limit(): longer steps are rejected */
#define SHRINK_FLIGHT_STEP 0.5       /* ratio of the next attempt then */
#define TRANSIENT_PART 0.5          /* of the time up to a missed transient: length of the next attempt */
#define MIN_PARTING 0.1         /* of a step: an earlier separation does not shorten it */
enum { PATIENCE = 8, MAX_PATIENCE = 4096,
    LASTING_STEPS = 400 /* steps with a method after which the next return to it is as easy as the first */,
    RATE_ITERATIONS = 5, RECONSIDER_STEPS = 24 /* steps until the explicit method is considered again */,
    MAX_AGAINST = 3 /* successive steps against the explicit method until the change */,
    COMPARE_FROM = 8, COMPARE_TO = 200 /* steps after a change in which the lengths of both methods are compared */,
    MAX_SHORTENED = 12 /* reductions by four: what remains unresolved then is rounding */ };
#define FILM_ERROR_RATIO 0.7   /* largest ratio of the film errors of a shorter and a longer step without rounding */
#define MIN_TRANSIENT_FRACTION 1e-9     /* of the times: in shorter steps no transients are searched */
#define STIFF_LENGTH_RATIO 0.8     /* of the stiff step length: an explicit step must be longer to be cheaper */
#define WORK_TOL 10.0    /* times rtol: allowed error of the works of a step relative to the energy throughput */
#define SEPARATION_MARGIN 1.05    /* of the estimated time to a separation: length of a step that ends after it */
#define MAX_FLIGHTS 2.0    /* of the time in which a journal crosses its bearing: longest step */
#define MAX_EXPLICIT_STABILITY 2.5     /* h rho below which the explicit method is cheaper */
#define MAX_ORDER_SEEN 30.0 /* largest order of error growth inferred from two steps */
#define ORDER_DECAY 0.95    /* factor on that order after each step */

/* Return the method of the same name in this library: the run may have begun in another library of the same code. */
static const Method *local_method(const Method *method)
{
    return method ? METHODS[gudgeon_method(method->name)] : NULL;
}

/* Let the methods of a run refer to this library. */
static void relink_choice(Integrator *run)
{
    run->choice.method = local_method(run->choice.method);
    run->choice.implicit = local_method(run->choice.implicit);
}

/* Start with a method (gudgeon_method) and the stiff method to which the run may change, 0: none. */
static void start_choice(Integrator *run, int method, int automatic)
{
    run->choice.method = METHODS[method];
    run->choice.automatic = automatic > 0;
    run->choice.implicit = METHODS[automatic];
    run->choice.patience = automatic && METHODS[method]->stiff ? 4 * PATIENCE : PATIENCE;
}

/* Start the step-size control; fixed: length of all steps, s, 0: errors determine it. */
static void start_control(Integrator *run, double fixed)
{
    run->control.fixed = run->control.h = fixed;
    run->control.grid = run->t;
    run->control.error_before = MIN_LAST_ERROR;
    run->control.accept = fixed > 0.0 ? INFINITY : 1.0;
}

/*
 * Change between the explicit and the stiff method. A return to the explicit method that did not last makes the next
 * return harder.
 */
static void change_method(Integrator *run)
{
    const int stiff = run->choice.method->stiff;
    if (!stiff)
        run->choice.patience = run->choice.since > LASTING_STEPS ? PATIENCE
            : run->choice.patience < MAX_PATIENCE ? 2 * run->choice.patience : run->choice.patience;
    run->control.h_stiff = stiff ? run->control.h : 0.0;
    run->choice.method = stiff ? EXPLICIT : run->choice.implicit;
    run->choice.n_against = 0;
    run->choice.since = 0;
}

/*
 * Return rho, the largest rate of the motion near the state in 1/s, by power iteration with differences; 0: unknown.
 * The method is that of B. P. Sommeijer, L. F. Shampine, J. G. Verwer, J. Comput. Appl. Math. 88 (1998), 315-326.
 * Stages of a stiff method do not show a fast mode at rest, which makes an explicit step unstable.
 */
static double largest_rate(Integrator *run, const Parameters *p)
{
    double direction[N_Y], y[N_Y], dy[N_Y], growth[2] = {0.0, 0.0};
    RhsOutputs rhs;
    for (int k = 0; k < N_Y; k++)
        direction[k] = (k % 2 ? -1.0 : 1.0) / run->norm.weight[k];
    for (int n = 0; n <= RATE_ITERATIONS; n++) {
        double size = 0.0;
        for (int k = 2 * N_X; k < FIRST_STATE; k++)
            direction[k] = 0.0; /* no rate depends on the works */
        for (int k = 0; k < N_Y; k++)
            size = max_of(size, fabs(direction[k]) * run->norm.weight[k]);
        growth[n % 2] = size; /* over two iterations: a vibration alternates between positions and velocities */
        for (int k = 0; k < N_Y; k++)
            y[k] = run->y[k] + direction[k] / size;
        if (!(size > 0.0 && isfinite(size)) || rates(run, run->t, y, p, dy, &rhs))
            return 0.0;
        for (int k = 0; k < N_Y; k++)
            direction[k] = dy[k] - run->dy[k];
    }
    return sqrt(growth[0] * growth[1]);
}

/*
 * Choose the method of the next step: the explicit one until stability limits its steps, the stiff one while it would.
 */
static void choose_method(Integrator *run, const Parameters *p)
{
    /* the stiff method's stages give a lower bound of rho: soon after a change, compare the step lengths too */
    const int slower = run->choice.since > COMPARE_FROM && run->choice.since < COMPARE_TO
        && run->control.h < STIFF_LENGTH_RATIO * run->control.h_stiff;
    const int stiff = run->choice.method->stiff;
    const double stability = run->choice.stability;
    const int against = stiff ? stability < MAX_EXPLICIT_STABILITY : stability > run->choice.method->bounded || slower;
    run->choice.n_against = against ? run->choice.n_against + 1 : 0;
    run->choice.since++;
    if (!run->choice.automatic || run->choice.n_against < (stiff ? run->choice.patience : MAX_AGAINST))
        return;
    const double rate = stiff ? largest_rate(run, p) : 0.0;
    if (rate * run->control.h < MAX_EXPLICIT_STABILITY)
        change_method(run);
    else
        run->choice.n_against = -RECONSIDER_STEPS;
    run->choice.rate = rate;
}

/* Return the order of a step's error in its length: that of the method, or lower where a force has just begun. */
static double error_order(const Integrator *run, const Step *step)
{
    const double order = 1.0 / step->method->power;
    return run->control.first && run->control.first_step_order > 0.0 ? min_of(run->control.first_step_order, order)
                                                                     : order;
}

/* Return x^n with a relative error of 1e-4, which is enough for step lengths. */
static double approximate_power(double x, double n) { return rough_exp2(n * rough_log2(x)); }

/* Return the error norm of a step, bounded from below so that a length can be computed from it. */
static double limited_error(const Step *step) { return max_of(MIN_ERROR, step->error); }

/* Return the factor on the length of a rejected step for the next attempt. Two successive errors show their order. */
static double shrink_factor(Integrator *run, const Step *step)
{
    Attempt *now = &run->control.attempt;
    double order = error_order(run, step);
    if (now->refused > now->h && isfinite(now->error) && now->error > step->error)
        order = min_of(1.0 / step->method->power,
            max_of(MIN_ORDER_SEEN, log(now->error / step->error) / log(now->refused / now->h)));
    now->refused = now->h;
    now->error = step->error;
    run->control.too_long = now->h;
    run->control.too_long_until = run->t + now->h;
    return min_of(MAX_SHRINK, max_of(MIN_SHRINK, SAFETY * approximate_power(step->error, -1.0 / order)));
}

/* Store the length that would have fitted for the first step after an event. */
static void record_first_step(Integrator *run, const Step *step)
{
    if (!run->control.first)
        return;
    const double safe = run->control.first_step_order > 0.0 ? SAFETY_ONSET : SAFETY;
    const double fits = safe * approximate_power(limited_error(step), -1.0 / error_order(run, step));
    *run->control.first = step->h * min_of(MAX_GROWTH_FIRST, max_of(MIN_GROWTH, fits));
    if (run->control.first_step_order > 0.0 && run->control.onset_error_per_s > 0.0)
        run->control.onset[!!step->method->stiff] = run->control.onset_error_per_s
            * approximate_power(*run->control.first, run->control.first_step_order - 1.0);
    run->control.first = NULL;
}

/*
 * Return the largest factor on the length of the next step by the order of error growth seen in rejected attempts;
 * INFINITY: no limit. In stiff motion that order can be far higher than the method's.
 */
static double observed_growth(Integrator *run, const Step *step, int again)
{
    const Attempt *now = &run->control.attempt;
    if (again && now->refused > step->h && isfinite(now->error) && now->error > step->error)
        run->control.observed_order =
            min_of(MAX_ORDER_SEEN, log(now->error / limited_error(step)) / log(now->refused / step->h));
    run->control.observed_order *= ORDER_DECAY;
    const double observed_order = run->control.observed_order;
    return observed_order * step->method->power > 1.0
        ? SAFETY * approximate_power(limited_error(step), -1.0 / observed_order) : INFINITY;
}

/*
 * Set the length of the next step after an accepted one. again: after a rejection; whole: the end of the run did not
 * cut the step.
 */
static void next_length(Integrator *run, const Step *step, int again, int whole)
{
    if (step->method->controls_length) { /* up to the largest length of the next attempt */
        run->control.h = again ? step->h : max_attempt_length(run);
        return;
    }
    const double error = limited_error(step), power = step->method->power;
    double factor = SAFETY * rough_exp2(power
        * (LAST_ERROR_EXPONENT * rough_log2(run->control.error_before) - ERROR_EXPONENT * rough_log2(error)));
    const double known = run->choice.since <= PATIENCE ? run->choice.rate * step->h : 0.0;
    const double stability = max_of(run->choice.stability, known);
    if (!step->method->stiff && stability > 1.0)
        factor = min_of(factor, STABLE_GROWTH * step->method->bounded / stability);
    factor = min_of(factor, observed_growth(run, step, again));
    const double most = again ? 1.0 /* [1] */ : step->has_zero_bracket ? MAX_GROWTH_EVENTS : MAX_GROWTH;
    factor = min_of(most, max_of(MIN_GROWTH, factor));
    run->control.error_before = max_of(MIN_LAST_ERROR, error);
    record_first_step(run, step);
    if (step->h * factor > run->control.h || (whole && run->roots.skip < 0) || factor < 1.0)
        run->control.h = step->h * factor;
}

/*
 * Return a step length h, shortened to end just after the separation of a contact if h would reach beyond. The force is
 * not smooth there. The time to separation follows from penetration and rate.
 */
static double limit_by_separation(const Integrator *run, double h)
{
    for (int i = 0; i < N_CLEARANCES; i++) {
        const Clearance *joint = &run->rhs.clearance[i];
        const double left = SEPARATION_MARGIN * joint->delta / -joint->deltadot;
        if (gives(i) && run->discrete.contact[i].closed && joint->deltadot < 0.0 && left < h && left > MIN_PARTING * h)
            h = left;
    }
    return h;
}

/*
 * Return a step length h of at most FLIGHT times the time in which a journal that leaves the wall crosses its bearing.
 */
static double limit_by_flight(const Integrator *run, double h, const Parameters *p)
{
    for (int i = 0; i < N_CLEARANCES; i++) {
        const Clearance *joint = &run->rhs.clearance[i];
        const double c = radial_clearance(p, i), distance = max_of(c, 2.0 * c + joint->delta);
        if (gives(i) && !run->discrete.contact[i].closed && joint->deltadot < 0.0)
            h = min_of(h, MAX_FLIGHTS * distance / -joint->deltadot);
    }
    return h;
}

/*
 * Return a step length h, limited after a switching point by the length that was just rejected for its error. A
 * switching point of forces changes the motion little; a small estimate of such a long step would be chance.
 */
static double limit_by_rejected(const Integrator *run, double h)
{
    const int again = begins_at_switch(run) && run->t < run->control.too_long_until;
    return again ? min_of(h, run->control.too_long) : h;
}

/*
 * Return the length in s of a fixed step to the next point *end of the grid that begins with the run. An event in
 * between does not move the grid. A step repeated to end just after an event has the length control.h.
 */
static double fixed_step_length(Integrator *run, double t_end, double *end)
{
    StepControl *control = &run->control;
    double h;
    for (;; control->on_grid += 1.0) {
        *end = step_end(control->grid, t_end, control->fixed, control->on_grid + 1.0, &h);
        if (*end > run->t || *end == t_end)
            break;
    }
    h = *end - run->t < h * EQUAL_LENGTH_RATIO ? *end - run->t : h;
    if (control->h >= h)
        return h;
    *end = run->t + control->h;
    return control->h;
}

/*
 * Open the attempts at a step towards t_end with its first length. Fixed steps do not freeze branches: without an error
 * estimate, a branch held beyond its end, as the force of a film, could grow without bound.
 */
static void open_attempt(Integrator *run, double t_end, const Parameters *p)
{
    const double left = t_end - run->t, far = max_of(min_of(fabs(t_end), MAX_RUN_SCALE_S), fabs(run->t));
    double h, end = t_end;
    if (run->control.fixed > 0.0) {
        h = fixed_step_length(run, t_end, &end);
        run->discrete.held = DRIVE_IMPULSES; /* at the jump of a drive constraints have two rates */
    } else {
        h = run->roots.skip >= 0 ? min_of(run->control.h, run->roots.monitor) : run->control.h;
        h = limit_by_flight(
            run, limit_by_separation(run, min_of(limit_by_rejected(run, h), flight_step_limit(run, NULL, p))), p);
        h = h > left * EQUAL_LENGTH_RATIO ? left : h;
    }
    run->control.attempt = (Attempt){.h = h, .longest = h, .left = left, .end = end, .far = far, .open = 1,
        .lane = run->choice.method->lane, .film_error_norm = INFINITY};
}

/* Prepare another attempt of length run->control.attempt.h, and return 0. */
static int retry_step(Integrator *run)
{
    run->control.attempt.lane = run->choice.method->lane;
    return 0;
}

/*
 * Return whether the tried step with status `tried` is accepted, without regard to events. If it is accepted,
 * run->control.h is the length of the next step, or *status the cause of a failure. If not, run->control.attempt holds
 * the next attempt.
 */
static int is_step_accepted(Integrator *run, int tried, const Parameters *p, Step *step, int *status)
{
    const Method *method = step->method;
    Attempt *now = &run->control.attempt;
    const int fixed = run->control.fixed > 0.0;
    *status = tried;
    if (N_SWITCHES > 0 && fixed && tried == NOT_FINITE && run->discrete.held) {
        run->discrete.held = 0; /* until the step is committed: a held branch may be NaN beyond its switching point */
        return retry_step(run);
    }
    if (tried == STOPPED || fixed)
        return 1;
    const int fits = !tried && step->error <= run->control.accept;
    const double at_ends = fits ? film_error_at_ends(run, step, FILM_PART) : 0.0;
    if (fits && !is_film_error_small(run, step, at_ends)) {
        const double error = measure_film_error(run, step, p);
        if (!(error > FILM_ERROR_RATIO * now->film_error_norm)) /* not rounding */
            step->error = max_of(step->error, error);
        now->film_error_norm = error > run->control.accept ? error : INFINITY;
    }
    const int good = !tried && step->error <= run->control.accept;
    const double least = MIN_STEP_FRACTION * now->far;
    if (good && !method->stiff && run->choice.stability > method->unstable) {
        count_rejected(run);
        if (run->choice.automatic && !now->methods_failed)
            change_method(run);
        else
            now->h *= method->bounded / run->choice.stability;
        return retry_step(run);
    }
    if (good && FLIGHT_STEP_SLACK * flight_step_limit(run, step, p) < now->h) {
        now->again = 1;
        count_rejected(run);
        now->h *= SHRINK_FLIGHT_STEP;
        return retry_step(run);
    }
    const int unresolved = good && is_unresolved(run, step, p);
    if (good && (unresolved || has_wrong_film_force(run, step, at_ends)) && now->n_shortened++ < MAX_SHORTENED) {
        now->again = 1;
        count_rejected(run);
        now->h *= SHRINK_UNRESOLVED;
        return retry_step(run);
    }
    const double transient = good && now->h > MIN_TRANSIENT_FRACTION * now->far ? missed_transient(run, step, p) : 0.0;
    if (transient > 0.0 && now->n_shortened++ < MAX_SHORTENED) {
        now->again = 1;
        count_rejected(run);
        now->h *= max_of(SHRINK_UNRESOLVED, TRANSIENT_PART * transient);
        return retry_step(run);
    }
    if (good) {
        next_length(run, step, now->again, now->h < now->left);
        const int is_short = now->h < SHORT_STEP_FRACTION * now->far;
        *status = is_stuck_in_short_steps(run, is_short) ? diagnose_stall(run, TOO_SMALL, p) : 0;
        return 1;
    }
    now->again = 1;
    count_rejected(run);
    now->h *= tried == NOT_FOUND ? SHRINK_NEWTON : tried ? SHRINK_FAILED : shrink_factor(run, step);
    if (now->h > least)
        return retry_step(run);
    if (N_SWITCHES > 0 && tried == NOT_FINITE && run->discrete.held) {
        run->discrete.held = 0; /* until the step is committed: a held branch may be NaN beyond its switching point */
        now->h = now->longest;
        return retry_step(run);
    }
    if (!run->choice.automatic || !method->stiff || now->methods_failed++) {
        *status = tried ? tried : diagnose_stall(run, TOO_SMALL, p);
        return 1;
    }
    change_method(run); /* its matrix is singular with dependent constraints; the explicit method can continue */
    now->h = now->longest;
    return retry_step(run);
}

/*
 * Compute one attempt at a step of length run->control.attempt.h, repeated by the policy near singular positions.
 * Return 0 or the status.
 */
static int try_step(Integrator *run, const Parameters *p, Step *step)
{
    step->method = run->choice.method;
    step->stages_lane = NULL;
    int status;
    for (begin_singular_policy(run);
         next_singular_policy(run, status = run->choice.method->try(run, run->control.attempt.h, p, step));)
        ;
    return status;
}

/* Close the attempts at a step: one was accepted. */
static void close_attempt(Integrator *run) { run->control.attempt.open = 0; }

/* Try steps until one is accepted; return 0 or the status. */
static int find_accepted_step(Integrator *run, const Parameters *p, Step *step)
{
    int status;
    while (!is_step_accepted(run, try_step(run, p, step), p, step, &status))
        ;
    close_attempt(run);
    return status;
}
