/*
 * Run the time loops: call the engine for some steps or samples at a time, and handle its statuses.
 *
 * The calls are the same as in engine/batch, runtime/integrators/batch.py and kinematic.py, so that results are equal
 * bit by bit.
 */
const AT_ONCE = 2000; // steps between samples of a kinematic analysis before it yields
const {ENDED, EVENTS_FULL, EVENT_STOPS, MAX_LISTED, N_IMPACT_COLUMNS, N_WORK} = Boundary;
const TOLD = {
    [Boundary.NOT_FINITE]: "the motion is no longer finite",
    [Boundary.CHATTERING]: "a friction or a corner of the forces changes its side without end",
    [Boundary.TOO_SMALL]: "no step is small enough",
    [Boundary.UNBOUNDED]: "the second rate of a drive grows beyond all bounds",
    [Boundary.LOST]: "a contact was lost: a free journal or corner lies outside its walls",
    [Boundary.OUTSIDE]: "a journal or corner is deeper in its wall than contact laws hold",
    [Boundary.STALLED]: "the run no longer advances",
};
const KINEMATIC_TOLD = {
    [Boundary.NEWTON_FAILED]: "the linkage cannot follow its drives: Newton's method finds no position there",
    [Boundary.NOT_FINITE]: "what the drives and forces do is no number",
    [Boundary.STALLED]: "the motion takes more steps than can be made",
};

/* Return the time difference in s below which an event and a sample coincide. */
function resolution(t) {
    const end = t[t.length - 1];
    return Math.max(32 * Number.EPSILON * Math.max(end, t[0]), Math.min(1e-11, 1e-10 * (end - t[0])));
}

/* Return how many of increasing times are less than a time. */
function before(t, time) {
    const row = t.findIndex((x) => x >= time);
    return row < 0 ? t.length : row;
}

/* Return the error of a status at a time, with the run so far. */
function failure(run, status, told, pivots, t) {
    const why = told[status] ?? `singular: the pivot of constraint row ${pivots[status - 1]} vanished`;
    return Object.assign(new Error(`${why}: t = ${said(t, "s", 9)}`), {partial: run, status, t});
}

/* Integration of one run: its struct in the engine, and rows of samples as C writes them. */
class Session {
    constructor(sim, {t, method, rtol, step}, memory, run) {
        const {lib, n, about} = sim, p = method === "rk4" ? sim.p : sim.projected;
        Object.assign(this, {sim, lib, n, t, method, step, memory, run, rows: t.length + 1}); // one for an early end
        this.width = {y: 2 * n + N_WORK, memory: Math.max(about.memory, 1), state: Math.max(about.clearances.length, 1)};
        this.y = memory.numbers(this.rows * this.width.y);
        this.latched = memory.numbers(this.rows * this.width.memory);
        this.state = memory.bytes(this.rows * this.width.state);
        this.p = memory.numbers(p.length, p);
        this.times = memory.numbers(t.length, t);
        this.filled = memory.bytes(4);
        this.struct = memory.bytes(lib.gudgeon_run_size());
        this.report_at = [memory.numbers(1), memory.bytes(4 * Boundary.N_COUNTS),
            memory.numbers(Boundary.N_RESIDUALS), memory.numbers(Boundary.N_PEAK * this.width.state)];
        const {q, v} = run.begin(), first = memory.numbers(this.width.y, [...q, ...v]);
        const unknown = memory.numbers(this.width.memory, new Float64Array(this.width.memory).fill(NaN));
        lib.gudgeon_run_start(this.struct, this.p, t[0], first, unknown);
        lib.gudgeon_run_stop(this.struct, 1);
        this.setUp(rtol);
    }

    /* Set tolerances and methods, as runtime/integrators/adaptive.py does. */
    setUp(rtol) {
        const {about, size, p} = this.sim, play = about.clearances.map(([, k]) => p[k]).filter((c) => c > 0);
        const length = play.length ? Math.min(...play) : size, share = length / size;
        const of_v = about.film ? Math.min(rtol, about.felt_by_films * length / size) : rtol;
        const of_q = about.angles.map((turns) => rtol * (turns ? share : length));
        const scale = of_q.length ? [...of_q, ...about.angles.map(() => of_v)] : [of_v];
        const automatic = this.method === "adaptive", name = automatic ? about.begins : this.method;
        const {memory, lib} = this, number = (name) => {
            const text = new TextEncoder().encode(`${name}\0`);
            return lib.gudgeon_method(memory.bytes(text.length, text));
        };
        lib.gudgeon_adaptive_setup(this.struct, number(name), automatic && about.automatic ? number(about.stiff) : 0,
            memory.numbers(scale.length, scale), memory.numbers(2, [length, share]), this.step ?? 0);
    }

