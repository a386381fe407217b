/* Draw curves over time, and the path of a journal in its clearance, as SVG with readable units. */
const PREFIXES = {"-12": "p", "-9": "n", "-6": "µ", "-3": "m", 0: "", 3: "k", 6: "M", 9: "G"};
const SUPERSCRIPTS = {
    0: "⁰", 1: "¹", 2: "²", 3: "³", 4: "⁴", 5: "⁵", 6: "⁶", 7: "⁷", 8: "⁸", 9: "⁹", "-": "⁻", ".": "·",
};
const MARGINS = {left: 54, right: 12, top: 10, bottom: 24}; // of a chart, pixels
const CHART_HEIGHT = 150; // pixels

/* Return a unit as text for people: "kg*m^2" as "kg·m²". */
function formatUnit(unit) {
    return unit.replace(/\^(-?[\d.]+)/g, (_, power) => formatSuperscript(power)).replaceAll("*", "·");
}

/*
 * Return [factor, unit] in which numbers of a magnitude in SI are readable (runtime/language/plot_units.py).
 *
 * Angles are in degrees.
 */
function choosePlotUnit(magnitude, unit) {
    if (unit === "rad" || unit.startsWith("rad/")) return [180 / Math.PI, `°${formatUnit(unit.slice(3))}`];
    const isReadable = !(magnitude > 0) || !Number.isFinite(magnitude) || (magnitude >= 0.1 && magnitude < 3000);
    if (isReadable || !/^(m|N|J|W|Pa|s|Hz)(?![\w^])/.test(unit)) return [1, formatUnit(unit)];
    const power = Math.min(Math.max(3 * Math.floor((Math.log10(magnitude) + 1) / 3), -12), 9);
    // beyond all prefixes a number is written with a power of ten
    if (!(magnitude / 10 ** power < 1e21 && magnitude / 10 ** power >= 1e-6)) return [1, formatUnit(unit)];
    return [10 ** -power, PREFIXES[power] + formatUnit(unit)];
}

/* Return a number as text with a number of digits, without trailing zeros; "–" if it is not finite. */
function formatNumber(x, digits = 5) {
    if (!Number.isFinite(x)) return "–";
    const [mantissa, power] = String(Number(x.toPrecision(digits))).replace(/^-/, "−").split("e");
    return power === undefined ? mantissa : `${mantissa}·10${formatSuperscript(power.replace("+", ""))}`;
}

/* Return a number in SI as text with a readable unit. */
function formatQuantity(x, unit, digits) {
    const [factor, shownUnit] = choosePlotUnit(Math.abs(x), unit);
    return `${formatNumber(x * factor, digits)} ${shownUnit}`;
}

/* Return the text of a power as superscript. */
function formatSuperscript(power) { return [...power].map((c) => SUPERSCRIPTS[c]).join(""); }

/* Return about `count` round numbers between two limits. */
function computeTicks(low, high, count) {
    const spacing = (high - low) / count, power = 10 ** Math.floor(Math.log10(spacing));
    const step = [1, 2, 5, 10].map((x) => x * power).find((x) => x >= spacing * 0.999), ticks = [];
    for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; k++) ticks.push(k * step);
    return ticks;
}

/* Return [smallest, largest] finite number of several series; [0, 0] if there is none. */
function findRange(...series) {
    let [low, high] = [Infinity, -Infinity];
    for (const values of series)
        for (const x of values)
            if (Number.isFinite(x)) [low, high] = [Math.min(low, x), Math.max(high, x)];
    return low <= high ? [low, high] : [0, 0];
}

/* Return the SVG path data of a curve through points, interrupted where y is not finite; to_x, to_y: to pixels. */
function makePathData(xs, ys, to_x, to_y) {
    let [d, command] = ["", "M"];
    for (let i = 0; i < xs.length; i++) {
        if (!Number.isFinite(ys[i])) command = "M";
        else {
            d += `${command}${roundToTenth(to_x(xs[i]))} ${roundToTenth(to_y(ys[i]))}`;
            command = "L";
        }
    }
    return d;
}

/* Violations of constraints are shown by powers of ten, at least over these exponents: from rounding to a drift. */
const [MIN_EXPONENT, MAX_EXPONENT] = [-17, -9];

