/*
 * Events: contacts, corners of laws and expressions, and friction that may stick end a step where their margin
 * crosses zero. What is looked at is a range of signs, not a crossing alone, so that a contact that starts again on
 * the wrong side of zero is not lost.
 */

#define LONG_STEP 7.0 /* times the last one, that a step is as long as: a rule of lengths lets it grow by less */
enum { N_INNER_SAMPLES = 8 };
#define HARMLESS 0.1 /* of the tolerance, that the wrong branch of a corner may change a step */

/* To the other side with the corners that are passed, or back. */
static void flip_ignored_branches(Integrator *run, const Step *step)
{
    for (int k = 0; k < N_SWITCHES; k++)
        if (step->passed[k])
            run->discrete.branch[k] *= -1.0;
}

/* From now on every switch is watched. */
static void watch_every_switch(Integrator *run) { run->roots.skip = -1; }

/*
 * Corners of contact laws that the step crossed for good, near enough to its end: their branches meet, so that what
 * the held one did wrong is at most the step times what the rates differ by at its end. Where that is harmless the
 * step stays as it is, and what follows begins on the other side. The same holds for a corner that is left alone
 * (suppress_repeated_switch): beyond it the step may be long.
 */
static int ignore_harmless_switches(Integrator *run, Step *step, const Parameters *p)
{
    double dy[N_Y], most = 0.0;
    int crossed = 0;
    RhsOutputs rhs;
    step->harm = INFINITY;
    for (int k = 0; k < N_SWITCHES; k++) {
        const int gap_function = N_CLEARANCES + k;
        const int law = meets[k] && watched_as[gap_function] < 0 && run->control.fixed <= 0.0;
        const int may_pass = law || k == run->roots.skip; /* a fixed step knows no tolerance of what does harm */
        step->passed[k] = may_pass && event_function(&run->discrete, &step->rhs, gap_function) < 0.0;
        crossed |= step->passed[k];
    }
    if (!crossed)
        return 0;
    flip_ignored_branches(run, step);
    const int status = rates(run, step->t + step->h, step->y, p, dy, &rhs);
    flip_ignored_branches(run, step); /* held until the step is taken: what lies inside it is on this side */
    for (int k = 0; k < 2 * N_X && !status; k++)
        most = max_of(most, fabs(step->h * (dy[k] - step->dy[k])) * run->norm.weight[k]);
    for (int k = FIRST_STATE; k < N_Y && !status; k++)
        most = max_of(most, fabs(step->h * (dy[k] - step->dy[k])) * run->norm.weight[k]);
    if (!status && all_finite(dy, N_Y))
        step->harm = most;
    if (step->harm < HARMLESS) {
        for (int k = 0; k < N_Y; k++)
            step->dy[k] = dy[k];
        step->rhs = rhs;
        step->dense_ready = step->dense_ready == HERE ? HERE : 0; /* others made it with rates of this side */
        return 1;
    }
    for (int k = 0; k < N_SWITCHES; k++)
        step->passed[k] = 0;
    watch_every_switch(run); /* one that was to be left alone as well: its wrong branch does harm */
    return 0;
}

/* Whether margin k is not looked at: a corner left alone, or passed without harm. */
static int is_ignored(const Integrator *run, const Step *step, int k)
{
    const int corner = k - N_CLEARANCES;
    return corner >= 0 && corner < N_SWITCHES && (corner == run->roots.skip || step->passed[corner]);
}

/* The stage at which margin k was lowest; 1: none. */
static double stage_of_minimum(const Step *step, int k)
{
    const StageValues seen = stage_values(step, k);
    for (int i = 0; i < step->n_seen; i++)
        if (stage_value(seen, i) == step->lowest[k])
            return step->node[i];
    return 1.0;
}

/* The first stage at which margin k was below zero, where a later one, or the end, was not: it may cross more than
 * once. 1: none. */
static double first_negative_stage(const Step *step, int k, double end)
{
    const StageValues seen = stage_values(step, k);
    double first = 1.0, back = end >= 0.0 ? 1.0 : 0.0;
    for (int i = 0; i < step->n_seen; i++) {
        const double f = stage_value(seen, i);
        first = f < 0.0 ? min_of(first, step->node[i]) : first;
        back = f >= 0.0 ? max_of(back, step->node[i]) : back;
    }
    return first < back ? first : 1.0;
}

