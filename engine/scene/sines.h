/*
 * Body of a function that computes sine and cosine of an angle, for one number or a SIMD vector. `angle` has the type
 * SINES_OF, a number or a vector; small: where the results are valid. SINES_BITS: integers of the same length; BITS_OF,
 * OF_BITS: reinterpret bits.
 */
    const double shift = 6755399441055744.0;
    const double half_1 = 1.57079632673412561417, half_2 = 6.07710050630396597660e-11;
    const double half_3 = 2.02226624879595063154e-21;
    const SINES_OF x = angle, shifted = x * 0.63661977236758134308 + shift, turns = shifted - shift;
    const SINES_BITS quarter = BITS_OF(shifted), small = (x < TURN_LIMIT) & (x > -TURN_LIMIT);
    const SINES_OF r = ((x - turns * half_1) - turns * half_2) - turns * half_3;
    const SINES_OF z = r * r, w = z * z;
    const SINES_OF s_high = 8.33333333332248946124e-03
        + z * (-1.98412698298579493134e-04 + z * 2.75573137070700676789e-06)
        + z * w * (-2.50507602534068634195e-08 + z * 1.58969099521155010221e-10);
    const SINES_OF s = r + z * r * (-1.66666666666666324348e-01 + z * s_high);
    const SINES_OF c_high =
        z * (4.16666666666666019037e-02 + z * (-1.38888888888741095749e-03 + z * 2.48015872894767294178e-05))
        + w * w * (-2.75573143513906633035e-07 + z * (2.08757232129817482790e-09 + z * -1.13596475577881948265e-11));
    const SINES_OF half = 0.5 * z, rest = 1.0 - half;
    const SINES_OF c = rest + (((1.0 - rest) - half) + z * c_high);
    /* odd quarters exchange sine and cosine; the sine has the sign of the half turn, the cosine the next quarter's */
    const SINES_BITS odd = -(quarter & 1), s_bits = BITS_OF(s), c_bits = BITS_OF(c);
    *sine = OF_BITS(((c_bits & odd) | (s_bits & ~odd)) ^ ((quarter & 2) << 62));
    *cosine = OF_BITS(((s_bits & odd) | (c_bits & ~odd)) ^ (((quarter + 1) & 2) << 62));
