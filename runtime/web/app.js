/*
 * Run the page: advance the time, rerun the scene when parameters change, and update all that is shown.
 *
 * At each shown sample the document receives the event `gudgeon:state` with {sim, run, k, t, q, v, p};
 * `window.gudgeonState` is the last one.
 */
const FRAME_BUDGET_MS = 4; // of a frame in which work continues
const MIN_RUN_MS = 200; // age below which a run is completed although parameters change
const PAINT = "paint"; // yielded after work that the browser has to paint: at most one in a frame
const MAX_REPORTED = 8; // number of refused parameters of a link that are reported
const PROGRESS_DELAY_MS = 500; // age of a run before its progress and a button to stop it are shown
const RUN_LIMIT_S = 120; // age at which a run is stopped
const CONTINUED_NOTE = "The start is the assembly followed from the file’s: near its guess Python may find another.";
const NUMBERS_INTERVAL_MS = 100; // between two updates of numbers

/* Return a count with its noun as text: "1 step", "1,000 steps". */
function formatCount(count, plural) {
    return `${count.toLocaleString("en")} ${count === 1 ? plural.replace(/s$/, "") : plural}`;
}

/* Return the element of the page with an id. */
const getElement = (id) => document.getElementById(id);

/*
 * State of the page: simulator, current run, drawing, charts, panel.
 *
 * run: the shown Run; referenceRun: that with the file's values. activeRun: the generator of a run in progress, or
 * null; fraction: how much of it is done. k, t: index and time (s) of the shown sample. scales: largest values by unit.
 */
class App {
    constructor(description, settings, sim) {
        Object.assign(this, {settings, k: 0, t: 0, isPlaying: false, charts: [], activeRun: null, needsUpdate: false,
            limit_s: RUN_LIMIT_S});
        this.useSimulator(description, sim);
        this.values = settings.values.map((name) => this.addValueRow(name));
        this.connectControls();
        if (sim) this.createPanel();
        this.linkScenes();
        new ResizeObserver(() => this.resize()).observe(getElement("g-charts"));
    }

    /* Use a simulator (null: a recorded run), and draw its scene. */
    useSimulator(description, sim) {
        Object.assign(this, {description, sim});
        this.drawing = new Drawing(getElement("g-drawing"), this.settings, description);
        const journals = description.clearances.filter(([name]) => !name.includes("."));
        this.orbits = journals.map(([name, index]) => new Orbit(this, name, index));
        getElement("g-orbits").replaceChildren(...this.orbits.map(({box}) => box));
    }

    /* Change to the other formulation of the same scene, whose elements' ids end with a suffix. */
    async changeFormulation(suffix) {
        const sim = await loadSimulator(suffix);
        this.activeRun?.return();
        this.activeRun = null;
        this.useSimulator(sim.description, sim);
        this.startRun();
    }

    /* Create the panel of parameters. */
    createPanel() {
        const callbacks = {onChange: () => this.startRun(), showError: (text) => this.showError(text),
            onFormulation: (suffix) => this.changeFormulation(suffix)};
        this.panel = new Panel(getElement("g-parameters"), this.settings, this.description, callbacks);
    }

    /* Connect the controls of time, forces, names, path and traces. */
    connectControls() {
        const [play, time, names, forces, path] =
            ["g-play", "g-time", "g-show-names", "g-show-forces", "g-path"].map(getElement);
        play.onclick = () => this.setPlaying(!this.isPlaying);
        getElement("g-progress").querySelector("button").onclick = () => this.stopRun("stopped by hand");
        time.oninput = () => this.seek(this.run.t[0] + time.value / 1000 * this.duration);
        names.onchange = () => getElement("g-drawing").classList.toggle("g-hide-names", !names.checked);
        forces.onchange = () => {
            getElement("g-force-scale").hidden = !forces.checked;
            this.requestFrame();
        };
        path.onchange = () => this.drawTrace();
        const {points} = this.description;
        for (const name of ["", ...Object.keys(points).filter((point) => points[point][0] >= 0)])
            createElement("option", {value: name}, path).textContent = name || "none";
        path.value = this.settings.path;
        getElement("g-add-trace").onclick = () => {
            if (!this.run) return;
            this.addChart(this.run.names.find((name) => !this.charts.some((chart) => chart.name === name)));
        };
    }

