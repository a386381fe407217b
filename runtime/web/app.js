/*
 * Run the page: advance the time, rerun the scene when parameters change, and update all that is shown.
 *
 * At each shown sample the document receives the event `gudgeon:state` with {sim, run, k, t, q, v, p};
 * `window.gudgeonState` is the last one.
 */
const SPENT = 4; // ms of a frame in which work continues
const PATIENT = 200; // ms up to which a run is completed although parameters change
const PAINT = "paint"; // yielded after work that the browser has to paint: at most one in a frame
const MOST_TOLD = 8; // number of refused parameters of a link that are reported
const UNTOLD = 500; // ms of a run before its progress and a button to stop it are shown
const LIMIT = 120; // s after which a run is stopped
const FOLLOWED = "The start is the assembly followed from the file’s: near its guess Python may find another.";
const READ = 100; // ms between two updates of numbers

/* Return a count with its noun: "1 step", "1,000 steps". */
function howMany(count, names) {
    return `${count.toLocaleString("en")} ${count === 1 ? names.replace(/s$/, "") : names}`;
}

const by = (id) => document.getElementById(id);

/* State of the page: simulator, current run, drawing, charts, panel. */
class App {
    constructor(about, panel, sim) {
        Object.assign(this, {settings: panel, k: 0, t: 0, playing: false, charts: [], way: null, dirty: false, limit: LIMIT});
        this.use(about, sim);
        this.values = panel.values.map((name) => this.valueRow(name));
        this.transport();
        if (sim) this.controls();
        this.scenes();
        new ResizeObserver(() => this.resized()).observe(by("g-charts"));
    }

    /* Use a simulator (null: a recorded run), and draw its scene. */
    use(about, sim) {
        Object.assign(this, {about, sim});
        this.drawing = new Drawing(by("g-drawing"), this.settings, about);
        this.orbits = about.clearances.filter(([name]) => !name.includes(".")).map(([name, place]) => new Orbit(this, name, place));
        by("g-orbits").replaceChildren(...this.orbits.map(({box}) => box));
    }

    /* Change to the other formulation of the same scene. */
    async formulated(which) {
        const sim = await loaded(which);
        this.way?.return();
        this.way = null;
        this.use(sim.about, sim);
        this.begin();
    }

    /* Create the panel of parameters. */
    controls() {
        const heard = {changed: () => this.begin(), complain: (text) => this.complain(text),
            formulated: (which) => this.formulated(which)};
        this.panel = new Panel(by("g-numbers"), this.settings, this.about, heard);
    }

    /* Connect the controls of time, forces, names, path and traces. */
    transport() {
        by("g-play").onclick = () => this.play(!this.playing);
        by("g-way").querySelector("button").onclick = () => this.stop("stopped by hand");
        by("g-when").oninput = () => this.seek(this.run.t[0] + by("g-when").value / 1000 * this.span);
        by("g-named").onchange = () => by("g-drawing").classList.toggle("g-unnamed", !by("g-named").checked);
        by("g-forces").onchange = () => {
            by("g-scale").hidden = !by("g-forces").checked;
            this.wake();
        };
        by("g-path").onchange = () => this.trail();
        for (const name of ["", ...Object.keys(this.about.points).filter((one) => this.about.points[one][0] >= 0)])
            element("option", {value: name}, by("g-path")).textContent = name || "none";
        by("g-path").value = this.settings.path;
        by("g-add").onclick = () => {
            if (this.run) this.addChart(this.run.names.find((name) => !this.charts.some((chart) => chart.name === name)));
        };
    }

    /* Link to the pages of other scenes; they begin with the parameters of this page. */
    scenes() {
        const {scenes} = this.settings, select = by("g-scene");
        for (const name of Object.keys(scenes)) element("option", {value: name}, select).textContent = name;
        select.value = this.about.scene;
        select.parentElement.hidden = Object.keys(scenes).length < 2;
        select.onchange = () => {
            const told = {...this.panel?.given, t: this.t};
            const leaves = `${encodeURIComponent(scenes[select.value])}#${new URLSearchParams(told)}`;
            select.value = this.about.scene; // for who comes back
            location.href = leaves;
        };
    }

