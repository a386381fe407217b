/* Edit the parameters of the file and the options of a run, as fields for pointer and keyboard. */
const METHOD_LABELS = {
    auto: "auto", driven: "rk4 (all constraint equations: they drift)", kinematic: "kinematic (Φ = 0 by Newton)",
    rk4: "rk4 (Baumgarte, not projected)", dop853: "dop853 (projected onto Φ = 0)",
    rodas5p: "rodas5p (implicit, projected)",
};

const MAX_GAIN_STEP = 0.4; // 2 α h up to which Baumgarte's terms do not make Φ grow

/* Create an HTML element, with attributes, at the end of `parent` if it is given. */
function createElement(name, attributes = {}, parent = null) {
    const element = document.createElement(name);
    for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
    parent?.append(element);
    return element;
}

/* Create a folding section of the panel, and return its element. */
function createSection(title, isOpen, parent) {
    const box = createElement("details", {class: "g-section"}, parent);
    box.open = isOpen;
    box.ontoggle = () => {
        if (box.open && box.contains(document.activeElement)) box.scrollIntoView({block: "nearest"});
    };
    createElement("summary", {}, box).textContent = title;
    return box;
}

/* Return a unit in the form of UNITS of runtime/language/units.py: "kg·m²" as "kg*m^2". */
function convertToFileUnit(unit) {
    const signs = {"°": "deg", "·": "*", "²": "^2", "³": "^3", "µ": "u", "μ": "u", " ": ""};
    return unit.replace(/[°·²³µμ ]/g, (sign) => signs[sign]);
}

/*
 * Return the number that a user typed, in SI: with decimal point or comma, in the field's unit or with its own; NaN if
 * invalid.
 *
 * factor: value in SI of the field's unit. units: values in SI by name of the units that may follow the number. With a
 * decimal prefix the result is the number nearest to the text.
 */
function parseNumber(text, {factor, unit: fieldUnit = ""}, units = {}) {
    const plain = text.trim().replace(",", ".").replace("−", "-");
    const [, number, typedUnit] = /^([-+]?(?:\d+\.?\d*|\.\d+)(?:e[-+]?\d+)?)(.*)$/i.exec(plain) ?? [];
    if (number === undefined) return NaN;
    const unit = convertToFileUnit(typedUnit);
    const scale = !unit || unit === convertToFileUnit(fieldUnit) ? factor : units[unit] ?? NaN;
    const exponent = Math.round(Math.log10(scale));
    if (Number(`1e${exponent}`) !== scale) return Number(number) * scale;
    const [mantissa, power = "0"] = number.toLowerCase().split("e");
    return Number(`${mantissa}e${Number(power) + exponent}`);
}

/* Mark a field as invalid, and return the message. */
function markInvalid(field, name, text, units = {}) {
    field.setAttribute("aria-invalid", true);
    const names = Object.keys(units).join(", ");
    return `${name}: ${text} is no number${names && `; a unit may follow the number: ${names}`}`;
}

/*
 * Parameter with a slider over its range, and a field for any value.
 *
 * entry: {k, name, unit, factor, low, high} of build_parameter_sections (parameter_panel.py). parameter: {address,
 * unit, …} of the description.
 */
class NumberField {
    constructor(panel, entry, parameter, parent) {
        Object.assign(this, {panel, entry, parameter, units: panel.units[parameter.unit]});
        const row = this.row = createElement("div", {class: "g-parameter"}, parent), id = `g-parameter-${entry.k}`;
        const label = createElement("label", {for: id}, row);
        label.textContent = entry.name;
        this.slider = createElement("input", {type: "range", id, min: 0, max: 1000, step: 1}, row);
        const name = `${parameter.address} in ${entry.unit || "one"}`;
        this.field = createElement("input", {type: "text", "aria-label": name, size: 8}, row);
        createElement("span", {class: "g-unit"}, row).textContent = entry.unit;
        const attributes = {type: "button", class: "g-small", title: "as in the file"};
        this.resetButton = createElement("button", attributes, row);
        this.resetButton.textContent = "↺";
        this.resetButton.setAttribute("aria-label", `${parameter.address} as in the file`);
        this.slider.oninput = () => this.setFromSlider();
        this.field.onchange = () => this.setValue(parseNumber(this.field.value, entry, this.units), this.field.value);
        this.resetButton.onclick = () => panel.resetParameter(parameter.address);
    }