    /* Link to the pages of other scenes; they begin with the parameters of this page. */
    linkScenes() {
        const {scenes} = this.settings, select = getElement("g-scene"), {scene} = this.description;
        for (const name of Object.keys(scenes)) createElement("option", {value: name}, select).textContent = name;
        select.value = scene;
        select.parentElement.hidden = Object.keys(scenes).length < 2;
        select.onchange = () => {
            const parameters = new URLSearchParams({...this.panel?.givenValues, t: this.t});
            const target = `${encodeURIComponent(scenes[select.value])}#${parameters}`;
            select.value = scene; // if the user returns to this page
            location.href = target;
        };
    }

    /* Apply parameters of the link that led here, after the first run; report those that this scene does not have. */
    applyLinkParameters() {
        const refused = new Set(), text = location.hash.includes("=") ? location.hash.slice(1) : ""; // or an anchor
        for (const [address, typedValue] of new URLSearchParams(text)) {
            const parameter = this.description.slots.find((slot) => slot.address === address);
            const unit = parameter?.unit ?? "s", words = parameter?.words;
            const value = parseNumber(typedValue, {factor: 1, unit}, this.panel.units[unit]); // without unit in SI
            const assignment = `${address} = ${typedValue || "nothing"}`.slice(0, 80);
            if (address === "t" && Number.isFinite(value)) {
                this.seek(value);
                const [first, last] = [this.run.t[0], this.endTime].map((t) => formatNumber(t));
                if (this.t !== value) refused.add(`${assignment} (the run has ${first} to ${last} s)`);
            } else if (!parameter && address !== "t") refused.add(`${assignment} (this scene has no such number)`);
            else if (words ? words.includes(typedValue) : Number.isFinite(value)) {
                this.panel.givenValues[address] = words ? typedValue : value;
                this.panel.changedSinceRun.add(address);
                this.isRestartPending = true; // `continueRun`, which called this, starts the run
            } else refused.add(`${assignment} (expected ${words?.join(" or ") ?? "a number"})`);
        }
        if (!refused.size) return;
        const first = [...refused].slice(0, MAX_REPORTED).join(", ");
        const more = refused.size > MAX_REPORTED ? " and more" : "";
        getElement("g-note").textContent = `Not taken from the link: ${first}${more}.`;
    }

    /* Draw the path of the chosen point. */
    drawTrace() {
        const name = getElement("g-path").value, isKnown = name && this.run?.names.includes(`${name}.x`);
        const [x, y] = isKnown ? [this.run.series(`${name}.x`), this.run.series(`${name}.y`)] : [[], []];
        this.drawing.drawTrace(x, y);
    }

    /* Add a row to the live values, and return its cells, {name, cell, unit}. */
    addValueRow(name) {
        const row = createElement("tr", {}, getElement("g-values"));
        createElement("th", {scope: "row"}, row).textContent = name;
        return {name, cell: createElement("td", {}, row), unit: createElement("td", {class: "g-unit"}, row)};
    }

    /* Return a Map of the names of series by owner: "A.Fx" belongs to A. */
    groupSeriesByOwner() {
        const groups = new Map();
        for (const name of this.run.names) {
            const owner = name.includes(".") ? name.slice(0, name.indexOf(".")) : "outputs";
            if (!groups.has(owner)) groups.set(owner, []);
            groups.get(owner).push(name);
        }
        return groups;
    }

    /* Add a chart of a series. */
    addChart(name) {
        const chart = new Chart(this, name);
        getElement("g-charts").append(chart.box);
        this.charts.push(chart);
        chart.draw();
    }

