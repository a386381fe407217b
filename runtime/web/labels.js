/*
 * Place the names of parts next to them without overlap, as runtime/drawing/labels.py does.
 *
 * A name keeps its offset from its part until it would overlap another name or leave the picture. Then it returns to
 * its planned offset, or moves to the nearest free position, on no line if possible. Lengths are in pixels of the
 * drawing, y down; boxes are [left, top, right, bottom].
 */
const RINGS = [2, 6, 11, 17, 25, 35, 48, 64, 84, 110, 145, 190]; // pixels of the screen from the named part
const DIRECTIONS = [45, 0, 90, 180, 270, 135, 315, 225, ...[0, 1, 2, 3, 4, 5, 6, 7].map((k) => 22.5 + 45 * k)]
    .map((degrees) => [Math.cos(degrees * Math.PI / 180), -Math.sin(degrees * Math.PI / 180)]);

/* Return the box of a name of half its width and height, at an offset from its anchor. */
const computeBox = (anchor, offset, [halfWidth, halfHeight]) => {
    const [x, y] = [anchor[0] + offset[0], anchor[1] + offset[1]];
    return [x - halfWidth, y - halfHeight, x + halfWidth, y + halfHeight];
};

/* Return whether two boxes do not overlap. */
const areDisjoint = (a, b) => a[0] >= b[2] || b[0] >= a[2] || a[1] >= b[3] || b[1] >= a[3];

/* Return whether box a is within box b. */
const isWithin = (a, b) => a[0] >= b[0] && a[1] >= b[1] && a[2] <= b[2] && a[3] <= b[3];

/*
 * Update the offset of each label {anchor, halfSize, clearance, plannedOffset, offset}.
 *
 * clearance: radius of the part around the anchor. pictureBox: box of the drawing. pixelSize: size of a pixel of the
 * screen. `collectSegments()` returns all lines as segments x, y, x, y, …; it is called if a label has to move.
 */
function placeLabels(labels, pictureBox, pixelSize, collectSegments) {
    const occupiedBoxes = [];
    let segments = null;
    for (const label of labels) {
        const {anchor, halfSize, plannedOffset} = label, isFree = (offset) => {
            const box = computeBox(anchor, offset, halfSize);
            return isWithin(box, pictureBox) && occupiedBoxes.every((other) => areDisjoint(other, box));
        };
        if (!isFree(label.offset)) {
            label.offset = isFree(plannedOffset) ? plannedOffset
                : findBestOffset(label, isFree, pixelSize, segments ??= collectSegments()) ?? label.offset;
        }
        occupiedBoxes.push(computeBox(anchor, label.offset, halfSize));
    }
}

/* Return the nearest free offset on no line, otherwise that with the fewest crossings; null if no one is free. */
function findBestOffset({anchor, halfSize, clearance}, isFree, pixelSize, segments) {
    let [best, lowestCost] = [null, Infinity];
    for (const ring of RINGS) {
        const radius = clearance + ring * pixelSize;
        let [bestOnRing, fewest] = [null, Infinity];
        for (const [x, y] of DIRECTIONS) {
            const offset = [x * (radius + halfSize[0]), y * (radius + halfSize[1])];
            if (!isFree(offset)) continue;
            const crossings = countCrossings(computeBox(anchor, offset, halfSize), segments);
            if (crossings < fewest) [bestOnRing, fewest] = [offset, crossings];
        }
        if (fewest === 0) return bestOnRing;
        if (fewest + 0.02 * ring < lowestCost) [best, lowestCost] = [bestOnRing, fewest + 0.02 * ring];
    }
    return best;
}

/* Return how many segments x, y, x, y, … intersect a box (Liang and Barsky, 1984). */
function countCrossings([left, top, right, bottom], segments) {
    let count = 0;
    for (let i = 0; i < segments.length; i += 4) {
        const x = segments[i], y = segments[i + 1], dx = segments[i + 2] - x, dy = segments[i + 3] - y;
        let [entry, exit] = [0, 1]; // fractions of the segment at which it enters and leaves the box
        for (const [low, high, start, change] of [[left, right, x, dx], [top, bottom, y, dy]]) {
            if (change === 0 && (start < low || start > high)) exit = -1;
            if (change === 0) continue;
            const [a, b] = [(low - start) / change, (high - start) / change];
            entry = Math.max(entry, Math.min(a, b));
            exit = Math.min(exit, Math.max(a, b));
        }
        count += entry <= exit;
    }
    return count;
}
