/*
 * Simulate a scene in a page or in Node by its C and the engine as WebAssembly, called as Python calls them.
 *
 * Numbers are SI, angles rad. With run.js, time_loops.js and start.js this is one script (`build_script` of page.py):
 *
 *     const sim = await gudgeon.load(description, module);   // JSON, and base64 or bytes, as Python wrote them
 *     sim.setParameters({omega: 3, "joints.A.clearance": 5e-4});   // all others are the file's
 *     const run = sim.run({t_end: 2, output: 500, method: "auto", rtol: 1e-8});
 *     run.t, run.series("S9.y"), run.unit("S9.y"), run.names, run.events, run.impacts
 *
 * To keep its frame rate, a page uses `sim.running(...)`, a generator that yields the fraction done after some steps
 * and returns the run. `return()` stops it and frees its memory. `throw(error)` with `error.stops` stops it too, and
 * the run up to there is the error's `partial`:
 *
 *     const steps = sim.running({t_end: 2});
 *     const advance = () => {
 *         let next = steps.next();
 *         for (const until = performance.now() + 8; !next.done && performance.now() < until;) next = steps.next();
 *         next.done ? show(next.value) : requestAnimationFrame(advance);
 *     };
 *
 * A failure is an Error; its `partial` is the run up to there.
 */
const MIN_RTOL = 1e-14, MAX_STEPS = 2 ** 31, MAX_INTERVALS = 1e7, MAX_TIME_S = 1e18;
const DRIVEN_STEP_FRACTION = 1e-3; // default step of rk4 without degrees of freedom, over the length of the run
const DEFAULT_SLICES = {rk4: 4000, kinematic: 50, adaptive: 500}; // steps or samples between two yields
const OPTION_NAMES = "t_end, output, method, rtol, step, slice";
const RELATIONS = {">": (a, b) => a > b, ">=": (a, b) => a >= b, "<": (a, b) => a < b, "<=": (a, b) => a <= b};

/*
 * Return the simulator of a scene, as a promise.
 *
 * description: JSON or its object. module: bytes, or base64 of bytes packed by gzip.
 */
async function load(description, module) {
    const parsed = typeof description === "string" ? JSON.parse(description) : description;
    const bytes = typeof module === "string" ? await unpack(module) : module;
    // the engine reads the clock to poll cancellation only, which pages do not use: 52 is "no such call"
    const host = {wasi_snapshot_preview1: {clock_time_get: () => 52}};
    const {instance} = await WebAssembly.instantiate(bytes, host);
    instance.exports._initialize();
    return new Simulator(parsed, instance.exports);
}

/* Return the bytes (ArrayBuffer) of a base64 text that gzip packed, as a promise. */
async function unpack(text) {
    const packed = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
    const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip"));
    return new Response(stream).arrayBuffer();
}

/*
 * Blocks of the module's memory for one call or one run, freed together.
 *
 * Addresses are in bytes. Views are created at each use, because growing memory invalidates old ones.
 */
class Memory {
    constructor(lib) {
        this.lib = lib;
        this.blocks = [];
    }

    /* Allocate bytes, zero or from `values`, and return their address. Throws an Error if no memory is left. */
    allocateBytes(count, values) {
        const address = this.lib.malloc(Math.max(count, 8));
        if (!address) throw new Error("no memory is left: ask for fewer samples");
        this.blocks.push(address);
        new Uint8Array(this.lib.memory.buffer, address, count).fill(0);
        if (values) new Uint8Array(this.lib.memory.buffer, address, count).set(values);
        return address;
    }

    /* Allocate doubles, zero or from `values`, and return their address. */
    allocateDoubles(count, values) {
        const address = this.allocateBytes(8 * count);
        if (values) this.viewDoubles(address, count).set(values);
        return address;
    }

    /* Return a view of doubles. */
    viewDoubles(address, count) { return new Float64Array(this.lib.memory.buffer, address, count); }

    /* Return a view of integers: `long` of wasm32, and `int`. */
    viewLongs(address, count) { return new Int32Array(this.lib.memory.buffer, address, count); }

    /* Return a copy of doubles. */
    copyDoubles(address, count) { return this.viewDoubles(address, count).slice(); }

    /* Return a copy of signed bytes. */
    copyBytes(address, count) { return new Int8Array(this.lib.memory.buffer, address, count).slice(); }

