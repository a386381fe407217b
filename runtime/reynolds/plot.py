"""Draw a film, unrolled and around the journal, and the map of a law's deviation."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from gudgeon.language.plot_units import choose_prefix
from gudgeon.results.figures.plots import COLOURS, IDEAL, STYLE
from gudgeon.reynolds.bearing import Film

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from gudgeon.reynolds.deviations import Deviation

DRAWN_CLEARANCE, DRAWN_PRESSURE = 0.25, 0.8  # drawn clearance and largest pressure, over the bearing's radius


def draw_film(film: Film) -> Figure:
    """Return a figure of a film: left a map of p(φ, z), right the middle plane with journal, pressure and force.

    In the middle plane the gap is not to scale.
    """
    import matplotlib
    from matplotlib.figure import Figure

    factor, unit = choose_prefix(float(film.pressure.max(initial=0.0)), "Pa")
    with matplotlib.rc_context(STYLE):
        figure = Figure(figsize=(10, 4.2), dpi=120, layout="constrained")
        left, right = figure.subplots(1, 2, width_ratios=(1.7, 1.0))
        _draw_pressure_map(left, film, factor, unit)
        _draw_middle_plane(right, film)
        figure.suptitle(_format_title(film), fontsize=11, x=0.012, ha="left")
    return figure


def _format_title(film: Film) -> str:
    """Return the title: cavitation condition, ratios, force with its error, attitude angle, leakage."""
    force, attitude = math.hypot(*film.force), math.degrees(film.attitude)
    return (
        f"{film.cavitation}, L/D = {film.bearing.l_over_d:.3g}, ε = {film.eccentricity_ratio:.3g}: "
        f"{force:.4g} N ± {film.error:.1g} N, attitude {attitude:.1f}°, leakage {film.leakage * 1e6:.3g} ml/s"
    )


def _draw_pressure_map(ax: Axes, film: Film, factor: float, unit: str) -> None:
    """Draw the pressure over angle and axial position, with the edge of the film, the thinnest film and the groove.

    factor, unit: factor from Pa to the unit that is shown, and its name. The edge of the film is the boundary of p > 0.
    The first angle is repeated after the last.
    """
    angle = np.degrees(np.append(film.angle, film.angle[0] + 2.0 * math.pi))
    p = np.concatenate([film.pressure, film.pressure[:1]]) * factor
    from matplotlib.ticker import MaxNLocator, MultipleLocator

    length_factor, length_unit = choose_prefix(film.bearing.length, "m")
    z = film.z * length_factor
    if p.any():
        contours = ax.contourf(angle, z, p.T, np.linspace(0.0, p.max(), 21), cmap="viridis")
        bar = ax.figure.colorbar(contours, ax=ax, ticks=MaxNLocator(6))
        bar.set_label(f"p in {unit}")
        ax.contour(angle, z, np.where(p > 0.0, 1.0, 0.0).T, [0.5], colors="white", linewidths=0.9)
    if any(film.eccentricity):
        _mark_thinnest_film(ax, film, angle[0])
    if film.groove is not None:
        ax.axvline(angle[0], color=COLOURS[5], lw=3.0, label="groove")
        ax.legend(loc="lower left", fontsize=8, frameon=True)
    ax.set(xlabel="direction from the bearing's centre in °", ylabel=f"z in {length_unit}")
    ax.set(xlim=(angle[0], angle[-1]), ylim=(z[0], z[-1]))
    ax.xaxis.set_major_locator(MultipleLocator(60.0))
    ax.xaxis.set_major_formatter(lambda x, _: f"{(x + 180.0) % 360.0 - 180.0:g}".replace("-", "−"))
    ax.grid(False)


def _mark_thinnest_film(ax: Axes, film: Film, first_angle: float) -> None:
    """Mark the direction of the thinnest film by a line, within one turn from the angle `first_angle` (degrees)."""
    thinnest = math.degrees(math.atan2(film.eccentricity[1], film.eccentricity[0]))
    thinnest += 360.0 * math.ceil((first_angle - thinnest) / 360.0)
    ax.axvline(thinnest, color=COLOURS[0], lw=1.0, ls="--", label="thinnest film")
    ax.legend(loc="lower left", fontsize=8, frameon=True)


def _draw_middle_plane(ax: Axes, film: Film) -> None:
    """Draw bearing, journal, pressure around the bearing, and force on the journal in the middle plane, not to
    scale.
    """
    angles = np.linspace(0.0, 2.0 * math.pi, 361)
    ax.plot(np.cos(angles), np.sin(angles), color="#777777", lw=1.2)
    x, y = np.array(film.eccentricity) / film.bearing.clearance * DRAWN_CLEARANCE
    ax.fill(
        x + (1.0 - DRAWN_CLEARANCE) * np.cos(angles),
        y + (1.0 - DRAWN_CLEARANCE) * np.sin(angles),
        facecolor="#e8e8e8",
        edgecolor="#777777",
    )
    p = film.pressure[:, film.pressure.shape[1] // 2]
    closed_pressure, closed_angle = np.append(p, p[0]), np.append(film.angle, film.angle[0])
    if p.any():
        radii = 1.0 + DRAWN_PRESSURE * closed_pressure / p.max()
        outline = np.concatenate([radii * np.exp(1j * closed_angle), np.exp(1j * closed_angle[::-1])])
        ax.fill(outline.real, outline.imag, facecolor=COLOURS[1], alpha=0.35, lw=0)
        ax.plot(radii * np.cos(closed_angle), radii * np.sin(closed_angle), color=COLOURS[1], lw=1.0)
        tip = np.array([x, y]) + 0.65 * film.force / math.hypot(*film.force)
        style = {"arrowstyle": "-|>", "color": COLOURS[0], "lw": 1.6}
        ax.annotate("", (float(tip[0]), float(tip[1])), (x, y), arrowprops=style)
    ax.plot([0.0], [0.0], "+", color="#777777", ms=6)
    ax.plot([x], [y], "o", color=IDEAL, ms=3)
    half_width = 1.05 + DRAWN_PRESSURE
    ax.set(xlim=(-half_width, half_width), ylim=(-half_width, half_width), aspect="equal", xticks=[], yticks=[])
    ax.set_title("pressure in the middle plane")
    ax.spines[:].set_visible(False)
    ax.grid(False)


def draw_deviation_map(deviation: Deviation, ax: Axes | None) -> Axes:
    """Draw a map of the deviation in percent over ε and the direction of motion on `ax`, None for new axes; return the
    axes.

    The darkest colour is open-ended.
    """
    import matplotlib
    from matplotlib.figure import Figure

    with matplotlib.rc_context(STYLE):
        axes = Figure(figsize=(5.2, 3.8), dpi=120, layout="constrained").subplots() if ax is None else ax
        levels = (0.0, 1.0, 3.0, 10.0, 30.0, 100.0, 300.0)
        percentages, angles = 100.0 * deviation.share.T, np.degrees(deviation.motion)
        norm = matplotlib.colors.BoundaryNorm(levels, 256, extend="max")
        mesh = axes.pcolormesh(deviation.eps, angles, percentages, norm=norm, cmap="YlOrRd", shading="nearest")
        bar = axes.figure.colorbar(mesh, ax=axes, extend="max")
        bar.set_label("deviation in % of the largest force at ε")
        axes.set(xlabel="ε", title=f"{deviation.law} against {deviation.cavitation}, L/D = {deviation.l_over_d:g}")
        axes.set_yticks((0.0, 45.0, 90.0, 135.0, 180.0), ("closes", "45°", "turns", "135°", "opens"))
        axes.grid(False)
    return axes
