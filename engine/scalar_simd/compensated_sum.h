/* Compensated summation: sums together with their rounding errors. */

/*
 * Add a change to *sum and return the rounding error of the sum; both together are exact (TwoSum). W. Kahan's
 * compensated summation, with the error of D. E. Knuth, The Art of Computer Programming 2, section 4.2.2, theorem B.
 */
static inline Real add_compensated(Real *sum, Real change)
{
    const Real before = *sum, after = before + change, added = after - before;
    *sum = after;
    return (before - (after - added)) + (change - added);
}