    /* Return the number of samples that are filled. */
    get done() { return this.memory.longs(this.filled, 1)[0]; }

    set done(rows) { this.memory.longs(this.filled, 1)[0] = rows; }

    /* Integrate some steps, and return the status. */
    advance(slice) {
        const samples = [this.t.length, this.times, slice, this.y, this.latched, this.state, this.filled];
        return this.lib.gudgeon_adaptive_run(this.struct, this.p, ...samples);
    }

    /* Return the present time, and counts by name. */
    report() {
        this.lib.gudgeon_run_report(this.struct, ...this.report_at);
        const counts = this.memory.longs(this.report_at[1], Boundary.N_COUNTS);
        const named = Object.fromEntries(Boundary.COUNT_NAMES.map((name, k) => [name, counts[k]]));
        return {t: this.memory.view(this.report_at[0], 1)[0], counts: named};
    }

    /* Return the messages of statuses; that of OUTSIDE names the deepest journal. */
    get told() {
        const {N_PEAK, PEAK_NAMES, OUTSIDE} = Boundary, {about, p} = this.sim, e_max = PEAK_NAMES.indexOf("e_max");
        const peaks = this.memory.view(this.report_at[3], N_PEAK * this.width.state);
        const depths = about.clearances.map(([name, k], i) => {
            const [first, count] = about.contours?.[name] ?? [0, 0], worn = Math.max(0, ...p.slice(first, first + count));
            return [peaks[N_PEAK * i + e_max] - p[k] - worn, name];
        });
        const [depth, name] = depths.sort(([a], [b]) => b - a)[0] ?? [];
        const far = `${Number((1e3 * depth).toPrecision(3))} mm deep in its`, corner = name?.includes(".");
        const deep = corner ? `corner ${name} lies ${far} wall, beyond a tenth of half the guide's width`
            : `the journal of ${name} lies ${far} bearing, beyond a tenth of its radius`;
        return depths.length ? {...TOLD, [OUTSIDE]: deep} : TOLD;
    }

    /* Return the first sample from a row on that is not finite, or undefined. */
    odd(from) {
        for (let i = from; i < this.done; i++)
            if (!this.memory.view(this.y + 8 * i * this.width.y, 2 * this.n).every(Number.isFinite)) return i;
        return undefined;
    }

    /* Store the present state as the last sample, in place of samples that are not earlier. */
    close() {
        const {t} = this.report(), row = Math.min(this.done, before(this.t, t - resolution(this.t)));
        this.run.t = Float64Array.of(...this.t.subarray(0, row), t);
        this.lib.gudgeon_run_sample(this.struct, this.p, this.y + 8 * row * this.width.y,
            this.latched + 8 * row * this.width.memory, this.state + row * this.width.state);
        this.done = row + 1;
    }

    /* Move lists of events and impacts into the run; `last`: unfinished impacts too. */
    takeLists(last) {
        const {lib, struct, run, width} = this, rows = this.sim.about.events.length ? MAX_LISTED : 1;
        within(lib, (memory) => {
            const arrays = [memory.numbers(rows), memory.bytes(4 * rows), memory.numbers(rows * width.y),
                memory.numbers(rows * width.memory), memory.bytes(rows * width.state)], [at, which] = arrays;
            for (let count = rows; count === rows;) {
                count = lib.gudgeon_run_events(struct, rows, ...arrays);
                for (let i = 0; i < count; i++) run.noteEvent(memory.longs(which, count)[i], memory.view(at, count)[i]);
            }
            const [numbers, joints] = [memory.numbers(N_IMPACT_COLUMNS * MAX_LISTED), memory.bytes(4 * MAX_LISTED)];
            for (let count = MAX_LISTED; count === MAX_LISTED;) {
                count = lib.gudgeon_run_impacts(struct, last, MAX_LISTED, numbers, joints);
                for (let i = 0; i < count; i++)
                    run.noteImpact(memory.longs(joints, count)[i],
                        memory.view(numbers + 8 * N_IMPACT_COLUMNS * i, N_IMPACT_COLUMNS));
            }
        });
    }

