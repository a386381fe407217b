/*
 * Terms that hang on time alone and may rise and fall within a step.
 */
void time_terms(const Range t, const Parameters *p, Range *out)
{
    /* terms */
    out[0] = range_asin(range_times(range_times(range_inverse(only(p->length_)), only(p->r_)),
        range_sin(range_times(only(p->omega_), t))));
    out[1] = range_inverse(range_sqrt(range_add(only(1.0), range_times(range_times(range_times(only(-1.0),
        range_pow(only(p->length_), only(-2.0))), range_square(only(p->r_))),
        range_square(range_sin(range_times(only(p->omega_), t)))))));
    out[2] = range_add(range_times(range_times(range_times(range_times(range_times(only(-1.0),
        range_inverse(only(p->length_))), range_square(only(p->omega_))), only(p->r_)),
        range_inverse(range_sqrt(range_add(only(1.0), range_times(range_times(range_times(only(-1.0),
        range_pow(only(p->length_), only(-2.0))), range_square(only(p->r_))),
        range_square(range_sin(range_times(only(p->omega_), t)))))))), range_sin(range_times(only(p->omega_), t))),
        range_times(range_times(range_times(range_times(range_times(range_pow(only(p->length_), only(-3.0)),
        range_square(only(p->omega_))), range_pow(only(p->r_), only(3.0))),
        range_pow(range_add(only(1.0), range_times(range_times(range_times(only(-1.0),
        range_pow(only(p->length_), only(-2.0))), range_square(only(p->r_))),
        range_square(range_sin(range_times(only(p->omega_), t))))), only(-1.5))),
        range_sin(range_times(only(p->omega_), t))), range_square(range_cos(range_times(only(p->omega_), t)))));
    out[3] = range_pow(range_add(only(1.0), range_times(range_times(range_times(only(-1.0),
        range_pow(only(p->length_), only(-2.0))), range_square(only(p->r_))),
        range_square(range_sin(range_times(only(p->omega_), t))))), only(-1.5));
}