    /* Set the parameter to the slider's position, rounded to four digits. */
    setFromSlider() {
        const {low, high, factor} = this.entry, x = low + this.slider.value / 1000 * (high - low);
        const digits = String(Number((x / factor).toPrecision(4)));
        this.setValue(parseNumber(digits, this.entry), digits);
    }

    /* Set the parameter (SI), or report the text of an invalid value. */
    setValue(value, text) {
        if (Number.isFinite(value)) this.panel.set(this.parameter.address, value);
        else this.panel.showError(markInvalid(this.field, this.parameter.address, text, this.units));
    }

    /* Show the value of the run, given by the user or else from p; a field with focus keeps its text. */
    show(p, givenValue) {
        const {k, low, high, factor} = this.entry, value = givenValue ?? p[k], isGiven = givenValue !== undefined;
        this.row.classList.toggle("g-changed", isGiven);
        this.field.removeAttribute("aria-invalid");
        this.resetButton.style.visibility = isGiven ? "" : "hidden";
        const position = Math.round(1000 * (value - low) / (high - low));
        if (document.activeElement !== this.slider) this.slider.value = position;
        this.slider.setAttribute("aria-valuetext", `${formatNumber(value / factor, 6)} ${this.entry.unit}`);
        const round = (digits) => String(Number((value / factor).toPrecision(digits))), exact = round(12);
        this.field.value = exact.length > 9 ? round(6) : exact;
        this.field.title = exact;
    }
}

/* Parameter with a choice of words; arguments as of NumberField. */
class ChoiceField {
    constructor(panel, entry, parameter, parent) {
        Object.assign(this, {parameter, entry});
        const row = this.row = createElement("div", {class: "g-parameter"}, parent), id = `g-parameter-${entry.k}`;
        createElement("label", {for: id}, row).textContent = entry.name;
        this.select = createElement("select", {id, class: "g-wide-field"}, row);
        for (const word of parameter.words) createElement("option", {value: word}, this.select).textContent = word;
        this.select.onchange = () => panel.set(parameter.address, this.select.value);
    }

    /* Show the chosen word, given by the user or else from p. */
    show(p, givenWord) {
        this.row.classList.toggle("g-changed", givenWord !== undefined);
        this.select.value = givenWord ?? this.parameter.words[p[this.entry.k]];
    }
}

const MAX_TRIED = 12; // largest number of parameters that are tried one by one as the cause of an error

/*
 * All parameters and options of a run.
 *
 * givenValues: values by address that differ from the file. changedSinceRun: addresses changed since the last complete
 * run. Callbacks: `onChange` after each change, `showError` with messages, `onFormulation` with the suffix of the
 * chosen formulation's elements.
 */
class Panel {
    constructor(form, {groups, units, drift, drifts: hasDrift}, description, {onChange, showError, onFormulation}) {
        Object.assign(this, {description, onChange, showError, onFormulation, units, drift, hasDrift, givenValues: {},
            changedSinceRun: new Set(), gainSections: []});
        this.options = new RunOptions(form, description, this);
        this.fields = groups.flatMap(({title, numbers: entries}, k) => {
            const box = createSection(title, k === 0, form);
            if (entries.every((entry) => description.gains.includes(entry.k))) this.gainSections.push(box);
            return entries.map((entry) => {
                const parameter = description.slots[entry.k];
                return new (parameter.words ? ChoiceField : NumberField)(this, entry, parameter, box);
            });
        });
        const footer = createElement("div", {class: "g-footer"}, form);
        this.resetButton = createElement("button", {type: "button", class: "g-reset"}, footer);
        this.resetButton.textContent = "All as in the file";
        this.resetButton.onclick = () => {
            this.givenValues = {};
            this.changedSinceRun.clear();
            this.onChange();
        };
        form.onsubmit = (event) => event.preventDefault();
    }