    /* Move all results so far into the run. */
    take() {
        const {run, n, memory, done} = this, y = memory.copy(this.y, done * this.width.y);
        const part = (from, count) => columns(y, this.width.y, from, count);
        Object.assign(run, {q: part(0, n), v: part(n, n), work: part(2 * n, N_WORK), counts: this.report().counts,
            memory: memory.copy(this.latched, done * this.width.memory), t: run.t.slice(0, done),
            state: memory.codes(this.state, done * this.width.state)});
        this.takeLists(1);
        run.closeLists();
    }
}

/* Return columns of a row-major table as a table of their own. */
function columns(rows, width, from, count) {
    const found = new Float64Array(rows.length / width * count);
    for (let i = 0; i < found.length; i++) found[i] = rows[Math.floor(i / count) * width + from + i % count];
    return found;
}

/* Integrate a run in C; a generator that yields the fraction done. */
function* integrate(sim, asked, memory, run) {
    const session = new Session(sim, asked, memory, run), t_end = asked.t[asked.t.length - 1];
    run.soFar = () => session.take();
    for (let seen = 0; session.done < asked.t.length; seen = session.done) {
        let status = session.advance(asked.slice);
        const odd = session.odd(seen), {t} = session.report();
        if (odd !== undefined) [status, session.done] = [Boundary.NOT_FINITE, odd];
        if (status === EVENTS_FULL) session.takeLists(0);
        else if (status === ENDED) session.close();
        else if (status) {
            session.take();
            throw failure(run, status, session.told, sim.about.pivots, odd === undefined ? t : asked.t[odd]);
        }
        if (status === ENDED) break;
        yield t / t_end;
    }
    session.take();
    run.checkLeftOut();
}

/* Kinematic analysis of a scene without degrees of freedom: samples, and the engine's state of motion and works. */
class Way {
    constructor(sim, {t}, memory, run) {
        const {lib, n} = sim, rows = t.length;
        Object.assign(this, {sim, lib, n, t: t.slice(), memory, run, t_end: t[rows - 1], capacity: MAX_LISTED});
        [this.q, this.v, this.a] = [n, n, n].map((width) => memory.numbers(rows * width));
        this.work = memory.numbers(rows * N_WORK);
        this.times = memory.numbers(rows + 1, t);
        this.p = memory.numbers(sim.p.length, sim.p);
        this.maxima = memory.numbers(2);
        this.longs = memory.bytes(8);
        this.side = memory.bytes(sim.about.events.length);
        this.course = memory.bytes(lib.gudgeon_kinematic_size());
        this.row_size = 1 + 2 * n;
        this.tape = memory.numbers(AT_ONCE * this.row_size);
        const {q, v} = run.begin();
        memory.view(this.q, n).set(q);
        memory.view(this.v, n).set(v);
        lib.gudgeon_kinematic_begin(this.course, sim.about.reach, sim.size, this.t_end, 0, 0, 1);
    }

    /* Return the addresses of a row: time, q, v. */
    row(i) { return [this.times + 8 * i, this.q + 8 * i * this.n, this.v + 8 * i * this.n]; }

    /* Compute rows up to `last`; return the last one that was reached, and the status. */
    motion(first, last, room = AT_ONCE) {
        const [t, q, v] = this.row(first), a = this.a + 8 * first * this.n, {lib, course} = this;
        lib.gudgeon_kinematic_record(course, room && this.tape, room);
        const status = lib.gudgeon_kinematic(course, last - first, t, this.p, q, v, a, this.maxima, this.maxima + 8,
            this.longs, this.longs + 4);
        const moved = first + this.memory.longs(this.longs, 2)[1], full = status === EVENTS_FULL;
        if (full && moved > first) lib.gudgeon_kinematic_restart(course); // from there, as if it had gone no further
        return [moved, full ? 0 : status];
    }

    /* Store the intermediate state as the next row after many steps without reaching a sample; see `goOn`, `arrive`. */
    rest(first) {
        const {n, memory, row_size} = this, [time, q, v] = this.row(first + 1);
        const [t, ...state] = memory.view(this.tape + 8 * (AT_ONCE - 1) * row_size, row_size);
        this.resting = {row: first + 1, t: this.t[first + 1]};
        this.t[first + 1] = memory.view(time, 1)[0] = t;
        [q, v].forEach((place, k) => memory.view(place, n).set(state.slice(k * n, k * n + n)));
    }