    /* Remove a chart. */
    removeChart(chart) {
        chart.box.remove();
        this.charts = this.charts.filter((other) => other !== chart);
    }

    /* Redraw after a change of the window's size. */
    resize() {
        this.drawing.resize();
        if (!this.run) return;
        for (const chart of this.charts) chart.draw();
        this.requestFrame();
    }

    /* Start a run with the present parameters. An active run that is young is completed first, others are stopped. */
    startRun() {
        const age = performance.now() - this.startedAt;
        this.isRestartPending = this.activeRun !== null && age < MIN_RUN_MS;
        if (this.isRestartPending) return;
        this.activeRun?.return();
        this.activeRun = null;
        this.startedAt = performance.now();
        let failure = null;
        try {
            this.sim.setParameters(this.panel.givenValues);
            this.activeRun = this.computeRun();
        } catch (error) {
            failure = error;
        }
        this.panel.show(this.sim);
        if (failure) this.showFailure(failure);
        this.showProgress();
        this.requestFrame();
    }

    /* Show the progress of a long run, and stop it after the limit. */
    showProgress() {
        const age = performance.now() - this.startedAt, isLong = this.activeRun !== null && age > PROGRESS_DELAY_MS;
        const box = getElement("g-progress"), limit = formatNumber(this.limit_s);
        if (isLong && age > 1000 * this.limit_s) return this.stopRun(`given up after ${limit} s`);
        if (isLong && box.hidden && !this.run) this.showStart(this.unfinishedRun);
        box.hidden = !isLong;
        if (!isLong) return;
        const percent = formatNumber(100 * (this.fraction ?? 0), 2), seconds = Math.floor(age / 1000);
        box.querySelector("progress").value = this.fraction ?? 0;
        box.querySelector("span").textContent = `running: ${percent} % after ${seconds} s; given up after ${limit} s`;
    }

    /* Draw the mechanism at the start of a run that has no result yet. */
    showStart(run) {
        if (!run?.start) return;
        const {q, v} = run.start;
        this.drawing.fitView({t: [0], q, v, p: run.p});
        this.drawing.show(q, run.p, () => [0, 0], []);
    }

    /* Stop the active run for a reason; its samples so far are shown. */
    stopRun(reason) {
        if (!this.activeRun) return;
        const percent = formatNumber(100 * (this.fraction ?? 0), 2);
        const error = Object.assign(new Error(`${reason} at ${percent} % of the run`), {stops: true});
        this.isRestartPending = false;
        this.continueRun(() => this.activeRun.throw(error));
        this.showProgress();
    }

    /* Compute a run and update the page in pieces; a generator that yields the fraction done or PAINT. */
    *computeRun() {
        this.fraction = 0;
        const options = {slice: 200, ...this.panel.options.read()};
        const run = yield* this.sim.running(options, (unfinished) => { this.unfinishedRun = unfinished; });
        if (run.names.includes("Phi.max")) run.series("Phi.max"); // C evaluates all samples, before the next yield
        yield;
        yield* this.showInPieces(run);
        this.showError("");
        this.panel.changedSinceRun.clear();
    }

    /* Continue the active run for some milliseconds; `advance` is the first step, by default the next one. */
    continueRun(advance = () => this.activeRun.next()) {
        try {
            let next = advance();
            const until = performance.now() + FRAME_BUDGET_MS;
            while (!next.done && next.value !== PAINT && performance.now() < until) next = this.activeRun.next();
            if (typeof next.value === "number") this.fraction = next.value;
            if (!next.done) return;
            this.activeRun = null;
        } catch (error) {
            this.activeRun = null;
            if (error.partial?.q?.length) this.showRun(error.partial);
            this.showFailure(error);
        }
        if (this.isRestartPending) this.startRun();
    }