    /* Set a parameter, in SI or to a word. */
    set(address, value) {
        this.givenValues[address] = value;
        this.changedSinceRun.add(address);
        this.onChange();
    }

    /* Reset a parameter to the file's value. */
    resetParameter(address) {
        delete this.givenValues[address];
        this.changedSinceRun.delete(address);
        this.onChange();
    }

    /* Show the values of the simulator. */
    show(sim) {
        for (const field of this.fields) field.show(sim.p, this.givenValues[field.parameter.address]);
        this.options.show(sim);
        for (const box of this.gainSections) box.hidden = !this.options.usesGains;
        this.resetButton.disabled = !Object.keys(this.givenValues).length;
    }

    /* Return text on the parameters that cause an error which does not name them; "" for others. Mark their fields. */
    describeCauses(error, sim) {
        const words = error.message.split(/[\s,:;=]+/), isNamed = (address) => words.includes(address);
        const causes = Object.keys(this.givenValues).some(isNamed) ? [] : this.findCauses(error, sim);
        const fields = this.fields.filter(({parameter: {address}}) => causes.includes(address)
            || (address in this.givenValues && isNamed(address)));
        for (const {field} of fields) field?.setAttribute("aria-invalid", true);
        if (!causes.length) return "";
        const values = fields.map(({entry: {factor, unit}, parameter: {address, words}}) => {
            const value = this.givenValues[address];
            return `${address} = ${words ? value : `${formatNumber(value / factor, 6)} ${unit}`.trim()}`;
        });
        return `. ${error.partial ? "Changed since the last complete run" : "Cause"}: ${values.join(", ")}`;
    }

    /*
     * Return the parameters without which the run starts; if no single one suffices, those that fail alone, otherwise
     * all.
     *
     * After the start of a run: all that changed since the last complete one. The simulator is left as it was.
     */
    findCauses(error, sim) {
        const addresses = Object.keys(this.givenValues), {p, p_motion, givenValues, isGiven} = sim;
        if (error.partial) return [...this.changedSinceRun];
        const hasStart = (selected) => {
            try {
                sim.setParameters(Object.fromEntries(selected.map((address) => [address, this.givenValues[address]])));
                sim.start();
                return true;
            } catch {
                return false;
            }
        };
        try {
            if (hasStart(addresses)) return [];
            if (addresses.length > MAX_TRIED) return [...this.changedSinceRun];
            const needed = addresses.filter((address) => hasStart(addresses.filter((other) => other !== address)));
            if (needed.length) return needed;
            const failing = addresses.filter((address) => !hasStart([address]));
            return failing.length ? failing : addresses;
        } finally {
            Object.assign(sim, {p, p_motion, givenValues, isGiven});
        }
    }
}

/* Method, tolerance, length and samples of a run; empty fields stand for the scene's defaults. */
class RunOptions {
    constructor(form, description, panel) {
        const box = createSection("Run", true, form), isDriven = description.methods[0] === "kinematic";
        Object.assign(this, {description, timeUnits: panel.units.s, hasDrift: panel.hasDrift});
        this.method = this.addRow(box, "method", createElement("select", {class: "g-wide-field"}));
        for (const name of isDriven ? description.methods : ["auto", ...description.methods]) {
            const label = METHOD_LABELS[isDriven && name === "rk4" ? "driven" : name] ?? name;
            createElement("option", {value: name}, this.method).textContent = label;
        }
        if (getElement("gudgeon-module-full")) this.addFormulationChoice(box, panel);
        if (panel.drift) this.addDriftNote(box, panel.drift);
        this.rtol = !isDriven ? this.addField(box, "rtol", "") : null;
        this.step = description.methods.includes("rk4") ? this.addField(box, "step", "s") : null;
        this.t_end = this.addField(box, "t_end", "s");
        this.output = this.addField(box, "output", "intervals");
        for (const input of [this.method, this.rtol, this.step, this.t_end, this.output])
            if (input) input.onchange = () => {
                this.updateFields();
                panel.onChange();
            };
        this.gainNote = createElement("p", {class: "g-quiet"}, box);
        this.updateFields();
    }

