/*
 * Run the time loops: call the engine for some steps or samples at a time, and handle its status codes.
 *
 * The calls are the same as in engine/batch, runtime/integrators/batch.py and kinematic.py, so that results are equal
 * bit by bit. Each loop is a generator of a simulator, checked options, memory of the module and a Run: it yields the
 * fraction done, fills the Run, and throws an Error whose `partial` is the Run up to there.
 */
const MAX_RECORDED_STEPS = 2000; // of a kinematic analysis between samples, after which it yields
const {ENDED, EVENTS_FULL, EVENT_STOPS, MAX_LISTED, N_IMPACT_COLUMNS, N_WORK} = Boundary;
const MESSAGES = { // by status
    [Boundary.NOT_FINITE]: "the motion is no longer finite",
    [Boundary.CHATTERING]: "a friction or a switching function of the forces changes its branch without end",
    [Boundary.TOO_SMALL]: "no step is small enough",
    [Boundary.UNBOUNDED]: "the second rate of a drive grows beyond all bounds",
    [Boundary.LOST]: "a contact was lost: a free journal or corner lies outside its walls",
    [Boundary.OUTSIDE]: "a journal or corner is deeper in its wall than contact laws hold",
    [Boundary.STALLED]: "the run no longer advances",
};
const KINEMATIC_MESSAGES = {
    [Boundary.NEWTON_FAILED]: "the linkage cannot follow its drives: Newton's method finds no position there",
    [Boundary.NOT_FINITE]: "the value of a drive or a force is not a number",
    [Boundary.STALLED]: "the motion takes more steps than can be made",
};

/* Return the time difference in s below which an event and a sample coincide. */
function computeTimeResolution(t) {
    const end = t[t.length - 1];
    return Math.max(32 * Number.EPSILON * Math.max(end, t[0]), Math.min(1e-11, 1e-10 * (end - t[0])));
}

/* Return how many of increasing times t are less than a time. */
function countEarlier(t, time) {
    const row = t.findIndex((x) => x >= time);
    return row < 0 ? t.length : row;
}

/* Return the error of a status at a time (s), with the run so far. pivots: names of constraint rows by status. */
function makeRunError(run, status, messages, pivots, t) {
    const message = messages[status] ?? `singular: the pivot of constraint row ${pivots[status - 1]} vanished`;
    return Object.assign(new Error(`${message}: t = ${formatQuantity(t, "s", 9)}`), {partial: run, status, t});
}

/*
 * Integration of one run: its struct in the engine, and rows of samples as C writes them.
 *
 * Arrays of samples are addresses; `widths` are their columns. The last row is for a run that ends early.
 */
class Integration {
    constructor(sim, {t, method, rtol, step}, memory, run) {
        const {lib, n, description} = sim, capacity = t.length + 1;
        const p = method === "rk4" && description.rk4_has_gains ? sim.p : sim.p_motion;
        run.p_motion = p;
        const n_joints = Math.max(description.clearances.length, 1);
        Object.assign(this, {sim, lib, n, t, method, step, memory, run});
        this.widths = {y: 2 * n + N_WORK, discreteStates: Math.max(description.memory, 1), contactCodes: n_joints};
        this.y = memory.allocateDoubles(capacity * this.widths.y);
        this.discreteStates = memory.allocateDoubles(capacity * this.widths.discreteStates);
        this.contactCodes = memory.allocateBytes(capacity * this.widths.contactCodes);
        this.p = memory.allocateDoubles(p.length, p);
        this.times = memory.allocateDoubles(t.length, t);
        this.storedCount = memory.allocateBytes(4);
        this.integrator = memory.allocateBytes(lib.gudgeon_run_size());
        this.report = [memory.allocateDoubles(1), memory.allocateBytes(4 * Boundary.N_COUNTS),
            memory.allocateDoubles(Boundary.N_RESIDUALS), memory.allocateDoubles(Boundary.N_PEAK * n_joints)];
        const {q, v} = run.findStart(), y = memory.allocateDoubles(this.widths.y, [...q, ...v]);
        const none = new Float64Array(this.widths.discreteStates).fill(NaN);
        lib.gudgeon_run_start(this.integrator, this.p, t[0], y, memory.allocateDoubles(none.length, none));
        lib.gudgeon_run_enable_end_events(this.integrator, 1);
        this.setUpMethod(rtol);
    }