    /* Free all blocks. */
    free() {
        for (const address of this.blocks.splice(0)) this.lib.free(address);
    }
}

/* Return the result of `call(memory)`, and free that memory afterwards. */
function withMemory(lib, call) {
    const memory = new Memory(lib);
    try {
        return call(memory);
    } finally {
        memory.free();
    }
}

/*
 * Simulator of one scene with its parameter values.
 *
 * p: parameter values of a run. p_motion: without Baumgarte's terms, for methods that project. defaults: p of the file.
 * n: number of coordinates. lib: exports of the module. notes: texts on what pages do not check.
 */
class Simulator {
    constructor(description, lib) {
        this.description = description;
        this.lib = lib;
        this.n = description.coordinates.length;
        this.parameterIndices = new Map(description.slots.map(({address}, k) => [address, k]));
        this.notes = description.notes;
        this.setParameters({});
        this.defaults = this.p;
        this.startFinder = new StartFinder(this);
    }

    /*
     * Set parameters by address or name, a choice by its word; all others get the file's values.
     *
     * Throws an Error for an unknown name, a value of another kind, or a violated condition of the file.
     */
    setParameters(values = {}) {
        expect(isMapping(values), "parameters", values, "an object {address: number}");
        const count = this.parameterIndices.size;
        const givenValues = new Float64Array(count), isGiven = new Uint8Array(count);
        for (const [name, value] of Object.entries(values)) {
            const k = this.parameterIndices.get(name) ?? this.parameterIndices.get(`parameters.${name}`);
            if (k === undefined) throw new Error(`no run-time number has the address ${name} in this scene`);
            const {words, address} = this.description.slots[k];
            if (isGiven[k]) throw new Error(`${address} is given twice`);
            const expected = words ? words.join(" or ") : "a number";
            expect(words ? words.includes(value) : Number.isFinite(value), address, value, expected);
            givenValues[k] = words ? words.indexOf(value) : value;
            isGiven[k] = 1;
        }
        const p = this.prepareValues(givenValues, isGiven);
        this.checkParameterValues(p, isGiven);
        Object.assign(this, {p, givenValues, isGiven});
        this.p_motion = this.prepareWithoutBaumgarte(givenValues, isGiven);
    }

    /* Return all parameter values of a run; a chosen material defines further ones (runtime/model/choices.py). */
    prepareValues(givenValues, isGiven) {
        const p = this.callPrepare(givenValues, isGiven);
        const chosen = this.description.slots.filter(({words}, k) => words && isGiven[k]);
        if (!chosen.length) return p;
        const [values, isFilled] = [givenValues.slice(), isGiven.slice()];
        for (const {address, words} of chosen) {
            const word = words[givenValues[this.parameterIndices.get(address)]];
            for (const [other, k] of this.parameterIndices)
                if (other.startsWith(`${address}.`) && !isGiven[k]) {
                    const key = other.slice(address.length + 1);
                    values[k] = p[this.parameterIndices.get(`materials.${word}.${key}`)];
                    isFilled[k] = 1;
                }
        }
        return this.callPrepare(values, isFilled);
    }

    /* Return the values that `gudgeon_prepare` computes, of all parameters and of the derived ones. */
    callPrepare(givenValues, isGiven) {
        const count = this.parameterIndices.size + this.description.derived.length;
        return withMemory(this.lib, (memory) => {
            const p = memory.allocateDoubles(count), given = memory.allocateDoubles(givenValues.length, givenValues);
            this.lib.gudgeon_prepare(given, memory.allocateBytes(isGiven.length, isGiven), p);
            return memory.copyDoubles(p, count);
        });
    }

    /* Return the values without Baumgarte's terms, for methods that project onto the constraints. */
    prepareWithoutBaumgarte(givenValues, isGiven) {
        const [values, isFilled] = [givenValues.slice(), isGiven.slice()];
        for (const k of this.description.gains) [values[k], isFilled[k]] = [0, 1];
        return this.prepareValues(values, isFilled);
    }

