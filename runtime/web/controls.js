/* Edit the parameters of the file and the options of a run, as fields for pointer and keyboard. */
const METHODS = {
    auto: "auto", driven: "rk4 (all rows of Φ kept: they drift)", kinematic: "kinematic (Φ = 0 by Newton)", rk4: "rk4 (Baumgarte, not projected)",
    dop853: "dop853 (projected onto Φ = 0)", rodas5p: "rodas5p (implicit, projected)",
};

const HOLDS = 0.4; // 2 alpha h up to which Baumgarte's terms do more good than harm

/* Create an HTML element. */
function element(name, attributes = {}, parent = null) {
    const made = document.createElement(name);
    for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
    parent?.append(made);
    return made;
}

/* Create a folding section of the panel. */
function section(title, open, parent) {
    const box = element("details", {class: "g-section"}, parent);
    box.open = open;
    box.ontoggle = () => {
        if (box.open && box.contains(document.activeElement)) box.scrollIntoView({block: "nearest"});
    };
    element("summary", {}, box).textContent = title;
    return box;
}

/* Return a unit as in UNITS of runtime/language/units.py. */
function asWritten(unit) {
    const signs = {"°": "deg", "·": "*", "²": "^2", "³": "^3", "µ": "u", "μ": "u", " ": ""};
    return unit.replace(/[°·²³µμ ]/g, (sign) => signs[sign]);
}

/*
 * Return the number that a user typed in SI: with decimal point or comma, in the field's unit or with its own; NaN if
 * invalid.
 *
 * With a decimal prefix it is the number nearest to the text.
 */
function typed(text, {factor, unit: own = ""}, units = {}) {
    const plain = text.trim().replace(",", ".").replace("−", "-");
    const [, number, unit] = /^([-+]?(?:\d+\.?\d*|\.\d+)(?:e[-+]?\d+)?)(.*)$/i.exec(plain) ?? [];
    if (number === undefined) return NaN;
    const behind = asWritten(unit), of = !behind || behind === asWritten(own) ? factor : units[behind] ?? NaN;
    const ten = Math.round(Math.log10(of));
    if (Number(`1e${ten}`) !== of) return Number(number) * of;
    const [digits, power = "0"] = number.toLowerCase().split("e");
    return Number(`${digits}e${Number(power) + ten}`);
}

/* Mark a field as invalid, and return the message. */
function refusal(field, name, text, units = {}) {
    field.setAttribute("aria-invalid", true);
    const names = Object.keys(units).join(", ");
    return `${name}: ${text} is no number${names && `; a unit may stand behind one: ${names}`}`;
}

/* Parameter with a slider over its range, and a field for any value. */
class NumberField {
    constructor(panel, told, slot, parent) {
        Object.assign(this, {panel, told, slot, units: panel.units[slot.unit]});
        const row = this.row = element("div", {class: "g-number"}, parent), id = `g-number-${told.k}`;
        const label = element("label", {for: id}, row);
        label.textContent = told.name;
        this.slider = element("input", {type: "range", id, min: 0, max: 1000, step: 1}, row);
        const name = `${slot.address} in ${told.unit || "one"}`;
        this.field = element("input", {type: "text", "aria-label": name, size: 8}, row);
        element("span", {class: "g-unit"}, row).textContent = told.unit;
        this.back = element("button", {type: "button", class: "g-small", title: "as in the file"}, row);
        this.back.textContent = "↺";
        this.back.setAttribute("aria-label", `${slot.address} as in the file`);
        this.slider.oninput = () => this.slide();
        this.field.onchange = () => this.take(typed(this.field.value, told, this.units), this.field.value);
        this.back.onclick = () => panel.forget(slot.address);
    }

    /* Set the parameter to the slider's position, rounded to four digits. */
    slide() {
        const {low, high, factor} = this.told, x = low + this.slider.value / 1000 * (high - low);
        const digits = String(Number((x / factor).toPrecision(4)));
        this.take(typed(digits, this.told), digits);
    }

    /* Set the parameter, or report an invalid text. */
    take(value, text) {
        if (Number.isFinite(value)) this.panel.set(this.slot.address, value);
        else this.panel.complain(refusal(this.field, this.slot.address, text, this.units));
    }

    /* Show the value of the run; a field with focus keeps its text. */
    show(p, given) {
        const {k, low, high, factor} = this.told, value = given ?? p[k];
        const mine = given !== undefined;
        this.row.classList.toggle("g-mine", mine);
        this.field.removeAttribute("aria-invalid");
        this.back.style.visibility = mine ? "" : "hidden";
        const place = Math.round(1000 * (value - low) / (high - low));
        if (document.activeElement !== this.slider) this.slider.value = place;
        this.slider.setAttribute("aria-valuetext", `${told(value / factor, 6)} ${this.told.unit}`);
        const exact = String(Number((value / factor).toPrecision(12))), rounded = Number((value / factor).toPrecision(6));
        this.field.value = exact.length > 9 ? String(rounded) : exact;
        this.field.title = exact;
    }
}