    /* Set methods and error tolerances, as compute_tolerances of runtime/integrators/adaptive.py. */
    setUpMethod(rtol) {
        const {description, size, p} = this.sim, {memory, lib} = this;
        const clearances = description.clearances.map(([, k]) => p[k]).filter((c) => c > 0);
        const length = clearances.length ? Math.min(...clearances) : size, ratio = length / size;
        const ofSpeed = description.film ? Math.min(rtol, description.felt_by_films * length / size) : rtol;
        const ofCoordinates = description.angles.map((isAngle) => rtol * (isAngle ? ratio : length));
        const tolerances = ofCoordinates.length
            ? [...ofCoordinates, ...description.angles.map(() => ofSpeed)] : [ofSpeed];
        const maySwitch = this.method === "adaptive", first = maySwitch ? description.begins : this.method;
        const findMethodNumber = (name) => {
            const text = new TextEncoder().encode(`${name}\0`);
            return lib.gudgeon_method(memory.allocateBytes(text.length, text));
        };
        lib.gudgeon_adaptive_setup(this.integrator, findMethodNumber(first),
            maySwitch && description.automatic ? findMethodNumber(description.stiff) : 0,
            memory.allocateDoubles(tolerances.length, tolerances), memory.allocateDoubles(2, [length, ratio]),
            this.step ?? 0);
    }

    /* Return the number of samples that are stored. */
    get nStored() { return this.memory.viewLongs(this.storedCount, 1)[0]; }

    set nStored(rows) { this.memory.viewLongs(this.storedCount, 1)[0] = rows; }

    /* Integrate at most `limit` steps, and return the status. */
    advance(limit) {
        return this.lib.gudgeon_adaptive_run(this.integrator, this.p, this.t.length, this.times, limit, this.y,
            this.discreteStates, this.contactCodes, this.storedCount);
    }

    /* Read and return the present time (s), and counts of steps and others by name. */
    readReport() {
        this.lib.gudgeon_run_report(this.integrator, ...this.report);
        const counts = this.memory.viewLongs(this.report[1], Boundary.N_COUNTS);
        const countsByName = Object.fromEntries(Boundary.COUNT_NAMES.map((name, k) => [name, counts[k]]));
        return {t: this.memory.viewDoubles(this.report[0], 1)[0], counts: countsByName};
    }

    /* Return the messages of statuses; that of OUTSIDE names the journal or corner that is deepest in its wall. */
    get messages() {
        const {N_PEAK, PEAK_NAMES, OUTSIDE} = Boundary, {description, p} = this.sim;
        const e_max = PEAK_NAMES.indexOf("e_max");
        const peaks = this.memory.viewDoubles(this.report[3], N_PEAK * this.widths.contactCodes);
        const depths = description.clearances.map(([name, k], i) => {
            const [first, count] = description.contours?.[name] ?? [0, 0];
            const wear = Math.max(0, ...p.slice(first, first + count));
            return [peaks[N_PEAK * i + e_max] - p[k] - wear, name];
        });
        const [depth, name] = depths.sort(([a], [b]) => b - a)[0] ?? [];
        const millimetres = `${Number((1e3 * depth).toPrecision(3))} mm deep in its`, isCorner = name?.includes(".");
        const message = isCorner
            ? `corner ${name} lies ${millimetres} wall, beyond a tenth of half the guide's width`
            : `the journal of ${name} lies ${millimetres} bearing, beyond a tenth of its radius`;
        return depths.length ? {...MESSAGES, [OUTSIDE]: message} : MESSAGES;
    }

    /* Return the index of the first stored sample from `first` on that is not finite, or undefined. */
    findNonFinite(first) {
        for (let i = first; i < this.nStored; i++)
            if (!this.memory.viewDoubles(this.y + 8 * i * this.widths.y, 2 * this.n).every(Number.isFinite)) return i;
        return undefined;
    }

    /* Store the present state as the last sample, in place of samples that are not earlier. */
    storeEnd() {
        const {widths} = this, {t} = this.readReport();
        const row = Math.min(this.nStored, countEarlier(this.t, t - computeTimeResolution(this.t)));
        this.run.t = Float64Array.of(...this.t.subarray(0, row), t);
        this.lib.gudgeon_run_sample(this.integrator, this.p, this.y + 8 * row * widths.y,
            this.discreteStates + 8 * row * widths.discreteStates, this.contactCodes + row * widths.contactCodes);
        this.nStored = row + 1;
    }

