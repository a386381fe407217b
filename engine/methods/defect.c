/*
 * Defect of the dense output: by how much the interpolant of a step fails the equations of motion between its ends.
 */

/*
 * Rates of the interpolant at fraction theta of a step, whose coefficients are made: of the nested polynomial
 * y0 + w0 (d0 + w1 (d1 + ...)), each w being theta or 1 - theta, and of its derivative by Horner's scheme.
 */
static void interpolate_rates(const Step *step, double theta, double *dy)
{
    const Method *method = step->method;
    double value[N_Y] = {0.0};
    for (int i = 0; i < N_Y; i++)
        dy[i] = 0.0;
    for (int k = method->degree - 1; k >= 0; k--) {
        const int turned = method->turned >> k & 1;
        const double w = turned ? 1.0 - theta : theta, way = turned ? -1.0 : 1.0;
        for (int i = 0; i < N_Y; i++) {
            const double sum = step->dense[k][i] + value[i];
            dy[i] = w * dy[i] + way * sum;
            value[i] = w * sum;
        }
    }
    for (int i = 0; i < N_Y; i++)
        dy[i] /= step->h;
}

/*
 * Forces of films: by how much accelerations `dy` that follow from a state inside a step differ from those of the
 * interpolant, `rate`. That is the error of the forces there. It is a share of the largest acceleration of its kind,
 * or, near equilibrium, of that of the lightest body under the largest force of a film, whose joint is in `where`.
 */
static double film_defect(const Run *run, const Aside *aside, const double *rate, const double *dy,
    const Parameters *p, int *where)
{
    double most = 0.0, off[2] = {0.0, 0.0}, largest[2], m[N_Q], lightest = INFINITY, share = 0.0;
    *where = -1;
    for (int i = 0; i < N_CLEARANCES; i++)
        if (has_film(i) && total_force(&aside->clearance[i]) > most)
            most = total_force(&aside->clearance[i]), *where = i;
    if (*where < 0)
        return 0.0;
    mass_matrix(p, m);
    for (int k = 0; k < N_Q; k += 3)
        lightest = m[k] > 0.0 ? min_of(lightest, m[k]) : lightest;
    largest[0] = most / lightest;
    largest[1] = largest[0] * run->least[1] / run->least[0];
    for (int k = 0; k < N_X; k++) {
        const int v = N_X + k, kind = !!is_angle[k];
        off[kind] = max_of(off[kind], fabs(rate[v] - dy[v]));
        largest[kind] = max_of(largest[kind], max_of(fabs(run->dy[v]), max_of(fabs(rate[v]), fabs(dy[v]))));
    }
    for (int kind = 0; kind < 2; kind++)
        share = max_of(share, largest[kind] > 0.0 ? off[kind] / largest[kind] : 0.0);
    return share;
}

#define FILM_FORCE 1e6 /* times rtol, 1e-2 at least: share of a film's force that may be wrong inside a step */

static double film_limit(const Run *run) { return min_of(1.0, max_of(1e-2, FILM_FORCE * tolerance_of(run))); }

/*
 * Whether a step that begins with a force of a film which fades at once, or rises, leads over that: where the
 * interpolant begins with other accelerations than the motion does, forces inside the step are wrong.
 */
static int misses_film(Run *run, Step *step, const Parameters *p)
{
    double rate[N_Y];
    int where;
    if (!step->method->stiff || !has_films() || make_dense(run, p, step))
        return 0;
    interpolate_rates(step, 0.0, rate);
    return film_defect(run, &step->aside, rate, run->dy, p, &where) > film_limit(run);
}