/* Chart of one series over time; the App is notified of a selected time and of its removal. */
class Chart {
    constructor(app, name) {
        Object.assign(this, {app, name});
        this.box = createElement("figure", {class: "g-chart"});
        const head = createElement("div", {class: "g-chart-head"}, this.box);
        const label = createElement("label", {class: "g-control"}, head);
        createElement("span", {class: "g-hidden"}, label).textContent = "series of this trace";
        this.select = createElement("select", {}, label);
        for (const [owner, names] of app.groupSeriesByOwner()) {
            const group = createElement("optgroup", {label: owner}, this.select);
            for (const one of names) createElement("option", {value: one}, group).textContent = one;
        }
        this.select.value = name;
        this.title = createElement("span", {class: "g-print"}, head);
        this.value = createElement("output", {class: "g-value"}, head);
        const attributes = {type: "button", class: "g-control g-small", title: "remove this trace"};
        const removeButton = createElement("button", attributes, head);
        removeButton.textContent = "×";
        removeButton.setAttribute("aria-label", `remove the trace of ${name}`);
        const plot = createElement("div", {class: "g-plot"}, this.box);
        this.root = createSvg("svg", {role: "img"}, plot);
        this.axes = createSvg("g", {class: "g-axes"}, this.root);
        this.referenceLine = createSvg("path", {class: "g-reference"}, this.root);
        this.line = createSvg("path", {class: "g-line"}, this.root);
        // what moves at each frame lies on top, so that no curve is painted again
        this.timeLine = createElement("div", {class: "g-time-line"}, plot);
        this.marker = createElement("div", {class: "g-marker"}, plot);
        this.select.onchange = () => { this.name = this.select.value; this.draw(); };
        removeButton.onclick = () => app.removeChart(this);
        this.root.onpointerdown = this.root.onpointermove = (event) => event.buttons && this.seek(event);
    }

    /* Show the time at the pointer. */
    seek(event) {
        const {left} = this.root.getBoundingClientRect(), [start, end] = this.timeRange;
        this.app.seek(start + (event.clientX - left - MARGINS.left) / this.plotWidth * (end - start));
    }

    /* Draw the series of the present run over that of the file's run. */
    draw() {
        const {run, referenceRun} = this.app, {name} = this, width = Math.max(this.box.clientWidth, 200);
        this.run = run;
        this.isLogarithmic = name.startsWith("Phi");
        const isKnown = run.names.includes(name), unit = isKnown ? run.unit(name) : "";
        const y = this.computeValues(run), reference = referenceRun === run ? [] : this.computeValues(referenceRun);
        const rounding = this.isLogarithmic || !isKnown ? 0 : this.app.getRoundingError(unit);
        let [min, max] = findRange(y, reference, this.isLogarithmic ? [MIN_EXPONENT, MAX_EXPONENT] : []);
        if (Math.max(-min, max) < rounding) [min, max] = [-rounding, rounding];
        const magnitude = Math.max(Math.abs(min), Math.abs(max));
        const [factor, shownUnit] = this.isLogarithmic ? [1, ""] : choosePlotUnit(magnitude, unit);
        const range = max - min, isConstant = !(range > 1e-9 * magnitude);
        const margin = isConstant ? (this.isLogarithmic ? 1 : 0.5 * magnitude || 1) : 0.06 * range;
        const low = min - margin, high = max + margin;
        this.plotWidth = width - MARGINS.left - MARGINS.right;
        const lastReference = referenceRun ? referenceRun.t[referenceRun.t.length - 1] : 0;
        this.timeRange = [run.t[0], Math.max(run.t[run.t.length - 1], lastReference)];
        const [start, end] = this.timeRange;
        const to_x = (t) => MARGINS.left + this.plotWidth * (t - start) / (end - start || 1);
        const plotHeight = CHART_HEIGHT - MARGINS.top - MARGINS.bottom;
        const to_y = (x) => MARGINS.top + plotHeight * (high - x) / (high - low);
        Object.assign(this, {y, to_x, to_y, factor, unit: shownUnit});
        this.root.setAttribute("viewBox", `0 0 ${width} ${CHART_HEIGHT}`);
        this.root.setAttribute("height", CHART_HEIGHT);
        this.root.setAttribute("aria-label", `${name} over time`);
        this.title.textContent = name;
        this.drawAxes(low * factor, high * factor, width, (x) => to_y(x / factor));
        this.line.setAttribute("d", makePathData(run.t, y, to_x, to_y));
        const d = reference.length ? makePathData(referenceRun.t, reference, to_x, to_y) : "";
        this.referenceLine.setAttribute("d", d);
        this.markSample(this.app.k);
    }

    /* Return the drawn values (N) of a run: the series, or the exponents of a constraint violation. */
    computeValues(run) {
        const y = run.names.includes(this.name) ? run.series(this.name) : run.t.map(() => NaN);
        return this.isLogarithmic ? y.map((x) => Math.max(Math.log10(x), MIN_EXPONENT)) : y;
    }

