/*
 * Show current values next to the equations of a page. Each element with data-value shows its number at the state that
 * the page announces, once a frame and only where it is seen.
 */
const gudgeonValues = (() => {
    const FUNCTIONS = {phi: "constraints", phi_q: "jacobian", nu: "velocity_rhs", gamma: "acceleration_rhs", play: "play",
        rhs: "dynamics"};
    const IDLE = null; // of a line that is not run at the state
    const NOISE = 1e-9; // as runtime/results/reports/comparison.py has it
    const RAISED = {...["⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"], "-": "⁻"};
    let equations = null, state = null, known = {}, waiting = false;
    const seen = new Set();

    /* p by the names of its numbers. */
    function named(p) {
        const found = {}, {numbers, tables} = equations;
        for (const name in numbers) found[name] = p[numbers[name]];
        for (const name in tables) found[name] = p.slice(...tables[name]);
        return found;
    }

    /* What a function of the equations gives at the state: its locals and arrays, computed once. */
    function computed(of) { return called(FUNCTIONS[of], state); }

    /* The same of any function, of coordinates q and rates v that are its own. */
    function called(name, {q, v, latches, r, all_a}) {
        const call = equations?.functions[name];
        if (!call) return {};
        known.p ??= named(state.p);
        const given = {t: state.t, q, v, r, all_a, p: known.p, discrete: {contact: latches}};
        known[name] ??= call(...equations.given[name].map((one) => given[one]));
        return known[name];
    }

    /*
     * Coordinates and rates of the tree follow from those of all bodies; of driven chains stand behind them, as C has
     * them, directions and second rates. Theirs are closed as the sample left them.
     */
    function treeState() {
        const {s, s_rate: rates} = called("reduce_state", state);
        if (known.tree || !s) return known.tree ?? {};
        const q = [...s], v = [...rates];
        Object.assign(q, called("evaluate_loop_directions", {q}).out);
        Object.assign(v, called("compute_loop_rates", {q}).v);
        return known.tree = {q, v};
    }

    /* Of the reduced formulation. */
    function inTree(name) {
        const {q, v} = treeState();
        if (name === "reduce_state" || !q) return known[name] ?? {};
        if (name === "reduce_accelerations") return called(name, {...state, all_a: accelerations()});
        const r = name === "reduced_project" && residuals(q);
        return called(name, {q, v, r, latches: Object.keys(equations.joints).map(contactState)});
    }

    /* How far the loops are open, in all rows of the tree's linkage. */
    function residuals(q) {
        const r = [];
        called("closures", {q}).out?.forEach((x, k) => { r[equations.closing[k]] = x; });
        return r;
    }

    /* Of all bodies, as the run has them. */
    function accelerations() {
        return equations.bodies.flatMap((body) => ["ax", "ay", "alpha"].map((one) => series(`${body}.${one}`)));
    }

    /* At the state; NaN where the run has none. */
    function series(name) {
        try {
            return state.run.series(name)[state.k];
        } catch {
            return NaN;
        }
    }

    /* The locals of the functions of a joint with play, by function, computed once. */
    function contact(joint) {
        const play = computed("play"), {functions, joints} = equations;
        const motion = joints[joint].map((name) => play[name]);
        return known[`joint ${joint}`] ??= functions[`clearance_${joint}_`](...motion, contactState(joint), known.p, {});
    }

    /* The contact state of a joint at the sample. A run without stored ones has NaN: its forces are no numbers. */
    function contactState(joint) {
        const joints = Object.keys(equations.joints), i = joints.indexOf(joint), {run, k} = state;
        const memory = run?.memory ?? [], width = memory.length / (run?.t?.length || 1);
        const own = memory.slice(k * width, (k + 1) * width);
        const deltadot_minus = own[i] ?? NaN, each = equations.states, last = width - each * (joints.length - i);
        return {closed: !own.length || !Number.isNaN(deltadot_minus), deltadot_minus, state: own.slice(last, last + each)};
    }

    /* Of a function of clearance.c, in the joint that is lit, or the first that calls it. */
    function ofLaw(of, name) {
        const joints = equations?.called[of] ?? [];
        const lit = (joint) => typeof gudgeonLight !== "undefined" && gudgeonLight.isLit(`joint-${joint}`);
        const joint = joints.find(lit) ?? joints[0];
        if (!joint) return NaN;
        const found = contact(joint)[of];
        return found && name in found ? found[name] : IDLE;
    }

    /* What a line stored: "phi.arm_x", "law.dry_A.v_t"; "law.f.x<side" where f's side is below zero, ">": elsewhere. */
    function stored(name) {
        const [, plain, relation, side] = name.match(/^([^<>]*)([<>]?)(.*)$/), [kind, ...rest] = plain.split(".");
        if (relation) {
            const below = stored(`${plain.slice(0, plain.lastIndexOf("."))}.${side}`);
            if (below === IDLE || below < 0 !== (relation === "<")) return IDLE;
        }
        if (kind === "p" || kind === "lambda") return value(plain);
        if (kind === "law") return ofLaw(rest[0], rest.slice(1).join("."));
        if (kind === "tree") return local(inTree(rest[0]), rest.slice(1).join(".")) ?? IDLE; // behind a pivot of zero
        return local(computed(kind), rest.join("."));
    }

    /* The number of a name: "q.7", "phi.3", "phi_q.3.7", "lambda.3", "p.5", "tmp.phi.arm_x"; NaN where there is none. */
    function value(name) {
        const [kind, ...rest] = name.split("."), numbers = rest.map(Number);
        if (kind === "q" || kind === "v") return state[kind][numbers[0] - 1];
        if (kind === "p") return state.p[numbers[0] - 1];
        if (kind === "tmp") return stored(rest.join("."));
        if (kind === "lambda") return multiplier(numbers[0]);
        const row = equations?.rows[numbers[0] - 1];
        if (kind === "phi_q") return computed(kind).phi_q?.[row * state.q.length + numbers[1] - 1];
        return computed(kind)[kind === "gamma" ? "gamma_rows" : kind]?.[row];
    }

    /* A local of a function, or an entry of what it fills: "phi[3]", "rhs.lambda[2]". */
    function local(found, name) {
        return name.split(/[.[\]]+/).filter(Boolean).reduce((part, key) => part?.[key], found);
    }

    function multiplier(row) { return series(`lambda.${equations?.names[row - 1]}`); }

    /* Five digits; 1.2e-5 as 1.2·10⁻⁵. */
    function text(x) {
        if (x === IDLE) return "\u2013";
        if (!Number.isFinite(x)) return "";
        const [digits, power] = String(Number(x.toPrecision(5))).replace(/^-/, "\u2212").split("e");
        return power === undefined ? digits : `${digits}\u00b710${[...power].map((c) => RAISED[c] ?? "").join("")}`;
    }

    const largest = (values) => values.reduce((most, x) => Math.max(most, Math.abs(x) || 0), 0);

    /*
     * Whether a number is what rounding leaves of none: of a coordinate, a rate, a multiplier as the page has it, of an
     * entry beside its matrix; an open row counts sooner, for it may drift.
     */
    function isNone(name, x) {
        const [kind, k] = name.replace(/^tmp\.lambda\./, "lambda.").split("."), rate = kind === "v" ? "/s" : "";
        if (kind === "lambda") return state.isNone?.(x, state.run.unit(`lambda.${equations?.names[k - 1]}`));
        if (x !== 0 && kind === "phi") return Math.abs(x) < 4 * Number.EPSILON * largest(state.q);
        const beside = {phi_q: "phi_q", nu: "nu", gamma: "gamma_rows"}[kind];
        if (x !== 0 && beside) return Math.abs(x) < NOISE * largest(computed(kind)[beside]);
        return (kind === "q" || kind === "v") && state.isNone?.(x, (k % 3 ? "m" : "rad") + rate);
    }

    /* A number as text; a mark of a plot goes to its place. */
    function fill(element) {
        const x = value(element.dataset.value);
        if (!element.dataset.range) {
            element.textContent = Number.isFinite(x) && isNone(element.dataset.value, x) ? "\u2248 0" : text(x);
            return;
        }
        const [first, last, left, right] = element.dataset.range.split(" ").map(Number);
        const inside = x !== IDLE && x >= first && x <= last;
        element.setAttribute("visibility", inside ? "visible" : "hidden");
        if (!inside) return;
        const share = (x - first) / (last - first);
        element.setAttribute("transform", `translate(${left + (right - left) * share} 0)`);
        const curves = element.parentNode.querySelectorAll("polyline");
        element.querySelectorAll("circle").forEach((dot, k) => dot.setAttribute("cy", height(curves[k], share)));
    }

    /* Of a curve whose points stand evenly, at a share of its way across. */
    function height(curve, share) {
        const y = curve.getAttribute("points").split(" ").map((point) => Number(point.split(",")[1]));
        const at = share * (y.length - 1), k = Math.min(Math.floor(at), y.length - 2);
        return y[k] + (at - k) * (y[k + 1] - y[k]);
    }

    function frame() {
        waiting = false;
        for (const element of state ? seen : []) {
            if (element.isConnected) fill(element);
            else seen.delete(element);
        }
    }

    function ask() {
        if (!waiting && typeof document !== "undefined") requestAnimationFrame(frame);
        waiting = true;
    }

    /* The functions of the scene (targets/javascript), once they are unpacked. */
    function take(found) {
        equations = found;
        known = {};
        ask();
    }

    /* A state: {t, q, v, p, run, k}, coordinates and numbers in the order of the source. */
    function announce(detail) {
        state = detail;
        known = {};
        ask();
    }

    /* Looks which places of values are seen; those of lines that are listed later too. */
    function begin() {
        const watch = new IntersectionObserver((changes) => {
            for (const {target, isIntersecting} of changes) seen[isIntersecting ? "add" : "delete"](target);
            ask();
        });
        const observe = () => {
            document.querySelectorAll("[data-value]").forEach((one) => watch.observe(one));
            ask(); // another joint may be lit
        };
        for (const name of ["gudgeon:lit", "gudgeon:listed"]) document.addEventListener(name, observe);
        observe();
        if (window.gudgeonState) announce(window.gudgeonState);
    }

    if (typeof document !== "undefined") {
        document.addEventListener("gudgeon:state", (event) => announce(event.detail));
        addEventListener("DOMContentLoaded", begin);
    }
    return {announce, take, value, text};
})();
if (typeof module !== "undefined") module.exports = gudgeonValues;
