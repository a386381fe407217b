/*
 * Keep names next to their parts without overlap, like runtime/drawing/labels.py.
 *
 * A name keeps its position relative to its part until it would overlap another name or leave the picture. Then it
 * returns to its planned position, or moves to the nearest free one, on no line if possible. Lengths are those of the
 * drawing, y down.
 */
const RINGS = [2, 6, 11, 17, 25, 35, 48, 64, 84, 110, 145, 190]; // pixels from what is named
const WAYS = [45, 0, 90, 180, 270, 135, 315, 225, ...[0, 1, 2, 3, 4, 5, 6, 7].map((k) => 22.5 + 45 * k)]
    .map((degrees) => [Math.cos(degrees * Math.PI / 180), -Math.sin(degrees * Math.PI / 180)]);

const boxed = (at, beside, [width, height]) => {
    const [x, y] = [at[0] + beside[0], at[1] + beside[1]];
    return [x - width, y - height, x + width, y + height];
};
const apart = (a, b) => a[0] >= b[2] || b[0] >= a[2] || a[1] >= b[3] || b[1] >= a[3];
const within = (a, room) => a[0] >= room[0] && a[1] >= room[1] && a[2] <= room[2] && a[3] <= room[3];

/* Update the relative position `beside` of each name {at, half, clear, planned, beside}. */
function settle(names, room, pixel, lines) {
    const taken = [];
    let found = null;
    for (const name of names) {
        const {at, half} = name, free = (beside) => {
            const box = boxed(at, beside, half);
            return within(box, room) && taken.every((one) => apart(one, box));
        };
        if (!free(name.beside))
            name.beside = free(name.planned) ? name.planned : nearest(name, free, pixel, found ??= lines()) ?? name.beside;
        taken.push(boxed(at, name.beside, half));
    }
}

/* Return the nearest free position on no line, otherwise that with the fewest crossings; null if there is none. */
function nearest({at, half, clear}, free, pixel, lines) {
    let [best, fewest] = [null, Infinity];
    for (const ring of RINGS) {
        const reach = clear + ring * pixel;
        let [own, least] = [null, Infinity];
        for (const [x, y] of WAYS) {
            const beside = [x * (reach + half[0]), y * (reach + half[1])];
            if (!free(beside)) continue;
            const hits = crossing(boxed(at, beside, half), lines);
            if (hits < least) [own, least] = [beside, hits];
        }
        if (least === 0) return own;
        if (least + 0.02 * ring < fewest) [best, fewest] = [own, least + 0.02 * ring];
    }
    return best;
}

/* Return how many segments x, y, x, y, … intersect a box (Liang and Barsky). */
function crossing([left, top, right, bottom], lines) {
    let count = 0;
    for (let i = 0; i < lines.length; i += 4) {
        const x = lines[i], y = lines[i + 1], dx = lines[i + 2] - x, dy = lines[i + 3] - y;
        let [enters, leaves] = [0, 1];
        for (const [low, high, start, way] of [[left, right, x, dx], [top, bottom, y, dy]]) {
            if (way === 0 && (start < low || start > high)) leaves = -1;
            if (way === 0) continue;
            const [one, other] = [(low - start) / way, (high - start) / way];
            enters = Math.max(enters, Math.min(one, other));
            leaves = Math.min(leaves, Math.max(one, other));
        }
        count += enters <= leaves;
    }
    return count;
}