    /* Add the choice of the formulation: reduced, where tree joints do not drift, or full, where all joints drift. */
    addFormulationChoice(box, panel) {
        const select = this.formulation = createElement("select", {class: "g-wide-field"});
        this.addRow(box, "formulation", select);
        for (const [suffix, label] of [["", "reduced (a tree’s coordinates)"], ["-full", "full (all rows of Φ)"]])
            createElement("option", {value: suffix}, select).textContent = label;
        select.onchange = () => panel.onFormulation(select.value);
    }

    /* Add a row with a name, an input element and a unit, and return the element. */
    addRow(box, name, input, unit = "") {
        const row = createElement("div", {class: "g-parameter"}, box), id = `g-run-${name}`;
        createElement("label", {for: id}, row).textContent = name;
        input.id = id;
        row.append(input);
        createElement("span", {class: "g-unit"}, row).textContent = unit;
        return input;
    }

    /* Show why no constraint drifts here, with Python code in which they do. */
    addDriftNote(box, {note, code}) {
        createElement("p", {class: "g-quiet"}, box).textContent = note;
        const section = createSection("A drift in Python", false, box);
        createElement("pre", {}, section).textContent = code;
    }

    /* Add a text field, and return it. */
    addField(box, name, unit) {
        return this.addRow(box, name, createElement("input", {type: "text", size: 8}), unit);
    }

    /* Return whether Baumgarte's terms act: on integrated constraints without projection. */
    get usesGains() {
        return this.method.value === "rk4" && (this.hasDrift || this.formulation?.value === "-full");
    }

    /* Show the defaults in empty fields. */
    show(sim) {
        const t_end = parseNumber(this.t_end.value, {factor: 1}, this.timeUnits);
        const defaults = {rtol: sim.description.rtol, ...sim.computeDefaultOptions(t_end > 0 ? t_end : undefined)};
        for (const name of ["rtol", "step", "t_end", "output"])
            if (this[name]) this[name].placeholder = formatNumber(defaults[name], 4);
        this.showGainNote(sim, defaults.step);
        if (!this.step || !defaults.isStepEstimated) return;
        this.step.placeholder += ", estimated";
        this.step.title = "estimated for the file’s numbers";
    }

    /* Show whether Baumgarte's terms limit Φ at this step (s) or make it grow (docs/error_control.md). */
    showGainNote({p}, defaultStep) {
        const {gains} = this.description, step = parseNumber(this.step?.value ?? "", {factor: 1}, this.timeUnits);
        this.gainNote.hidden = !this.usesGains || !gains.length;
        if (this.gainNote.hidden) return;
        const h = step > 0 ? step : defaultStep, gainStep = 2 * h * Math.max(...gains.map((k) => p[k]));
        const suitable = formatNumber(0.1 / h, 1);
        const effect = gainStep > MAX_GAIN_STEP
            ? `is too much: with gains near 1/h, Φ grows. Some ${suitable} 1/s would hold it at this step`
            : gainStep > 0 ? "is small enough: Φ is held"
                : `holds nothing: Φ drifts on. Some ${suitable} 1/s would hold it`;
        this.gainNote.textContent = `2αh = ${formatNumber(gainStep, 2)} ${effect}.`;
    }

    /* Show the field of the step for rk4, that of the tolerance for other methods. */
    updateFields() {
        for (const input of [this.rtol, this.step, this.t_end, this.output]) input?.removeAttribute("aria-invalid");
        const hasFixedStep = this.method.value === "rk4";
        if (this.step) this.step.parentElement.hidden = !hasFixedStep;
        if (this.rtol) this.rtol.parentElement.hidden = hasFixedStep;
    }

    /* Return the options for `sim.running`. Throws an Error for text that is not a number. */
    read() {
        const options = {method: this.method.value}, hasFixedStep = options.method === "rk4";
        for (const name of hasFixedStep ? ["step", "t_end", "output"] : ["rtol", "t_end", "output"]) {
            const text = this[name]?.value.trim();
            if (!text) continue;
            const units = name === "step" || name === "t_end" ? this.timeUnits : {};
            options[name] = parseNumber(text, {factor: 1}, units);
            if (Number.isNaN(options[name])) throw new Error(markInvalid(this[name], name, text, units));
        }
        return options;
    }
}
