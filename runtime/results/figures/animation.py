"""Write a run as an animation: a GIF, an MP4 video, or an HTML page that plays (drawing/page.py)."""

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

from gudgeon.drawing.labels import NameLabels
from gudgeon.drawing.layout import make_layout
from gudgeon.drawing.page import PIXELS_PER_INCH, write_animation_page
from gudgeon.drawing.picture import STYLE, compute_figure_size, draw_sketch
from gudgeon.drawing.roles import EDGES, ROLES, TINTS
from gudgeon.drawing.sketch import compute_common_box, make_sketch
from gudgeon.errors import BadValueError, GudgeonError, OutputError
from gudgeon.files.writing import check_output_path, convert_os_errors, write_bytes, write_text
from gudgeon.language.argument_checks import check_callable, check_flag, check_number, check_path, raise_bad_value
from gudgeon.language.text_output import format_one_line
from gudgeon.results.figures.configurations import compute_configuration, select_configurations
from gudgeon.results.figures.mechanism_plots import (
    build_path_lines,
    check_points,
    draw_requested_arrows,
    find_contacts_at_configuration,
)
from gudgeon.results.figures.plots import format_caption

import matplotlib  # isort: skip  (labels.py says where it is missing)
from matplotlib.animation import PillowWriter  # isort: skip
from matplotlib.figure import Figure  # isort: skip

if TYPE_CHECKING:
    from gudgeon.drawing.shapes import Sketch
    from gudgeon.integrators.trajectory import Progress
    from gudgeon.results.results import Result

SUFFIXES = (".gif", ".mp4", ".html")
N_COLOURS, STRIPE_PIXELS = 128, 6  # of a GIF palette; height of the stripe of a colour from which it is computed
MAX_TITLE = 60  # characters of a title, next to which the time fits
DEFAULT_RATE, MAX_PICTURES = 25.0, 1000  # frames per second; frames of an animation
CONTACT_NOTE = "red journal or corner: in contact now; red bearing or wall: touched since the picture before"
MIN_REAL_TIME, MAX_REAL_TIME = 2.0, 20.0  # s, durations of runs that play in real time
DEFAULT_DURATION = 6.0  # s, of the animation of a shorter or longer run


@dataclass(frozen=True)
class Animation:
    """An HTML page that plays the run; a notebook displays it at the end of a cell."""

    html: str
    width: float
    height: float

    def __repr__(self) -> str:
        """Return the size of the page in one line."""
        return f"<Animation: a page of {len(self.html) / 1e3:.0f} kB; a notebook displays it>"

    def _repr_html_(self) -> str:
        """Return an iframe that contains the page."""
        size = f'width="{self.width + 60:.0f}" height="{self.height + 170:.0f}"'
        return f'<iframe {size} style="border: 0" srcdoc="{escape(self.html)}"></iframe>'


@dataclass(frozen=True)
class AnimationOptions:
    """Checked options of an animation: times of the run (s), duration (s), points with paths, arrows."""

    times: Any
    seconds: float
    points: Sequence[str]
    velocities: bool
    forces: bool
    progress: Progress | None = None


def check_animation_options(
    run: Result, seconds: Any, rate: Any, points: Any, velocities: Any, forces: Any, progress: Any = None
) -> AnimationOptions:
    """Return the checked options of an animation, with evenly spaced times (s) of its pictures.

    `seconds` None: the duration of the run, or DEFAULT_DURATION if that is below MIN_REAL_TIME or above MAX_REAL_TIME.
    Raises BadValueError for options out of range or over MAX_PICTURES pictures, UnknownNameError for a point.
    """
    duration = float(run.t[-1] - run.t[0])
    seconds = (
        (duration if MIN_REAL_TIME <= duration <= MAX_REAL_TIME else DEFAULT_DURATION)
        if seconds is None
        else check_number(seconds, "seconds")
    )
    rate = check_number(rate, "rate")
    if not (seconds > 0.0 and rate > 0.0):
        raise BadValueError(f"seconds {seconds:g}, rate {rate:g}: expected numbers above 0")
    n_pictures = max(2, round(seconds * rate))
    if n_pictures > MAX_PICTURES:
        hint = "choose fewer seconds or a lower rate"
        raise BadValueError(f"{n_pictures} pictures: expected at most {MAX_PICTURES}", hint=hint)
    times = np.linspace(float(run.t[0]), float(run.t[-1]), n_pictures)
    arrows = check_flag(velocities, "velocities"), check_flag(forces, "forces")
    return AnimationOptions(times, seconds, check_points(run, [points]), *arrows, check_callable(progress, "progress"))