    /* Move the lists of events and impacts into the run. includesUnfinished (0 or 1): impacts that last still, too. */
    fetchLists(includesUnfinished) {
        const {lib, integrator, run, widths} = this;
        const capacity = this.sim.description.events.length ? MAX_LISTED : 1;
        withMemory(lib, (memory) => {
            const arrays = [memory.allocateDoubles(capacity), memory.allocateBytes(4 * capacity),
                memory.allocateDoubles(capacity * widths.y), memory.allocateDoubles(capacity * widths.discreteStates),
                memory.allocateBytes(capacity * widths.contactCodes)], [times, events] = arrays;
            for (let count = capacity; count === capacity;) {
                count = lib.gudgeon_run_events(integrator, capacity, ...arrays);
                for (let i = 0; i < count; i++)
                    run.addEvent(memory.viewLongs(events, count)[i], memory.viewDoubles(times, count)[i]);
            }
            const columns = memory.allocateDoubles(N_IMPACT_COLUMNS * MAX_LISTED);
            const joints = memory.allocateBytes(4 * MAX_LISTED);
            for (let count = MAX_LISTED; count === MAX_LISTED;) {
                count = lib.gudgeon_run_impacts(integrator, includesUnfinished, MAX_LISTED, columns, joints);
                for (let i = 0; i < count; i++)
                    run.addImpact(memory.viewLongs(joints, count)[i],
                        memory.viewDoubles(columns + 8 * N_IMPACT_COLUMNS * i, N_IMPACT_COLUMNS));
            }
        });
    }

    /* Copy all results so far into the run. */
    fetchResults() {
        const {run, n, memory, nStored, widths} = this, y = memory.copyDoubles(this.y, nStored * widths.y);
        const extract = (first, count) => extractColumns(y, widths.y, first, count);
        Object.assign(run, {q: extract(0, n), v: extract(n, n), work: extract(2 * n, N_WORK),
            counts: this.readReport().counts, t: run.t.slice(0, nStored),
            memory: memory.copyDoubles(this.discreteStates, nStored * widths.discreteStates),
            state: memory.copyBytes(this.contactCodes, nStored * widths.contactCodes)});
        this.fetchLists(1);
        run.sortLists();
    }
}

/* Return `count` columns, from `first` on, of a row-major table as a table of their own. */
function extractColumns(rows, width, first, count) {
    const table = new Float64Array(rows.length / width * count);
    for (let i = 0; i < table.length; i++) table[i] = rows[Math.floor(i / count) * width + first + i % count];
    return table;
}

/* Integrate a run in C; a generator that yields the fraction done. */
function* integrate(sim, settings, memory, run) {
    const {t} = settings, t_end = t[t.length - 1], integration = new Integration(sim, settings, memory, run);
    run.storePartial = () => integration.fetchResults();
    for (let nChecked = 0; integration.nStored < t.length; nChecked = integration.nStored) {
        let status = integration.advance(settings.slice);
        const nonFinite = integration.findNonFinite(nChecked), {t: t_reached} = integration.readReport();
        if (nonFinite !== undefined) [status, integration.nStored] = [Boundary.NOT_FINITE, nonFinite];
        if (status === EVENTS_FULL) integration.fetchLists(0);
        else if (status === ENDED) integration.storeEnd();
        else if (status) {
            integration.fetchResults();
            const t_failed = nonFinite === undefined ? t_reached : t[nonFinite];
            throw makeRunError(run, status, integration.messages, sim.description.pivots, t_failed);
        }
        if (status === ENDED) break;
        yield t_reached / t_end;
    }
    integration.fetchResults();
    run.checkRedundantEquations();
}

/*
 * Kinematic analysis of a scene without degrees of freedom: rows of samples, and the engine's struct.
 *
 * Arrays are addresses. After many steps without reaching a sample, the state between the samples is stored as an
 * intermediate row, so that the analysis can yield; `storeIntermediate` explains it.
 */
