/* No switches of the user's expressions, and no events: nothing that has an uncertainty. */
static void resolved_events(const Run *run, double t, const double *y, const Aside *aside, const Parameters *p,
    double *value)
{
    (void)run, (void)t, (void)y, (void)aside, (void)p, (void)value;
}

static void uncertainty(const Run *run, double t, const double *y, const Parameters *p, double *out)
{
    (void)run, (void)t, (void)y, (void)p, (void)out;
}