def write_animation(run: Result, target: Any, options: AnimationOptions) -> Animation | None:
    """Write an animation as x.gif, x.mp4 or x.html; return an Animation for a page or if `target` is None, else None.

    Raises BadValueError for another name, GudgeonError if ffmpeg is missing, OutputError if writing fails.
    """
    if target is None:
        return _build_animation(run, options)
    file = Path(check_path(target, "the file of an animation"))
    suffix = file.suffix.lower()
    if suffix not in SUFFIXES or os.fspath(target).endswith(os.sep):
        raise_bad_value("the file of an animation", os.fspath(target), "a name that ends in .gif, .mp4 or .html")
    if suffix == ".mp4" and shutil.which("ffmpeg") is None:
        message = f"{file}: an mp4 file needs the program ffmpeg, which was not found"
        raise GudgeonError(f"{message}\n  install it, or write a .gif or .html file")
    check_output_path(file)
    if suffix == ".html":
        animation = _build_animation(run, options)
        write_text(file, animation.html)
        return animation
    try:
        with convert_os_errors(file):  # errors in the temporary folder
            video_bytes = _encode_video(run, options, suffix)
    except subprocess.CalledProcessError as error:
        raise OutputError(file, f"ffmpeg ended with {error.returncode}") from error
    write_bytes(file, video_bytes)
    return None


def draw_sketches(run: Result, options: AnimationOptions) -> Iterator[Sketch]:
    """Yield the drawing of each picture of an animation, all in one box and to one scale, and report the progress.

    Arrows are drawn if `options` requests them. Joints in contact, and those that were since the previous picture, are
    marked; a note explains the marks.
    """
    motion = select_configurations(run, 60)
    layout = make_layout(motion)
    box, paths = compute_common_box(motion, [layout]), build_path_lines(run, options.points)
    previous_time = options.times[0]
    for k, t in enumerate(options.times):
        if options.progress:
            options.progress(k / len(options.times), f"picture {k + 1} of {len(options.times)}")
        configuration = compute_configuration(run, float(t))
        scaled_layout, arrows = draw_requested_arrows(
            run, configuration, motion, layout, options.velocities, options.forces
        )
        sketch = make_sketch(
            configuration,
            scaled_layout,
            shapes_on_top=paths,
            arrows=arrows,
            contact_names=find_contacts_at_configuration(run, configuration),
            earlier_contact_names=find_contacts_between(run, previous_time, t),
            box=box,
            shows_zero_loads=False,
        )
        yield replace(sketch, notes=(*sketch.notes, CONTACT_NOTE)) if sketch.notes else sketch
        previous_time = t


def find_contacts_between(run: Result, begin: float, end: float) -> frozenset[str]:
    """Return the joints and slider corners with play that were in contact between two times (s), by name.

    Both impacts and stored contact states count, since an impact may be shorter than a picture.
    """
    names = [joint.name for joint in run.source.clearances]
    end_times = np.where(np.isnan(run.impacts["t_off"]), np.inf, run.impacts["t_off"])
    indices_in_contact = run.impacts["joint"][(run.impacts["t_on"] <= end) & (end_times >= begin)]
    states = run.state[(run.t >= begin) & (run.t <= end)]
    return frozenset(name for k, name in enumerate(names) if k in indices_in_contact or (states[:, k] > 0).any())


def _format_caption(run: Result, t: float, options: AnimationOptions) -> str:
    """Return the caption of a picture: mechanism, scene, time, and the factor of slow or fast motion."""
    slowdown = options.seconds / float(run.t[-1] - run.t[0]) if run.t[-1] > run.t[0] else 1.0
    speed_text = f", {slowdown:.3g} times slower" if slowdown > 1.0 else f", {1 / slowdown:.3g} times faster"
    title = textwrap.shorten(format_caption(run), MAX_TITLE, placeholder="…")
    return f"{title}, t = {t:.4f} s{speed_text if abs(slowdown - 1.0) > 1e-9 else ''}"