    /* Draw the axes with limits `low`, `high` in the shown unit; width: of the chart in pixels. */
    drawAxes(low, high, width, to_y) {
        const {axes} = this, bottom = CHART_HEIGHT - MARGINS.bottom, [start, end] = this.timeRange;
        axes.replaceChildren();
        const [timeFactor, unit] = choosePlotUnit(end, "s");
        const levels = computeTicks(low, high, 4).filter((x) => !this.isLogarithmic || Number.isInteger(x));
        for (const x of levels) {
            createSvg("path", {d: `M${MARGINS.left} ${roundToTenth(to_y(x))}H${width - MARGINS.right}`}, axes);
            const attributes = {x: MARGINS.left - 6, y: roundToTenth(to_y(x)) + 4, "text-anchor": "end"};
            createSvg("text", attributes, axes).textContent =
                this.isLogarithmic ? `10${formatSuperscript(String(x))}` : formatNumber(x);
        }
        const times = computeTicks(start * timeFactor, end * timeFactor, width < 380 ? 4 : 6);
        times.forEach((t, k) => {
            const x = roundToTenth(this.to_x(t / timeFactor)), isLast = k === times.length - 1;
            const text = createSvg("text", {x, y: bottom + 16, "text-anchor": "middle"}, axes);
            text.textContent = isLast ? `${formatNumber(t)} ${unit}` : formatNumber(t);
            if (isLast && this.to_x(t / timeFactor) > width - 30) text.setAttribute("text-anchor", "end");
            createSvg("path", {d: `M${x} ${bottom}v-4`}, axes);
        });
    }

    /* Mark sample k, and show its value. */
    markSample(k) {
        const {y, to_x, to_y, app} = this, x = roundToTenth(to_x(app.run.t[k]));
        this.timeLine.style.transform = `translate(${x}px, ${MARGINS.top}px)`;
        const top = Number.isFinite(y[k]) ? roundToTenth(to_y(y[k])) : -99;
        this.marker.style.transform = `translate(${x}px, ${top}px)`;
        const text = this.isLogarithmic ? formatNumber(this.run.series(this.name)[k], 3)
            : app.isRoundingError(y[k], this.run.unit(this.name)) ? "≈ 0"
                : `${formatNumber(y[k] * this.factor, 4)} ${this.unit}`;
        if (app.showsNumbers) this.value.textContent = text;
    }
}

/* Path of a journal's centre in its clearance circle; clearanceIndex: of the clearance c in p. */
class Orbit {
    constructor(app, name, clearanceIndex) {
        Object.assign(this, {app, name, clearanceIndex});
        this.box = createElement("figure", {class: "g-orbit", "data-of": `joint-${name}`});
        const plot = createElement("div", {class: "g-plot"}, this.box), view = {viewBox: "-92 -92 184 184"};
        const label = `path of the journal of ${name} in its clearance`;
        this.root = createSvg("svg", {role: "img", "aria-label": label, ...view}, plot);
        this.circle = createSvg("circle", {class: "g-clearance"}, this.root);
        createSvg("path", {class: "g-centre", d: "M-6 0H6M0 -6V6"}, this.root);
        this.line = createSvg("path", {class: "g-line"}, this.root);
        const overlay = createSvg("svg", {class: "g-overlay", "aria-hidden": "true", ...view}, plot);
        this.eccentricity = createSvg("path", {class: "g-eccentricity"}, overlay);
        this.journal = createSvg("circle", {class: "g-journal", r: 4}, overlay);
        this.caption = createElement("figcaption", {}, this.box);
    }

    /* Draw the path of the present run. */
    draw() {
        const {run} = this.app, {name} = this, c = run.p[this.clearanceIndex];
        this.run = run;
        [this.x, this.y] = [run.series(`${name}.ex`), run.series(`${name}.ey`)];
        this.scale = 80 / Math.max(c, ...findRange(this.x, this.y).map(Math.abs));
        this.c = c;
        this.circle.setAttribute("r", roundToTenth(c * this.scale));
        const d = makePathData(this.x, this.y, (x) => x * this.scale, (y) => -y * this.scale);
        this.line.setAttribute("d", d);
    }

    /* Mark sample k, and show clearance and eccentricity ratio. */
    markSample(k) {
        const [e_x, e_y] = [this.x[k], this.y[k]], [factor, unit] = choosePlotUnit(this.c, "m");
        const [x, y] = [roundToTenth(e_x * this.scale), roundToTenth(-e_y * this.scale)];
        this.journal.setAttribute("cx", x);
        this.journal.setAttribute("cy", y);
        this.eccentricity.setAttribute("d", `M0 0L${x} ${y}`);
        if (!this.app.showsNumbers) return;
        const ratio = (Math.hypot(e_x, e_y) / this.c).toFixed(3);
        this.caption.textContent = `${this.name}: c = ${formatNumber(this.c * factor, 4)} ${unit}, e/c = ${ratio}`;
    }
}