    /* Apply parameters of the link that led here, after the first run; report those that this scene does not have. */
    arrive() {
        const odd = new Set(), asked = location.hash.includes("=") ? location.hash.slice(1) : ""; // else a place here
        for (const [address, text] of new URLSearchParams(asked)) {
            const slot = this.about.slots.find((one) => one.address === address), unit = slot?.unit ?? "s";
            const value = typed(text, {factor: 1, unit}, this.panel.units[unit]); // as its field takes it, else in SI
            const one = `${address} = ${text || "nothing"}`.slice(0, 80);
            if (address === "t" && Number.isFinite(value)) {
                this.seek(value);
                if (this.t !== value) odd.add(`${one} (the run has ${told(this.run.t[0])} to ${told(this.end)} s)`);
            } else if (!slot && address !== "t") odd.add(`${one} (this scene has no such number)`);
            else if (slot?.words ? slot.words.includes(text) : Number.isFinite(value)) {
                this.panel.given[address] = slot.words ? text : value;
                this.panel.since.add(address);
                this.again = true; // what goes on then (goOn) begins again
            } else odd.add(`${one} (expected ${slot?.words?.join(" or ") ?? "a number"})`);
        }
        const first = [...odd].slice(0, MOST_TOLD).join(", "), more = odd.size > MOST_TOLD ? " and more" : "";
        if (odd.size) by("g-note").textContent = `Not taken from the link: ${first}${more}.`;
    }

    /* Draw the path of the chosen point. */
    trail() {
        const name = by("g-path").value, known = name && this.run?.names.includes(`${name}.x`);
        const [x, y] = known ? [this.run.series(`${name}.x`), this.run.series(`${name}.y`)] : [[], []];
        this.drawing.trail(x, y);
    }

    /* Add a row to the live values, and return its cells. */
    valueRow(name) {
        const row = element("tr", {}, by("g-values"));
        element("th", {scope: "row"}, row).textContent = name;
        return {name, cell: element("td", {}, row), unit: element("td", {class: "g-unit"}, row)};
    }

    /* Return the names of series by owner: "A.Fx" belongs to A. */
    owners() {
        const found = new Map();
        for (const name of this.run.names) {
            const owner = name.includes(".") ? name.slice(0, name.indexOf(".")) : "outputs";
            if (!found.has(owner)) found.set(owner, []);
            found.get(owner).push(name);
        }
        return found;
    }

    /* Add a chart of a series. */
    addChart(name) {
        const chart = new Chart(this, name);
        by("g-charts").append(chart.box);
        this.charts.push(chart);
        chart.draw();
    }

    /* Remove a chart. */
    removeChart(chart) {
        chart.box.remove();
        this.charts = this.charts.filter((one) => one !== chart);
    }

    /* Redraw after a change of the window's size. */
    resized() {
        this.drawing.resize();
        if (!this.run) return;
        for (const chart of this.charts) chart.draw();
        this.wake();
    }

    /* Start a run with the present parameters. An active run that is young is completed first, others are stopped. */
    begin() {
        const age = performance.now() - this.begun;
        this.again = this.way !== null && age < PATIENT;
        if (this.again) return;
        this.way?.return();
        this.way = null;
        this.begun = performance.now();
        let wrong = null;
        try {
            this.sim.setParameters(this.panel.given);
            this.way = this.work();
        } catch (error) {
            wrong = error;
        }
        this.panel.show(this.sim);
        if (wrong) this.failed(wrong);
        this.onTheWay();
        this.wake();
    }

    /* Show the progress of a long run, and stop it after the limit. */
    onTheWay() {
        const age = performance.now() - this.begun, long = this.way !== null && age > UNTOLD, box = by("g-way");
        if (long && age > 1000 * this.limit) return this.stop(`given up after ${told(this.limit)} s`);
        if (long && box.hidden && !this.run) this.still(this.going);
        box.hidden = !long;
        if (!long) return;
        const share = told(100 * (this.share ?? 0), 2), seconds = Math.floor(age / 1000);
        box.querySelector("progress").value = this.share ?? 0;
        box.querySelector("span").textContent =
            `running: ${share} % after ${seconds} s; given up after ${told(this.limit)} s`;
    }

