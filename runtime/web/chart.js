/* Draw curves over time, and the path of a journal in its clearance, as SVG with readable units. */
const PREFIXES = {"-12": "p", "-9": "n", "-6": "µ", "-3": "m", 0: "", 3: "k", 6: "M", 9: "G"};
const RAISED = {0: "⁰", 1: "¹", 2: "²", 3: "³", 4: "⁴", 5: "⁵", 6: "⁶", 7: "⁷", 8: "⁸", 9: "⁹", "-": "⁻", ".": "·"};
const PAD = {left: 54, right: 12, top: 10, bottom: 24}; // of a chart, pixels
const HIGH = 150;

/* Return a unit for people: "kg*m^2" as "kg·m²". */
function pretty(unit) {
    return unit.replace(/\^(-?[\d.]+)/g, (_, power) => raised(power)).replaceAll("*", "·");
}

/* Return [factor, unit] in which numbers of a size are readable (runtime/language/plot_units.py); angles in degrees. */
function readable(size, unit) {
    if (unit === "rad" || unit.startsWith("rad/")) return [180 / Math.PI, `°${pretty(unit.slice(3))}`];
    const plain = !(size > 0) || !Number.isFinite(size) || (size >= 0.1 && size < 3000);
    if (plain || !/^(m|N|J|W|Pa|s|Hz)(?![\w^])/.test(unit)) return [1, pretty(unit)];
    const power = Math.min(Math.max(3 * Math.floor((Math.log10(size) + 1) / 3), -12), 9);
    if (!(size / 10 ** power < 1e21 && size / 10 ** power >= 1e-6)) return [1, pretty(unit)]; // told with a power of ten
    return [10 ** -power, PREFIXES[power] + pretty(unit)];
}

/* Return a number as text with a number of digits, without trailing zeros. */
function told(x, digits = 5) {
    if (!Number.isFinite(x)) return "–";
    const [digit, power] = String(Number(x.toPrecision(digits))).replace(/^-/, "−").split("e");
    if (power === undefined) return digit;
    return `${digit}·10${raised(power.replace("+", ""))}`;
}

/* Return a number with its unit as text. */
function quantity(x, unit, digits) {
    const [factor, short_] = readable(Math.abs(x), unit);
    return `${told(x * factor, digits)} ${short_}`;
}

/* Return a power in superscript. */
function raised(power) { return [...power].map((c) => RAISED[c]).join(""); }

/* Return about `count` round numbers between two limits. */
function ticks(low, high, count) {
    const raw = (high - low) / count, power = 10 ** Math.floor(Math.log10(raw));
    const step = [1, 2, 5, 10].map((x) => x * power).find((x) => x >= raw * 0.999), found = [];
    for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; k++) found.push(k * step);
    return found;
}

/* Return the smallest and the largest finite number of several series. */
function extent(...all) {
    let [low, high] = [Infinity, -Infinity];
    for (const values of all)
        for (const x of values)
            if (Number.isFinite(x)) [low, high] = [Math.min(low, x), Math.max(high, x)];
    return low <= high ? [low, high] : [0, 0];
}

/* Return the SVG path through points, interrupted where there is no finite number. */
function curve(xs, ys, to_x, to_y) {
    let [text, pen] = ["", "M"];
    for (let i = 0; i < xs.length; i++) {
        if (!Number.isFinite(ys[i])) pen = "M";
        else {
            text += `${pen}${short(to_x(xs[i]))} ${short(to_y(ys[i]))}`;
            pen = "L";
        }
    }
    return text;
}

/* Violations of the constraints are shown by powers of ten, from rounding to a drift: at least these. */
const [LEAST, MOST] = [-17, -9];