    /* Check the conditions of the file, and that all expressions are defined as written. Throws an Error. */
    checkParameterValues(p, isGiven) {
        const {conditions, slots: parameters, derived, partials, divides} = this.description;
        const getValue = (address) => p[this.parameterIndices.get(address)];
        const getUnit = (address) => parameters[this.parameterIndices.get(address)].unit;
        for (const [address, relation, bound, message] of conditions) {
            const limit = typeof bound === "number" ? bound
                : bound.split(" + ").reduce((sum, term) => sum + getValue(term), 0);
            const x = getValue(address), isKnown = Number.isFinite(x) && Number.isFinite(limit);
            if (!isKnown || RELATIONS[relation](x, limit)) continue;
            const origin = typeof bound === "number" ? "" : `, which is ${bound}`, unit = getUnit(address);
            throw new Error(`${address} is ${formatQuantity(x, unit)}: ${message}; expected ${relation}`
                + ` ${formatQuantity(limit, unit)}${origin}`);
        }
        [...parameters.map(({address}) => address), ...derived].forEach((name, k) => {
            if (!Number.isFinite(p[k])) throw new Error(`${name} is ${p[k]}: not finite with these numbers`);
        });
        for (const {address, tree, slot: index, slots: indices} of partials) {
            if (index >= 0 && isGiven[index]) continue;
            const known = Object.fromEntries(Object.entries(indices).map(([name, k]) => [name, p[k]]));
            const value = findUndefinedPart(tree, known, divides), pairs = Object.entries(known);
            if (value !== undefined) {
                const values = pairs.map((pair) => pair.join(" = ")).join(", ");
                throw new Error(`${address} has a part that is ${value} with ${values}`);
            }
        }
    }

    /* Return values at a fraction of the way from the file's values to the given ones; words are as given. */
    interpolateParameters(fraction) {
        const interpolate = (x, k) =>
            this.description.slots[k].words ? x : this.defaults[k] + fraction * (x - this.defaults[k]);
        return fraction === 1 ? this.p : this.prepareValues(this.givenValues.map(interpolate), this.isGiven);
    }

    /* Return whether the scene has no degrees of freedom. */
    get isDriven() { return this.description.methods[0] === "kinematic"; }

    /* Return the size of the mechanism in m, as compute_mechanism_sizes of runtime/model/sizes.py. */
    get size() { return this.computeSize(this.p); }

    /* Return the size of the mechanism in m for parameter values p. */
    computeSize(p) {
        // equal to the last bit to Python and C
        const computeLength = ([x, y]) => Math.sqrt(p[x] * p[x] + (y < 0 ? 0 : p[y] * p[y]));
        return Math.max(0, ...this.description.sizes.map(computeLength)) || 1;
    }

    /*
     * Return the start of a run at t = 0, {q, v, isContinued}, of the closed linkage.
     *
     * isContinued: whether it was continued from the start of the file's values. Throws an Error if there is none.
     */
    start() { return this.startFinder.find(); }

    /* Return the complete run of `running`. */
    run(options = {}) {
        const steps = this.running(options);
        for (;;) {
            const next = steps.next();
            if (next.done) return next.value;
        }
    }

    /*
     * Run with options like `simulate` of Python: t_end (s), output (number of intervals, or times), method, rtol, step
     * (s).
     *
     * A generator that yields the fraction done, and returns the Run. `slice`: steps or samples between two yields.
     * `onStart` is called with the Run before its first step. Throws an Error.
     */
    *running(options = {}, onStart = () => {}) {
        expect(isMapping(options), "options", options, "an object {t_end, output, ...}");
        const settings = this.checkOptions(options), memory = new Memory(this.lib), run = new Run(this, settings.t);
        Object.assign(run, {step: settings.step, isStepEstimated: settings.isStepEstimated});
        onStart(run);
        try {
            const loop = settings.method === "kinematic" ? integrateKinematic
                : this.isDriven ? integrateWithDrift : integrate;
            yield* loop(this, settings, memory, run);
            return run;
        } catch (error) {
            if (error.stops && run.storePartial) { // by `throw` of the caller
                run.storePartial();
                error.partial = run;
            }
            throw error;
        } finally {
            memory.free();
        }
    }

