/*
 * Simulate a scene in a page or in Node by its C and the engine as WebAssembly, called as Python calls them.
 *
 * Numbers are SI, angles rad. With start.js, run.js and loops.js this is one script (`script` of web.page):
 *
 *     const sim = await gudgeon.load(description, module);   // JSON, and base64 or bytes, as Python wrote them
 *     sim.setParameters({omega: 3, "joints.A.clearance": 5e-4});   // all others are the file's
 *     const run = sim.run({t_end: 2, output: 500, method: "auto", rtol: 1e-8});
 *     run.t, run.series("S9.y"), run.unit("S9.y"), run.names, run.events, run.impacts
 *
 * To keep its frame rate, a page uses `sim.running(...)`, a generator that yields the fraction done after some steps and
 * returns the run. `return()` stops it and frees its memory. `throw(error)` with `error.stops` stops it too, and the run
 * up to there is the error's `partial`:
 *
 *     const way = sim.running({t_end: 2});
 *     const some = () => {
 *         let next = way.next();
 *         for (const until = performance.now() + 8; !next.done && performance.now() < until;) next = way.next();
 *         next.done ? show(next.value) : requestAnimationFrame(some);
 *     };
 *
 * What cannot be computed is an Error; its `partial` is the run up to there.
 */
const SMALLEST_RTOL = 1e-14, MOST_STEPS = 2 ** 31, MOST_OUTPUT = 1e7, FURTHEST = 1e18;
const DRIVEN_STEP = 1e-3; // default step of rk4 for driven scenes, over the length of the run
const SLICE = {rk4: 4000, kinematic: 50, adaptive: 500}; // default steps or samples between two yields
const OPTIONS = "t_end, output, method, rtol, step, slice";
const RELATIONS = {">": (a, b) => a > b, ">=": (a, b) => a >= b, "<": (a, b) => a < b, "<=": (a, b) => a <= b};

/* Return a simulator of a description (JSON or object) and a module (bytes, or base64 of bytes packed by gzip). */
async function load(description, module) {
    const about = typeof description === "string" ? JSON.parse(description) : description;
    const bytes = typeof module === "string" ? await unpacked(module) : module;
    // the engine reads the clock to poll cancellation only, which pages do not use: 52 is "no such call"
    const host = {wasi_snapshot_preview1: {clock_time_get: () => 52}};
    const {instance} = await WebAssembly.instantiate(bytes, host);
    instance.exports._initialize();
    return new Simulator(about, instance.exports);
}

/* Return the bytes of base64 text that gzip packed. */
async function unpacked(text) {
    const packed = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
    const way = new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip"));
    return new Response(way).arrayBuffer();
}

/*
 * Blocks of the module's memory for one call or one run, freed together.
 *
 * Views are created at each use, because growing memory invalidates old ones.
 */
class Memory {
    constructor(lib) {
        this.lib = lib;
        this.places = [];
    }

    /* Allocate zeroed bytes, and return their address. */
    bytes(count, values) {
        const place = this.lib.malloc(Math.max(count, 8));
        if (!place) throw new Error("no memory is left: ask for fewer samples");
        this.places.push(place);
        new Uint8Array(this.lib.memory.buffer, place, count).fill(0);
        if (values) new Uint8Array(this.lib.memory.buffer, place, count).set(values);
        return place;
    }

    /* Allocate doubles, and return their address. */
    numbers(count, values) {
        const place = this.bytes(8 * count);
        if (values) this.view(place, count).set(values);
        return place;
    }

    /* Return a view of doubles. */
    view(place, count) { return new Float64Array(this.lib.memory.buffer, place, count); }

    longs(place, count) { return new Int32Array(this.lib.memory.buffer, place, count); } // `long` of wasm32, and `int`

    /* Return a copy of doubles. */
    copy(place, count) { return this.view(place, count).slice(); }

    /* Return a copy of signed bytes. */
    codes(place, count) { return new Int8Array(this.lib.memory.buffer, place, count).slice(); }

    /* Free all blocks. */
    free() {
        for (const place of this.places.splice(0)) this.lib.free(place);
    }
}

/* Return the result of `work(memory)`, and free that memory afterwards. */
function within(lib, work) {
    const memory = new Memory(lib);
    try {
        return work(memory);
    } finally {
        memory.free();
    }
}

/* Simulator of one scene with its parameter values. */
class Simulator {
    constructor(about, lib) {
        this.about = about;
        this.lib = lib;
        this.n = about.coordinates.length;
        this.place = new Map(about.slots.map((slot, k) => [slot.address, k]));
        this.notes = about.notes;
        this.setParameters({});
        this.file = this.p;
        this.beginning = new Start(this);
    }

