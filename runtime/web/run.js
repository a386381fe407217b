/*
 * Store a run and compute its series by name, as runtime/results/series.py does.
 *
 * Series are columns of the stored arrays and of what C evaluates at the samples, points of bodies, magnitudes of
 * forces, and outputs of the file. Values are in SI units, angles in rad.
 */
const FUNCTIONS = { // of outputs; other functions are the browser's, whose last digit may differ from NumPy's
    "+": (a, b) => a + b, "*": (a, b) => a * b, "/": (a, b) => a / b, "**": Math.pow,
    "-": (a, b) => (b === undefined ? -a : a - b),
    where: (left, right, valueBelow, valueAbove) =>
        (Number.isNaN(left) || Number.isNaN(right) ? NaN : left < right ? valueBelow : valueAbove),
    mod: (a, b) => {
        const remainder = a % b;
        return remainder !== 0 && remainder < 0 !== b < 0 ? remainder + b : remainder;
    },
    ramp: (t, start, duration) => Math.min(Math.max((t - start) / duration, 0), 1),
    smooth_step: (t, start, duration) => {
        const s = FUNCTIONS.ramp(t, start, duration);
        return s ** 3 * (10 + s * (6 * s - 15));
    },
};

/* Return the value of an expression tree: a number, a name, or [function, ...]; `getValue` returns that of a name. */
function evaluateExpression(tree, getValue) {
    if (typeof tree === "number") return tree;
    if (typeof tree === "string") return getValue(tree);
    const [head, ...rest] = tree;
    if (head === "curve") return evaluateCurve(rest[0], evaluateExpression(rest[1], getValue));
    return (FUNCTIONS[head] ?? Math[head])(...rest.map((part) => evaluateExpression(part, getValue)));
}

const DECODED_TABLES = new Map(); // tables of long curves by their base64 texts

/* Return the numbers of a table from its base64 text (binary64, little-endian); results are cached. */
function decodeTable(text) {
    if (!DECODED_TABLES.has(text)) {
        const bytes = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
        DECODED_TABLES.set(text, new Float64Array(bytes.buffer));
    }
    return DECODED_TABLES.get(text);
}

/* Return the index of the interval between knots that contains x; outside of all knots that of the nearest one. */
function findInterval(knots, x) {
    let low = 0, high = knots.length - 1;
    while (high - low > 1) {
        const middle = (low + high) >> 1;
        if (x < knots[middle]) high = middle;
        else low = middle;
    }
    return low;
}

/*
 * Return the value of a cubic spline at x (runtime/language/curves.py).
 *
 * The curve is [name, knots, coefficients, ends, extrapolation, unit]; knots and coefficients are arrays, or base64
 * texts if they are long. NaN outside of the knots if the extrapolation is "none".
 */
function evaluateCurve([, knots, coefficients, ends, extrapolation], x) {
    if (typeof knots === "string") knots = decodeTable(knots);
    const first = knots[0], last = knots[knots.length - 1], range = last - first, tolerance = 1e-9 * range;
    const isPeriodic = ends === "periodic";
    if (isPeriodic) x -= range * Math.floor((x - first) / range);
    else if (extrapolation === "none" && !(x >= first - tolerance && x <= last + tolerance)) return NaN;
    const clamped = isPeriodic || extrapolation === "none" ? x : Math.min(Math.max(x, first), last);
    const k = findInterval(knots, clamped), h = clamped - knots[k];
    const isEncoded = typeof coefficients === "string";
    const [c0, c1, c2, c3] = isEncoded ? decodeTable(coefficients).subarray(4 * k, 4 * k + 4) : coefficients[k];
    const value = c0 + h * (c1 + h * (c2 + h * c3));
    if (extrapolation !== "line" || x === clamped) return value;
    return value + (c1 + h * (2 * c2 + h * (3 * c3))) * (x - clamped);
}

const POINT_AXES = [["x", "y"], ["vx", "vy"], ["ax", "ay"]]; // names of coordinates, velocities, accelerations
const POINT_UNITS = ["m", "m/s", "m/s^2"];
const STORED_ARRAYS = ["q", "v", "work", "memory", "state"]; // which the time loops store

/*
 * Samples of a run by rows, and lists of events and impacts.
 *
 * t (N) in s; q, v (N n); work (N 3) in J; memory: discrete states; state: contact codes; a (N n) of a kinematic
 * analysis. counts: steps and others by name; p: parameter values, p_motion: those of the motion; size of the mechanism
 * in m.
 */
