/*
 * No freedom, and integrated all the same: rk4 over a = Phi_q^-1 (gamma - 2 alpha Phi_dot - beta^2 Phi), in which all
 * rows, those of the drives too, drift or are held. For classes; Python solves Phi = 0 instead, and so does `follow`.
 */
function* drift(sim, {t, step, slice}, memory, run) {
    const {lib, n, about} = sim, width = 2 * n + N_WORK, rows = memory.numbers(t.length * width);
    const [at, dy, mode] = [width, width, Math.max(about.memory, 1)].map((count) => memory.numbers(count));
    const {q, v} = run.begin(), p = memory.numbers(sim.p.length, sim.p), counts = {steps: 0, right_hand_sides: 0};
    let y = Float64Array.of(...q, ...v, ...new Float64Array(N_WORK)), done = 0;
    const store = () => memory.view(rows + 8 * width * done++, width).set(y);
    const take = () => {
        const all = memory.copy(rows, done * width), part = (from, count) => columns(all, width, from, count);
        Object.assign(run, {t: t.slice(0, done), q: part(0, n), v: part(n, n), work: part(2 * n, N_WORK), counts,
            memory: new Float64Array(done * Math.max(about.memory, 1)), state: new Int8Array(0)});
    };
    run.soFar = take;
    const failed = (status, now) => {
        take();
        throw failure(run, status, TOLD, about.evaluation_pivots, now);
    };
    const rate = (now, h, k) => {
        memory.view(at, width).set(k ? y.map((x, i) => x + h * k[i]) : y);
        const status = lib.gudgeon_rhs(now, at, mode, p, dy);
        counts.right_hand_sides++;
        if (status) failed(status, now);
        return memory.copy(dy, width);
    };
    for (store(); done < t.length; store()) {
        const begun = t[done - 1], lasts = t[done] - begun, parts = Math.max(Math.ceil(lasts / step * (1 - 1e-12)), 1);
        for (let i = 0, h = lasts / parts; i < parts; i++) {
            const now = begun + i * h, half = now + h / 2, end = i + 1 === parts ? t[done] : now + h;
            const k1 = rate(now), k2 = rate(half, h / 2, k1), k3 = rate(half, h / 2, k2), k4 = rate(end, h, k3);
            y = y.map((x, j) => x + h / 6 * (k1[j] + 2 * k2[j] + 2 * k3[j] + k4[j]));
            if (!y.every(Number.isFinite)) failed(-2, end);
            if (++counts.steps % slice === 0) yield end / t[t.length - 1];
        }
    }
    take();
    run.checkLeftOut();
}