/* Parameter with a choice of words. */
class Choice {
    constructor(panel, told, slot, parent) {
        Object.assign(this, {slot, told});
        const row = this.row = element("div", {class: "g-number"}, parent), id = `g-number-${told.k}`;
        element("label", {for: id}, row).textContent = told.name;
        this.select = element("select", {id, class: "g-across"}, row);
        for (const word of slot.words) element("option", {value: word}, this.select).textContent = word;
        this.select.onchange = () => panel.set(slot.address, this.select.value);
    }

    /* Show the chosen word. */
    show(p, given) {
        this.row.classList.toggle("g-mine", given !== undefined);
        this.select.value = given ?? this.slot.words[p[this.told.k]];
    }
}

const MOST_BLAMED = 12; // largest number of parameters that are tried one by one

/* All parameters and options of a run; `changed` is called after each change, `complain` with messages. */
class Panel {
    constructor(form, {groups, units, drift, drifts}, about, {changed, complain, formulated}) {
        Object.assign(this, {about, changed, complain, formulated, units, drift, drifts, given: {},
            since: new Set(), gains: []});
        this.options = new Options(form, about, this);
        this.fields = groups.flatMap(({title, numbers}, k) => {
            const box = section(title, k === 0, form);
            if (numbers.every((one) => about.gains.includes(one.k))) this.gains.push(box);
            return numbers.map((one) => {
                const slot = about.slots[one.k];
                return new (slot.words ? Choice : NumberField)(this, one, slot, box);
            });
        });
        this.reset = element("button", {type: "button", class: "g-reset"}, element("div", {class: "g-foot"}, form));
        this.reset.textContent = "All as in the file";
        this.reset.onclick = () => {
            this.given = {};
            this.since.clear();
            this.changed();
        };
        form.onsubmit = (event) => event.preventDefault();
    }

    /* Set a parameter. */
    set(address, value) {
        this.given[address] = value;
        this.since.add(address);
        this.changed();
    }

    /* Reset a parameter to the file's value. */
    forget(address) {
        delete this.given[address];
        this.since.delete(address);
        this.changed();
    }

    /* Show the values of the simulator. */
    show(sim) {
        for (const field of this.fields) field.show(sim.p, this.given[field.slot.address]);
        this.options.show(sim);
        for (const box of this.gains) box.hidden = !this.options.heldByGains;
        this.reset.disabled = !Object.keys(this.given).length;
    }

    /* Return the parameters that cause an error which does not name them, as text; their fields are marked. */
    blamed(error, sim) {
        const words = error.message.split(/[\s,:;=]+/), named = (one) => words.includes(one);
        const found = Object.keys(this.given).some(named) ? [] : this.culprits(error, sim);
        const fields = this.fields.filter(({slot}) => found.includes(slot.address) || (slot.address in this.given
            && named(slot.address)));
        for (const {field} of fields) field?.setAttribute("aria-invalid", true);
        if (!found.length) return "";
        const told_ = fields.map(({told: {factor, unit}, slot: {address, words}}) => {
            const value = this.given[address];
            return `${address} = ${words ? value : `${told(value / factor, 6)} ${unit}`.trim()}`;
        });
        return `. ${error.partial ? "Moved since the last whole run" : "What makes it"}: ${told_.join(", ")}`;
    }

    /*
     * Return parameters without which the run starts; if no single one suffices, those that fail alone, otherwise all.
     *
     * After the start of a run: all changed ones.
     */
    culprits(error, sim) {
        const all = Object.keys(this.given), {given} = this, {p, projected, given: values, mask} = sim;
        if (error.partial) return [...this.since];
        const begins = (names) => {
            try {
                sim.setParameters(Object.fromEntries(names.map((name) => [name, given[name]])));
                sim.start();
                return true;
            } catch {
                return false;
            }
        };
        try {
            if (begins(all)) return [];
            if (all.length > MOST_BLAMED) return [...this.since];
            const needed = all.filter((name) => begins(all.filter((other) => other !== name)));
            if (needed.length) return needed;
            const alone = all.filter((name) => !begins([name]));
            return alone.length ? alone : all;
        } finally {
            Object.assign(sim, {p, projected, given: values, mask});
        }
    }
}