/* Chart of one series over time; `page` is the App, which learns of a selected time or a removed chart. */
class Chart {
    constructor(page, name) {
        Object.assign(this, {page, name});
        this.box = element("figure", {class: "g-chart"});
        const head = element("div", {class: "g-chart-head"}, this.box);
        const label = element("label", {class: "g-control"}, head);
        element("span", {class: "g-hidden"}, label).textContent = "series of this trace";
        this.select = element("select", {}, label);
        for (const [owner, own] of page.owners()) {
            const group = element("optgroup", {label: owner}, this.select);
            for (const one of own) element("option", {value: one}, group).textContent = one;
        }
        this.select.value = name;
        this.title = element("span", {class: "g-print"}, head);
        this.value = element("output", {class: "g-value"}, head);
        const away = element("button", {type: "button", class: "g-control g-small", title: "remove this trace"}, head);
        away.textContent = "×";
        away.setAttribute("aria-label", `remove the trace of ${name}`);
        const plot = element("div", {class: "g-plot"}, this.box);
        this.root = svg("svg", {role: "img"}, plot);
        this.parts = Object.fromEntries(["axes", "before", "line"].map((one) =>
            [one, svg(one === "axes" ? "g" : "path", {class: `g-${one}`}, this.root)]));
        // what moves at each frame lies on top, so that no curve is painted again
        [this.now, this.dot] = ["g-now", "g-spot"].map((one) => element("div", {class: one}, plot));
        this.select.onchange = () => { this.name = this.select.value; this.draw(); };
        away.onclick = () => page.removeChart(this);
        this.root.onpointerdown = this.root.onpointermove = (event) => event.buttons && this.seek(event);
    }

    /* Show the time at the pointer. */
    seek(event) {
        const {left} = this.root.getBoundingClientRect(), [from, to] = this.range;
        this.page.seek(from + (event.clientX - left - PAD.left) / this.wide * (to - from));
    }

    /* Draw the series of the present run, and of the file's run behind it. */
    draw() {
        const {run, before} = this.page, {name} = this, full = Math.max(this.box.clientWidth, 200);
        this.run = run;
        this.powers = name.startsWith("Phi");
        const known = run.names.includes(name), [y, other] = [this.scaled(run), before === run ? [] : this.scaled(before)];
        const noise = this.powers || !known ? 0 : this.page.noise(run.unit(name));
        let [least, most] = extent(y, other, this.powers ? [LEAST, MOST] : []);
        if (Math.max(-least, most) < noise) [least, most] = [-noise, noise];
        const size = Math.max(Math.abs(least), Math.abs(most));
        const [factor, unit] = this.powers ? [1, ""] : readable(size, known ? run.unit(name) : "");
        const spread = most - least, flat = !(spread > 1e-9 * size);
        const margin = flat ? (this.powers ? 1 : 0.5 * size || 1) : 0.06 * spread, low = least - margin, high = most + margin;
        this.wide = full - PAD.left - PAD.right;
        this.range = [run.t[0], Math.max(run.t[run.t.length - 1], before ? before.t[before.t.length - 1] : 0)];
        const [from, to] = this.range, to_x = (t) => PAD.left + this.wide * (t - from) / (to - from || 1);
        const tall = HIGH - PAD.top - PAD.bottom, to_y = (x) => PAD.top + tall * (high - x) / (high - low);
        Object.assign(this, {y, to_x, to_y, factor, unit});
        this.root.setAttribute("viewBox", `0 0 ${full} ${HIGH}`);
        this.root.setAttribute("height", HIGH);
        this.root.setAttribute("aria-label", `${name} over time`);
        this.title.textContent = name;
        this.axes(low * factor, high * factor, full, (x) => to_y(x / factor));
        this.parts.line.setAttribute("d", curve(run.t, y, to_x, to_y));
        this.parts.before.setAttribute("d", other.length ? curve(before.t, other, to_x, to_y) : "");
        this.cursor(this.page.k);
    }

    /* Return the drawn values of a run: the series, or the exponents of a constraint violation. */
    scaled(run) {
        const y = run.names.includes(this.name) ? run.series(this.name) : run.t.map(() => NaN);
        return this.powers ? y.map((x) => Math.max(Math.log10(x), LEAST)) : y;
    }

