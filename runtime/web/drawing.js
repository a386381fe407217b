/*
 * Draw a mechanism at any coordinates and parameter values.
 *
 * runtime/drawing/rig.py determined the appearance of all shapes, and the moving frame of each of their points, when
 * the page was written. Here points are only moved:
 *
 * x = r_P(p, q) + A(φ) (c₀ + s c₁)
 */
const SVG = "http://www.w3.org/2000/svg";
const MAX_ARROW_LENGTH = 9, HEAD_LENGTH = 1.3; // of an arrow of force and of its head, in units of the drawing

/* Create an SVG element, with attributes, at the end of `parent` if it is given. */
function createSvg(name, attributes = {}, parent = null) {
    const element = document.createElementNS(SVG, name);
    for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
    parent?.append(element);
    return element;
}

/*
 * Write the position in m of a point to out[index], out[index + 1], and return `out`.
 *
 * The point is [index of its body in q, indices of x and y in p, signs]; −1: the ground, zero. No point: the origin.
 */
function writePosition(point, q, p, out, index) {
    if (!point) return out.fill(0, index, index + 2);
    const [body, x, y, sign_x, sign_y] = point, a = x < 0 ? 0 : sign_x * p[x], b = y < 0 ? 0 : sign_y * p[y];
    if (body < 0) [out[index], out[index + 1]] = [a, b];
    else {
        const c = Math.cos(q[body + 2]), s = Math.sin(q[body + 2]);
        [out[index], out[index + 1]] = [q[body] + (c * a - s * b), q[body + 1] + (s * a + c * b)];
    }
    return out;
}

/*
 * Moving frames of points (MovingFrame of rig.py): `turn` defines φ, `length` the index of s in p.
 *
 * `values` contains r_P, cos φ, sin φ and s of each frame, five consecutive numbers.
 */
class MovingFrames {
    constructor(data, points) {
        this.frames = data.map(([name, turn, length]) =>
            ({point: points[name], turn, length, second: points[turn[1]]}));
        this.values = new Float64Array(5 * data.length);
        this.buffer = new Float64Array(2);
    }

    /* Return whether frame k moves with q or a force, not with parameters only. */
    isMoving(k) {
        const {point, turn, second} = this.frames[k], [kind, , , body] = turn;
        const turns = kind === "body" || kind === "load" || (kind === "axis" && body >= 0);
        return turns || (point && point[0] >= 0) || (kind === "pair" && second[0] >= 0);
    }

    /* Update all frames; `getLoad` returns the force of an element by its name, [x, y] in N. */
    update(q, p, getLoad) {
        const {values} = this;
        this.frames.forEach((frame, k) => {
            writePosition(frame.point, q, p, values, 5 * k);
            const [x, y] = this.computeDirection(frame, q, p, getLoad, k), size = Math.hypot(x, y);
            values[5 * k + 2] = size > 0 ? x / size : 1;
            values[5 * k + 3] = size > 0 ? y / size : 0;
            values[5 * k + 4] = frame.length === -1 ? 0 : frame.length === -2 ? size : p[frame.length];
        });
    }

    /* Return the direction φ of frame k as a vector of any length, [x, y]; the position of the frame must be known. */
    computeDirection({turn: [kind, i, j, body], second}, q, p, getLoad, k) {
        if (kind === "body") return [Math.cos(q[i]), Math.sin(q[i])];
        if (kind === "load") return getLoad(i);
        if (kind === "pair") {
            writePosition(second, q, p, this.buffer, 0);
            return [this.buffer[0] - this.values[5 * k], this.buffer[1] - this.values[5 * k + 1]];
        }
        if (kind !== "axis") return [1, 0];
        const x = i < 0 ? 0 : p[i], y = j < 0 ? 0 : p[j];
        if (body < 0) return [x, y];
        const c = Math.cos(q[body]), s = Math.sin(q[body]);
        return [c * x - s * y, s * x + c * y];
    }

