/*
 * Store a run and compute its series by name, like runtime/results/series.py.
 *
 * Series are columns of stored arrays and of what C evaluates at the samples, points of bodies, magnitudes, outputs of
 * the file.
 */
const FUNCTIONS = { // of outputs; other functions are the browser's, whose last digit may differ from NumPy's
    "+": (a, b) => a + b, "*": (a, b) => a * b, "/": (a, b) => a / b, "**": Math.pow,
    "-": (a, b) => (b === undefined ? -a : a - b),
    where: (left, right, then, otherwise) =>
        (Number.isNaN(left) || Number.isNaN(right) ? NaN : left < right ? then : otherwise),
    mod: (a, b) => {
        const rest = a % b;
        return rest !== 0 && rest < 0 !== b < 0 ? rest + b : rest;
    },
    ramp: (t, start, lasts) => Math.min(Math.max((t - start) / lasts, 0), 1),
    smooth_step: (t, start, lasts) => {
        const s = FUNCTIONS.ramp(t, start, lasts);
        return s ** 3 * (10 + s * (6 * s - 15));
    },
};

/* Return the value of an expression: a number, a name, or [function, ...]. */
function valueOf(tree, named) {
    if (typeof tree === "number") return tree;
    if (typeof tree === "string") return named(tree);
    const [head, ...rest] = tree;
    if (head === "curve") return curveAt(rest[0], valueOf(rest[1], named));
    return (FUNCTIONS[head] ?? Math[head])(...rest.map((part) => valueOf(part, named)));
}

const UNPACKED = new Map(); // tables of long curves: base64 of binary64, by their text

/* Return the numbers of a packed table, cached. */
function unpacked(text) {
    if (!UNPACKED.has(text)) {
        const bytes = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
        UNPACKED.set(text, new Float64Array(bytes.buffer));
    }
    return UNPACKED.get(text);
}

/* Return the index of the interval between knots that contains x, or of the outermost one. */
function pieceOf(knots, x) {
    let low = 0, high = knots.length - 1;
    while (high - low > 1) {
        const middle = (low + high) >> 1;
        if (x < knots[middle]) high = middle;
        else low = middle;
    }
    return low;
}

/* Return the value of a cubic spline (runtime/language/curves.py): [name, knots, coefficients, ends, outside, unit]. */
function curveAt([, knots, pieces, ends, outside], x) {
    if (typeof knots === "string") knots = unpacked(knots);
    const first = knots[0], last = knots[knots.length - 1], range = last - first, margin = 1e-9 * range;
    const periodic = ends === "periodic";
    if (periodic) x -= range * Math.floor((x - first) / range);
    else if (outside === "none" && !(x >= first - margin && x <= last + margin)) return NaN;
    const held = periodic || outside === "none" ? x : Math.min(Math.max(x, first), last);
    const k = pieceOf(knots, held), h = held - knots[k];
    const row = typeof pieces === "string" ? unpacked(pieces).subarray(4 * k, 4 * k + 4) : pieces[k];
    const [c0, c1, c2, c3] = row, value = c0 + h * (c1 + h * (c2 + h * c3));
    if (outside !== "line" || x === held) return value;
    return value + (c1 + h * (2 * c2 + h * (3 * c3))) * (x - held);
}

const RATES = [["x", "y"], ["vx", "vy"], ["ax", "ay"]];
const POINT_UNITS = ["m", "m/s", "m/s^2"];
const STORED = ["q", "v", "work", "memory", "state"]; // arrays that the loops store

/* Samples by rows: t (N), q, v (N n), work (N 3), memory, state; impacts, events; counts of the loop. */
class Run {
    constructor(sim, t) {
        Object.assign(this, {sim, about: sim.about, t, p: sim.p, size: sim.size});
        Object.assign(this, {events: [], impacts: [], noNumber: []});
        this.found = new Map(); // series that were computed
        this.ways = this.followUps();
    }