    /* Continue from the intermediate state, which replaces the row of the last sample; its values are saved. */
    goOn(first) {
        const {memory, n, resting} = this, places = [...this.row(first), this.work + 8 * first * N_WORK];
        const sizes = [1, n, n, N_WORK], next = [...this.row(first + 1), this.work + 8 * (first + 1) * N_WORK];
        this.kept ??= {places, t: this.t[first], first, values: places.map((place, k) => memory.copy(place, sizes[k]))};
        places.forEach((place, k) => memory.view(place, sizes[k]).set(memory.copy(next[k], sizes[k])));
        this.t[first] = this.t[first + 1];
        this.t[first + 1] = memory.view(next[0], 1)[0] = resting.t;
        this.resting = null;
    }

    /* Restore the row of the last sample. */
    arrive() {
        const {kept, memory} = this;
        if (!kept) return;
        kept.places.forEach((place, k) => memory.view(place, kept.values[k].length).set(kept.values[k]));
        this.t[kept.first] = kept.t;
        this.kept = null;
    }

    /* Compute the works of rows; return the last one that was reached, and the status. */
    works(first, last) {
        if (last === first) return [last, 0];
        const [t, q, v] = this.row(first);
        const status = this.lib.gudgeon_kinematic_works(this.course, last - first, t, this.p, q, v,
            this.work + 8 * first * N_WORK, this.longs + 4);
        return [status ? first + this.memory.longs(this.longs, 2)[1] : last, status];
    }

    /* Find events between rows; return whether one ends the run. A short time after the end is searched too. */
    eventStops(first, end) {
        if (!this.sim.about.events.length || end === first) return false;
        const times = [...this.t.subarray(first, end + 1)];
        if (times[times.length - 1] === this.t_end)
            times.push(this.t_end + Math.max(4 * spacing(this.t_end), 1e-12 * (this.t_end - times[times.length - 2])));
        for (let done = 0; done < times.length - 1;) {
            const [status, count] = this.look(first + done, times.slice(done));
            done += count;
            if (status === EVENT_STOPS) return true;
            if (status === EVENTS_FULL) this.capacity *= 4;
            else if (status && times[done] < this.t_end)
                throw failure(this.run, Boundary.NEWTON_FAILED, KINEMATIC_TOLD, [], times[done]);
            else if (status) break; // beyond the end
        }
        return false;
    }

    /* Find events between times, and enter them in the run; return the status and the number of searched intervals. */
    look(row, times) {
        return within(this.lib, (memory) => {
            const [, q, v] = this.row(row), counts = memory.bytes(8), {capacity, run} = this;
            const [at, which] = [memory.numbers(capacity), memory.bytes(4 * capacity)];
            const status = this.lib.gudgeon_kinematic_events(this.course, times.length - 1,
                memory.numbers(times.length, times), this.p, q, v, this.t[0], 1, this.side, capacity, at, which, counts,
                counts + 4);
            const [found, done] = memory.longs(counts, 2);
            for (let i = 0; i < found; i++)
                run.noteEvent(memory.longs(which, found)[i], Math.min(memory.view(at, found)[i], this.t_end));
            return [status, done];
        });
    }

    /* End the run at the event among these rows: the last sample is at its time. */
    cut(first, end) {
        const t_end = Math.max(...this.run.events.map(({t}) => t));
        const rows = before(this.t.subarray(first, end + 1), t_end - resolution(this.run.t));
        const last = first + Math.max(rows, Number(Boolean(this.kept))); // whose row is another's now
        this.t = Float64Array.of(...this.t.subarray(0, last), t_end);
        this.memory.view(this.times, last + 1)[last] = t_end;
        if (last === first) return last;
        this.lib.gudgeon_kinematic_restart(this.course);
        const [, status] = this.motion(last - 1, last, 0);
        if (status) throw failure(this.run, status, KINEMATIC_TOLD, this.sim.about.start_pivots, t_end);
        return last;
    }

    /* Return the time in s that the motion (0) or the works (1) have reached. */
    reached(which) {
        return within(this.lib, (memory) => {
            const t = memory.numbers(2);
            this.lib.gudgeon_kinematic_progress(this.course, t, memory.numbers(1), memory.bytes(8));
            return memory.view(t, 2)[which];
        });
    }

