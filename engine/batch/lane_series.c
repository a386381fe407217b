/* A trial step by the Taylor series of the motion for several runs in SIMD lanes (methods/taylor.c). */
#define SeriesRow Lanes
#define SeriesWide Lanes
#define SeriesPart Lanes
#include "../scalar_simd/series.h"

/*
 * Remove the lanes whose step has an error above run->control.max_accepted_error from the mask step->is_accepted.
 * Called when the defect at the end of a step is known.
 */
static void reject_step_by_defect(const LaneIntegrator *run, LaneStep *step)
{
    step->is_accepted &= ~(step->error > run->control.max_accepted_error);
}

/* Do nothing: lanes do not count the repeated evaluation at the end of a step. */
static void subtract_end_evaluation(const LaneIntegrator *run) { (void)run; }

#include "../scalar_simd/taylor.h"

/*
 * Try a step by Taylor series in all lanes, of length h (s) or of the longest valid length if that is shorter. Return 0
 * or a status. Lanes at singular positions or with series that are not finite are added to run->discrete.needs_scalar:
 * their scalar runs make the step. `method` is not used. In the library of the other methods, lane_tries.c defines this
 * function.
 */
static int try_method(LaneIntegrator *run, int method, Lanes h, const LaneParameters *p, LaneStep *step)
{
    SeriesRow(*const factors)[TAYLOR_ORDERS][SERIES_ROWS] = get_series_factors();
    TaylorValues at;
    Lanes(*const c)[TAYLOR_Y] = run->series.terms;
    (void)method;
    for (int i = 0; i < N_Y; i++)
        c[0][i] = run->y[i];
    taylor_values(run->t, run->y, run->y + N_X, p, &at, c[1] + N_X, c[1] + 2 * N_X, &run->discrete.needs_scalar);
    compute_series_orders(p, &at, run->series.order, c, factors[0], factors[1]);
    run->discrete.needs_scalar |= find_nonfinite_lanes(c[run->series.order], NULL, N_Y);
    run->series.max_step = round_step_length(run, taylor_compute_max_length(run));
    return taylor_try_series_step(run, h, p, step);
}