/* The bracket's upper end for margin k, of no joint whose rate is known: a share at which it is below zero; 0: none. */
static double last_negative_stage(Integrator *run, Step *step, int k, const Parameters *p, double *value)
{
    if (watched_as[k] >= 0)
        return first_negative_sample(run, step, watched_as[k], p, value);
    const double end = event_function(&run->discrete, &step->rhs, k);
    for (int last = 0; last < 2 && step->lowest[k] < 0.0; last++) {
        const double at = last ? stage_of_minimum(step, k) : first_negative_stage(step, k, end);
        if (at >= 1.0 || make_dense(run, p, step))
            continue;
        *value = event_function_at(run, step, at, k, p);
        if (*value < 0.0)
            return at;
    }
    *value = end;
    return end < 0.0 ? 1.0 : 0.0;
}

/* Whether margin k, if it is watched, is larger than its uncertainty at a state. */
static int is_resolved(Integrator *run, double t, const double *y, const RhsOutputs *rhs, int k, const Parameters *p)
{
    double error[AT_LEAST_ONE(N_WATCHED)] = {0.0};
    if (watched_as[k] < 0)
        return 1;
    uncertainty(run, t, y, p, error);
    return !(fabs(event_function(&run->discrete, rhs, k)) <= error[watched_as[k]]);
}

/* The same at a share of a step. */
static int is_resolved_at(Integrator *run, const Step *step, double fraction, int k, const Parameters *p)
{
    double y[N_Y], dy[N_Y];
    RhsOutputs rhs;
    return watched_as[k] < 0 || state_at(run, step, fraction, p, y, dy, &rhs)
        || is_resolved(run, step->t + fraction * step->h, y, &rhs, k, p);
}

/* What was not seen at the stages but shows where an event was found crossed before it: the first of all. */
static double event_before(Integrator *run, const Step *step, double first, const Parameters *p, int *event)
{
    for (int again = 0; again < N_EVENT_FUNCTIONS && first > 0.0; again++) {
        const int slot = sample_at(run, step, first, *event, p);
        int found = -1;
        for (int k = 0; k < N_EVENT_FUNCTIONS && slot >= 0; k++)
            if (run->roots.samples.event_function[slot][k] < 0.0 && k != *event && !is_ignored(run, step, k)
                && !isfinite(bracket_begin(run, step, k).slope) && event_function(&run->discrete, &run->rhs, k) >= 0.0
                && is_resolved_at(run, step, first, k, p))
                found = k;
        if (found < 0)
            return first;
        const Place high = bracket_point_at(run, step, first, found, p);
        const Bracket of = stage_bracket(step, found, bracket_begin(run, step, found), high);
        const double s = locate_root(run, step, found, of, guess_zero(&of, n_interpolation_points(run, found)), p);
        if (!(s < first))
            return first;
        first = s;
        *event = found;
    }
    return first;
}

/* A margin that ends the step: places at which it is not yet below zero and at which it is; about where it crosses. */
typedef struct {
    int k;
    Bracket of;
    double guess, about;
} Candidate;

/* Whether margin k is below zero somewhere in the step; a joint's beyond the share `until` may be left out. */
static int is_candidate(Integrator *run, Step *step, int k, const Parameters *p, double until, Candidate *now)
{
    double at_high;
    Place low = bracket_begin(run, step, k), end = {0.0, NAN, NAN};
    const int is_gap = isfinite(low.slope), sampled = is_gap || is_contact_force_function(run, k);
    const int some = is_gap ? has_zero(run, step, k, p, until, &low, &end)
        : sampled ? has_force_zero(run, step, k, p, &low, &end) : 0;
    const double high = sampled ? some * end.s : last_negative_stage(run, step, k, p, &at_high);
    if (high == 0.0 || make_dense(run, p, step))
        return 0;
    if (watched_as[k] >= 0 && step->from[watched_as[k]] > 0.0) {
        const Place from = bracket_point_at(run, step, step->from[watched_as[k]], k, p);
        if (from.f >= 0.0 || step->above[watched_as[k]] >= 0.0)
            low = from;
    }
    if (watched_as[k] >= 0 && step->above[watched_as[k]] >= 0.0) /* below zero by its uncertainty at most */
        low.f = max_of(low.f, 0.0);
    for (int j = 1; j < 4 && !sampled && !(low.f >= 0.0); j++) { /* begun on the wrong side: does it come back first? */
        const Place part = bracket_point_at(run, step, 0.25 * j * high, k, p);
        if (part.f >= 0.0)
            low = part;
    }
    now->k = k;
    if (!is_gap)
        end = high < 1.0 ? bracket_point_at(run, step, high, k, p) : bracket_end(run, step, k);
    now->of = stage_bracket(step, k, low, end);
    now->guess = low.f >= 0.0 ? guess_zero(&now->of, n_interpolation_points(run, k)) : low.s;
    now->about = low.f >= 0.0 ? about_where(now->guess, &now->of) : low.s;
    return 1;
}

