/*
 * Terms that hang on time alone and may rise and fall within a step.
 */
void time_terms(const Range t, const Parameters *p, Range *out)
{
    /* parameters and time */
    const Range time = t;
    const Range length = only(p->length);
    const Range par_r = only(p->par_r);
    const Range omega = only(p->omega);

    /* terms */
    out[0] = range_asin(range_times(range_times(range_inverse(length), par_r), range_sin(range_times(omega,
        time))));
    out[1] = range_inverse(range_sqrt(range_add(only(1.0), range_times(range_times(range_times(only(-1.0),
        range_pow(length, only(-2.0))), range_square(par_r)), range_square(range_sin(range_times(omega,
        time)))))));
    out[2] = range_add(range_times(range_times(range_times(range_times(range_times(only(-1.0),
        range_inverse(length)), range_square(omega)), par_r), range_inverse(range_sqrt(range_add(only(1.0),
        range_times(range_times(range_times(only(-1.0), range_pow(length, only(-2.0))), range_square(par_r)),
        range_square(range_sin(range_times(omega, time)))))))), range_sin(range_times(omega, time))),
        range_times(range_times(range_times(range_times(range_times(range_pow(length, only(-3.0)),
        range_square(omega)), range_pow(par_r, only(3.0))), range_pow(range_add(only(1.0),
        range_times(range_times(range_times(only(-1.0), range_pow(length, only(-2.0))), range_square(par_r)),
        range_square(range_sin(range_times(omega, time))))), only(-1.5))), range_sin(range_times(omega,
        time))), range_square(range_cos(range_times(omega, time)))));
    out[3] = range_pow(range_add(only(1.0), range_times(range_times(range_times(only(-1.0), range_pow(length,
        only(-2.0))), range_square(par_r)), range_square(range_sin(range_times(omega, time))))), only(-1.5));
}
