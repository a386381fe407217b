/* Root finding by closed forms: location of a zero to a tolerance, zeros and grazes between samples, poles. */
#include "part.h"

/* A function to locate a zero of; how often it was evaluated; the evaluation that fails, -1: none. */
typedef struct {
    double (*f)(double), (*slope)(double);
    int count, fails;
} Evaluated;

static double minus_sine(double s) { return -sin(s); }
static double cubed(double s) { return -(s - 1.0) * (s - 1.0) * (s - 1.0); }
static double jump(double s) { return s < 1.5 ? 1.0 : -1e-6; }
static double pole(double s) { return 1.0 / (1.5 - s); }

static int evaluate(void *context, double s, Sample *now)
{
    Evaluated *of = context;
    now->f = of->f(s);
    now->slope = of->slope ? of->slope(s) : NAN;
    return of->count++ == of->fails ? 7 : 0;
}

/* The bracket of the zero between `from` and `to` after it was located. */
static Bracket located(Evaluated *of, double from, double to, ZeroTolerance near, int places)
{
    Bracket zero = {{{from, of->f(from), NAN}, {to, of->f(to), NAN}}, 2};
    CHECK(locate_zero(evaluate, of, &near, places, estimate_zero(&zero, 2), &zero) == 0);
    CHECK(zero.at[0].f >= 0.0 && zero.at[1].f < 0.0);
    return zero;
}

static void check_location(void)
{
    const struct {
        Evaluated of;
        double zero;
        int most; /* evaluations */
    } cases[] = {
        {{cos, NULL, 0, -1}, 0.5 * PI, 10}, {{cos, minus_sine, 0, -1}, 0.5 * PI, 50}, {{cubed, NULL, 0, -1}, 1.0, 160},
        {{jump, NULL, 0, -1}, 1.5, 160}, {{pole, NULL, 0, -1}, 1.5, 160},
    };
    for (int i = 0; i < 5; i++)
        for (double width = 0.0; width < 1e-2; width = width > 0.0 ? 1e4 * width : 1e-15) {
            Evaluated of = cases[i].of;
            const Bracket zero = located(&of, 0.25, 2.75, (ZeroTolerance){.width = width}, MAX_POINTS);
            const double low = zero.at[0].s, high = zero.at[1].s;
            CHECK(high - low <= width || high == nextafter(low, 3.0));
            CHECK(of.count <= (width > 0.0 ? cases[i].most : 160));
            CHECK(of.f != cubed ? low <= cases[i].zero && cases[i].zero <= high : CLOSE(high, 1.0, 1e-5 + width));
        }
}

/* A place after the zero is enough where it does no harm: |df/ds| d^2 <= 1e-8 with df/ds = -1. */
static void check_tolerance(void)
{
    for (double beyond = 1e-2; beyond > 1e-9; beyond *= 0.1) {
        Evaluated of = {cos, minus_sine, 0, -1};
        const double d = located(&of, 0.25, 2.75, (ZeroTolerance){1e-15, beyond, 1e-8, 1.0}, 3).at[1].s - 0.5 * PI;
        CHECK(d >= 0.0 && d <= 1.001 * beyond && d <= 1.001e-4);
        CHECK(of.count <= 4);
    }
    Evaluated of = {cos, NULL, 0, 2};
    Bracket zero = {{{0.0, 1.0, NAN}, {3.0, -1.0, NAN}}, 2};
    CHECK(locate_zero(evaluate, &of, &(ZeroTolerance){.width = 1e-12}, 3, NAN, &zero) == 7);
}

/* (s - middle)^2 - depth, by the bounds of its terms; where a part was found that has its first zero. */
typedef struct {
    double middle, depth, a, b;
    int parts;
} Parabola;

static int judge(void *context, double a, double b, int small)
{
    Parabola *of = context;
    const Interval s = {a - of->middle, b - of->middle, 1.0, 1.0, 0};
    const Interval f = interval_add(interval_mul(s, s), make_interval(-of->depth));
    const int found = classify_zero(f, s.lo * s.lo - of->depth, s.hi * s.hi - of->depth, b - a, small);
    of->parts++;
    of->a = found > 0 ? a : of->a;
    of->b = found > 0 ? b : of->b;
    return found;
}

static void check_grazes(void)
{
    for (double depth = 0.04; depth > 1e-18; depth *= 0.1) {
        Parabola of = {.middle = 0.3, .depth = depth};
        CHECK(bisect_interval(0.0, 1.0, 1e-12, judge, &of) == 1); /* the first of two zeros, 2 sqrt(depth) apart */
        CHECK(of.a <= 0.3 - sqrt(depth) + 1e-12 && of.b >= 0.3 - sqrt(depth) - 1e-12 && of.a < 0.3);
        CHECK(of.b < 0.3 + sqrt(depth) + 1e-12);
        of = (Parabola){.middle = 0.3, .depth = -depth};
        CHECK(bisect_interval(0.0, 1.0, 1e-12, judge, &of) == 0);
        CHECK(of.parts < 200);
    }
    Parabola touched = {.middle = 0.3};
    CHECK(bisect_interval(0.0, 1.0, 1e-12, judge, &touched) == 0); /* it comes to zero and is not below it */
}

int main(void)
{
    check_location();
    check_tolerance();
    check_grazes();
    CHECK(is_near_pole(1.0 / 1e-12, 1.0 / 64e-12) && is_near_pole(INFINITY, INFINITY));
    CHECK(!is_near_pole(1e-12, 64e-12) && !is_near_pole(1.0, 1.0));
    CHECK(is_bound_narrowing(-0.01, 0.0625, -1.0) && !is_bound_narrowing(-0.5, 0.0625, -1.0));
    CHECK(!is_bound_narrowing(-0.01, 1.0, -1.0));
    return failures;
}