    /* Set parameters by address or name (a choice by its word); all others get the file's values. Throws an Error. */
    setParameters(values = {}) {
        expect(isMapping(values), "parameters", values, "an object {address: number}");
        const given = new Float64Array(this.place.size), mask = new Uint8Array(this.place.size);
        for (const [name, value] of Object.entries(values)) {
            const k = this.place.get(name) ?? this.place.get(`parameters.${name}`);
            if (k === undefined) throw new Error(`no run-time number has the address ${name} in this scene`);
            const {words, address} = this.about.slots[k];
            if (mask[k]) throw new Error(`${address} is given twice`);
            const expected = words ? words.join(" or ") : "a number";
            expect(words ? words.includes(value) : Number.isFinite(value), address, value, expected);
            given[k] = words ? words.indexOf(value) : value;
            mask[k] = 1;
        }
        const p = this.prepared(given, mask);
        this.check(p, mask);
        Object.assign(this, {p, given, mask});
        this.projected = this.withoutGains(given, mask);
    }

    /* Return all parameter values of a run; a chosen material defines further ones (runtime/model/choices.py). */
    prepared(given, mask) {
        const p = this.called(given, mask), chosen = this.about.slots.filter((slot, k) => slot.words && mask[k]);
        if (!chosen.length) return p;
        const [values, filled] = [given.slice(), mask.slice()];
        for (const {address, words} of chosen) {
            const word = words[given[this.place.get(address)]];
            for (const [own, k] of this.place)
                if (own.startsWith(`${address}.`) && !mask[k]) {
                    values[k] = p[this.place.get(`materials.${word}.${own.slice(address.length + 1)}`)];
                    filled[k] = 1;
                }
        }
        return this.called(values, filled);
    }

    /* Return the values that `gudgeon_prepare` computes. */
    called(given, mask) {
        const count = this.place.size + this.about.derived.length;
        return within(this.lib, (memory) => {
            const p = memory.numbers(count);
            this.lib.gudgeon_prepare(memory.numbers(given.length, given), memory.bytes(mask.length, mask), p);
            return memory.copy(p, count);
        });
    }

    /* Return the values without Baumgarte's terms, for methods that project onto the constraints. */
    withoutGains(given, mask) {
        const [values, filled] = [given.slice(), mask.slice()];
        for (const k of this.about.gains) [values[k], filled[k]] = [0, 1];
        return this.prepared(values, filled);
    }

    /* Check the conditions of the file, and that all expressions are defined as written. Throws an Error. */
    check(p, mask) {
        const {conditions, slots, derived} = this.about, value = (address) => p[this.place.get(address)];
        const unit = (address) => slots[this.place.get(address)].unit;
        for (const [address, relation, bound, message] of conditions) {
            const limit = typeof bound === "number" ? bound : bound.split(" + ").reduce((sum, a) => sum + value(a), 0);
            const known = Number.isFinite(value(address)) && Number.isFinite(limit);
            if (known && !RELATIONS[relation](value(address), limit))
                throw new Error(`${address} is ${said(value(address), unit(address))}: ${message}; expected ${relation}`
                    + ` ${said(limit, unit(address))}${typeof bound === "number" ? "" : `, which is ${bound}`}`);
        }
        [...slots.map((slot) => slot.address), ...derived].forEach((name, k) => {
            if (!Number.isFinite(p[k])) throw new Error(`${name} is ${p[k]}: not finite with these numbers`);
        });
        for (const {address, tree, slot, slots: used} of this.about.partials) {
            if (slot >= 0 && mask[slot]) continue;
            const known = Object.fromEntries(Object.entries(used).map(([name, k]) => [name, p[k]]));
            const odd = undefinedPart(tree, known, this.about.divides), by = Object.entries(known);
            if (odd !== undefined)
                throw new Error(`${address} has a part that is ${odd} with ${by.map((pair) => pair.join(" = ")).join(", ")}`);
        }
    }

    /* Return values at a fraction of the path from the file's values to the given ones; words are as given. */
    between(share) {
        const along = (x, k) => this.about.slots[k].words ? x : this.file[k] + share * (x - this.file[k]);
        return share === 1 ? this.p : this.prepared(this.given.map(along), this.mask);
    }

    /* Return whether the scene has no degrees of freedom. */
    get driven() { return this.about.methods[0] === "kinematic"; }

    /* Return the size of the mechanism in m, as mechanism_sizes of sizes.py. */
    get size() { return this.sizeOf(this.p); }

    /* Return the size for parameter values p. */
    sizeOf(p) {
        const length = ([x, y]) => Math.sqrt(p[x] * p[x] + (y < 0 ? 0 : p[y] * p[y])); // to the bit as in Python and C
        return Math.max(0, ...this.about.sizes.map(length)) || 1;
    }

    /* Return q and q̇ of the closed linkage at t = 0; `followed`: continued from the file's start. */
    start() { return this.beginning.find(); }

    /* Return the complete run of `running`. */
    run(options = {}) {
        const way = this.running(options);
        for (;;) {
            const next = way.next();
            if (next.done) return next.value;
        }
    }