class Run {
    constructor(sim, t) {
        Object.assign(this, {sim, description: sim.description, t, p: sim.p, p_motion: sim.p_motion, size: sim.size});
        Object.assign(this, {events: [], impacts: [], undefinedEvents: []});
        this.seriesCache = new Map();
        this.catalogue = this.buildCatalogue();
    }

    /*
     * Find the start of the run and return it, {q, v, isContinued}; it is stored before the time loop begins.
     *
     * isContinued: whether the start was continued from that of the file's parameter values. Throws an Error.
     */
    findStart() {
        this.start = this.sim.start();
        this.isContinued = Boolean(this.start.isContinued);
        return this.start;
    }

    /* Add event `index` at a time (s), or the time from which the expression of an event is not a number. */
    addEvent(index, t) {
        const {events} = this.description, isUndefined = index >= events.length;
        if (isUndefined) this.undefinedEvents.push({name: events[index - events.length][0], t});
        else if (t > this.t[0] + computeTimeResolution(this.t)) this.events.push({name: events[index][0], t});
    }

    /* Add an impact of the joint with play `index` from its columns (ImpactColumn of engine/boundary.h). */
    addImpact(index, columns) {
        const values = Boundary.IMPACT_COLUMN_NAMES.map((name, k) => [name, columns[k]]);
        this.impacts.push({joint: this.description.clearances[index][0], ...Object.fromEntries(values)});
    }

    /* Sort the lists by time, and remove events after the last sample. */
    sortLists() {
        const last = this.t[this.t.length - 1] + computeTimeResolution(this.t);
        for (const name of ["events", "undefinedEvents"])
            this[name] = this[name].filter(({t}) => t <= last).sort((a, b) => a.t - b.t);
        this.impacts.sort((a, b) => a.t_on - b.t_on);
    }

    /* Return the names of all series. */
    get names() { return [...this.catalogue.keys()]; }

    /* Return the SI unit of a series; "" for a pure number. */
    unit(name) { return name === "t" ? "s" : this.findSeries(name).unit; }

    /* Return a series by name, Float64Array (N), SI; it is computed once. */
    series(name) {
        if (name === "t") return this.t;
        if (!this.seriesCache.has(name)) this.seriesCache.set(name, this.findSeries(name).compute());
        return this.seriesCache.get(name);
    }

    /* Return {unit, compute} of a series. Throws an Error for an unknown name. */
    findSeries(name) {
        if (!this.catalogue.has(name)) throw new Error(`this scene has no series named ${name}`);
        return this.catalogue.get(name);
    }

    /* Return all series by name: {unit, compute}, where `compute()` returns the values (N). */
    buildCatalogue() {
        const {columns, points, outputs, clearances, unknown} = this.description, catalogue = new Map();
        const add = (name, unit, compute) => catalogue.set(name, {unit, compute});
        const computeEach = (f) => Float64Array.from(this.t, (_, i) => f(i));
        for (const [name, [unit, array, column]] of Object.entries(columns))
            add(name, unit, () => // unknown: left indeterminate by redundant constraints
                (unknown.includes(name) ? computeEach(() => NaN) : this.getColumn(array, column)));
        for (const [name, point] of Object.entries(points))
            for (let order = 0; order < (point[0] < 0 ? 1 : 3); order++)
                for (const axis of [0, 1])
                    add(`${name}.${POINT_AXES[order][axis]}`, POINT_UNITS[order],
                        () => this.computePointMotion(point, axis, order));
        const owners = Object.keys(columns).filter((name) => name.endsWith(".Fx")).map((name) => name.slice(0, -3));
        for (const owner of owners) {
            const [x, y] = [`${owner}.Fx`, `${owner}.Fy`];
            add(`${owner}.F`, "N", () => computeEach((i) => Math.hypot(this.series(x)[i], this.series(y)[i])));
        }
        for (const [name, k] of clearances)
            add(`${name}.eps`, "", () => this.series(`${name}.e`).map((e) => e / this.p[k]));
        if (columns["energy.kinetic"]) add("energy.residual", "J", () => this.computeEnergyResidual());
        for (const [name, [unit, tree]] of Object.entries(outputs))
            add(name, unit, () => computeEach((i) => evaluateExpression(tree, (path) => this.getValue(path, i))));
        return catalogue;
    }

    /* Return the value of a name in an output's expression at sample i: of a series, or of a parameter. */
    getValue(path, i) {
        if (path === "t" || this.catalogue.has(path)) return this.series(path)[i];
        const {parameterIndices} = this.sim;
        return this.p[parameterIndices.get(path) ?? parameterIndices.get(`parameters.${path}`)];
    }