class KinematicAnalysis {
    constructor(sim, {t}, memory, run) {
        const {lib, n, description} = sim, rows = t.length;
        Object.assign(this, {sim, lib, n, t: t.slice(), memory, run, t_end: t[rows - 1], eventCapacity: MAX_LISTED});
        [this.q, this.v, this.a] = [n, n, n].map((width) => memory.allocateDoubles(rows * width));
        this.work = memory.allocateDoubles(rows * N_WORK);
        this.times = memory.allocateDoubles(rows + 1, t);
        this.p = memory.allocateDoubles(sim.p.length, sim.p_motion);
        this.maxima = memory.allocateDoubles(2); // |Φ|, |Φ̇|
        this.callCounts = memory.allocateBytes(8); // steps in total, rows of the last call
        this.branches = memory.allocateBytes(description.events.length);
        this.analysis = memory.allocateBytes(lib.gudgeon_kinematic_size());
        this.recordWidth = 1 + 2 * n;
        this.records = memory.allocateDoubles(MAX_RECORDED_STEPS * this.recordWidth);
        const {q, v} = run.findStart();
        memory.viewDoubles(this.q, n).set(q);
        memory.viewDoubles(this.v, n).set(v);
        lib.gudgeon_kinematic_begin(this.analysis, description.reach, sim.size, this.t_end, 0, 0, 1);
    }

    /* Return the addresses of row i: time, q, v. */
    getRow(i) { return [this.times + 8 * i, this.q + 8 * i * this.n, this.v + 8 * i * this.n]; }

    /*
     * Compute the motion of the rows after `first` up to `last`; return the last computed row, and the status.
     *
     * capacity: number of steps that are recorded before the call returns; 0: all steps, without records.
     */
    computeMotion(first, last, capacity = MAX_RECORDED_STEPS) {
        const [t, q, v] = this.getRow(first), a = this.a + 8 * first * this.n, {lib, analysis} = this;
        lib.gudgeon_kinematic_set_recording(analysis, capacity && this.records, capacity);
        const status = lib.gudgeon_kinematic(analysis, last - first, t, this.p, q, v, a, this.maxima, this.maxima + 8,
            this.callCounts, this.callCounts + 4);
        const end = first + this.memory.viewLongs(this.callCounts, 2)[1], isFull = status === EVENTS_FULL;
        if (isFull && end > first) lib.gudgeon_kinematic_restart(analysis); // at `end`, without the steps beyond it
        return [end, isFull ? 0 : status];
    }

    /*
     * Store the last recorded step as row first + 1, since its sample was not reached.
     *
     * `resumeFromIntermediate` then moves it to row `first`, whose sample is saved, and restores the time of the next
     * sample. `restoreSample` puts the saved sample back when the next one is reached.
     */
    storeIntermediate(first) {
        const {n, memory, recordWidth} = this, [time, q, v] = this.getRow(first + 1);
        const lastRecord = this.records + 8 * (MAX_RECORDED_STEPS - 1) * recordWidth;
        const [t, ...state] = memory.viewDoubles(lastRecord, recordWidth);
        this.nextSampleTime = this.t[first + 1];
        this.t[first + 1] = memory.viewDoubles(time, 1)[0] = t;
        [q, v].forEach((address, k) => memory.viewDoubles(address, n).set(state.slice(k * n, k * n + n)));
    }

    /* Resume from the intermediate row, which replaces that of the last sample; the sample's values are saved. */
    resumeFromIntermediate(first) {
        const {memory, n} = this, sizes = [1, n, n, N_WORK];
        const getAddresses = (row) => [...this.getRow(row), this.work + 8 * row * N_WORK];
        const addresses = getAddresses(first), nextAddresses = getAddresses(first + 1);
        this.savedSample ??= {addresses, t: this.t[first], first,
            values: addresses.map((address, k) => memory.copyDoubles(address, sizes[k]))};
        addresses.forEach((address, k) =>
            memory.viewDoubles(address, sizes[k]).set(memory.copyDoubles(nextAddresses[k], sizes[k])));
        this.t[first] = this.t[first + 1];
        this.t[first + 1] = memory.viewDoubles(nextAddresses[0], 1)[0] = this.nextSampleTime;
    }

    /* Restore the row of the last sample, if an intermediate row replaced it. */
    restoreSample() {
        const {savedSample, memory} = this;
        if (!savedSample) return;
        const {addresses, values, first, t} = savedSample;
        addresses.forEach((address, k) => memory.viewDoubles(address, values[k].length).set(values[k]));
        this.t[first] = t;
        this.savedSample = null;
    }

    /* Compute the works of the rows after `first` up to `last`; return the last computed row, and the status. */
    computeWorks(first, last) {
        if (last === first) return [last, 0];
        const [t, q, v] = this.getRow(first);
        const status = this.lib.gudgeon_kinematic_works(this.analysis, last - first, t, this.p, q, v,
            this.work + 8 * first * N_WORK, this.callCounts + 4);
        return [status ? first + this.memory.viewLongs(this.callCounts, 2)[1] : last, status];
    }

