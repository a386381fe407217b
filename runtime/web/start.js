/*
 * Find the start of a run: coordinates q and velocities v of the closed linkage.
 *
 * As in Python, C closes the linkage near its guess. If that fails, the file's start, which Python found, is continued
 * from the file's parameter values to those of the run.
 */
const MAX_STEP_FRACTION = 1 / 8, MIN_STEP_FRACTION = 1e-7; // of a continuation, over the way of the parameters
const MAX_CHANGE = 0.2; // of q in a step: rad, or fraction of the size; less than assemblies differ (guess_warnings.py)
const MAX_TRIES = 3000; // steps of a continuation, some milliseconds each for the largest linkages

/* Return the error for a start that Python, unlike a page, would search further (assembly/start.py). */
function makeStartError(message) { return Object.assign(new Error(message), {isSearchedInPython: true}); }

/* Return a number as text: a length in mm, an angle in degrees, any other number in SI. */
function formatLengthOrAngle(x, unit, digits) {
    const [factor, shownUnit] = {m: [1e3, "mm"], rad: [180 / Math.PI, "°"]}[unit] ?? [1, unit];
    return `${Number((factor * x).toPrecision(digits))}${shownUnit === "°" ? "" : " "}${shownUnit}`.trim();
}

/* Search of the start of a simulator's scene. A start is {q, v, isContinued}, Float64Arrays (n) in SI. */
class StartFinder {
    constructor(sim) { Object.assign(this, {sim, lib: sim.lib, description: sim.description, n: sim.n}); }

    /* Return the start at the parameter values of the run. Throws an Error if there is none. */
    find() {
        const {sim, description} = this, stored = description.start;
        const present = stored && this.computeDependencies(sim.p);
        const isUnchanged = (part) => present[part].every((x, k) => Object.is(x, this.atDefaults[part][k]));
        if (stored) this.atDefaults ??= this.computeDependencies(sim.defaults);
        const isPositionStored = stored && isUnchanged("rows") && isUnchanged("guess");
        if (isPositionStored && isUnchanged("rates"))
            return {q: Float64Array.from(stored.q), v: Float64Array.from(stored.v)};
        const closed = isPositionStored || stored?.large ? null : this.closeNearGuess(sim.p);
        if (closed && !closed.open) return closed;
        return this.continueFromDefaults(closed?.gap ?? "", isPositionStored);
    }

    /* Return the start near the guess for parameter values p, found by C; {open, gap} if the linkage does not close. */
    closeNearGuess(p) {
        const {lib, n, sim} = this;
        return withMemory(lib, (memory) => {
            const [parameters, q, v] = [memory.allocateDoubles(p.length, p), memory.allocateDoubles(n),
                memory.allocateDoubles(n)];
            const open = lib.gudgeon_start(0, parameters, sim.computeSize(p), q, v, memory.allocateDoubles(1));
            const start = {q: memory.copyDoubles(q, n), v: memory.copyDoubles(v, n)};
            const isFound = !open && start.v.every(Number.isFinite);
            return isFound ? start : {open: true, gap: this.describeGap(memory, parameters, q)};
        });
    }

    /* Return the most violated constraint equation at q as text, from addresses of p and q; "" if all are satisfied. */
    describeGap(memory, p, q) {
        const {rows, open} = this.description, phi = memory.allocateDoubles(rows.length);
        const computeRatio = ([x, unit]) => x / (unit === "m" ? this.sim.size : 1);
        this.lib.gudgeon_phi(0, q, p, phi);
        const residuals = rows.map(([owner, unit], k) =>
            [Math.abs(memory.viewDoubles(phi, rows.length)[k]), unit, owner]);
        const worst = residuals.sort((a, b) => computeRatio(b) - computeRatio(a))[0];
        if (!worst || !(computeRatio(worst) > open) || !Number.isFinite(computeRatio(worst))) return "";
        const [x, unit, owner] = worst;
        return `: the largest gap, ${formatLengthOrAngle(x, unit, 3)}, is in a row of ${owner}`;
    }