    /* Return a column (N) of a stored or evaluated array. */
    getColumn(array, column) {
        const values = STORED_ARRAYS.includes(array) ? this[array]
            : this.getAccelerations(array) ?? this.evaluation[array];
        const width = values.length / this.t.length;
        return Float64Array.from(this.t, (_, i) => values[i * width + column]);
    }

    /* Return the accelerations (N n) that the kinematic analysis stored; undefined after integration. */
    getAccelerations(array = "a") { return array === "a" ? this.a : undefined; }

    /* Return the residual of the energy balance (N) in J. */
    computeEnergyResidual() {
        const [kinetic, potential, ...works] = ["energy.kinetic", "energy.potential", "work.drives", "work.forces",
            "work.clearances"].map((name) => this.series(name));
        const start = kinetic[0] + potential[0];
        return kinetic.map((T, i) => T + potential[i] - start - (works[0][i] + works[1][i] + works[2][i]));
    }

    /*
     * Return a coordinate of r_P = r + A(theta) s (N), or its first or second time derivative.
     *
     * s = (x, y) in the body's frame; the point is [index of the body in q, indices of x and y in p, signs].
     */
    computePointMotion([body, x, y, sign_x, sign_y], axis, order) {
        const s = [x < 0 ? 0 : sign_x * this.p[x], y < 0 ? 0 : sign_y * this.p[y]];
        if (body < 0) return new Float64Array(this.t.length).fill(s[axis]);
        const n = this.sim.n, at = (rows, i, k) => rows[i * n + body + k];
        const a = order < 2 ? [] : this.getAccelerations() ?? this.evaluation.a;
        return Float64Array.from(this.t, (_, i) => {
            const [sin, cos] = [Math.sin(at(this.q, i, 2)), Math.cos(at(this.q, i, 2))];
            const arm = [cos * s[0] - sin * s[1], sin * s[0] + cos * s[1]], normal = axis ? arm[0] : -arm[1];
            if (order === 0) return at(this.q, i, axis) + arm[axis];
            if (order === 1) return at(this.v, i, axis) + at(this.v, i, 2) * normal;
            return at(a, i, axis) + at(a, i, 2) * normal - at(this.v, i, 2) ** 2 * arm[axis];
        });
    }

    /* Return accelerations, multipliers, forces and energies at all samples by array name, computed once. */
    get evaluation() {
        this.evaluatedArrays ??= withMemory(this.sim.lib, (memory) => this.evaluateSamples(memory));
        return this.evaluatedArrays;
    }

    /* Evaluate all samples in C, and return the arrays by name, row by row. Throws an Error at a singular sample. */
    evaluateSamples(memory) {
        const {widths} = this.description, N = this.t.length, {lib} = this.sim;
        const inputs = [this.t, this.q, this.v, this.memory, this.p_motion].map((x) =>
            memory.allocateDoubles(x.length, x));
        const outputs = Object.entries(widths).map(([name, width]) =>
            [name, memory.allocateDoubles(N * width), N * width]);
        const failed = memory.allocateBytes(4);
        const status = lib.gudgeon_evaluate(N, ...inputs, ...outputs.map(([, address]) => address), failed);
        if (status) {
            const k = memory.viewLongs(failed, 1)[0];
            throw makeRunError(this, status, {}, this.description.evaluation_pivots, this.t[k]);
        }
        return Object.fromEntries(outputs.map(([name, address, count]) => [name, memory.copyDoubles(address, count)]));
    }

    /* Throw an Error if a constraint equation that is redundant at the file's values is violated (assembly/rank.py). */
    checkRedundantEquations() {
        const {left_out: redundant, open, rows} = this.description, {lib, n} = this.sim;
        if (!redundant.length) return;
        withMemory(lib, (memory) => {
            const p = memory.allocateDoubles(this.p.length, this.p), q = memory.allocateDoubles(n);
            const phi = memory.allocateDoubles(rows.length);
            this.t.forEach((t, i) => {
                memory.viewDoubles(q, n).set(this.q.subarray(i * n, (i + 1) * n));
                lib.gudgeon_phi(t, q, p, phi);
                for (const [k, owner, isLength] of redundant)
                    if (Math.abs(memory.viewDoubles(phi, rows.length)[k]) > open * (isLength ? this.size : 1)) {
                        const message = `${owner} depends on others at the file's values, and is violated at these`;
                        throw makeRunError(this, 0, {0: message}, [], t);
                    }
            });
        });
    }
}