    /*
     * Find the events between rows and add them to the run; return whether one ends the run.
     *
     * A short time after the end of the run is searched too. Throws an Error if the motion cannot be followed.
     */
    findEvents(first, end) {
        if (!this.sim.description.events.length || end === first) return false;
        const times = [...this.t.subarray(first, end + 1)];
        if (times[times.length - 1] === this.t_end)
            times.push(this.t_end
                + Math.max(4 * computeSpacing(this.t_end), 1e-12 * (this.t_end - times[times.length - 2])));
        for (let nSearched = 0; nSearched < times.length - 1;) {
            const [status, count] = this.searchIntervals(first + nSearched, times.slice(nSearched));
            nSearched += count;
            if (status === EVENT_STOPS) return true;
            if (status === EVENTS_FULL) this.eventCapacity *= 4;
            else if (status && times[nSearched] < this.t_end)
                throw makeRunError(this.run, Boundary.NEWTON_FAILED, KINEMATIC_MESSAGES, [], times[nSearched]);
            else if (status) break; // beyond the end
        }
        return false;
    }

    /* Add the events between times, from a row on, to the run; return [status, number of searched intervals]. */
    searchIntervals(row, times) {
        return withMemory(this.lib, (memory) => {
            const [, q, v] = this.getRow(row), counts = memory.allocateBytes(8), {eventCapacity: capacity, run} = this;
            const [found, events] = [memory.allocateDoubles(capacity), memory.allocateBytes(4 * capacity)];
            const status = this.lib.gudgeon_kinematic_events(this.analysis, times.length - 1,
                memory.allocateDoubles(times.length, times), this.p, q, v, this.t[0], 1, this.branches, capacity, found,
                events, counts, counts + 4);
            const [nFound, nSearched] = memory.viewLongs(counts, 2);
            for (let i = 0; i < nFound; i++) {
                const t = Math.min(memory.viewDoubles(found, nFound)[i], this.t_end);
                run.addEvent(memory.viewLongs(events, nFound)[i], t);
            }
            return [status, nSearched];
        });
    }

    /* Shorten the run to the event that ends it between rows, and compute the last sample there; return its row. */
    truncateAtEvent(first, end) {
        const t_end = Math.max(...this.run.events.map(({t}) => t));
        const rows = countEarlier(this.t.subarray(first, end + 1), t_end - computeTimeResolution(this.run.t));
        const last = first + Math.max(rows, Number(Boolean(this.savedSample))); // row `first` may be intermediate
        this.t = Float64Array.of(...this.t.subarray(0, last), t_end);
        this.memory.viewDoubles(this.times, last + 1)[last] = t_end;
        if (last === first) return last;
        this.lib.gudgeon_kinematic_restart(this.analysis);
        const [, status] = this.computeMotion(last - 1, last, 0);
        if (status)
            throw makeRunError(this.run, status, KINEMATIC_MESSAGES, this.sim.description.start_pivots, t_end);
        return last;
    }

    /* Return the times in s that the motion and the works have reached. */
    readProgress() {
        return withMemory(this.lib, (memory) => {
            const t = memory.allocateDoubles(2);
            this.lib.gudgeon_kinematic_progress(this.analysis, t, memory.allocateDoubles(1), memory.allocateBytes(8));
            return memory.copyDoubles(t, 2);
        });
    }

    /* Copy the results of the first rows into the run. */
    fetchResults(rows) {
        this.restoreSample();
        const {memory, n} = this, copy = (address, width) => memory.copyDoubles(address, rows * width);
        Object.assign(this.run, {t: this.t.slice(0, rows), q: copy(this.q, n), v: copy(this.v, n), a: copy(this.a, n),
            work: copy(this.work, N_WORK), memory: new Float64Array(rows), state: new Int8Array(0),
            counts: {steps: memory.viewLongs(this.callCounts, 1)[0]}});
        this.run.sortLists();
    }
}

/* Return the distance from a positive number to the next larger one. */
function computeSpacing(x) {
    const bits = new BigUint64Array(1), number = new Float64Array(bits.buffer);
    number[0] = x;
    bits[0] += 1n;
    return number[0] - x;
}