    /* Draw the mechanism at the start of a run that has no result yet. */
    still(run) {
        if (!run?.first) return;
        const {q, v} = run.first;
        this.drawing.fit({t: [0], q, v, p: run.p});
        this.drawing.show(q, run.p, () => [0, 0], []);
    }

    /* Stop the active run for the reason `why`; its samples so far are shown. */
    stop(why) {
        if (!this.way) return;
        const share = told(100 * (this.share ?? 0), 2), wrong = Object.assign(new Error(), {stops: true});
        wrong.message = `${why} at ${share} % of the run`;
        this.again = false;
        this.goOn(() => this.way.throw(wrong));
        this.onTheWay();
    }

    /* Compute a run and update the page in pieces; a generator that yields the fraction done or PAINT. */
    *work() {
        this.share = 0;
        const options = {slice: 200, ...this.panel.options.read()};
        const run = yield* this.sim.running(options, (going) => { this.going = going; });
        if (run.names.includes("Phi.max")) run.series("Phi.max"); // all that C evaluates
        yield;
        yield* this.taking(run);
        this.complain("");
        this.panel.since.clear();
    }

    /* Continue the active work for some milliseconds. */
    goOn(first = () => this.way.next()) {
        try {
            let next = first();
            const until = performance.now() + SPENT;
            while (!next.done && next.value !== PAINT && performance.now() < until) next = this.way.next();
            if (typeof next.value === "number") this.share = next.value;
            if (!next.done) return;
            this.way = null;
        } catch (error) {
            this.way = null;
            if (error.partial?.q?.length) this.take(error.partial);
            this.failed(error);
        }
        if (this.again) this.begin();
    }

    /* Show the error of a run, and its samples up to there. */
    failed(error) {
        const upTo = error.partial?.q?.length ? " What is shown is the run up to there." : "";
        const {message} = error, blamed = error.stops ? "" : this.panel?.blamed(error, this.sim) ?? "";
        const call = `gudgeon.load(${this.settings.loaded}).simulate(parameters=${JSON.stringify(this.panel?.given)})`;
        const python = error.searched ? ` Python searches on and runs from what it finds: ${call}.` : "";
        this.complain(`${message}${blamed}.${python}${upTo || (this.run ? " What is shown is the run before." : "")}`);
    }

    /* Show an error message; "" hides it. */
    complain(text) {
        by("g-error").textContent = text;
        by("g-error").hidden = !text;
    }

    /* Show a finished run at once. */
    take(run) { for (const _ of this.taking(run)); }

    /* Show a finished run in pieces. The first run, at the file's values, stays behind later ones in the charts. */
    *taking(run) {
        const first = !this.run;
        this.run = run;
        this.before ??= run;
        this.span = run.t[run.t.length - 1] - run.t[0];
        this.drawing.fit(run);
        this.counted(run);
        this.trail();
        this.seek(Math.min(this.t, run.t[run.t.length - 1]));
        this.scales = this.motionScales(run);
        for (const name of [...this.settings.joints.map(([joint]) => `${joint}.F`), ...this.settings.values]) {
            if (run.names.includes(name)) this.scale(run.unit(name), extent(run.series(name)));
            yield;
        }
        if (first) this.settings.traces.forEach((name) => this.addChart(name));
        for (const part of [...first ? [] : this.charts, ...this.orbits]) {
            part.draw();
            yield PAINT;
        }
        if (first && this.panel) this.arrive();
        this.wake();
    }

    /* Show steps, impacts and times of a run. */
    counted(run) {
        const made = Object.entries(run.counts ?? {}).filter(([name]) => ["steps", "right_hand_sides"].includes(name));
        const counts = made.map(([name, count]) => howMany(count, name.replaceAll("_", " ")));
        const how = run.estimated ? " (estimated for the file’s numbers)" : "";
        if (run.step) counts.unshift(`steps of ${quantity(run.step, "s", 4)}${how}`);
        if (run.impacts.length) counts.push(howMany(run.impacts.length, "impacts"));
        const ms = this.begun === undefined ? "" : `, ${(performance.now() - this.begun).toFixed(0)} ms`;
        const length = this.span ? `${told(this.span)} s simulated` : "the run ends where it begins";
        const start = run.followed ? `. ${FOLLOWED}` : "";
        by("g-counts").textContent = `${length}: ${counts.join(", ")}${ms}${start}`;
        by("g-when").disabled = !this.span;
    }