    /* Show the error of a run, its cause, and whether its samples up to there are shown. */
    showFailure(error) {
        const isPartialShown = error.partial?.q?.length, {message} = error;
        const shown = isPartialShown ? " What is shown is the run up to there."
            : this.run ? " What is shown is the run before." : "";
        const causes = error.stops ? "" : this.panel?.describeCauses(error, this.sim) ?? "";
        const parameters = JSON.stringify(this.panel?.givenValues);
        const call = `gudgeon.load(${this.settings.loaded}).simulate(parameters=${parameters})`;
        const python = error.isSearchedInPython ? ` Python searches on and runs from what it finds: ${call}.` : "";
        this.showError(`${message}${causes}.${python}${shown}`);
    }

    /* Show an error message; "" hides it. */
    showError(text) {
        getElement("g-error").textContent = text;
        getElement("g-error").hidden = !text;
    }

    /* Show a finished run at once. */
    showRun(run) { for (const _ of this.showInPieces(run)); }

    /* Show a finished run in pieces. The first run, at the file's values, is the reference of later ones in charts. */
    *showInPieces(run) {
        const isFirst = !this.run, t_last = run.t[run.t.length - 1];
        this.run = run;
        this.referenceRun ??= run;
        this.duration = t_last - run.t[0];
        this.drawing.fitView(run);
        this.showCounts(run);
        this.drawTrace();
        this.seek(Math.min(this.t, t_last));
        this.scales = this.computeScales(run);
        for (const name of [...this.settings.joints.map(([joint]) => `${joint}.F`), ...this.settings.values]) {
            if (run.names.includes(name)) this.enlargeScale(run.unit(name), findRange(run.series(name)));
            yield;
        }
        if (isFirst) this.settings.traces.forEach((name) => this.addChart(name));
        for (const part of [...isFirst ? [] : this.charts, ...this.orbits]) {
            part.draw();
            yield PAINT;
        }
        if (isFirst && this.panel) this.applyLinkParameters();
        this.requestFrame();
    }

    /* Show steps, impacts and times of a run. */
    showCounts(run) {
        const shown = Object.entries(run.counts ?? {}).filter(([name]) => ["steps", "right_hand_sides"].includes(name));
        const texts = shown.map(([name, count]) => formatCount(count, name.replaceAll("_", " ")));
        const origin = run.isStepEstimated ? " (estimated for the file’s numbers)" : "";
        if (run.step) texts.unshift(`steps of ${formatQuantity(run.step, "s", 4)}${origin}`);
        if (run.impacts.length) texts.push(formatCount(run.impacts.length, "impacts"));
        const ms = this.startedAt === undefined ? "" : `, ${(performance.now() - this.startedAt).toFixed(0)} ms`;
        const length = this.duration ? `${formatNumber(this.duration)} s simulated` : "the run ends where it begins";
        const note = run.isContinued ? `. ${CONTINUED_NOTE}` : "";
        getElement("g-counts").textContent = `${length}: ${texts.join(", ")}${ms}${note}`;
        getElement("g-time").disabled = !this.duration;
    }

    /* Return a series of the run (N), or an empty list. */
    getSeries(name) { return this.run.names.includes(name) ? this.run.series(name) : []; }

    /* Return the largest coordinate and velocity of a run by unit, the scale of rounding errors (comparison.py). */
    computeScales(run) {
        const scales = this.scales = {}, n = this.description.coordinates.length;
        [run.q, run.v].forEach((rows, order) => {
            const largest = [0, 0], rate = order ? "/s" : ""; // of lengths, of angles
            rows.forEach((x, i) => {
                const isAngle = Number(i % n % 3 === 2);
                largest[isAngle] = Math.max(largest[isAngle], Math.abs(x) || 0);
            });
            scales[`m${rate}`] = largest[0];
            // at least 1 rad, or the largest velocity over the largest length
            scales[`rad${rate}`] = Math.max(largest[1], largest[0] / scales.m || 0);
        });
        return scales;
    }

    /* Enlarge the scale of a unit to a range of values. */
    enlargeScale(unit, range) { this.scales[unit] = Math.max(this.scales[unit] ?? 0, ...range.map(Math.abs)); }

