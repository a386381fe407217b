/*
 * The start of a run: q and v of the closed linkage. As in Python C closes it near its guess; where that does not do,
 * the file's start, which Python found by all its means, is followed from the file's numbers to those of the run.
 */
const FIRST_STEP = 1 / 8, LEAST_STEP = 1e-7; // shares of that way
const NEAR = 0.2; // rad, or share of the size: tells two assemblies apart (assembly/followed.py); no step goes so far
const MOST_TRIES = 3000; // steps of that way, some milliseconds each for the largest linkages

/* The error of a start that a page does not look for any further, as Python does (assembly/start.py). */
function searched(text) { return Object.assign(new Error(text), {searched: true}); }

/* A length or an angle with the unit that people read, any other number in SI. */
function readably(x, unit, digits) {
    const [factor, shown] = {m: [1e3, "mm"], rad: [180 / Math.PI, "°"]}[unit] ?? [1, unit];
    return `${Number((factor * x).toPrecision(digits))}${shown === "°" ? "" : " "}${shown}`.trim();
}

class Start {
    constructor(sim) { Object.assign(this, {sim, lib: sim.lib, about: sim.about, n: sim.n}); }

    /* With the numbers of the run. */
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

    /* Near the guess, by C; or `open`, and where. */
    near(numbers) {
        const {lib, n, sim} = this;
        return within(lib, (memory) => {
            const [p, q, v] = [memory.numbers(numbers.length, numbers), memory.numbers(n), memory.numbers(n)];
            const open = lib.gudgeon_start(0, p, sim.sizeOf(numbers), q, v, memory.numbers(1));
            const found = {q: memory.copy(q, n), v: memory.copy(v, n)};
            return open || !found.v.every(Number.isFinite) ? {open: true, gap: this.gap(memory, p, q)} : found;
        });
    }

    /* The row that is furthest open at q, in words; "" where none is. */
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

    /* What a start follows from: rows that close and their slopes, the guess; what the velocities follow from. */
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

    /* The start that one with other numbers leads to, if it is near: by Newton's steps of C. */
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

    /* The file's assembly, from the file's numbers on; where the rows stand it is as it was. */
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

    /* How far it went. */
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