def _build_animation(run: Result, options: AnimationOptions) -> Animation:
    """Return the Animation of an HTML page.

    matplotlib places the names in the first picture. Each then has the same offset from its part until it would overlap
    another.
    """
    sketch_list = list(draw_sketches(run, options))
    figure, name_artist = _build_sketch_figure(sketch_list[0], _format_caption(run, options.times[0], options))
    offsets = _compute_name_offsets(figure, name_artist)
    half_sizes = (
        {part: 0.5 * (np.array(box[2:]) - box[:2]) for part, box in name_artist.boxes.items()} if name_artist else {}
    )
    width = float(figure.get_size_inches()[0]) * PIXELS_PER_INCH
    title = format_one_line(f"{run.source.title or run.source.mechanism}: {run.source.scene}")
    text = write_animation_page(
        title, sketch_list, [float(t) for t in options.times], options.seconds, width, offsets, half_sizes
    )
    return Animation(text, width, width * float(np.divide(*(sketch_list[0].high - sketch_list[0].low)[::-1])))


def _build_sketch_figure(sketch: Sketch, caption: str) -> tuple[Figure, NameLabels | None]:
    """Return a figure of the sketch with a caption (PIXELS_PER_INCH dpi), and its names; None without names."""
    width, height = compute_figure_size(sketch, 7.0)
    figure = Figure(figsize=(width, height + 0.3), dpi=PIXELS_PER_INCH)
    ax = figure.add_axes((0.0, 0.0, 1.0, height / (height + 0.3)))
    draw_sketch(ax, sketch)
    figure.text(0.01, 0.99, caption, va="top", fontsize=9, parse_math=False)
    return figure, next((artist for artist in ax.get_children() if isinstance(artist, NameLabels)), None)


def _compute_name_offsets(figure: Figure, name_labels: NameLabels | None) -> dict[str, tuple[float, float]]:
    """Lay out a figure and return the offsets of its names from their parts; {} without names."""
    figure.draw_without_rendering()
    return name_labels.label_offsets if name_labels is not None else {}


class _GifWriter(PillowWriter):
    """Writer of GIF files with one palette for all frames, so that unchanged areas are compressed well."""

    _frames: list[Any]
    _palette: Any

    def grab_frame(self, **options: Any) -> None:
        """Add the figure as a frame, reduced to the palette of the first frame.

        That palette contains every colour of a drawing, also the red of contacts. matplotlib calls the method with
        options of savefig.
        """
        super().grab_frame(**options)
        image = self._frames[-1].convert("RGB")
        if len(self._frames) == 1:
            self._palette = _append_colour_stripes(image).quantize(N_COLOURS)
        self._frames[-1] = image.quantize(palette=self._palette, dither=0)


def _append_colour_stripes(image: Any) -> Any:
    """Return a Pillow image with a stripe of each colour of drawings below it, from which a palette is computed."""
    colour_codes = [
        *TINTS,
        *EDGES,
        *(word for role in ROLES.values() for word in (role.edge, role.face) if word[:1] == "#"),
    ]
    width, height = image.size
    unique_codes = list(dict.fromkeys(colour_codes))
    extended_image = image.crop((0, 0, width, height + STRIPE_PIXELS * len(unique_codes)))
    for k, code in enumerate(unique_codes):
        colour = tuple(round(255 * component) for component in matplotlib.colors.to_rgb(code))
        extended_image.paste(colour, (0, height + STRIPE_PIXELS * k, width, height + STRIPE_PIXELS * (k + 1)))
    return extended_image


def _encode_video(run: Result, options: AnimationOptions, suffix: str) -> bytes:
    """Return the bytes of a GIF or MP4 file, written by matplotlib into a temporary directory.

    `suffix` is ".gif" or ".mp4". Names keep their offsets from the previous picture if these are free. Raises
    CalledProcessError if ffmpeg fails.
    """
    from matplotlib.animation import FFMpegWriter

    rate: Any = (len(options.times) - 1) / options.seconds
    writer: Any = _GifWriter(fps=rate) if suffix == ".gif" else FFMpegWriter(fps=rate, codec="libx264")
    offsets: dict[str, tuple[float, float]] = {}
    with matplotlib.rc_context(STYLE), tempfile.TemporaryDirectory() as directory:
        file = os.path.join(directory, f"film{suffix}")
        for t, sketch in zip(options.times, draw_sketches(run, options), strict=True):
            figure, name_artist = _build_sketch_figure(sketch, _format_caption(run, float(t), options))
            if name_artist is not None:
                name_artist.previous_offsets = offsets
            offsets = _compute_name_offsets(figure, name_artist)
            if t == options.times[0]:
                writer.setup(figure, file, PIXELS_PER_INCH)
            writer.fig = figure
            writer.grab_frame()
        writer.finish()
        return Path(file).read_bytes()