    /* Return the position in m, [x, y], of the point with offsets c₀, c₁ (four numbers from `index` on) in frame k. */
    computePosition(k, offsets, index) {
        const [x, y, c, s, length] = this.values.subarray(5 * k, 5 * k + 5);
        const a = offsets[index] + length * offsets[index + 2], b = offsets[index + 1] + length * offsets[index + 3];
        return [x + c * a - s * b, y + s * a + c * b];
    }
}

/*
 * Return a shape {part, role, tint, disc, closed, frameIndices, offsets} from its JSON (_encode_shape of rig.py).
 *
 * frameIndices: moving frame of each of N points. offsets: c₀, c₁ of each, Float64Array (4 N), in m. disc: [r₀, r₁, k],
 * null for lines. step: unit of the integers in JSON, m.
 */
function decodeShape([part, role, tint, kind, ...runs], frames, step) {
    const frameIndices = [], offsets = [];
    for (let i = 0; i < runs.length; i += 2) {
        const width = frames[runs[i]][2] === -1 ? 2 : 4;
        for (let j = 0; j < runs[i + 1].length; j += width) {
            const lengths = runs[i + 1].slice(j, j + width).map((x) => x * step);
            frameIndices.push(runs[i]);
            offsets.push(...lengths, ...(width === 2 ? [0, 0] : []));
        }
    }
    const disc = Array.isArray(kind) ? [kind[0] * step, kind[1], kind[2]] : null;
    return {part, role, tint, disc, closed: kind === 1, frameIndices, offsets: Float64Array.from(offsets)};
}

/* All shapes of a drawing, at the last update of their moving frames. */
class Rig {
    constructor({carriers: frames, shapes, labels, step}, points) {
        this.movingFrames = new MovingFrames(frames, points);
        this.shapes = shapes.map((shape) => decodeShape(shape, frames, step));
        for (const shape of this.shapes) shape.isMoving = shape.frameIndices.some((k) => this.movingFrames.isMoving(k));
        this.labels = labels.map(([k, ...offsets]) => ({k, offsets: offsets.map((x) => x * step)}));
    }

    /* Move all frames to coordinates q and parameters p; `getLoad` as in MovingFrames. */
    update(q, p, getLoad = () => [0, 0]) { this.movingFrames.update(q, p, getLoad); }

    /* Return the points of a shape, [[x, y], …], in m. */
    computePoints({frameIndices, offsets}) {
        return frameIndices.map((k, i) => this.movingFrames.computePosition(k, offsets, 4 * i));
    }

    /* Return the radius of a disc in m. */
    computeRadius({disc: [r0, r1, k]}, p) { return k < 0 ? r0 : r0 + r1 * p[k]; }

    /* Return the position of a label's anchor in m. */
    computeAnchor({k, offsets}) { return this.movingFrames.computePosition(k, offsets, 0); }
}

/*
 * Drawing in an <svg> element: paths, names of constant size on the screen, arrows of the joints' forces.
 *
 * scale: pixels of the drawing per metre. plannedScales: the same of wide and of narrow screens, for which the offsets
 * of names were planned. box: the visible part of the plane, [low x, low y, high x, high y] in m.
 */
class Drawing {
    constructor(root, {rig, names, looks: classes, pixels: plannedScales}, description) {
        Object.assign(this, {root, description, rig: new Rig(rig, description.points), box: [...rig.low, ...rig.high]});
        Object.assign(this, {scale: plannedScales[0], plannedScales, low: rig.low, high: rig.high, unit: rig.unit});
        root.replaceChildren();
        this.paths = this.createPaths(classes);
        this.trace = createSvg("path", {class: "d-path"}, root);
        this.arrows = ["d-reaction", "d-reaction-head"].map((name) => createSvg("path", {class: name}, root));
        const group = createSvg("g", {class: "g-name-group"}, root);
        this.labels = names.map(([text, part, cssClass, wideOffset, narrowOffset, clearance], k) => {
            const element = createSvg("text", {class: cssClass, "data-of": makeToken(part)}, group);
            element.textContent = text;
            return {element, offsets: [wideOffset, narrowOffset], rigLabel: this.rig.labels[k],
                clearance: clearance * this.scale};
        });
        this.setView(this.box);
    }

