/*
 * Draw a mechanism at any coordinates and parameter values.
 *
 * runtime/drawing/rig.py found the appearance of shapes and the carrier of each of their points when the page was
 * written; here points are only placed:
 *
 * x = r_P(p, q) + A(φ) (c₀ + s c₁)
 */
const SVG = "http://www.w3.org/2000/svg";
const LONGEST = 9, HEAD = 1.3; // of an arrow of force and of its head, in units of the drawing

/* Create an SVG element. */
function svg(name, attributes = {}, parent = null) {
    const made = document.createElementNS(SVG, name);
    for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
    parent?.append(made);
    return made;
}

/* Write the position of a point [index of its body in q, indices in p, signs] to out[at], out[at + 1]. */
function placePoint(point, q, p, out, at) {
    if (!point) return out.fill(0, at, at + 2);
    const [body, x, y, sign_x, sign_y] = point, a = x < 0 ? 0 : sign_x * p[x], b = y < 0 ? 0 : sign_y * p[y];
    if (body < 0) [out[at], out[at + 1]] = [a, b];
    else {
        const c = Math.cos(q[body + 2]), s = Math.sin(q[body + 2]);
        [out[at], out[at + 1]] = [q[body] + (c * a - s * b), q[body + 1] + (s * a + c * b)];
    }
    return out;
}

/* Carriers with their frames: r_P, cos φ, sin φ and s, five consecutive numbers each. */
class Carriers {
    constructor(told, points) {
        this.told = told.map(([name, turn, by]) => ({point: points[name], turn, by, other: points[turn[1]]}));
        this.frames = new Float64Array(5 * told.length);
        this.other = new Float64Array(2);
    }

    /* Return whether a carrier moves with q or a force, not with parameters only. */
    moves(k) {
        const {point, turn, other} = this.told[k], [kind, , , last] = turn;
        const turns = kind === "body" || kind === "load" || (kind === "axis" && last >= 0);
        return turns || (point && point[0] >= 0) || (kind === "pair" && other[0] >= 0);
    }

    /* Update all frames; `load` returns the force of an element by its name, [x, y]. */
    update(q, p, load) {
        const {frames} = this;
        this.told.forEach((told, k) => {
            placePoint(told.point, q, p, frames, 5 * k);
            const [x, y] = this.way(told, q, p, load, k), size = Math.hypot(x, y);
            frames[5 * k + 2] = size > 0 ? x / size : 1;
            frames[5 * k + 3] = size > 0 ? y / size : 0;
            frames[5 * k + 4] = told.by === -1 ? 0 : told.by === -2 ? size : p[told.by];
        });
    }

    /* Return the direction of a carrier's axis, [x, y]. */
    way({turn: [kind, i, j, body], other}, q, p, load, k) {
        if (kind === "body") return [Math.cos(q[i]), Math.sin(q[i])];
        if (kind === "load") return load(i);
        if (kind === "pair") {
            placePoint(other, q, p, this.other, 0);
            return [this.other[0] - this.frames[5 * k], this.other[1] - this.frames[5 * k + 1]];
        }
        if (kind !== "axis") return [1, 0];
        const x = i < 0 ? 0 : p[i], y = j < 0 ? 0 : p[j];
        if (body < 0) return [x, y];
        const c = Math.cos(q[body]), s = Math.sin(q[body]);
        return [c * x - s * y, s * x + c * y];
    }

    /* Return the position of an offset (c₀, c₁) of a carrier, [x, y]. */
    place(k, offsets, at) {
        const [x, y, c, s, by] = this.frames.subarray(5 * k, 5 * k + 5);
        const a = offsets[at] + by * offsets[at + 2], b = offsets[at + 1] + by * offsets[at + 3];
        return [x + c * a - s * b, y + s * a + c * b];
    }
}

/* Return a shape [part, role, tint, closed or [r₀, r₁, k], carrier, [numbers], …] with an array of its points. */
function unfolded([part, role, tint, kind, ...runs], carriers, step) {
    const which = [], offsets = [];
    for (let i = 0; i < runs.length; i += 2) {
        const width = carriers[runs[i]][2] === -1 ? 2 : 4;
        for (let j = 0; j < runs[i + 1].length; j += width) {
            const own = runs[i + 1].slice(j, j + width).map((x) => x * step);
            which.push(runs[i]);
            offsets.push(...own, ...(width === 2 ? [0, 0] : []));
        }
    }
    const disc = Array.isArray(kind) ? [kind[0] * step, kind[1], kind[2]] : null;
    return {part, role, tint, disc, closed: kind === 1, which, offsets: Float64Array.from(offsets)};
}

