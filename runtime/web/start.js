/*
 * Find the start of a run: q and v of the closed linkage.
 *
 * As in Python, C closes the linkage near its guess. If that fails, the file's start, which Python found, is continued
 * from the file's parameter values to those of the run.
 */
const FIRST_STEP = 1 / 8, LEAST_STEP = 1e-7; // fractions of the path of parameters
const NEAR = 0.2; // rad, or fraction of the size: largest step; distinguishes two assemblies (assembly/guess_warnings.py)
const MOST_TRIES = 3000; // steps of the continuation, some milliseconds each for the largest linkages

/* Return an error for a start that a page does not search any further, unlike Python (assembly/start.py). */
function searched(text) { return Object.assign(new Error(text), {searched: true}); }

/* Return a length or an angle with a readable unit, any other number in SI. */
function readably(x, unit, digits) {
    const [factor, shown] = {m: [1e3, "mm"], rad: [180 / Math.PI, "°"]}[unit] ?? [1, unit];
    return `${Number((factor * x).toPrecision(digits))}${shown === "°" ? "" : " "}${shown}`.trim();
}

/* Search for the start of a simulator's scene. */
class Start {
    constructor(sim) { Object.assign(this, {sim, lib: sim.lib, about: sim.about, n: sim.n}); }

    /* Return the start at the parameter values of the run. Throws an Error if there is none. */
    find() {
        const {sim, about} = this, own = about.start, now = own && this.follows(sim.p);
        const same = (part) => now[part].every((x, k) => Object.is(x, this.before[part][k]));
        if (own) this.before ??= this.follows(sim.file);
        const stands = own && same("rows") && same("guess");
        if (stands && same("rates")) return {q: Float64Array.from(own.q), v: Float64Array.from(own.v)};
        const near = stands || own?.large ? null : this.near(sim.p);
        if (near && !near.open) return near;
        return this.along(near?.gap ?? "", stands);
    }

    /* Return the start near the guess, found by C; {open, gap} if the linkage does not close. */
    near(numbers) {
        const {lib, n, sim} = this;
        return within(lib, (memory) => {
            const [p, q, v] = [memory.numbers(numbers.length, numbers), memory.numbers(n), memory.numbers(n)];
            const open = lib.gudgeon_start(0, p, sim.sizeOf(numbers), q, v, memory.numbers(1));
            const found = {q: memory.copy(q, n), v: memory.copy(v, n)};
            return open || !found.v.every(Number.isFinite) ? {open: true, gap: this.gap(memory, p, q)} : found;
        });
    }

    /* Return the most violated constraint equation at q as text; "" if all are satisfied. */
    gap(memory, p, q) {
        const {rows, open} = this.about, phi = memory.numbers(rows.length);
        const far = ([x, unit]) => x / (unit === "m" ? this.sim.size : 1);
        this.lib.gudgeon_phi(0, q, p, phi);
        const found = rows.map(([owner, unit], k) => [Math.abs(memory.view(phi, rows.length)[k]), unit, owner]);
        const worst = found.sort((a, b) => far(b) - far(a))[0];
        if (!worst || !(far(worst) > open) || !Number.isFinite(far(worst))) return "";
        const [x, unit, owner] = worst;
        return `: the largest gap, ${readably(x, unit, 3)}, is in a row of ${owner}`;
    }

    /*
     * Return what a start depends on: constraint equations with slopes, the guess, and what the velocities depend on.
     */
    follows(numbers) {
        const {lib, n} = this, {q, rows, values: [guesses, sets, rates]} = this.about.start;
        return within(lib, (memory) => {
            const counts = [rows, rows * n, sets, guesses, rows, rates, n];
            const places = counts.map((count) => memory.numbers(count));
            const [phi, phi_q, set, guess, nu, rate, mass] = places;
            const p = memory.numbers(numbers.length, numbers), at = memory.numbers(n, q);
            lib.gudgeon_phi(0, at, p, phi);
            lib.gudgeon_phi_q(0, at, p, phi_q);
            lib.gudgeon_nu(0, at, p, nu);
            lib.gudgeon_start_values(p, guess, set, rate);
            lib.gudgeon_mass(p, mass);
            const of = (...some) => some.flatMap((place) => [...memory.copy(place, counts[places.indexOf(place)])]);
            return {rows: of(phi, phi_q, set), guess: of(guess), rates: of(nu, rate, mass)};
        });
    }

    /* Return the start for other parameter values if it is near `from`, by Newton steps of C; otherwise null. */
    next(numbers, from) {
        const {lib, n} = this, size = this.sim.sizeOf(numbers);
        return within(lib, (memory) => {
            const [q, v] = [memory.numbers(n, from), memory.numbers(n)];
            const status = lib.gudgeon_continuation(0, memory.numbers(numbers.length, numbers), size, q, v);
            const found = {q: memory.copy(q, n), v: memory.copy(v, n), moving: status === 0};
            const near = found.q.every((x, k) => Math.abs(x - from[k]) < NEAR * (k % 3 === 2 ? 1 : size));
            return status !== 1 && near ? found : null;
        });
    }

    /* Return the start by continuation from the file's assembly. Throws an Error if it does not reach the values. */
    along(gap, stands) {
        const {sim} = this, own = this.about.start ?? (this.closed ??= this.near(sim.file));
        let [found, share, step] = [own, 0, stands ? 1 : FIRST_STEP];
        for (let tries = 0; share < 1; tries++) {
            const to = Math.min(share + step, 1), next = this.next(sim.between(to), found.q);
            if (next) [found, share, step] = [next, to, Math.min(2 * step, FIRST_STEP)];
            else step /= 2;
            if (step < LEAST_STEP || tries === MOST_TRIES) throw searched(this.ends(share, gap));
        }
        if (!found.moving || !found.v.every(Number.isFinite))
            throw searched("the linkage closes with these numbers and has no velocities there");
        return stands ? {q: Float64Array.from(own.q), v: found.v} : {...found, followed: true};
    }

    /* Return the message for a continuation that ended at a fraction of the path. */
    ends(share, gap) {
        const {slots} = this.about, {given, mask, file} = this.sim;
        const moved = slots.filter((slot, k) => mask[k] && !slot.words && given[k] !== file[k]);
        const most = Number((100 * share).toPrecision(3));
        if (moved.length !== 1)
            return `the linkage no longer closes beyond ${most} % of the way from the file's numbers to these${gap}`;
        const [{address, unit}] = moved, k = slots.indexOf(moved[0]);
        const last = readably(file[k] + share * (given[k] - file[k]), unit, 4);
        return `the linkage no longer closes beyond ${address} = ${last}${gap}`;
    }
}