    /* Create the paths of all shapes; consecutive shapes of one class and part share a path. */
    createPaths(classes) {
        const paths = [];
        this.rig.shapes.forEach((shape, k) => {
            const last = paths[paths.length - 1], cssClass = classes[k], {part, isMoving} = shape;
            if (last && last.cssClass === cssClass && last.part === part && last.isMoving === isMoving)
                return last.shapes.push(shape);
            const element = createSvg("path", {class: cssClass, "data-of": makeToken(part)}, this.root);
            return paths.push({cssClass, part, isMoving, shapes: [shape], element});
        });
        return paths;
    }

    /* Show a part of the plane, [low x, low y, high x, high y], in m. */
    setView(box) {
        this.box = box;
        const [x, y] = this.toPixels([box[0], box[3]]), k = this.scale;
        const viewBox = [x, y, (box[2] - box[0]) * k, (box[3] - box[1]) * k];
        this.root.setAttribute("viewBox", viewBox.map(roundToTenth).join(" "));
        this.resize();
    }

    /* Adapt the names to the size on the screen; narrow screens have their own planned offsets. */
    resize() {
        const {width, height} = this.root.getBoundingClientRect(), [x0, y0, x1, y1] = this.box;
        const screenScale = Math.min(width / (x1 - x0), height / (y1 - y0)) || this.scale;
        const layout = screenScale < Math.sqrt(this.plannedScales[0] * this.plannedScales[1]) ? 1 : 0; // 1: narrow
        const magnification = screenScale / this.plannedScales[layout];
        const fontScale = Math.min(Math.max(magnification, 0.95), 1.35);
        this.pixelSize = this.scale / screenScale; // pixels of the drawing per pixel of the screen
        const offsetScale = this.pixelSize * magnification;
        this.pictureBox = [...this.toPixels([x0, y1]), ...this.toPixels([x1, y0])];
        this.root.style.setProperty("--name", `${11 * fontScale * this.pixelSize}px`);
        this.visibleLabels = this.labels.filter(({element, offsets}) => {
            element.style.display = offsets[layout] ? "" : "none";
            return offsets[layout];
        });
        for (const label of this.visibleLabels) {
            const {width, height} = label.element.getBBox();
            label.halfSize = [width / 2, height / 2];
            label.offset = label.plannedOffset = label.offsets[layout].map((x) => x * offsetScale);
        }
    }

    /* Return a position [x, y] in m as pixels of the drawing, y down. */
    toPixels([x, y]) { return [(x - this.low[0]) * this.scale, (this.high[1] - y) * this.scale]; }

    /* Draw the path of a point from series of its coordinates (N) in m. */
    drawTrace(xs, ys) {
        const d = makePathData(xs, ys, (x) => this.toPixels([x, 0])[0], (y) => this.toPixels([0, y])[1]);
        this.trace.setAttribute("d", d);
    }

    /* Draw everything at q with the parameters p; `forces`: [point, Fx, Fy, metres of arrow per newton]. */
    show(q, p, getLoad, forces = []) {
        const isSameParameters = this.p === p;
        this.p = p;
        this.rig.update(q, p, getLoad);
        for (const {element, isMoving, shapes} of this.paths)
            if (isMoving || !isSameParameters)
                element.setAttribute("d", shapes.map((shape) => this.makeShapePath(shape, p)).join(""));
        for (const label of this.visibleLabels) label.anchor = this.toPixels(this.rig.computeAnchor(label.rigLabel));
        placeLabels(this.visibleLabels, this.pictureBox, this.pixelSize, () => this.collectSegments());
        for (const label of this.visibleLabels) {
            const {element, anchor, offset} = label;
            const x = roundToTenth(anchor[0] + offset[0]), y = roundToTenth(anchor[1] + offset[1]);
            const transform = `translate(${x} ${y})`;
            if (label.transform !== transform) element.setAttribute("transform", label.transform = transform);
        }
        this.drawArrows(q, p, forces);
    }