    /*
     * Run with options like `simulate` of Python: t_end (s), output (number of intervals, or times), method, rtol, step
     * (s).
     *
     * A generator that yields the fraction done. `slice`: steps or samples between two yields. `begun` receives the run
     * at first.
     */
    *running(options = {}, begun = () => {}) {
        expect(isMapping(options), "options", options, "an object {t_end, output, ...}");
        const asked = this.checked(options), memory = new Memory(this.lib), run = new Run(this, asked.t);
        Object.assign(run, {step: asked.step, estimated: asked.estimated});
        begun(run);
        try {
            const loop = asked.method === "kinematic" ? follow : this.driven ? drift : integrate;
            yield* loop(this, asked, memory, run);
            return run;
        } catch (error) {
            if (error.stops && run.soFar) { // by `throw` of who goes on with it
                run.soFar();
                error.partial = run;
            }
            throw error;
        } finally {
            memory.free();
        }
    }

    /* Return all options with the scene's defaults. Throws an Error. */
    checked({t_end, output, method = "auto", rtol, step, slice, ...unknown}) {
        for (const name of Object.keys(unknown)) throw new Error(`${name} is no option: expected ${OPTIONS}`);
        for (const [name, value] of Object.entries({t_end, rtol, step, slice}))
            expect(value == null || typeof value === "number", name, value, "a number");
        const {methods} = this.about, usual = this.usual(t_end);
        if (this.driven && method === "rk4") // a sample a step, no more: a step ends at each sample
            output ??= Math.min(usual.output, Math.max(1, Math.ceil(usual.t_end / (step ?? usual.step) * (1 - 1e-12))));
        const t = outputTimes(usual.t_end, output ?? usual.output, t_end), end = t[t.length - 1];
        if (method === "auto") method = this.driven ? "kinematic" : step == null ? "adaptive" : "rk4";
        const known = methods.includes(method) || (method === "adaptive" && !this.driven);
        expect(known, "method", method, `auto, ${methods.join(", ")}`);
        if (method === "kinematic") step = null;
        const estimated = method === "rk4" && step == null && usual.estimated;
        if (method === "rk4") step ??= this.usual(end).step;
        if (step != null) {
            expect(step > 0 && end / step < MOST_STEPS, "step", step, "a positive time (s), not too short");
            expect(rtol == null, "rtol", rtol, "none beside a fixed step");
        }
        rtol ??= this.about.rtol;
        expect(rtol >= SMALLEST_RTOL && rtol < 1, "rtol", rtol, `a share from ${SMALLEST_RTOL} to 1`);
        slice ??= SLICE[method] ?? SLICE.adaptive;
        expect(Number.isInteger(slice) && slice >= 1 && slice < MOST_STEPS, "slice", slice, "a whole number from 1 on");
        return {t, method, rtol, step, slice, estimated};
    }

    /* Return the default options: those of the scene; a step of rk4 may be estimated for the file's values. */
    usual(t_end) {
        const {simulate, step} = this.about, named = (name) => this.p[this.place.get(`parameters.${name}`)];
        const said = (name) => simulate[name] === undefined ? undefined : valueOf(simulate[name], named);
        const end = t_end ?? said("t_end"), own = said("step"), estimated = own === undefined;
        const short = step ? Math.min(step[0] * end, step[1]) : end * DRIVEN_STEP;
        return {t_end: end, output: said("output"), step: own ?? short, estimated: estimated && step !== null};
    }
}

/* Throw an Error unless a condition holds. */
function expect(holds, name, value, expected) {
    if (!holds) throw new Error(`${name} is ${told(value)}: expected ${expected}`);
}

/* Return a number in SI with its unit. */
function said(x, unit, digits = 6) { return `${Number(x.toPrecision(digits))} ${unit}`.trim(); }

/* Return a value for a message; of an object its kind, such as [object Map]. */
function told(value) {
    const plain = value === null || typeof value !== "object" || Array.isArray(value);
    return plain ? String(value) : Object.prototype.toString.call(value);
}

/* Return whether a value is an object with names and values, not a list or a Map. */
function isMapping(value) { return typeof value === "object" && value !== null && !(Symbol.iterator in value); }

/* Return the times of samples (s), with the same bits as NumPy's linspace. */
function outputTimes(end, output, given_end) {
    if (typeof output !== "number") {
        const times = Float64Array.from(output), last = times[times.length - 1];
        const rise = times.every((t, k) => t <= FURTHEST && (k ? t > times[k - 1] : t >= 0));
        expect(times.length && rise, "output", output, "increasing times (s), from 0 on");
        const apart = given_end == null ? 0 : Math.abs(given_end - last);
        expect(apart <= 1e-9 * last, "t_end", given_end, "the last of the times of output, or none");
        return times[0] === 0 ? times : Float64Array.of(0, ...times);
    }
    expect(end > 0 && end <= FURTHEST, "t_end", end, "a positive time (s)");
    const whole = Number.isInteger(output) && output >= 1 && output <= MOST_OUTPUT;
    expect(whole, "output", output, `a number of intervals, 1 to ${MOST_OUTPUT}`);
    return Float64Array.from({length: output + 1}, (_, k) => (k === output ? end : k * (end / output)));
}