    /* Return the start, which is known first; `followed`: it was continued from the file's start. */
    begin() {
        this.first = this.sim.start();
        this.followed = Boolean(this.first.followed);
        return this.first;
    }

    /* Enter an event at a time (s), or the time from which its expression is not a number. */
    noteEvent(which, t) {
        const {events} = this.about, told = which >= events.length;
        if (told) this.noNumber.push({name: events[which - events.length][0], t});
        else if (t > this.t[0] + resolution(this.t)) this.events.push({name: events[which][0], t});
    }

    /* Enter an impact from its columns. */
    noteImpact(which, columns) {
        const named = Boundary.IMPACT_COLUMN_NAMES.map((name, k) => [name, columns[k]]);
        this.impacts.push({joint: this.about.clearances[which][0], ...Object.fromEntries(named)});
    }

    /* Sort the lists by time, without entries after the last sample. */
    closeLists() {
        const last = this.t[this.t.length - 1] + resolution(this.t);
        for (const name of ["events", "noNumber"])
            this[name] = this[name].filter(({t}) => t <= last).sort((a, b) => a.t - b.t);
        this.impacts.sort((a, b) => a.t_on - b.t_on);
    }

    /* Return the names of all series. */
    get names() { return [...this.ways.keys()]; }

    /* Return the SI unit of a series; "" for a pure number. */
    unit(name) { return name === "t" ? "s" : this.way(name).unit; }

    /* Return a series by name, Float64Array (N), SI. */
    series(name) {
        if (name === "t") return this.t;
        if (!this.found.has(name)) this.found.set(name, this.way(name).compute());
        return this.found.get(name);
    }

    /* Return unit and function of a series. Throws an Error for an unknown name. */
    way(name) {
        if (!this.ways.has(name)) throw new Error(`this scene has no series named ${name}`);
        return this.ways.get(name);
    }

    /* Return all series by name: unit, and the function that computes it. */
    followUps() {
        const {columns, points, outputs, clearances, unknown} = this.about, ways = new Map();
        const add = (name, unit, compute) => ways.set(name, {unit, compute});
        const each = (f) => Float64Array.from(this.t, (_, i) => f(i));
        for (const [name, [unit, array, column]] of Object.entries(columns))
            add(name, unit, () => (unknown.includes(name) ? each(() => NaN) : this.column(array, column)));
        for (const [name, point] of Object.entries(points))
            for (let order = 0; order < (point[0] < 0 ? 1 : 3); order++)
                for (const axis of [0, 1])
                    add(`${name}.${RATES[order][axis]}`, POINT_UNITS[order], () => this.point(point, axis, order));
        const owners = Object.keys(columns).filter((name) => name.endsWith(".Fx")).map((name) => name.slice(0, -3));
        for (const owner of owners) {
            const [x, y] = [`${owner}.Fx`, `${owner}.Fy`];
            add(`${owner}.F`, "N", () => each((i) => Math.hypot(this.series(x)[i], this.series(y)[i])));
        }
        for (const [name, k] of clearances)
            add(`${name}.eps`, "", () => this.series(`${name}.e`).map((e) => e / this.p[k]));
        if (columns["energy.kinetic"]) add("energy.residual", "J", () => this.residual());
        for (const [name, [unit, tree]] of Object.entries(outputs))
            add(name, unit, () => each((i) => valueOf(tree, (path) => this.named(path, i))));
        return ways;
    }

    /* Return the value of a name in an output's expression at a sample. */
    named(path, i) {
        if (path === "t" || this.ways.has(path)) return this.series(path)[i];
        const {place} = this.sim;
        return this.p[place.get(path) ?? place.get(`parameters.${path}`)];
    }

    /* Return a column of a stored or evaluated array. */
    column(array, column) {
        const values = STORED.includes(array) ? this[array] : this.accelerations(array) ?? this.evaluation[array];
        const width = values.length / this.t.length;
        return Float64Array.from(this.t, (_, i) => values[i * width + column]);
    }