/* All shapes of a drawing, at the last frames of its carriers. */
class Rig {
    constructor(rig, points) {
        this.carriers = new Carriers(rig.carriers, points);
        this.shapes = rig.shapes.map((told) => unfolded(told, rig.carriers, rig.step));
        for (const shape of this.shapes) shape.moves = shape.which.some((k) => this.carriers.moves(k));
        this.labels = rig.labels.map(([k, ...offsets]) => ({k, offsets: offsets.map((x) => x * rig.step)}));
    }

    /* Move the carriers. */
    update(q, p, load = () => [0, 0]) { this.carriers.update(q, p, load); }

    /* Return the points of a shape, [[x, y], …], in m. */
    points({which, offsets}) { return which.map((k, i) => this.carriers.place(k, offsets, 4 * i)); }

    /* Return the radius of a disc in m. */
    radius({disc: [r0, r1, k]}, p) { return k < 0 ? r0 : r0 + r1 * p[k]; }

    /* Return the position of a label in m. */
    label({k, offsets}) { return this.carriers.place(k, offsets, 0); }
}

/* Drawing in an <svg> element: paths, names of constant size on the screen, arrows of the joints' forces. */
class Drawing {
    constructor(root, {rig, names, joints, looks, pixels}, about) {
        Object.assign(this, {root, about, joints, rig: new Rig(rig, about.points), box: [...rig.low, ...rig.high]});
        Object.assign(this, {scale: pixels[0], planned: pixels, low: rig.low, high: rig.high, unit: rig.unit});
        root.replaceChildren();
        this.paths = this.makePaths(looks);
        this.way = svg("path", {class: "d-path"}, root);
        this.force = ["d-reaction", "d-reaction-head"].map((name) => svg("path", {class: name}, root));
        const group = svg("g", {class: "g-name-group"}, root);
        this.names = names.map(([text, part, look, wide, narrow, clear], k) => {
            const made = svg("text", {class: look, "data-of": tokens(part)}, group);
            made.textContent = text;
            return {made, shifts: [wide, narrow], label: this.rig.labels[k], clear: clear * this.scale};
        });
        this.view(this.box);
    }

    /* Create the paths; consecutive shapes of one class and part share a path. */
    makePaths(looks) {
        const found = [];
        this.rig.shapes.forEach((shape, k) => {
            const last = found[found.length - 1], look = looks[k];
            if (last && last.look === look && last.part === shape.part && last.moves === shape.moves)
                return last.shapes.push(shape);
            const made = svg("path", {class: look, "data-of": tokens(shape.part)}, this.root);
            return found.push({look, part: shape.part, moves: shape.moves, shapes: [shape], made});
        });
        return found;
    }

    /* Show a part of the plane, [low x, low y, high x, high y], in m. */
    view(box) {
        this.box = box;
        const [x, y] = this.at([box[0], box[3]]), k = this.scale;
        this.root.setAttribute("viewBox", [x, y, (box[2] - box[0]) * k, (box[3] - box[1]) * k].map(short).join(" "));
        this.resize();
    }

    /* Adapt the names to the size on the screen; narrow screens have their own planned positions. */
    resize() {
        const {width, height} = this.root.getBoundingClientRect(), [x0, y0, x1, y1] = this.box;
        const metre = Math.min(width / (x1 - x0), height / (y1 - y0)) || this.scale;
        this.narrow = metre < Math.sqrt(this.planned[0] * this.planned[1]) ? 1 : 0;
        const larger = metre / this.planned[this.narrow], size = Math.min(Math.max(larger, 0.95), 1.35);
        this.pixel = this.scale / metre; // of the drawing's pixels, to one of the screen
        this.shift = this.pixel * larger;
        this.room = [...this.at([x0, y1]), ...this.at([x1, y0])];
        this.root.style.setProperty("--name", `${11 * size * this.pixel}px`);
        this.named = this.names.filter(({made, shifts}) => {
            made.style.display = shifts[this.narrow] ? "" : "none";
            return shifts[this.narrow];
        });
        for (const name of this.named) {
            const {width, height} = name.made.getBBox();
            name.half = [width / 2, height / 2];
            name.beside = name.planned = name.shifts[this.narrow].map((x) => x * this.shift);
        }
    }

    /* Return a position in the drawing's pixels. */
    at([x, y]) { return [(x - this.low[0]) * this.scale, (this.high[1] - y) * this.scale]; }

    /* Draw the path of a point from series of its coordinates. */
    trail(xs, ys) { this.way.setAttribute("d", curve(xs, ys, (x) => this.at([x, 0])[0], (y) => this.at([0, y])[1])); }