    /* Return a series of the run, or an empty list. */
    seriesOf(name) { return this.run.names.includes(name) ? this.run.series(name) : []; }

    /* Return the largest value of each unit in a run, the scale of rounding errors (results/reports/comparison.py). */
    motionScales(run) {
        const found = this.scales = {}, n = this.about.coordinates.length;
        [run.q, run.v].forEach((rows, order) => {
            const most = [0, 0], rate = order ? "/s" : "";
            rows.forEach((x, i) => {
                const turns = Number(i % n % 3 === 2);
                most[turns] = Math.max(most[turns], Math.abs(x) || 0);
            });
            found[`m${rate}`] = most[0];
            found[`rad${rate}`] = Math.max(most[1], most[0] / found.m || 0); // what does not turn: as if it went so far
        });
        return found;
    }

    /* Enlarge the scale of a unit to a range of values. */
    scale(unit, range) { this.scales[unit] = Math.max(this.scales[unit] ?? 0, ...range.map(Math.abs)); }

    /* Return the largest rounding error of values with this unit. */
    noise(unit) { return this.settings.noise * (this.scales?.[unit] ?? 0); }

    /* Return whether a value is only a rounding error. */
    isNone(x, unit) { return x !== 0 && Math.abs(x) < this.noise(unit); }

    /* Return the time of the last sample. */
    get end() { return this.run.t[this.run.t.length - 1]; }

    /* Show the sample nearest to a time. */
    seek(t) {
        const {run} = this, last = run.t.length - 1;
        this.t = Math.min(Math.max(t, run.t[0]), run.t[last]);
        let [low, high] = [0, last];
        while (high - low > 1) {
            const middle = (low + high) >> 1;
            if (run.t[middle] <= this.t) low = middle;
            else high = middle;
        }
        this.k = this.t - run.t[low] <= run.t[high] - this.t ? low : high;
        this.wake();
    }

    /* Start or stop the animation. */
    play(playing) {
        this.playing = playing;
        by("g-play").textContent = playing ? "Pause" : "Play";
        this.last = undefined;
        this.wake();
    }

    /* Request a frame. */
    wake() {
        this.dirty = true;
        this.frame ??= requestAnimationFrame((now) => this.draw(now));
    }

    /* Draw a frame: continue the work, advance the time, update what is shown. */
    draw(now) {
        this.frame = null;
        if (this.way) this.goOn();
        this.onTheWay();
        if (this.playing && this.run) this.advance(now);
        if (this.dirty && this.run) this.show();
        this.dirty = false;
        if (this.way || this.playing) this.frame ??= requestAnimationFrame((later) => this.draw(later));
    }

    /* Advance the time of the animation; at the end of the run it begins again. */
    advance(now) {
        const passed = this.last === undefined ? 0 : (now - this.last) / 1000;
        const {run} = this, t = this.t + passed * by("g-speed").value * this.span / this.settings.seconds;
        this.last = now;
        this.seek(t > run.t[run.t.length - 1] ? run.t[0] : t);
    }

    /* Show everything at the present sample. */
    show() {
        const {run, k, sim} = this, n = this.about.coordinates.length, t = run.t[k], {p} = run;
        const [q, v] = [run.q, run.v].map((rows) => rows.subarray(k * n, (k + 1) * n));
        this.reads = !this.playing || performance.now() - (this.read ?? 0) > READ;
        if (this.reads) this.read = performance.now();
        this.drawing.show(q, p, (name) => this.load(name, k), by("g-forces").checked ? this.forces(k) : []);
        for (const part of [...this.charts, ...this.orbits]) if (part.run === run) part.cursor(k);
        if (this.reads) for (const {name, cell, unit} of this.values) this.tell(name, cell, unit, k);
        const share = (t - run.t[0]) / (this.span || 1);
        if (document.activeElement !== by("g-when") || this.playing) by("g-when").value = 1000 * share;
        by("g-t").textContent = `t = ${t.toFixed(4)} s`;
        by("g-when").setAttribute("aria-valuetext", `${t.toFixed(4)} seconds`);
        const isNone = (x, unit) => this.isNone(x, unit);
        const detail = window.gudgeonState = {sim, run, k, t, q, v, p, isNone};
        document.dispatchEvent(new CustomEvent("gudgeon:state", {detail}));
    }