    /* Return {t, method, rtol, step, slice, isStepEstimated} of options and the scene's defaults. Throws an Error. */
    checkOptions({t_end, output, method = "auto", rtol, step, slice, ...unknown}) {
        for (const name of Object.keys(unknown)) throw new Error(`${name} is no option: expected ${OPTION_NAMES}`);
        for (const [name, value] of Object.entries({t_end, rtol, step, slice}))
            expect(value == null || typeof value === "number", name, value, "a number");
        const {methods} = this.description, defaults = this.computeDefaultOptions(t_end);
        if (this.isDriven && method === "rk4") { // at most a sample for each step: a step ends at each sample
            const n_steps = Math.ceil(defaults.t_end / (step ?? defaults.step) * (1 - 1e-12));
            output ??= Math.min(defaults.output, Math.max(1, n_steps));
        }
        const t = computeOutputTimes(defaults.t_end, output ?? defaults.output, t_end), end = t[t.length - 1];
        if (method === "auto") method = this.isDriven ? "kinematic" : step == null ? "adaptive" : "rk4";
        const isKnown = methods.includes(method) || (method === "adaptive" && !this.isDriven);
        expect(isKnown, "method", method, `auto, ${methods.join(", ")}`);
        if (method === "kinematic") step = null;
        const isStepEstimated = method === "rk4" && step == null && defaults.isStepEstimated;
        if (method === "rk4") step ??= this.computeDefaultOptions(end).step;
        if (step != null) {
            expect(step > 0 && end / step < MAX_STEPS, "step", step, "a positive time (s), not too short");
            expect(rtol == null, "rtol", rtol, "none with a fixed step");
        }
        rtol ??= this.description.rtol;
        expect(rtol >= MIN_RTOL && rtol < 1, "rtol", rtol, `a fraction from ${MIN_RTOL} to 1`);
        slice ??= DEFAULT_SLICES[method] ?? DEFAULT_SLICES.adaptive;
        expect(Number.isInteger(slice) && slice >= 1 && slice < MAX_STEPS, "slice", slice, "a whole number from 1 on");
        return {t, method, rtol, step, slice, isStepEstimated};
    }

    /* Return the default {t_end, output, step, isStepEstimated} of the scene; a step may be estimated for the file. */
    computeDefaultOptions(t_end) {
        const {simulate, step} = this.description;
        const getParameter = (name) => this.p[this.parameterIndices.get(`parameters.${name}`)];
        const evaluateOption = (name) =>
            simulate[name] === undefined ? undefined : evaluateExpression(simulate[name], getParameter);
        const end = t_end ?? evaluateOption("t_end"), fileStep = evaluateOption("step");
        const estimate = step ? Math.min(step[0] * end, step[1]) : end * DRIVEN_STEP_FRACTION;
        return {t_end: end, output: evaluateOption("output"), step: fileStep ?? estimate,
            isStepEstimated: fileStep === undefined && step !== null};
    }
}

/* Throw an Error that names the value and what was expected, unless a condition holds. */
function expect(condition, name, value, expected) {
    if (!condition) throw new Error(`${name} is ${formatValue(value)}: expected ${expected}`);
}

/* Return a number in SI with its unit, as text with a number of digits. */
function formatQuantity(x, unit, digits = 6) { return `${Number(x.toPrecision(digits))} ${unit}`.trim(); }

/* Return a value as text for a message; of an object its kind, such as [object Map]. */
function formatValue(value) {
    const isPlain = value === null || typeof value !== "object" || Array.isArray(value);
    return isPlain ? String(value) : Object.prototype.toString.call(value);
}

/* Return whether a value is an object with names and values, not a list or a Map. */
function isMapping(value) { return typeof value === "object" && value !== null && !(Symbol.iterator in value); }

/*
 * Return the times of samples (s), with the same bits as NumPy's linspace.
 *
 * end: of the run (s). output: number of intervals, or increasing times, to which 0 is added. given_end: the caller's
 * t_end, which must agree with the last time. Throws an Error.
 */
function computeOutputTimes(end, output, given_end) {
    if (typeof output !== "number") {
        const times = Float64Array.from(output), last = times[times.length - 1];
        const isIncreasing = times.every((t, k) => t <= MAX_TIME_S && (k ? t > times[k - 1] : t >= 0));
        expect(times.length && isIncreasing, "output", output, "increasing times (s), from 0 on");
        const difference = given_end == null ? 0 : Math.abs(given_end - last);
        expect(difference <= 1e-9 * last, "t_end", given_end, "the last of the times of output, or none");
        return times[0] === 0 ? times : Float64Array.of(0, ...times);
    }
    expect(end > 0 && end <= MAX_TIME_S, "t_end", end, "a positive time (s)");
    const isValid = Number.isInteger(output) && output >= 1 && output <= MAX_INTERVALS;
    expect(isValid, "output", output, `a number of intervals, 1 to ${MAX_INTERVALS}`);
    return Float64Array.from({length: output + 1}, (_, k) => (k === output ? end : k * (end / output)));
}