    /* Draw everything at q with the parameters p; `forces`: [point, Fx, Fy, metres of arrow per newton]. */
    show(q, p, load, forces = []) {
        const same = this.p === p;
        this.p = p;
        this.rig.update(q, p, load);
        for (const {made, moves, shapes} of this.paths)
            if (moves || !same) made.setAttribute("d", shapes.map((shape) => this.path(shape, p)).join(""));
        for (const name of this.named) name.at = this.at(this.rig.label(name.label));
        settle(this.named, this.room, this.pixel, () => this.lines());
        for (const {made, at, beside} of this.named) {
            const place = `translate(${short(at[0] + beside[0])} ${short(at[1] + beside[1])})`;
            if (made.place !== place) made.setAttribute("transform", made.place = place);
        }
        this.arrows(q, p, forces);
    }

    /* Return all lines as segments x, y, x, y, …; circles as polygons. */
    lines() {
        const found = [];
        for (const shape of this.rig.shapes) {
            let points = this.rig.points(shape).map((point) => this.at(point));
            if (shape.disc) {
                const [[x, y]] = points, r = this.rig.radius(shape, this.p) * this.scale;
                points = Array.from({length: 17}, (_, k) =>
                    [x + r * Math.cos(k * Math.PI / 8), y + r * Math.sin(k * Math.PI / 8)]);
            }
            const ends = shape.closed ? [...points, points[0]] : points;
            for (let k = 1; k < ends.length; k++) found.push(...ends[k - 1], ...ends[k]);
        }
        return found;
    }

    /* Return the SVG path of a shape. */
    path(shape, p) {
        const points = this.rig.points(shape).map((point) => this.at(point));
        if (!shape.disc) return `M${points.map((xy) => xy.map(short).join(" ")).join("L")}${shape.closed ? "z" : ""}`;
        const r = short(this.rig.radius(shape, p) * this.scale), [x, y] = points[0];
        return `M${short(x - r)} ${short(y)}a${r} ${r} 0 1 0 ${2 * r} 0a${r} ${r} 0 1 0 ${-2 * r} 0z`;
    }

    /* Draw the arrows of forces. */
    arrows(q, p, forces) {
        let [lines, heads] = ["", ""];
        for (const [name, x, y, metres] of forces) {
            const size = Math.hypot(x, y) * metres * this.scale;
            if (!(size > 1)) continue;
            const tail = this.at(placePoint(this.about.points[name], q, p, new Float64Array(2), 0));
            const [c, s] = [x / Math.hypot(x, y), -y / Math.hypot(x, y)];
            const head = Math.min(HEAD * this.unit * this.scale, 0.6 * size), to = (a, b) =>
                `${short(tail[0] + c * a - s * b)} ${short(tail[1] + s * a + c * b)}`;
            lines += `M${to(0, 0)}L${to(size - 0.8 * head, 0)}`;
            heads += `M${to(size, 0)}L${to(size - head, 0.38 * head)}L${to(size - head, -0.38 * head)}z`;
        }
        this.force[0].setAttribute("d", lines);
        this.force[1].setAttribute("d", heads);
    }

    /* Enlarge the view so that the motion of a run is visible; it never becomes smaller than the first one. */
    fit(run) {
        const n = this.about.coordinates.length, box = [...this.low, ...this.high], margin = 2.6 * this.unit;
        const every = Math.max(1, Math.floor(run.t.length / 32)), {frames} = this.rig.carriers;
        for (let i = 0; i < run.t.length; i += every) {
            this.rig.update(run.q.subarray(i * n, (i + 1) * n), run.p);
            for (let k = 0; k < frames.length; k += 5) {
                const [x, y] = [frames[k], frames[k + 1]];
                if (!this.rig.carriers.told[k / 5].point || !Number.isFinite(x + y)) continue;
                [box[0], box[1]] = [Math.min(box[0], x - margin), Math.min(box[1], y - margin)];
                [box[2], box[3]] = [Math.max(box[2], x + margin), Math.max(box[3], y + margin)];
            }
        }
        if (box.some((x, k) => x !== this.box[k])) this.view(box);
    }
}

/* Return a number with one decimal. */
function short(x) { return Math.round(10 * x) / 10; }

/* Return the identifier of a part for cross-highlighting: "joint A" is joint-A; a point belongs to its body. */
function tokens(part) {
    const [kind, name = ""] = part.split(" ");
    return kind === "point" ? `body-${name.split(".")[0]}` : `${kind}-${name}`;
}