    /* Move the results of the first rows into the run. */
    take(rows) {
        this.arrive();
        const {memory, n} = this, of = (place, width) => memory.copy(place, rows * width);
        Object.assign(this.run, {t: this.t.slice(0, rows), q: of(this.q, n), v: of(this.v, n), a: of(this.a, n),
            work: of(this.work, N_WORK), memory: new Float64Array(rows), state: new Int8Array(0),
            counts: {steps: memory.longs(this.longs, 1)[0]}});
        this.run.closeLists();
    }
}

/* Return the distance from a positive number to the next one. */
function spacing(x) {
    const bits = new BigUint64Array(1), number = new Float64Array(bits.buffer);
    number[0] = x;
    bits[0] += 1n;
    return number[0] - x;
}

/* Solve the motion from sample to sample by Newton's method, with works and events; yields the fraction done. */
function* follow(sim, asked, memory, run) {
    const way = new Way(sim, asked, memory, run), samples = asked.t.length - 1;
    let first = 0, last = samples, stops = false;
    run.soFar = () => way.take(first + 1);
    do {
        let [moved, failed] = way.motion(first, Math.min(first + asked.slice, last));
        const rests = moved === first && !failed && last > first;
        if (rests) way.rest(moved++);
        stops = way.eventStops(first, moved);
        if (stops) last = way.cut(first, moved);
        const [worked, unknown] = way.works(first, stops ? last : moved);
        if (unknown || (failed && !stops)) {
            way.take(worked + 1);
            throw failure(run, unknown || failed, KINEMATIC_TOLD, sim.about.start_pivots, way.reached(unknown ? 1 : 0));
        }
        if (rests && !stops) way.goOn(first);
        else {
            way.arrive();
            first = worked;
        }
        yield way.t[first] / way.t_end;
    } while (first < last);
    way.take(first + 1);
    run.checkLeftOut();
}

/*
 * Integrate a driven scene all the same, for classes: rk4 with all constraint equations, which drift or are held.
 *
 * a = Φ_q⁻¹ (γ − 2 α Φ̇ − β² Φ). Python and `follow` solve Φ = 0 instead. Yields the fraction done.
 */
function* drift(sim, {t, step, slice}, memory, run) {
    const {lib, n, about} = sim, width = 2 * n + N_WORK, rows = memory.numbers(t.length * width);
    const [at, dy, mode] = [width, width, Math.max(about.memory, 1)].map((count) => memory.numbers(count));
    const {q, v} = run.begin(), p = memory.numbers(sim.p.length, sim.p), counts = {steps: 0, right_hand_sides: 0};
    let y = Float64Array.of(...q, ...v, ...new Float64Array(N_WORK)), done = 0;
    const store = () => memory.view(rows + 8 * width * done++, width).set(y);
    const take = () => {
        const all = memory.copy(rows, done * width), part = (from, count) => columns(all, width, from, count);
        Object.assign(run, {t: t.slice(0, done), q: part(0, n), v: part(n, n), work: part(2 * n, N_WORK), counts,
            memory: new Float64Array(done * Math.max(about.memory, 1)), state: new Int8Array(0)});
    };
    run.soFar = take;
    const failed = (status, now) => {
        take();
        throw failure(run, status, TOLD, about.evaluation_pivots, now);
    };
    const rate = (now, h, k) => {
        memory.view(at, width).set(k ? y.map((x, i) => x + h * k[i]) : y);
        const status = lib.gudgeon_rhs(now, at, mode, p, dy);
        counts.right_hand_sides++;
        if (status) failed(status, now);
        return memory.copy(dy, width);
    };
    for (store(); done < t.length; store()) {
        const begun = t[done - 1], lasts = t[done] - begun, parts = Math.max(Math.ceil(lasts / step * (1 - 1e-12)), 1);
        for (let i = 0, h = lasts / parts; i < parts; i++) {
            const now = begun + i * h, half = now + h / 2, end = i + 1 === parts ? t[done] : now + h;
            const k1 = rate(now), k2 = rate(half, h / 2, k1), k3 = rate(half, h / 2, k2), k4 = rate(end, h, k3);
            y = y.map((x, j) => x + h / 6 * (k1[j] + 2 * k2[j] + 2 * k3[j] + k4[j]));
            if (!y.every(Number.isFinite)) failed(-2, end);
            if (++counts.steps % slice === 0) yield end / t[t.length - 1];
        }
    }
    take();
    run.checkLeftOut();
}