/* Method, tolerance, length and samples; empty fields stand for the scene's defaults. */
class Options {
    constructor(form, about, panel) {
        const box = section("Run", true, form);
        const driven = about.methods[0] === "kinematic";
        Object.assign(this, {about, seconds: panel.units.s, drifts: panel.drifts});
        this.method = this.row(box, "method", element("select", {class: "g-across"}));
        for (const name of driven ? about.methods : ["auto", ...about.methods])
            element("option", {value: name}, this.method).textContent = METHODS[driven && name === "rk4" ? "driven" : name] ?? name;
        if (by("gudgeon-module-full")) this.formulations(box, panel);
        if (panel.drift) this.drift(box, panel.drift);
        this.rtol = !driven ? this.field(box, "rtol", "") : null;
        this.step = about.methods.includes("rk4") ? this.field(box, "step", "s") : null;
        this.t_end = this.field(box, "t_end", "s");
        this.output = this.field(box, "output", "intervals");
        for (const one of [this.method, this.rtol, this.step, this.t_end, this.output])
            if (one) one.onchange = () => {
                this.fit();
                panel.changed();
            };
        this.held = element("p", {class: "g-quiet"}, box);
        this.fit();
    }

    /* Add the choice of the formulation: reduced, where tree joints do not drift, or full, where all joints drift. */
    formulations(box, panel) {
        const made = this.formulation = this.row(box, "formulation", element("select", {class: "g-across"}));
        for (const [name, told_] of [["", "reduced (a tree’s coordinates)"], ["-full", "full (all rows of Φ)"]])
            element("option", {value: name}, made).textContent = told_;
        made.onchange = () => panel.formulated(made.value);
    }

    /* Add a row with an element. */
    row(box, name, made, unit = "") {
        const row = element("div", {class: "g-number"}, box), id = `g-run-${name}`;
        element("label", {for: id}, row).textContent = name;
        made.id = id;
        row.append(made);
        element("span", {class: "g-unit"}, row).textContent = unit;
        return made;
    }

    /* Show why no constraint drifts here, with Python code in which they do. */
    drift(box, {note, code}) {
        element("p", {class: "g-quiet"}, box).textContent = note;
        const more = section("A drift in Python", false, box);
        element("pre", {}, more).textContent = code;
    }

    /* Add a text field. */
    field(box, name, unit) {
        return this.row(box, name, element("input", {type: "text", size: 8}), unit);
    }

    /* Return whether Baumgarte's terms act: on integrated constraints without projection. */
    get heldByGains() {
        return this.method.value === "rk4" && (this.drifts || this.formulation?.value === "-full");
    }

    /* Show the defaults in empty fields. */
    show(sim) {
        const given = typed(this.t_end.value, {factor: 1}, this.seconds);
        const usual = {rtol: sim.about.rtol, ...sim.usual(given > 0 ? given : undefined)};
        for (const name of ["rtol", "step", "t_end", "output"])
            if (this[name]) this[name].placeholder = told(usual[name], 4);
        this.hold(sim, usual.step);
        if (!this.step || !usual.estimated) return;
        this.step.placeholder += ", estimated";
        this.step.title = "estimated for the file’s numbers";
    }

    /* Show whether Baumgarte's terms hold Φ at this step or destabilize it (docs/error_control.md). */
    hold({p}, usual) {
        const {gains} = this.about, own = typed(this.step?.value ?? "", {factor: 1}, this.seconds), h = own > 0 ? own : usual;
        this.held.hidden = !this.heldByGains || !gains.length;
        if (this.held.hidden) return;
        const share = 2 * h * Math.max(...gains.map((k) => p[k])), good = told(0.1 / h, 1);
        const what = share > HOLDS ? `is too much: gains near 1/h push Φ away. Some ${good} 1/s would hold it at this step`
            : share > 0 ? "is small enough: Φ is held" : `holds nothing: Φ drifts on. Some ${good} 1/s would hold it`;
        this.held.textContent = `2αh = ${told(share, 2)} ${what}.`;
    }

    /* Show the field of the step for rk4, that of the tolerance for other methods. */
    fit() {
        for (const one of [this.rtol, this.step, this.t_end, this.output]) one?.removeAttribute("aria-invalid");
        const fixed = this.method.value === "rk4";
        if (this.step) this.step.parentElement.hidden = !fixed;
        if (this.rtol) this.rtol.parentElement.hidden = fixed;
    }

    /* Return the options for `sim.running`. Throws an Error for text that is not a number. */
    read() {
        const found = {method: this.method.value}, fixed = found.method === "rk4";
        for (const name of fixed ? ["step", "t_end", "output"] : ["rtol", "t_end", "output"]) {
            const text = this[name]?.value.trim();
            if (!text) continue;
            const units = name === "step" || name === "t_end" ? this.seconds : {};
            found[name] = typed(text, {factor: 1}, units);
            if (Number.isNaN(found[name])) throw new Error(refusal(this[name], name, text, units));
        }
        return found;
    }
}
