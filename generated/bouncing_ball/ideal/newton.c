/* Stand-in. */
typedef struct {
    int none;
} Linear;

static int linearize(double t, const double *q, const double *v, const Memory *memory, const Parameters *p, const double *a,
    const Aside *aside, Linear *lin)
{
    (void)t, (void)q, (void)v, (void)memory, (void)p, (void)a, (void)aside, (void)lin;
    return 1;
}
static int newton_factor(double hg, Linear *lin) { (void)hg, (void)lin; return 1; }
static void newton_solve(const Linear *lin, double hg, double s, const double *r, double *u) { (void)lin, (void)hg, (void)s, (void)r, (void)u; }
