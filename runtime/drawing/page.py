"""Write a motion as one HTML page: drawings as SVG, a button and a slider in plain JavaScript, self-contained."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from html import escape
from typing import Any

import numpy as np

from gudgeon.drawing.labels import make_identifier, place_names
from gudgeon.drawing.roles import EDGES, NAMES, ROLES, TINTS, resolve_colour
from gudgeon.drawing.shapes import Disc, Shape, Sketch
from gudgeon.model.compiled import Array

PIXELS_PER_INCH = 100.0
Styles = dict[tuple[str, int], int]


def write_animation_page(
    title: str,
    sketches: Sequence[Sketch],
    times: Sequence[float],
    seconds: float,
    width: float,
    label_offsets: Mapping[str, tuple[float, float]],
    half_sizes: Mapping[str, Array],
) -> str:
    """Return the HTML text of an animation of a motion.

    `sketches` share one box; those at `times` (s) of the run play within `seconds`. `width` is in pixels.
    `label_offsets` are the first offsets of names from their parts in pixels, y up; names without one are left out.
    `half_sizes` are half the size of each name.
    """
    first = sketches[0]
    scale = width / float(first.high[0] - first.low[0])
    height = scale * float(first.high[1] - first.low[1])

    def to_pixels(points: Array) -> Array:
        """Return points in pixels of the SVG."""
        return (points - first.low) * [scale, -scale] + [0.0, height]

    styles: Styles = {}
    identifiers = _order_identifiers(sketches)
    frames = [_make_frame(sketch, identifiers, to_pixels, scale, styles) for sketch in sketches]
    labels = [label for label in first.labels if label.part in label_offsets]
    label_parts = [label.part for label in labels]
    offsets_by_picture = _iterate_name_offsets(sketches, label_offsets, half_sizes, scale)
    label_positions = [
        _compute_label_positions(sketch, label_parts, to_pixels, offsets)
        for sketch, offsets in zip(sketches, offsets_by_picture, strict=True)
    ]
    data = {
        "times": [round(time, 9) for time in times],
        "seconds": seconds,
        "styles": [_format_style(*key) for key in styles],
        "frames": _encode_changes(frames),
        "places": _encode_changes(label_positions),
    }
    name_elements = "".join(_format_name_element(label.text, label.role, label.part, first) for label in labels)
    path_elements = "".join(f'<path id="{name}"/>' for name in identifiers)
    notes = "<br>".join(escape(notes) for notes in first.notes)
    encoded = json.dumps(data, separators=(",", ":")).replace("<", "\\u003c")
    replacements = {
        "TITLE": escape(title),
        "NOTE": notes,
        "WIDTH": f"{width:.0f}",
        "HEIGHT": f"{height:.0f}",
        "PATHS": path_elements,
        "NAMES": name_elements,
        "DATA": encoded,
    }
    return re.sub(
        f"@({'|'.join(replacements)})@", lambda match: replacements[match[1]], PAGE
    )  # in one pass: a title may contain such a word


def _map_shapes_by_identifier(sketch: Sketch) -> dict[str, Shape]:
    """Return the shapes of a sketch by an identifier that is the same in all pictures of a motion.

    The identifier consists of the part and, from its second shape on, a number: "body-L1", "body-L1-2".
    """
    counts, shapes_by_identifier = dict[str, int](), dict[str, Shape]()
    for shape in sketch.shapes:
        k = counts[shape.part] = counts.get(shape.part, 0) + 1
        shapes_by_identifier[make_identifier("", shape.part) + (f"-{k}" if k > 1 else "")] = shape
    return shapes_by_identifier


def _order_identifiers(sketches: Sequence[Sketch]) -> list[str]:
    """Return the identifiers of all shapes that occur in any of the sketches, in the order of painting.

    Shapes of the first sketch precede others of the same order.
    """
    order = {
        name: ROLES[shape.role].order
        for sketch in reversed(sketches)
        for name, shape in _map_shapes_by_identifier(sketch).items()
    }
    first_identifiers = [name for name in _map_shapes_by_identifier(sketches[0]) if name in order]
    return sorted(
        [*first_identifiers, *(name for name in order if name not in first_identifiers)], key=lambda name: order[name]
    )


def _make_frame(sketch: Sketch, identifiers: Sequence[str], to_pixels: Any, scale: float, styles: Styles) -> list[Any]:
    """Return [path data, index of the style] for each identifier; "" for a shape that this sketch does not have.

    New styles are added to `styles`.
    """
    shapes, frame = _map_shapes_by_identifier(sketch), list[Any]()
    for name in identifiers:
        shape = shapes.get(name)
        if shape is None:
            frame.append("")
            continue
        style = styles.setdefault((shape.role, shape.colour_index % len(TINTS)), len(styles))
        frame.append([_format_path_data(shape, to_pixels, scale), style])
    return frame


def _format_path_data(shape: Shape, to_pixels: Any, scale: float) -> str:
    """Return the SVG path data of a shape, to a tenth of a pixel; `scale` is in pixels per metre."""
    if isinstance(shape, Disc):
        (x, y), r = to_pixels(shape.centre), round(shape.radius * scale, 1)  # rounded once: both arcs are half a circle
        return f"M{x - r:.1f} {y:.1f}a{r:.1f} {r:.1f} 0 1 0 {2 * r:.1f} 0a{r:.1f} {r:.1f} 0 1 0 {-2 * r:.1f} 0z"
    text = "L".join(f"{x:.1f} {y:.1f}" for x, y in to_pixels(shape.points))
    return f"M{text}{'z' if shape.closed else ''}"


def _format_style(role: str, colour_index: int) -> str:
    """Return the CSS of a role for shapes with the body colours of index `colour_index`."""
    role_style = ROLES[role]
    dashes = f";stroke-dasharray:{' '.join(f'{x:g}' for x in role_style.dashes)}" if role_style.dashes else ""
    width = role_style.width * PIXELS_PER_INCH / 72.0
    edge, face = resolve_colour(role_style.edge, colour_index), resolve_colour(role_style.face, colour_index)
    return f"stroke:{edge};fill:{face};stroke-width:{width:.2f}{dashes}"


def _iterate_name_offsets(
    sketches: Sequence[Sketch],
    label_offsets: Mapping[str, tuple[float, float]],
    half_sizes: Mapping[str, Array],
    scale: float,
) -> Iterator[Mapping[str, tuple[float, float]]]:
    """Yield the offset of each name from its part for each picture, in pixels, by part.

    `label_offsets` are those before the first picture; names without one are left out. In each picture a name keeps its
    previous offset if that is free, or if no position is. `half_sizes`: of the names, pixels; `scale`: pixels per m.
    """
    lower_corner, picture_box = sketches[0].low, scale * np.array([*np.zeros(2), *(sketches[0].high - sketches[0].low)])
    for sketch in sketches:
        labelled_sketch = replace(sketch, labels=tuple(label for label in sketch.labels if label.part in label_offsets))
        new_offsets = place_names(
            labelled_sketch,
            half_sizes,
            label_offsets,
            lambda points: scale * (np.asarray(points) - lower_corner),
            scale,
            PIXELS_PER_INCH / 72.0,
            picture_box,
        )
        label_offsets = {**label_offsets, **new_offsets}
        yield label_offsets


def _compute_label_positions(
    sketch: Sketch, parts: Sequence[str], to_pixels: Any, offsets: Mapping[str, tuple[float, float]]
) -> list[list[Any]]:
    """Return [x, y] of the middle of each name in pixels; of an inset also its text, which changes."""
    labels, positions = {label.part: label for label in sketch.labels}, list[list[Any]]()
    for part in parts:
        x, y = np.round(to_pixels(labels[part].position) + np.array(offsets[part]) * [1.0, -1.0], 1)
        positions.append([float(x), float(y), *([labels[part].text] if labels[part].role == "inset" else [])])
    return positions


def _format_name_element(label_text: str, role: str, part: str, sketch: Sketch) -> str:
    """Return the SVG text element of a name, without position, in the style of its role."""
    colour, weight = NAMES[role]
    colour_index = next((shape.colour_index for shape in sketch.shapes if shape.part == part), 0)
    colour = EDGES[colour_index % len(EDGES)] if colour == "edge" else colour
    style = "italic" if role == "joint" else "normal"
    return f'<text fill="{colour}" font-weight="{weight}" font-style="{style}">{escape(label_text)}</text>'


def _encode_changes(frames: Sequence[Sequence[Any]]) -> list[list[Any]]:
    """Delta-encode frames: return each with 0 for each entry that the previous frame has too.

    The first frame is complete.
    """
    encoded = [list(frames[0])]
    for previous, frame in zip(frames, frames[1:], strict=False):
        encoded.append([0 if old == new else new for old, new in zip(previous, frame, strict=True)])
    return encoded


PAGE = """<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width, initial-scale=1">
<title>@TITLE@</title>
<style>
body { font: 14px sans-serif; margin: 1em auto; max-width: @WIDTH@px; padding: 0 1em; color: #222; background: #fff }
svg { width: 100%; height: auto; display: block }
svg path { stroke-linejoin: round; stroke-linecap: round }
svg text { font: 11px sans-serif; text-anchor: middle; dominant-baseline: central }
.bar { display: flex; gap: .7em; align-items: center; flex-wrap: wrap }
#time { flex: 1; min-width: 8em }
output { font-variant-numeric: tabular-nums; min-width: 7em }
p { color: #555; font-size: 12px }
@media screen and (prefers-color-scheme: dark) {
  :root { color-scheme: dark }
  body { color: #e8e8ea; background: #16171a }
  p { color: #a3a3ad }
  svg { filter: invert(.92) hue-rotate(180deg) } /* dark background, light lines, the same hues */
}
</style></head><body>
<h1 dir="auto" style="font-size: 1.1em">@TITLE@</h1>
<svg viewBox="0 0 @WIDTH@ @HEIGHT@" role="img" aria-label="@TITLE@"><g>@PATHS@</g><g id="names">@NAMES@</g></svg>
<div class="bar"><button id="play">Play</button>
<input id="time" type="range" min="0" value="0" step="1" aria-label="time"><output id="time-text"></output>
<label>speed <select id="speed"><option>0.1</option><option>0.25</option><option>0.5</option>
<option selected>1</option><option>2</option></select></label>
<label><input id="show-names" type="checkbox" checked> names</label></div>
<p>@NOTE@</p>
<script type="application/json" id="data">@DATA@</script>
<script>
"use strict";
const data = JSON.parse(document.getElementById("data").textContent);
const getElement = id => document.getElementById(id);
const paths = [...document.querySelectorAll("svg path")], names = [...document.querySelectorAll("#names text")];
const slider = getElement("time"), playButton = getElement("play"), lastFrame = data.times.length - 1;
for (const frames of [data.frames, data.places]) // a 0 stands for the entry of the previous frame
  for (let k = 1; k < frames.length; k++) frames[k] = frames[k].map((x, i) => x === 0 ? frames[k - 1][i] : x);
slider.max = lastFrame;
let position = 0, isPlaying = false, previousTime = 0; // position in frames; ms
/* Show a frame: shapes, names and time. */
function showFrame(k) {
  data.frames[k].forEach((shape, i) => {
    const path = paths[i];
    path.setAttribute("d", shape ? shape[0] : "");
    if (shape) path.setAttribute("style", data.styles[shape[1]]);
  });
  data.places[k].forEach(([x, y, text], i) => {
    names[i].setAttribute("x", x);
    names[i].setAttribute("y", y);
    if (text) names[i].textContent = text;
  });
  slider.value = k;
  getElement("time-text").textContent = "t = " + data.times[k].toPrecision(5) + " s";
}
/* Advance the animation to the time `now` in ms, and request the next frame. */
function advance(now) {
  if (!isPlaying) return;
  const framesPerSecond = lastFrame / data.seconds * getElement("speed").value;
  position = (position + (now - previousTime) / 1000 * framesPerSecond) % (lastFrame + 1);
  previousTime = now;
  showFrame(Math.floor(position));
  requestAnimationFrame(advance);
}
playButton.onclick = () => {
  isPlaying = !isPlaying;
  playButton.textContent = isPlaying ? "Pause" : "Play";
  if (isPlaying) requestAnimationFrame(now => { previousTime = now; advance(now); });
};
slider.oninput = () => { position = +slider.value; showFrame(position); };
const showNames = getElement("show-names");
showNames.onchange = () => { getElement("names").style.display = showNames.checked ? "" : "none"; };
showFrame(0);
if (!matchMedia("(prefers-reduced-motion: reduce)").matches) playButton.click();
</script></body></html>
"""
