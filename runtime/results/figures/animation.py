"""Write a run as an animation: a GIF, a film, or an HTML page that plays (drawing/page.py)."""

from __future__ import annotations

import os
import shutil
import subprocess
import tempfile
import textwrap
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from html import escape
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from gudgeon.drawing.labels import Names
from gudgeon.drawing.page import PIXELS, page
from gudgeon.drawing.picture import STYLE, draw_on, size_of
from gudgeon.drawing.plan import make_plan
from gudgeon.drawing.roles import EDGES, ROLES, TINTS
from gudgeon.drawing.sketch import make_sketch, room_of_all
from gudgeon.errors import BadValueError, GudgeonError, OutputError
from gudgeon.files.writing import check_target, telling, write_bytes, write_text
from gudgeon.language.argument_checks import flag, function, number_of, path, refuse
from gudgeon.language.shown import one_line
from gudgeon.results.figures.mechanism_plots import arrows_of, path_lines, points_of, touching_at
from gudgeon.results.figures.plots import caption_of
from gudgeon.results.figures.postures import posture_at, postures_of

import matplotlib  # isort: skip  (labels.py says where it is missing)
from matplotlib.animation import PillowWriter  # isort: skip
from matplotlib.figure import Figure  # isort: skip

if TYPE_CHECKING:
    from gudgeon.drawing.shapes import Sketch
    from gudgeon.integrators.trajectory import Progress
    from gudgeon.results.results import Result

SUFFIXES = (".gif", ".mp4", ".html")
COLOURS, STRIPE = 128, 6  # of a GIF; pixels, by which a colour of the drawing counts for its palette
NAMED = 60  # characters of a title, next to which the time fits
RATE, LONGEST = 25.0, 1000  # pictures a second, and pictures in all
RED = "red journal or corner: in contact now; red bearing or wall: touched since the picture before"
SLOW, QUICK, SHOWN = 2.0, 20.0, 6.0  # s: runs shorter than SLOW or longer than QUICK play in SHOWN seconds


@dataclass(frozen=True)
class Animation:
    """An HTML page that plays the run; a notebook displays it at the end of a cell."""

    html: str
    width: float
    height: float

    def __repr__(self) -> str:
        """Return the size of the page in one line."""
        return f"<Animation: a page of {len(self.html) / 1e3:.0f} kB; a notebook shows it>"

    def _repr_html_(self) -> str:
        """Return an iframe that contains the page."""
        size = f'width="{self.width + 60:.0f}" height="{self.height + 170:.0f}"'
        return f'<iframe {size} style="border: 0" srcdoc="{escape(self.html)}"></iframe>'


@dataclass(frozen=True)
class Expected:
    """Checked options of an animation: times of the run (s), duration (s), points with paths, arrows."""

    times: Any
    seconds: float
    points: Sequence[str]
    velocities: bool
    forces: bool
    progress: Progress | None = None


def check_animation_options(
    run: Result, seconds: Any, rate: Any, points: Any, velocities: Any, forces: Any, progress: Any = None
) -> Expected:
    """Return the checked options of an animation. Raises BadValueError, UnknownNameError."""
    span = float(run.t[-1] - run.t[0])
    seconds = (span if SLOW <= span <= QUICK else SHOWN) if seconds is None else number_of(seconds, "seconds")
    rate = number_of(rate, "rate")
    if not (seconds > 0.0 and rate > 0.0):
        raise BadValueError(f"seconds {seconds:g}, rate {rate:g}: expected numbers above 0")
    count = max(2, round(seconds * rate))
    if count > LONGEST:
        hint = "ask for fewer seconds, or a lower rate"
        raise BadValueError(f"{count} pictures: expected at most {LONGEST}", hint=hint)
    times = np.linspace(float(run.t[0]), float(run.t[-1]), count)
    arrows = flag(velocities, "velocities"), flag(forces, "forces")
    return Expected(times, seconds, points_of(run, [points]), *arrows, function(progress, "progress"))


def animate(run: Result, target: Any, options: Expected) -> Animation | None:
    """Write x.gif, x.mp4 or x.html; return an Animation for a page or if `target` is None."""
    if target is None:
        return _build_page(run, options)
    file = Path(path(target, "the file of an animation"))
    kind = file.suffix.lower()
    if kind not in SUFFIXES or os.fspath(target).endswith(os.sep):
        refuse("the file of an animation", os.fspath(target), "a name that ends in .gif, .mp4 or .html")
    if kind == ".mp4" and shutil.which("ffmpeg") is None:
        message = f"{file}: a film needs the program ffmpeg, which is not there"
        raise GudgeonError(f"{message}\n  install it, or name a .gif or .html")
    check_target(file)
    if kind == ".html":
        shown = _build_page(run, options)
        write_text(file, shown.html)
        return shown
    try:
        with telling(file):  # a folder of its own, and what is written there first
            film = _write_film(run, options, kind)
    except subprocess.CalledProcessError as error:
        raise OutputError(file, f"ffmpeg ended with {error.returncode}") from error
    write_bytes(file, film)
    return None


def sketches(run: Result, options: Expected) -> Iterator[Sketch]:
    """Yield the drawing of each picture, all in one box."""
    motion = postures_of(run, 60)
    plan = make_plan(motion)
    box, lines = room_of_all(motion, [plan]), path_lines(run, options.points)
    before = options.times[0]
    for k, t in enumerate(options.times):
        if options.progress:
            options.progress(k / len(options.times), f"picture {k + 1} of {len(options.times)}")
        posture = posture_at(run, float(t))
        to_scale, arrows = arrows_of(run, posture, motion, plan, options.velocities, options.forces)
        drawn = make_sketch(
            posture,
            to_scale,
            more=lines,
            arrows=arrows,
            touching=touching_at(run, posture),
            touched=touching_between(run, before, t),
            box=box,
            still=False,
        )
        yield replace(drawn, notes=(*drawn.notes, RED)) if drawn.notes else drawn
        before = t


