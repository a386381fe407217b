/*
 * Show current values next to the equations of a page.
 *
 * data-value of an element is the name of a value: "q.7", "phi.3", "tmp.law.dry_A.v_t". Its value at the state that the
 * page announces is written into the element, once a frame and only if the element is visible.
 */
const gudgeonValues = (() => {
    const FUNCTIONS = { // of C, by the kind of value
        phi: "constraints", phi_q: "jacobian", nu: "velocity_rhs", gamma: "acceleration_rhs", rhs: "dynamics",
    };
    const NOT_RUN = null; // value of a line that is not run at the state
    const ROUNDING_TOL = 1e-9; // as in runtime/results/reports/comparison.py
    const SUPERSCRIPTS = {..."⁰¹²³⁴⁵⁶⁷⁸⁹", "-": "⁻"};
    let equations = null, state = null, isRequested = false;
    let cache = {}; // results of functions at the state, by name
    const visible = new Set();

    /* Return the parameters by the names that the functions use, from the array p of a run. */
    function nameParameters(p) {
        const named = {}, {parameterIndices, tableRanges} = equations;
        for (const name in parameterIndices) named[name] = p[parameterIndices[name]];
        for (const name in tableRanges) named[name] = p.slice(...tableRanges[name]);
        return named;
    }

    /* Return the locals and arrays by name of the function that computes a kind of value at the state; {} for none. */
    function evaluate(kind) { return callFunction(FUNCTIONS[kind], state); }

    /* Return the locals and arrays by name of a function of C for its own arguments, computed once for each state. */
    function callFunction(name, {q, v, contacts, r, all_a}) {
        const call = equations?.functions[name];
        if (!call) return {};
        cache.p ??= nameParameters(state.p);
        const values = {t: state.t, q, v, r, all_a, p: cache.p, discrete: {contact: contacts}};
        cache[name] ??= call(...equations.argumentNames[name].map((argument) => values[argument]));
        return cache[name];
    }

    /*
     * Return {q, v} of the tree's coordinates, from those of all bodies; {} in the full formulation.
     *
     * Directions and second rates of loops that drives determine follow after the coordinates and rates, as in C. These
     * loops are closed in a sample.
     */
    function computeTreeState() {
        const {s, s_rate: rates} = callFunction("reduce_state", state);
        if (cache.tree || !s) return cache.tree ?? {};
        const q = [...s], v = [...rates];
        Object.assign(q, callFunction("evaluate_loop_directions", {q}).out);
        Object.assign(v, callFunction("compute_loop_rates", {q}).v);
        return cache.tree = {q, v};
    }

    /* Return the locals and arrays by name of a function of reduced.c at the state. */
    function evaluateInTree(name) {
        const {q, v} = computeTreeState();
        if (name === "reduce_state" || !q) return cache[name] ?? {};
        if (name === "reduce_accelerations") return callFunction(name, {...state, all_a: getAccelerations()});
        const r = name === "reduced_project" && computeResiduals(q);
        return callFunction(name, {q, v, r, contacts: Object.keys(equations.motionLocals).map(getContactState)});
    }

    /* Return the residuals of the loop closures, at their indices among all constraint equations of the tree. */
    function computeResiduals(q) {
        const r = [];
        callFunction("closures", {q}).out?.forEach((x, k) => { r[equations.closureIndices[k]] = x; });
        return r;
    }

    /* Return the accelerations of all bodies from the series of the run. */
    function getAccelerations() {
        return equations.bodies.flatMap((body) => ["ax", "ay", "alpha"].map((name) => getSeries(`${body}.${name}`)));
    }

    /* Return the value of a series of the run at the state; NaN if the run does not have it. */
    function getSeries(name) {
        try {
            return state.run.series(name)[state.k];
        } catch {
            return NaN;
        }
    }

    /* Return the locals of the functions of a joint with play by function, computed once. */
    function computeContact(joint) {
        const play = callFunction("play", state), {functions, motionLocals} = equations;
        const motion = motionLocals[joint].map((name) => play[name]), call = functions[`clearance_${joint}_`];
        return cache[`joint ${joint}`] ??= call(...motion, getContactState(joint), cache.p, {});
    }

    /*
     * Return the ContactState of a joint at the sample: closed, approach speed, internal states of its laws.
     *
     * If the run has no discrete states, the approach speed is NaN, so that forces that depend on it are NaN too.
     */
    function getContactState(joint) {
        const joints = Object.keys(equations.motionLocals), i = joints.indexOf(joint), {run, k} = state;
        const rows = run?.memory ?? [], width = rows.length / (run?.t?.length || 1);
        const memory = rows.slice(k * width, (k + 1) * width), deltadot_minus = memory[i] ?? NaN;
        const {nLawStates} = equations, first = width - nLawStates * (joints.length - i);
        return {closed: !memory.length || !Number.isNaN(deltadot_minus), deltadot_minus,
            state: memory.slice(first, first + nLawStates)};
    }

    /* Return a local of a function of clearance.c, in the highlighted joint, or the first that calls the function. */
    function getLawValue(name, local) {
        const joints = equations?.jointsByFunction[name] ?? [];
        const isHighlighted = (joint) =>
            typeof gudgeonHighlighting !== "undefined" && gudgeonHighlighting.isHighlighted(`joint-${joint}`);
        const joint = joints.find(isHighlighted) ?? joints[0];
        if (!joint) return NaN;
        const locals = computeContact(joint)[name];
        return locals && local in locals ? locals[local] : NOT_RUN;
    }

    /*
     * Return the value that a line of C stored: "phi.arm_x", "law.dry_A.v_t".
     *
     * "law.f.x<branch" has a value where the local `branch` of f is below zero, "law.f.x>branch" elsewhere.
     */
    function getStoredValue(name) {
        const [, path, relation, branch] = name.match(/^([^<>]*)([<>]?)(.*)$/), [kind, ...rest] = path.split(".");
        if (relation) {
            const sign = getStoredValue(`${path.slice(0, path.lastIndexOf("."))}.${branch}`);
            if (sign === NOT_RUN || sign < 0 !== (relation === "<")) return NOT_RUN;
        }
        if (kind === "p" || kind === "lambda") return getValue(path);
        if (kind === "law") return getLawValue(rest[0], rest.slice(1).join("."));
        // a function ends at a pivot of zero: later values are undefined
        if (kind === "tree") return getMember(evaluateInTree(rest[0]), rest.slice(1).join(".")) ?? NOT_RUN;
        return getMember(evaluate(kind), rest.join("."));
    }

    /*
     * Return the value of a name: "q.7", "phi.3", "phi_q.3.7", "lambda.3", "p.5", with indices from 1, or
     * "tmp.phi.arm_x" of a line of C; NaN or undefined if there is none.
     */
    function getValue(name) {
        const [kind, ...rest] = name.split("."), [first, second] = rest.map(Number);
        if (kind === "q" || kind === "v") return state[kind][first - 1];
        if (kind === "p") return state.p[first - 1];
        if (kind === "tmp") return getStoredValue(rest.join("."));
        if (kind === "lambda") return getSeries(`lambda.${equations?.rowNames[first - 1]}`);
        const row = equations?.rowIndices[first - 1];
        if (kind === "phi_q") return evaluate(kind).phi_q?.[row * state.q.length + second - 1];
        return evaluate(kind)[kind === "gamma" ? "gamma_rows" : kind]?.[row];
    }

    /* Return a member of locals and arrays by its path: "arm_x", "phi[3]", "rhs.lambda[2]". */
    function getMember(values, path) {
        return path.split(/[.[\]]+/).filter(Boolean).reduce((part, key) => part?.[key], values);
    }

    /* Return a value as text with five digits; 1.2e-5 as 1.2·10⁻⁵, a line that is not run as "–". */
    function formatValue(x) {
        if (x === NOT_RUN) return "–";
        if (!Number.isFinite(x)) return "";
        const [mantissa, power] = String(Number(x.toPrecision(5))).replace(/^-/, "−").split("e");
        if (power === undefined) return mantissa;
        return `${mantissa}·10${[...power].map((c) => SUPERSCRIPTS[c] ?? "").join("")}`;
    }

    const findLargest = (values) => values.reduce((largest, x) => Math.max(largest, Math.abs(x) || 0), 0);

    /*
     * Return whether a value is only a rounding error.
     *
     * The page decides for coordinates, velocities and multipliers. Entries are compared with the largest of their
     * matrix, and rows of Φ with the coordinates, since their drift must be visible.
     */
    function isRoundingError(name, x) {
        const [kind, k] = name.replace(/^tmp\.lambda\./, "lambda.").split("."), rate = kind === "v" ? "/s" : "";
        if (kind === "lambda")
            return state.isRoundingError?.(x, state.run.unit(`lambda.${equations?.rowNames[k - 1]}`));
        if (x !== 0 && kind === "phi") return Math.abs(x) < 4 * Number.EPSILON * findLargest(state.q);
        const matrix = {phi_q: "phi_q", nu: "nu", gamma: "gamma_rows"}[kind];
        if (x !== 0 && matrix) return Math.abs(x) < ROUNDING_TOL * findLargest(evaluate(kind)[matrix]);
        return (kind === "q" || kind === "v") && state.isRoundingError?.(x, (k % 3 ? "m" : "rad") + rate);
    }

    /* Write the value of an element as text; an element with data-range is the marker of a plot, which is moved. */
    function updateElement(element) {
        const {value: name, range} = element.dataset, x = getValue(name);
        if (!range) {
            element.textContent = Number.isFinite(x) && isRoundingError(name, x) ? "≈ 0" : formatValue(x);
            return;
        }
        const [first, last, left, right] = range.split(" ").map(Number);
        const isInside = x !== NOT_RUN && x >= first && x <= last;
        element.setAttribute("visibility", isInside ? "visible" : "hidden");
        if (!isInside) return;
        const fraction = (x - first) / (last - first);
        element.setAttribute("transform", `translate(${left + (right - left) * fraction} 0)`);
        const curves = element.parentNode.querySelectorAll("polyline");
        element.querySelectorAll("circle").forEach((dot, k) => {
            dot.setAttribute("cy", interpolate(curves[k], fraction));
        });
    }

    /* Return y of a polyline, whose points have equal distances in x, at a fraction of its width. */
    function interpolate(curve, fraction) {
        const y = curve.getAttribute("points").split(" ").map((point) => Number(point.split(",")[1]));
        const position = fraction * (y.length - 1), k = Math.min(Math.floor(position), y.length - 2);
        return y[k] + (position - k) * (y[k + 1] - y[k]);
    }

    /* Update all visible elements; elements that the page removed are forgotten. */
    function updateElements() {
        isRequested = false;
        for (const element of state ? visible : []) {
            if (element.isConnected) updateElement(element);
            else visible.delete(element);
        }
    }

    /* Request a frame in which the visible elements are updated. */
    function requestUpdate() {
        if (!isRequested && typeof document !== "undefined") requestAnimationFrame(updateElements);
        isRequested = true;
    }

    /* Set the functions of the scene (print_equations_script of targets/javascript) once they are unpacked. */
    function setEquations(functions) {
        equations = functions;
        cache = {};
        requestUpdate();
    }

    /* Set the state {t, q, v, p, run, k}; coordinates and parameters are in the order of the scene's description. */
    function setState(detail) {
        state = detail;
        cache = {};
        requestUpdate();
    }

    /* Observe which elements with values are visible, those of lines that are listed later too. */
    function start() {
        const observer = new IntersectionObserver((changes) => {
            for (const {target, isIntersecting} of changes) visible[isIntersecting ? "add" : "delete"](target);
            requestUpdate();
        });
        const observe = () => {
            document.querySelectorAll("[data-value]").forEach((element) => observer.observe(element));
            requestUpdate(); // another joint may be highlighted
        };
        for (const name of ["gudgeon:highlighted", "gudgeon:listed"]) document.addEventListener(name, observe);
        observe();
        if (window.gudgeonState) setState(window.gudgeonState);
    }

    if (typeof document !== "undefined") {
        document.addEventListener("gudgeon:state", (event) => setState(event.detail));
        addEventListener("DOMContentLoaded", start);
    }
    return {setState, setEquations, getValue, formatValue};
})();
if (typeof module !== "undefined") module.exports = gudgeonValues;
