/* How the page begins: with the simulator that it carries, or with the one run that it has instead. */

/* One run of the file's numbers, as pages without a simulator have it: float32, by columns. */
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

/* What the page carries as JSON packed by gzip. */
async function carried(id) { return JSON.parse(new TextDecoder().decode(await gudgeon.unpacked(by(id).textContent))); }

/* The simulator of the page; "-full": of the other formulation. */
async function loaded(which = "") {
    return gudgeon.load(await carried(`gudgeon-description${which}`), by(`gudgeon-module${which}`).textContent);
}

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