/* The first share of the step at which one of the margins that count ends it, and which (-1: nothing, share 1). */
static double first_crossing(Integrator *run, Step *step, const Parameters *p, int *event)
{
    double first = 1.0, until = 1.0; /* an event comes no later than that */
    double at_end[AT_LEAST_ONE(N_EVENT_FUNCTIONS)];
    Candidate some[AT_LEAST_ONE(N_EVENT_FUNCTIONS)];
    int n = 0;
    *event = -1;
    evaluate_event_functions(&run->discrete, &step->rhs, at_end);
    for (int k = 0; k < N_EVENT_FUNCTIONS; k++) {
        const int quiet = k >= N_CLEARANCES && watched_as[k] < 0 && !is_contact_force_function(run, k)
            && !(step->lowest[k] < 0.0) && !(at_end[k] < 0.0);
        Candidate now;
        int i = n;
        if (quiet || is_ignored(run, step, k) || !is_candidate(run, step, k, p, until, &now))
            continue;
        for (n++; i > 0 && some[i - 1].about > now.about; i--)
            some[i] = some[i - 1];
        some[i] = now;
        if (k < N_CLEARANCES)
            until = min_of(until, now.of.at[1].s);
    }
    for (int i = 0; i < n; i++) {
        const Candidate *now = &some[i];
        if (*event >= 0 && now->of.at[1].s > first && event_function_at(run, step, first, now->k, p) >= 0.0)
            continue; /* later than what was found */
        const double s =
            now->of.at[0].f >= 0.0 ? locate_root(run, step, now->k, now->of, now->guess, p) : now->of.at[0].s;
        if (*event < 0 || s < first) {
            first = s;
            *event = now->k;
        }
    }
    return *event < 0 ? first : event_before(run, step, first, p, event);
}

/*
 * The first event of a step in contact that is far longer than the one before: margins of which no bounds are known may
 * cross zero and return between its stages, of which those of stiff methods lie far from the motion. The dense output
 * is sampled up to the first event that was found.
 */
static double first_event_of_long_step(Integrator *run, Step *step, double fraction, const Parameters *p, int *event)
{
    int closed = 0, hidden = 0;
    for (int i = 0; i < N_CLEARANCES; i++)
        closed |= run->discrete.contact[i].closed;
    if (!closed || !(fraction * step->h > LONG_STEP * run->control.last_step) || run->control.fixed > 0.0)
        return fraction;
    for (int k = 0; k < N_EVENT_FUNCTIONS && !hidden; k++)
        hidden = watched_as[k] < 0 && !isfinite(bracket_begin(run, step, k).slope) && !is_contact_force_function(run, k)
            && event_function(&run->discrete, &run->rhs, k) >= 0.0 && !is_ignored(run, step, k)
            && (step->method->stiff || !is_clear_of_zero(run, step, k, 0.0, p));
    if (!hidden || make_dense(run, p, step))
        return fraction;
    for (int i = 1; i < N_INNER_SAMPLES; i++) {
        int earlier = -1;
        const double first = event_before(run, step, fraction * i / N_INNER_SAMPLES, p, &earlier);
        if (earlier >= 0) {
            *event = earlier;
            return first;
        }
    }
    return fraction;
}

/* Poles of event functions: there a sign changes without an event. */
#if N_USER_EVENTS
enum { FAR_PLACES = 4 };