    /* Return the accelerations that the loop found, if nothing is integrated. */
    accelerations(array = "a") { return array === "a" ? this.a : undefined; }

    /* Return the residual of the energy balance in J. */
    residual() {
        const [kinetic, potential, ...works] = ["energy.kinetic", "energy.potential", "work.drives", "work.forces",
            "work.clearances"].map((name) => this.series(name));
        const start = kinetic[0] + potential[0];
        return kinetic.map((T, i) => T + potential[i] - start - (works[0][i] + works[1][i] + works[2][i]));
    }

    /* Return a coordinate of r_P = r + A(theta) s or of its time derivatives; s = (x, y) in the body's frame. */
    point([body, x, y, sign_x, sign_y], axis, order) {
        const s = [x < 0 ? 0 : sign_x * this.p[x], y < 0 ? 0 : sign_y * this.p[y]];
        if (body < 0) return new Float64Array(this.t.length).fill(s[axis]);
        const n = this.sim.n, at = (rows, i, k) => rows[i * n + body + k];
        const a = order < 2 ? [] : this.accelerations() ?? this.evaluation.a;
        return Float64Array.from(this.t, (_, i) => {
            const [sin, cos] = [Math.sin(at(this.q, i, 2)), Math.cos(at(this.q, i, 2))];
            const arm = [cos * s[0] - sin * s[1], sin * s[0] + cos * s[1]], turned = axis ? arm[0] : -arm[1];
            if (order === 0) return at(this.q, i, axis) + arm[axis];
            if (order === 1) return at(this.v, i, axis) + at(this.v, i, 2) * turned;
            return at(a, i, axis) + at(a, i, 2) * turned - at(this.v, i, 2) ** 2 * arm[axis];
        });
    }

    /* Return accelerations, multipliers, forces and energies at all samples, computed once. */
    get evaluation() {
        this.evaluated ??= within(this.sim.lib, (memory) => this.evaluate(memory));
        return this.evaluated;
    }

    /* Evaluate all samples in C. */
    evaluate(memory) {
        const {widths, beyond} = this.about, N = this.t.length, {lib} = this.sim;
        // velocities are those after a switching point, although rounding may put the time before it
        const t = beyond ? this.t.map((x) => x + Math.max(32 * Number.EPSILON * Math.abs(x), 1e-100)) : this.t;
        const given = [t, this.q, this.v, this.memory, this.p].map((values) => memory.numbers(values.length, values));
        const places = Object.entries(widths).map(([name, width]) => [name, memory.numbers(N * width), N * width]);
        const failed = memory.bytes(4), out = places.map(([, place]) => place);
        const status = lib.gudgeon_evaluate(N, ...given, ...out, failed);
        if (status) throw failure(this, status, {}, this.about.evaluation_pivots, this.t[memory.longs(failed, 1)[0]]);
        return Object.fromEntries(places.map(([name, place, count]) => [name, memory.copy(place, count)]));
    }

    /* Check that constraint equations redundant at the file's values are satisfied (assembly/rank.py); else throw. */
    checkLeftOut() {
        const {left_out, open, rows} = this.about, {lib, n} = this.sim;
        if (!left_out.length) return;
        within(lib, (memory) => {
            const p = memory.numbers(this.p.length, this.p), q = memory.numbers(n), phi = memory.numbers(rows.length);
            this.t.forEach((t, i) => {
                memory.view(q, n).set(this.q.subarray(i * n, (i + 1) * n));
                lib.gudgeon_phi(t, q, p, phi);
                for (const [k, owner, length] of left_out)
                    if (Math.abs(memory.view(phi, rows.length)[k]) > open * (length ? this.size : 1)) {
                        const told = {0: `${owner} said nothing new with the file's numbers and opens with these`};
                        throw failure(this, 0, told, [], t);
                    }
            });
        });
    }
}