    /* Show the value of a series in its row. */
    tell(name, cell, unit, k) {
        const x = this.seriesOf(name)[k] ?? NaN, of = this.run.unit(name), none = this.isNone(x, of);
        const [factor, text] = readable(Math.abs(x), of);
        cell.textContent = none ? "≈ 0" : told(x * factor, 4);
        unit.textContent = none ? "" : text;
    }

    /* Return the force of an element at sample k, for its arrow. */
    load(name, k) { return ["Fx", "Fy"].map((axis) => this.seriesOf(`${name}.${axis}`)[k] ?? 0); }

    /* Return the arrows of the joints' forces at sample k; the largest force of the moment has the longest arrow. */
    forces(k) {
        const found = this.settings.joints.map(([name, point]) => [point, ...this.load(name, k)]);
        const largest = Math.max(0, ...found.map(([, x, y]) => Math.hypot(x, y)).filter(Number.isFinite));
        const none = !(largest > this.noise("N")), most = quantity(this.scales.N ?? 0, "N", 3);
        const longest = none ? "no force at a joint now" : `longest arrow: ${quantity(largest, "N", 3)}`;
        if (this.reads) by("g-scale").textContent = `${longest}; largest of this run: ${most}`;
        return none ? [] : found.map((one) => [...one, LONGEST * this.drawing.unit / largest]);
    }
}

/* One recorded run at the file's values, for pages without simulator: float32, by columns. */
class Recorded {
    constructor({rows, p, series, bits}, about) {
        const all = Float64Array.from(new Float32Array(bits)), n = about.coordinates.length;
        const column = (k) => all.subarray(k * rows, (k + 1) * rows), rowed = (first) => {
            const found = new Float64Array(rows * n);
            for (let k = 0; k < n; k++) column(first + k).forEach((x, i) => { found[i * n + k] = x; });
            return found;
        };
        Object.assign(this, {t: column(0), q: rowed(1), v: rowed(1 + n), p: Float64Array.from(p), impacts: [], events: []});
        this.units = series;
        this.names = Object.keys(series);
        this.found = new Map(this.names.map((name, k) => [name, column(1 + 2 * n + k)]));
    }

    unit(name) { return name === "t" ? "s" : this.units[name] ?? ""; }

    series(name) { return name === "t" ? this.t : this.found.get(name) ?? this.t.map(() => NaN); }
}

/* Return JSON that a hidden element of the page contains, packed by gzip. */
async function carried(id) { return JSON.parse(new TextDecoder().decode(await gudgeon.unpacked(by(id).textContent))); }

/* Return the simulator of the page; "-full": that of the full formulation. */
async function loaded(which = "") {
    return gudgeon.load(await carried(`gudgeon-description${which}`), by(`gudgeon-module${which}`).textContent);
}

/* Start the page with its simulator, or with its recorded run. */
async function start() {
    const sim = by("gudgeon-module") ? await loaded() : null, panel = await carried("gudgeon-panel");
    by("gudgeon-app").hidden = false;
    const about = sim?.about ?? await carried("gudgeon-description"), app = new App(about, panel, sim);
    window.gudgeonApp = app;
    if (sim) app.begin();
    else app.take(new Recorded({...panel.recorded, bits: await gudgeon.unpacked(panel.recorded.bits)}, about));
    performance.mark("gudgeon:ready");
}

start().catch((error) => {
    by("g-error").textContent = `this browser does not run it: ${error.message}`;
    by("g-error").hidden = false;
});