/* Solve the motion from sample to sample by Newton's method, with works and events; yields the fraction done. */
function* integrateKinematic(sim, settings, memory, run) {
    const kinematic = new KinematicAnalysis(sim, settings, memory, run), {start_pivots} = sim.description;
    let first = 0, last = settings.t.length - 1, isStopped = false;
    run.storePartial = () => kinematic.fetchResults(first + 1);
    do {
        let [end, failed] = kinematic.computeMotion(first, Math.min(first + settings.slice, last));
        const isIntermediate = end === first && !failed && last > first;
        if (isIntermediate) kinematic.storeIntermediate(end++);
        isStopped = kinematic.findEvents(first, end);
        if (isStopped) last = kinematic.truncateAtEvent(first, end);
        const [complete, undefinedWork] = kinematic.computeWorks(first, isStopped ? last : end);
        if (undefinedWork || (failed && !isStopped)) {
            kinematic.fetchResults(complete + 1);
            const [t_motion, t_works] = kinematic.readProgress();
            throw makeRunError(run, undefinedWork || failed, KINEMATIC_MESSAGES, start_pivots,
                undefinedWork ? t_works : t_motion);
        }
        if (isIntermediate && !isStopped) kinematic.resumeFromIntermediate(first);
        else {
            kinematic.restoreSample();
            first = complete;
        }
        yield kinematic.t[first] / kinematic.t_end;
    } while (first < last);
    kinematic.fetchResults(first + 1);
    run.checkRedundantEquations();
}

/*
 * Integrate a scene without degrees of freedom by rk4 with all constraint equations, to show how these drift.
 *
 * a = Φ_q⁻¹ (γ − 2 α Φ̇ − β² Φ), with Baumgarte's α and β. Python and `integrateKinematic` solve Φ = 0 instead. Yields
 * the fraction done.
 */
function* integrateWithDrift(sim, {t, step, slice}, memory, run) {
    const {lib, n, description} = sim, width = 2 * n + N_WORK, rows = memory.allocateDoubles(t.length * width);
    const n_discrete = Math.max(description.memory, 1);
    const [stage, dy, discrete] = [width, width, n_discrete].map((count) => memory.allocateDoubles(count));
    const {q, v} = run.findStart(), p = memory.allocateDoubles(sim.p.length, sim.p);
    const counts = {steps: 0, right_hand_sides: 0};
    let y = Float64Array.of(...q, ...v, ...new Float64Array(N_WORK)), nStored = 0;
    const storeSample = () => memory.viewDoubles(rows + 8 * width * nStored++, width).set(y);
    const fetchResults = () => {
        const table = memory.copyDoubles(rows, nStored * width);
        const extract = (first, count) => extractColumns(table, width, first, count);
        Object.assign(run, {t: t.slice(0, nStored), q: extract(0, n), v: extract(n, n), work: extract(2 * n, N_WORK),
            counts, memory: new Float64Array(nStored * n_discrete), state: new Int8Array(0)});
    };
    run.storePartial = fetchResults;
    const fail = (status, t_failed) => {
        fetchResults();
        throw makeRunError(run, status, MESSAGES, description.evaluation_pivots, t_failed);
    };
    const computeRate = (t_stage, h, k) => { // at y + h k, or at y
        memory.viewDoubles(stage, width).set(k ? y.map((x, i) => x + h * k[i]) : y);
        const status = lib.gudgeon_rhs(t_stage, stage, discrete, p, dy);
        counts.right_hand_sides++;
        if (status) fail(status, t_stage);
        return memory.copyDoubles(dy, width);
    };
    for (storeSample(); nStored < t.length; storeSample()) {
        const start = t[nStored - 1], duration = t[nStored] - start;
        const n_steps = Math.max(Math.ceil(duration / step * (1 - 1e-12)), 1);
        for (let i = 0, h = duration / n_steps; i < n_steps; i++) {
            const t0 = start + i * h, middle = t0 + h / 2, end = i + 1 === n_steps ? t[nStored] : t0 + h;
            const k1 = computeRate(t0), k2 = computeRate(middle, h / 2, k1);
            const k3 = computeRate(middle, h / 2, k2), k4 = computeRate(end, h, k3);
            y = y.map((x, j) => x + h / 6 * (k1[j] + 2 * k2[j] + 2 * k3[j] + k4[j]));
            if (!y.every(Number.isFinite)) fail(Boundary.NOT_FINITE, end);
            if (++counts.steps % slice === 0) yield end / t[t.length - 1];
        }
    }
    fetchResults();
    run.checkRedundantEquations();
}