    /* Return all lines as segments x, y, x, y, … in pixels; circles as polygons of 16 sides. */
    collectSegments() {
        const segments = [];
        for (const shape of this.rig.shapes) {
            let points = this.rig.computePoints(shape).map((point) => this.toPixels(point));
            if (shape.disc) {
                const [[x, y]] = points, r = this.rig.computeRadius(shape, this.p) * this.scale;
                points = Array.from({length: 17}, (_, k) =>
                    [x + r * Math.cos(k * Math.PI / 8), y + r * Math.sin(k * Math.PI / 8)]);
            }
            const ends = shape.closed ? [...points, points[0]] : points;
            for (let k = 1; k < ends.length; k++) segments.push(...ends[k - 1], ...ends[k]);
        }
        return segments;
    }

    /* Return the SVG path of a shape. */
    makeShapePath(shape, p) {
        const points = this.rig.computePoints(shape).map((point) => this.toPixels(point));
        if (!shape.disc)
            return `M${points.map((xy) => xy.map(roundToTenth).join(" ")).join("L")}${shape.closed ? "z" : ""}`;
        const r = roundToTenth(this.rig.computeRadius(shape, p) * this.scale), [x, y] = points[0];
        const start = `${roundToTenth(x - r)} ${roundToTenth(y)}`;
        return `M${start}a${r} ${r} 0 1 0 ${2 * r} 0a${r} ${r} 0 1 0 ${-2 * r} 0z`;
    }

    /* Draw the arrows of forces, as in `show`; arrows shorter than a pixel are left out. */
    drawArrows(q, p, forces) {
        let [lines, heads] = ["", ""];
        for (const [name, x, y, metresPerNewton] of forces) {
            const length = Math.hypot(x, y) * metresPerNewton * this.scale;
            if (!(length > 1)) continue;
            const point = this.description.points[name];
            const tail = this.toPixels(writePosition(point, q, p, new Float64Array(2), 0));
            const [c, s] = [x / Math.hypot(x, y), -y / Math.hypot(x, y)];
            const head = Math.min(HEAD_LENGTH * this.unit * this.scale, 0.6 * length);
            const place = (along, across) => // relative to the tail
                `${roundToTenth(tail[0] + c * along - s * across)} ${roundToTenth(tail[1] + s * along + c * across)}`;
            lines += `M${place(0, 0)}L${place(length - 0.8 * head, 0)}`;
            heads += `M${place(length, 0)}L${place(length - head, 0.38 * head)}L${place(length - head, -0.38 * head)}z`;
        }
        this.arrows[0].setAttribute("d", lines);
        this.arrows[1].setAttribute("d", heads);
    }

    /* Enlarge the view so that the motion of a run is visible; it never becomes smaller than the first one. */
    fitView(run) {
        const n = this.description.coordinates.length, box = [...this.low, ...this.high], margin = 2.6 * this.unit;
        const stride = Math.max(1, Math.floor(run.t.length / 32)), {frames, values} = this.rig.movingFrames;
        for (let i = 0; i < run.t.length; i += stride) {
            this.rig.update(run.q.subarray(i * n, (i + 1) * n), run.p);
            for (let k = 0; k < frames.length; k++) {
                const [x, y] = [values[5 * k], values[5 * k + 1]];
                if (!frames[k].point || !Number.isFinite(x + y)) continue;
                [box[0], box[1]] = [Math.min(box[0], x - margin), Math.min(box[1], y - margin)];
                [box[2], box[3]] = [Math.max(box[2], x + margin), Math.max(box[3], y + margin)];
            }
        }
        if (box.some((x, k) => x !== this.box[k])) this.setView(box);
    }
}

/* Return a number rounded to one decimal. */
function roundToTenth(x) { return Math.round(10 * x) / 10; }

/* Return the token of a part for cross-highlighting: "joint A" is joint-A; a point has that of its body. */
function makeToken(part) {
    const [kind, name = ""] = part.split(" ");
    return kind === "point" ? `body-${name.split(".")[0]}` : `${kind}-${name}`;
}