def touching_between(run: Result, begin: float, end: float) -> frozenset[str]:
    """Return the joints with play whose surfaces met between two times.

    An impact may be shorter than a picture.
    """
    names = [joint.name for joint in run.source.clearances]
    ends = np.where(np.isnan(run.impacts["t_off"]), np.inf, run.impacts["t_off"])
    met = run.impacts["joint"][(run.impacts["t_on"] <= end) & (ends >= begin)]
    inside = run.state[(run.t >= begin) & (run.t <= end)]
    return frozenset(name for k, name in enumerate(names) if k in met or (inside[:, k] > 0).any())


def _caption(run: Result, t: float, options: Expected) -> str:
    """Return the caption of a picture: mechanism, scene, time and the ratio of speeds."""
    slow = options.seconds / float(run.t[-1] - run.t[0]) if run.t[-1] > run.t[0] else 1.0
    speed_text = f", {slow:.3g} times slower" if slow > 1.0 else f", {1 / slow:.3g} times faster"
    title = textwrap.shorten(caption_of(run), NAMED, placeholder="…")
    return f"{title}, t = {t:.4f} s{speed_text if abs(slow - 1.0) > 1e-9 else ''}"


def _build_page(run: Result, options: Expected) -> Animation:
    """Return the Animation of an HTML page.

    matplotlib places the names once; each then keeps its offset from its part until it would overlap another.
    """
    drawn = list(sketches(run, options))
    picture, names = _draw_canvas(drawn[0], _caption(run, options.times[0], options))
    offsets = _name_offsets(picture, names)
    halves = {part: 0.5 * (np.array(box[2:]) - box[:2]) for part, box in names.boxes.items()} if names else {}
    width = float(picture.get_size_inches()[0]) * PIXELS
    title = one_line(f"{run.source.title or run.source.mechanism}: {run.source.scene}")
    text = page(title, drawn, [float(t) for t in options.times], options.seconds, width, offsets, halves)
    return Animation(text, width, width * float(np.divide(*(drawn[0].high - drawn[0].low)[::-1])))


def _draw_canvas(sketch: Sketch, caption: str) -> tuple[Figure, Names | None]:
    """Return a figure of the sketch at PIXELS per inch, and its placed names."""
    width, height = size_of(sketch, 7.0)
    picture = Figure(figsize=(width, height + 0.3), dpi=PIXELS)
    ax = picture.add_axes((0.0, 0.0, 1.0, height / (height + 0.3)))
    draw_on(ax, sketch)
    picture.text(0.01, 0.99, caption, va="top", fontsize=9, parse_math=False)
    return picture, next((artist for artist in ax.get_children() if isinstance(artist, Names)), None)


def _name_offsets(picture: Figure, names: Names | None) -> dict[str, tuple[float, float]]:
    """Return the offsets of the placed names after the layout of a figure."""
    picture.draw_without_rendering()
    return names.beside if names is not None else {}


class _GifWriter(PillowWriter):
    """Writer of GIF files with one palette, so that flat areas stay flat and only moving parts need space."""

    _frames: list[Any]
    _palette: Any

    def grab_frame(self, **savefig: Any) -> None:
        """Add the figure as a frame. The palette of the first frame contains every colour of a drawing, also the red of
        contacts.
        """
        super().grab_frame(**savefig)
        picture = self._frames[-1].convert("RGB")
        if len(self._frames) == 1:
            self._palette = _with_swatches(picture).quantize(COLOURS)
        self._frames[-1] = picture.quantize(palette=self._palette, dither=0)


def _with_swatches(picture: Any) -> Any:
    """Return a Pillow image with a stripe of each colour of drawings below it."""
    names = [*TINTS, *EDGES, *(word for role in ROLES.values() for word in (role.edge, role.face) if word[:1] == "#")]
    width, height = picture.size
    stripes = list(dict.fromkeys(names))
    more = picture.crop((0, 0, width, height + STRIPE * len(stripes)))
    for k, name in enumerate(stripes):
        colour = tuple(round(255 * share) for share in matplotlib.colors.to_rgb(name))
        more.paste(colour, (0, height + STRIPE * k, width, height + STRIPE * (k + 1)))
    return more


def _write_film(run: Result, options: Expected, suffix: str) -> bytes:
    """Return the bytes of a GIF or film, written by matplotlib into a temporary folder."""
    from matplotlib.animation import FFMpegWriter

    rate: Any = (len(options.times) - 1) / options.seconds
    writer: Any = _GifWriter(fps=rate) if suffix == ".gif" else FFMpegWriter(fps=rate, codec="libx264")
    offsets: dict[str, tuple[float, float]] = {}
    with matplotlib.rc_context(STYLE), tempfile.TemporaryDirectory() as folder:
        file = os.path.join(folder, f"film{suffix}")
        for t, sketch in zip(options.times, sketches(run, options), strict=True):
            picture, names = _draw_canvas(sketch, _caption(run, float(t), options))
            if names is not None:
                names.held = offsets
            offsets = _name_offsets(picture, names)
            if t == options.times[0]:
                writer.setup(picture, file, PIXELS)
            writer.fig = picture
            writer.grab_frame()
        writer.finish()
        return Path(file).read_bytes()