    /* Return the largest rounding error of values with this unit. */
    getRoundingError(unit) { return this.settings.noise * (this.scales?.[unit] ?? 0); }

    /* Return whether a value is only a rounding error. */
    isRoundingError(x, unit) { return x !== 0 && Math.abs(x) < this.getRoundingError(unit); }

    /* Return the time of the last sample, s. */
    get endTime() { return this.run.t[this.run.t.length - 1]; }

    /* Show the sample nearest to a time (s). */
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
        this.requestFrame();
    }

    /* Start or stop the animation. */
    setPlaying(isPlaying) {
        this.isPlaying = isPlaying;
        getElement("g-play").textContent = isPlaying ? "Pause" : "Play";
        this.previousFrameTime = undefined;
        this.requestFrame();
    }

    /* Request a frame, which updates what is shown. */
    requestFrame() {
        this.needsUpdate = true;
        this.frameRequest ??= requestAnimationFrame((now) => this.drawFrame(now));
    }

    /* Draw a frame: continue the work, advance the time, update what is shown; now: ms. */
    drawFrame(now) {
        this.frameRequest = null;
        if (this.activeRun) this.continueRun();
        this.showProgress();
        if (this.isPlaying && this.run) this.advanceTime(now);
        if (this.needsUpdate && this.run) this.showSample();
        this.needsUpdate = false;
        if (this.activeRun || this.isPlaying)
            this.frameRequest ??= requestAnimationFrame((later) => this.drawFrame(later));
    }

    /* Advance the time of the animation; at the end of the run it begins again. */
    advanceTime(now) {
        const elapsed = this.previousFrameTime === undefined ? 0 : (now - this.previousFrameTime) / 1000;
        const speed = getElement("g-speed").value * this.duration / this.settings.seconds, t = this.t + elapsed * speed;
        this.previousFrameTime = now;
        this.seek(t > this.endTime ? this.run.t[0] : t);
    }

    /* Show everything at the present sample. */
    showSample() {
        const {run, k, sim} = this, n = this.description.coordinates.length, t = run.t[k], {p} = run;
        const [q, v] = [run.q, run.v].map((rows) => rows.subarray(k * n, (k + 1) * n)), slider = getElement("g-time");
        const now = performance.now();
        this.showsNumbers = !this.isPlaying || now - (this.numbersShownAt ?? 0) > NUMBERS_INTERVAL_MS;
        if (this.showsNumbers) this.numbersShownAt = now;
        const arrows = getElement("g-show-forces").checked ? this.listForceArrows(k) : [];
        this.drawing.show(q, p, (name) => this.getForce(name, k), arrows);
        for (const part of [...this.charts, ...this.orbits]) if (part.run === run) part.markSample(k);
        if (this.showsNumbers) for (const row of this.values) this.showValue(row, k);
        const fraction = (t - run.t[0]) / (this.duration || 1);
        if (document.activeElement !== slider || this.isPlaying) slider.value = 1000 * fraction;
        getElement("g-time-text").textContent = `t = ${t.toFixed(4)} s`;
        slider.setAttribute("aria-valuetext", `${t.toFixed(4)} seconds`);
        const isRoundingError = (x, unit) => this.isRoundingError(x, unit);
        const detail = window.gudgeonState = {sim, run, k, t, q, v, p, isRoundingError};
        document.dispatchEvent(new CustomEvent("gudgeon:state", {detail}));
    }

    /* Show the value of a series at sample k in its row. */
    showValue({name, cell, unit}, k) {
        const x = this.getSeries(name)[k] ?? NaN, seriesUnit = this.run.unit(name);
        const [factor, shownUnit] = choosePlotUnit(Math.abs(x), seriesUnit);
        const isZero = this.isRoundingError(x, seriesUnit);
        cell.textContent = isZero ? "≈ 0" : formatNumber(x * factor, 4);
        unit.textContent = isZero ? "" : shownUnit;
    }

    /* Return the force of an element at sample k, [x, y] in N. */
    getForce(name, k) { return ["Fx", "Fy"].map((axis) => this.getSeries(`${name}.${axis}`)[k] ?? 0); }

    /*
     * Return the arrows of the joints' forces at sample k, [point, Fx, Fy, metres of arrow per newton].
     *
     * The largest force of the sample has the longest arrow.
     */
    listForceArrows(k) {
        const forces = this.settings.joints.map(([name, point]) => [point, ...this.getForce(name, k)]);
        const largest = Math.max(0, ...forces.map(([, x, y]) => Math.hypot(x, y)).filter(Number.isFinite));
        const hasForce = largest > this.getRoundingError("N"), peak = formatQuantity(this.scales.N ?? 0, "N", 3);
        const longest = hasForce ? `longest arrow: ${formatQuantity(largest, "N", 3)}` : "no force at a joint now";
        if (this.showsNumbers) getElement("g-force-scale").textContent = `${longest}; largest of this run: ${peak}`;
        const metresPerNewton = MAX_ARROW_LENGTH * this.drawing.unit / largest;
        return hasForce ? forces.map((force) => [...force, metresPerNewton]) : [];
    }
}