/* Event functions at share s of a step, straight on beyond its end; 0 for those that are below their uncertainty. */
static int events_at(Integrator *run, const Step *step, double s, const Parameters *p, double *value)
{
    double y[N_Y], dy[N_Y];
    RhsOutputs rhs;
    if (s > 1.0)
        return events_ahead(run, step->t + step->h, (s - 1.0) * step->h, step->y, step->dy, p, value);
    const int status = state_at(run, step, s, p, y, dy, &rhs);
    if (!status)
        resolved_events(run, step->t + s * step->h, y, &rhs, p, value);
    return status;
}

/*
 * Whether event function i changes its sign at a pole and not at a zero: it is larger where it was located than at the
 * first place behind that where it is larger than its uncertainty. One that jumps from one finite value to another is
 * as large near it as far from it. Places are those of the dense output: what drives move does not go straight on.
 */
static int is_pole(Integrator *run, const Step *step, double fraction, int i, const Parameters *p)
{
    double y[N_Y], dy[N_Y], value[N_USER_EVENTS], ahead = event_time_tolerance(run, step);
    RhsOutputs rhs;
    if (state_at(run, step, fraction, p, y, dy, &rhs))
        return 0;
    for (int n = 0; n < FAR_PLACES && isfinite(rhs.event[i]); n++) {
        ahead *= POLE_DISTANCE;
        if (!events_at(run, step, fraction + ahead, p, value) && value[i] != 0.0)
            return is_near_pole(rhs.event[i], value[i]);
    }
    return isinf(rhs.event[i]);
}
#else
static inline int is_pole(Integrator *run, const Step *step, double fraction, int i, const Parameters *p)
{
    return (void)run, (void)step, (void)fraction, (void)i, (void)p, 0;
}
#endif

/* The first share of the step at which something ends it, and what (-1: nothing, share 1). */
static double first_event(Integrator *run, Step *step, const Parameters *p, int *event)
{
    const int passed = ignore_harmless_switches(run, step, p);
    search_step(run, step, p);
    double fraction = first_crossing(run, step, p, event);
    if (*event >= 0 && passed) {
        /* something else ends the step: what was passed may lie behind it */
        for (int k = 0; k < N_SWITCHES; k++)
            step->passed[k] = 0;
        fraction = first_crossing(run, step, p, event);
    }
    fraction = first_event_of_long_step(run, step, fraction, p, event);
    const int user_event = *event - (N_EVENT_FUNCTIONS - N_USER_EVENTS);
    set_pole(run, user_event >= 0 && is_pole(run, step, fraction, user_event, p));
    return fraction;
}

static void start_roots(Integrator *run) { run->roots.crossed = run->roots.skip = -1; }

/* left: of the run, s. By fixed steps a run goes on as if it had never been cut. */
static void set_time_resolution(Integrator *run, double left)
{
    run->roots.time_resolution = min_of(1e-12, run->control.fixed > 0.0 ? 1e-8 * run->control.fixed : 1e-11 * left);
}

#define LEAST_LEAP 1e-3 /* of a tolerance: a corner that changes less in a step is none that counts */
/* By how many tolerances a second the other side's rates differ from those before. */
static double rate_jump(const Integrator *run, const double *before)
{
    double most = 0.0;
    for (int k = 0; k < N_Y; k++)
        most = max_of(most, fabs(run->dy[k] - before[k]) * run->norm.weight[k]);
    return most;
}

/*
 * A motion that stays by a corner (a journal that hardly moves in its film) may cross it again and again. One that
 * comes back at once is not looked for in the next step, which is as short as the way between the crossings and
 * grows from there: the corner's branches meet, so that little is wrong with the held one so near. They do by their
 * expressions, or but for rounding: what another side does in such a step is no tolerance by far.
 */
static void suppress_repeated_switch(Integrator *run, int corner, const double *before)
{
    const double way = run->t - run->roots.t_crossed;
    const double monitor = 20.0 * max_of(100.0 * run->roots.time_resolution, max_of(run->roots.monitor, way));
    const int again = run->roots.crossed == corner && way < 1e-3 * run->control.h
        && (meets[corner]
            || (run->control.fixed <= 0.0 && rate_jump(run, before) * max_of(monitor, run->control.h) < LEAST_LEAP));
    run->roots.skip = again ? corner : -1;
    run->roots.monitor = again ? monitor : 0.0;
    run->roots.crossed = corner;
    run->roots.t_crossed = run->t;
}