    /* Draw the axes. */
    axes(low, high, full, to_y) {
        const {axes} = this.parts, bottom = HIGH - PAD.bottom, [from, to] = this.range;
        axes.replaceChildren();
        const [seconds, unit] = readable(to, "s");
        const marks = ticks(low, high, 4).filter((x) => !this.powers || Number.isInteger(x));
        for (const x of marks) {
            svg("path", {d: `M${PAD.left} ${short(to_y(x))}H${full - PAD.right}`}, axes);
            svg("text", {x: PAD.left - 6, y: short(to_y(x)) + 4, "text-anchor": "end"}, axes).textContent =
                this.powers ? `10${raised(String(x))}` : told(x);
        }
        const times = ticks(from * seconds, to * seconds, full < 380 ? 4 : 6);
        times.forEach((t, k) => {
            const text = svg("text", {x: short(this.to_x(t / seconds)), y: bottom + 16, "text-anchor": "middle"}, axes);
            text.textContent = k === times.length - 1 ? `${told(t)} ${unit}` : told(t);
            if (k === times.length - 1 && this.to_x(t / seconds) > full - 30) text.setAttribute("text-anchor", "end");
            svg("path", {d: `M${short(this.to_x(t / seconds))} ${bottom}v-4`}, axes);
        });
    }

    /* Mark sample k, and show its value. */
    cursor(k) {
        const {y, to_x, to_y} = this, x = short(to_x(this.page.run.t[k]));
        this.now.style.transform = `translate(${x}px, ${PAD.top}px)`;
        this.dot.style.transform = `translate(${x}px, ${Number.isFinite(y[k]) ? short(to_y(y[k])) : -99}px)`;
        const value = this.powers ? told(this.run.series(this.name)[k], 3) :
            this.page.isNone(y[k], this.run.unit(this.name)) ? "≈ 0" : `${told(y[k] * this.factor, 4)} ${this.unit}`;
        if (this.page.reads) this.value.textContent = value;
    }
}

/* Path of a journal's centre in its clearance circle. */
class Orbit {
    constructor(page, name, place) {
        Object.assign(this, {page, name, place});
        this.box = element("figure", {class: "g-orbit", "data-of": `joint-${name}`});
        const plot = element("div", {class: "g-plot"}, this.box), view = {viewBox: "-92 -92 184 184"};
        this.root = svg("svg", {role: "img", "aria-label": `path of the journal of ${name} in its clearance`, ...view}, plot);
        this.circle = svg("circle", {class: "g-clearance"}, this.root);
        svg("path", {class: "g-cross", d: "M-6 0H6M0 -6V6"}, this.root);
        this.line = svg("path", {class: "g-line"}, this.root);
        const above = svg("svg", {class: "g-above", "aria-hidden": "true", ...view}, plot);
        this.arm = svg("path", {class: "g-arm"}, above);
        this.dot = svg("circle", {class: "g-dot", r: 4}, above);
        this.caption = element("figcaption", {}, this.box);
    }

    /* Draw the path of the present run. */
    draw() {
        const {run} = this.page, {name} = this, c = run.p[this.place];
        this.run = run;
        [this.x, this.y] = [run.series(`${name}.ex`), run.series(`${name}.ey`)];
        const most = Math.max(c, ...extent(this.x, this.y).map(Math.abs));
        this.scale = 80 / most;
        this.c = c;
        this.circle.setAttribute("r", short(c * this.scale));
        this.line.setAttribute("d", curve(this.x, this.y, (x) => x * this.scale, (y) => -y * this.scale));
    }

    /* Mark sample k. */
    cursor(k) {
        const [x, y] = [this.x[k], this.y[k]], [factor, unit] = readable(this.c, "m");
        this.dot.setAttribute("cx", short(x * this.scale));
        this.dot.setAttribute("cy", short(-y * this.scale));
        this.arm.setAttribute("d", `M0 0L${short(x * this.scale)} ${short(-y * this.scale)}`);
        if (!this.page.reads) return;
        const share = (Math.hypot(x, y) / this.c).toFixed(3);
        this.caption.textContent = `${this.name}: c = ${told(this.c * factor, 4)} ${unit}, e/c = ${share}`;
    }
}
