/* Root finding: the first zero of a penetration in a step whose motion is a cosine. */
#include "part.h"

static Integrator run;

/* The time of the first event of a step of dop853 from t to t + h along x = cos t; NAN: there is none. */
static double event_on_cosine(double t, double h, double offset)
{
    const double scale[2] = {1e-8, 1e-8}, least[2] = {1.0, 1.0};
    const Parameters p = {.radius = 10.0, .offset = offset};
    int event;
    run = (Integrator){.t = t, .y = {cos(t), -sin(t)}};
    gudgeon_adaptive_setup(&run, gudgeon_method("dop853"), 0, scale, least, 0.0);
    set_time_resolution(&run, 1.0);
    run.norm.speed[0] = run.norm.speed[1] = run.norm.energy_scale = 1.0;
    update_error_weights(&run);
    run.discrete.is_frozen = 1;
    run.discrete.branch[0] = 1.0;
    Step *step = &run.step;
    step->method = run.choice.method;
    CHECK(!evaluate_run_rhs(&run, t, run.y, &p, run.dy, &run.rhs));
    run.discrete.contact[0].closed = run.rhs.clearance[0].delta > 0.0;
    CHECK(!dop853_try_step(&run, h, &p, step) && step->error <= 1.0);
    const double fraction = find_first_event(&run, step, &p, &event);
    CHECK(event == -1 || event == 0);
    return event < 0 ? NAN : t + fraction * h;
}

int main(void)
{
    const double quarter = 0.5 * acos(-1.0);
    /* a contact ends at pi/2 and begins at -pi/2 */
    CHECK(CLOSE(event_on_cosine(1.4, 0.4, 0.0), quarter, 1e-9));
    CHECK(CLOSE(event_on_cosine(-1.8, 0.4, 0.0), -quarter, 1e-9));
    CHECK(isnan(event_on_cosine(0.1, 0.4, 0.0)));

    /* two zeros in a step: the first of cos t = 1 - d lies at -acos(1 - d), however shallow the contact is */
    for (double depth = 1e-2; depth > 1e-5; depth *= 0.1)
        CHECK(CLOSE(event_on_cosine(-0.23, 0.4, 1.0 - depth), -acos(1.0 - depth), 1e-7));
    CHECK(isnan(event_on_cosine(-0.23, 0.4, 1.0 + 1e-9)));
    return failures;
}