    /*
     * Return what a start depends on for parameter values p, as {rows, guess, rates}.
     *
     * rows: constraint equations with their Jacobian at the file's start, and specified coordinates. guess: the guess.
     * rates: the right-hand side of the velocity equation, specified rates, and masses.
     */
    computeDependencies(p) {
        const {lib, n} = this, {q, rows, values: [n_guesses, n_set, n_rates]} = this.description.start;
        return withMemory(lib, (memory) => {
            const counts = [rows, rows * n, n_set, n_guesses, rows, n_rates, n];
            const arrays = counts.map((count) => memory.allocateDoubles(count));
            const [phi, phi_q, set, guess, nu, rates, mass] = arrays;
            const parameters = memory.allocateDoubles(p.length, p), position = memory.allocateDoubles(n, q);
            lib.gudgeon_phi(0, position, parameters, phi);
            lib.gudgeon_phi_q(0, position, parameters, phi_q);
            lib.gudgeon_nu(0, position, parameters, nu);
            lib.gudgeon_start_values(parameters, guess, set, rates);
            lib.gudgeon_mass(parameters, mass);
            const join = (...addresses) =>
                addresses.flatMap((address) => [...memory.copyDoubles(address, counts[arrays.indexOf(address)])]);
            return {rows: join(phi, phi_q, set), guess: join(guess), rates: join(nu, rates, mass)};
        });
    }

    /*
     * Return the start for parameter values p by Newton steps of C from the coordinates `from`; null if it is not near.
     *
     * The result also contains `hasVelocities`: whether C found the velocities.
     */
    tryStep(p, from) {
        const {lib, n} = this, size = this.sim.computeSize(p);
        return withMemory(lib, (memory) => {
            const [q, v] = [memory.allocateDoubles(n, from), memory.allocateDoubles(n)];
            const status = lib.gudgeon_continuation(0, memory.allocateDoubles(p.length, p), size, q, v);
            const start = {q: memory.copyDoubles(q, n), v: memory.copyDoubles(v, n), hasVelocities: status === 0};
            const isNear = start.q.every((x, k) => Math.abs(x - from[k]) < MAX_CHANGE * (k % 3 === 2 ? 1 : size));
            return status !== 1 && isNear ? start : null;
        });
    }

    /*
     * Return the start by continuation from the file's assembly. Throws an Error if it does not reach the values.
     *
     * gap: text on the most violated equation near the guess. isPositionStored: the stored coordinates are valid here.
     */
    continueFromDefaults(gap, isPositionStored) {
        const {sim} = this;
        const origin = this.description.start ?? (this.closedAtDefaults ??= this.closeNearGuess(sim.defaults));
        let [start, fraction, step] = [origin, 0, isPositionStored ? 1 : MAX_STEP_FRACTION];
        for (let tries = 0; fraction < 1; tries++) {
            const end = Math.min(fraction + step, 1), next = this.tryStep(sim.interpolateParameters(end), start.q);
            if (next) [start, fraction, step] = [next, end, Math.min(2 * step, MAX_STEP_FRACTION)];
            else step /= 2;
            if (step < MIN_STEP_FRACTION || tries === MAX_TRIES) throw makeStartError(this.describeEnd(fraction, gap));
        }
        if (!start.hasVelocities || !start.v.every(Number.isFinite))
            throw makeStartError("the linkage closes with these numbers and has no velocities there");
        return isPositionStored ? {q: Float64Array.from(origin.q), v: start.v} : {...start, isContinued: true};
    }

    /* Return the message for a continuation that ended at a fraction of the way. */
    describeEnd(fraction, gap) {
        const {slots: parameters} = this.description, {givenValues, isGiven, defaults} = this.sim;
        const changed = parameters.filter(({words}, k) => isGiven[k] && !words && givenValues[k] !== defaults[k]);
        const percent = Number((100 * fraction).toPrecision(3));
        if (changed.length !== 1)
            return `the linkage no longer closes beyond ${percent} % of the way from the file's numbers to these${gap}`;
        const [{address, unit}] = changed, k = parameters.indexOf(changed[0]);
        const last = formatLengthOrAngle(defaults[k] + fraction * (givenValues[k] - defaults[k]), unit, 4);
        return `the linkage no longer closes beyond ${address} = ${last}${gap}`;
    }
}