/*
 * Recorded run at the file's values, for pages without simulator; it has the fields and series of a Run.
 *
 * Its data (pack_run of panel.py) are float32, column by column: t, q, v, series; `rows` is the number of samples.
 */
class RecordedRun {
    constructor({rows, p, series, bits}, description) {
        const table = Float64Array.from(new Float32Array(bits)), n = description.coordinates.length;
        const getColumn = (k) => table.subarray(k * rows, (k + 1) * rows), joinColumns = (first) => {
            const joined = new Float64Array(rows * n);
            for (let k = 0; k < n; k++) getColumn(first + k).forEach((x, i) => { joined[i * n + k] = x; });
            return joined;
        };
        const [t, q, v] = [getColumn(0), joinColumns(1), joinColumns(1 + n)];
        Object.assign(this, {t, q, v, p: Float64Array.from(p), impacts: [], events: []});
        this.units = series;
        this.names = Object.keys(series);
        this.columns = new Map(this.names.map((name, k) => [name, getColumn(1 + 2 * n + k)]));
    }

    /* Return the SI unit of a series; "" for a pure number. */
    unit(name) { return name === "t" ? "s" : this.units[name] ?? ""; }

    /* Return a series (N) by name; NaN for one that is not recorded. */
    series(name) { return name === "t" ? this.t : this.columns.get(name) ?? this.t.map(() => NaN); }
}

/* Return the JSON that a hidden element of the page contains, packed by gzip, as a promise. */
async function readEmbeddedJson(id) {
    return JSON.parse(new TextDecoder().decode(await gudgeon.unpack(getElement(id).textContent)));
}

/* Return the simulator of the page, as a promise; suffix "-full": that of the full formulation. */
async function loadSimulator(suffix = "") {
    const description = await readEmbeddedJson(`gudgeon-description${suffix}`);
    return gudgeon.load(description, getElement(`gudgeon-module${suffix}`).textContent);
}

/* Start the page with its simulator, or with its recorded run. */
async function startPage() {
    const sim = getElement("gudgeon-module") ? await loadSimulator() : null;
    const settings = await readEmbeddedJson("gudgeon-panel");
    getElement("gudgeon-app").hidden = false;
    const description = sim?.description ?? await readEmbeddedJson("gudgeon-description");
    const app = new App(description, settings, sim);
    window.gudgeonApp = app;
    if (sim) app.startRun();
    else {
        const bits = await gudgeon.unpack(settings.recorded.bits);
        app.showRun(new RecordedRun({...settings.recorded, bits}, description));
    }
    performance.mark("gudgeon:ready");
}

startPage().catch((error) => {
    getElement("g-error").textContent = `this browser does not run it: ${error.message}`;
    getElement("g-error").hidden = false;
});
