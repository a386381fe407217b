/* No friction between surfaces that do not give. */
typedef char Rub;

static void leave_out_friction(Memory *memory) { (void)memory; }

static int what_ends(const Run *run, int otherwise, const Parameters *p) { return (void)run, (void)p, otherwise; }

static void see_slips(Run *run, const Parameters *p) { (void)run, (void)p; }

static int rub_in_blow(Run *run, const Answer *blow, const double *meeting, double *impulse, const Parameters *p,
    Rub *rub)
{
    (void)run, (void)blow, (void)meeting, (void)impulse, (void)p, (void)rub;
    return 0;
}

static double rub_off(const Rub *rub, const double *impulse, double *y)
{
    return (void)rub, (void)impulse, (void)y, 0.0;
}
