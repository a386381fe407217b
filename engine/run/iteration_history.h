/* States and rates at the starts of the current and the last step, for guesses of the stages of implicit methods. */
#ifndef GUDGEON_ITERATION_HISTORY_H
#define GUDGEON_ITERATION_HISTORY_H

#define FILM_FORCE_TOL 5e2 /* times rtol: relative accuracy of film forces when the iteration of stages ends */

/*
 * Update the stored beginnings of steps before a step is tried: at a new step the current beginning becomes the
 * previous one. A repeated attempt leaves them unchanged.
 *
 * Also set the distance of both beginnings (last_h, s; 0 unless the last step was stored), the accuracy of film forces
 * (film_force_tol), and newton.can_extrapolate. That is whether stages can be extrapolated from the last step: last_h >
 * 0 and no attempt at this step was rejected.
 */
static inline void update_iteration_history(Integrator *run)
{
    StepStart *now = &run->newton.now;
    if (run->newton.seen_steps != run->counts.steps || now->t != run->t) {
        const int is_next_step = run->newton.seen_steps == run->counts.steps - 1 && run->counts.steps > 0;
        run->newton.before_t = is_next_step ? now->t : run->t;
        for (int i = 0; i < N_Y; i++) {
            run->newton.before_y[i] = now->y[i];
            run->newton.before_dy[i] = now->dy[i];
            now->y[i] = run->y[i];
            now->dy[i] = run->dy[i];
        }
        now->t = run->t;
        run->newton.seen_steps = run->counts.steps;
    }
    run->newton.last_h = run->t - run->newton.before_t;
    run->newton.film_force_tol = min_of(1e-2, FILM_FORCE_TOL / run->norm.inverse_scale[2 * N_X - 1]);
    run->newton.can_extrapolate = run->newton.last_h > 0.0 && !run->control.attempt.was_rejected;
}

#endif
