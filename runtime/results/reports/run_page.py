"""Build the report of a run as an HTML page and as text, from the same table rows."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from html import escape
from typing import TYPE_CHECKING, Any

import numpy as np

from gudgeon.language.plot_units import format_quantity
from gudgeon.language.text_output import escape_invisible, format_one_line
from gudgeon.results.figures import joint_curves
from gudgeon.results.reports.html_page import Section, build_page, build_paragraphs, build_table
from gudgeon.results.reports.run_report import NOT_REQUESTED

if TYPE_CHECKING:
    from gudgeon.results.results import Result

ORBIT_SIZE, MAX_POINTS = 260, 6000  # width of an orbit's figure in pixels, points of its path
Rows = list[tuple[str, str]]


def build_report_page(run: Result, report: Mapping[str, Any]) -> str:
    """Return the report as a complete HTML file."""
    return build_page(_format_title(report), _describe_run(report), build_sections(run, report))


def build_sections(run: Result, report: Mapping[str, Any]) -> Iterator[Section]:
    """Yield (heading, HTML) of each section of the report: warnings, guides, joints, energy, accuracy, laws.

    A section without content has an empty HTML text. `report` has the values of RunReport.
    """
    yield "What to know", build_paragraphs(report["warnings"], "g-warning")
    for name, guide in report["guides"].items():
        yield f"Guide {name}", build_table(("", ""), build_guide_rows(guide, report["trust"]["asked"]))
    for name, joint in report["joints"].items():
        orbit_element = "" if "." in name else draw_orbit_svg(run, name)  # of a journal, no corner of a slider
        content = (
            f"{orbit_element}<div>{build_table(('', ''), build_joint_rows(joint, report['trust']['asked']))}</div>"
        )
        yield f"{'Corner' if '.' in name else 'Joint'} {name}", f"<div class='g-side-by-side'>{content}</div>"
    yield "Energy", build_table(("", ""), build_energy_rows(report))
    trust = report["trust"]
    yield (
        "Predictability and accuracy",
        build_table(("", ""), build_accuracy_rows(trust)) + build_paragraphs(trust["notes"], "g-quiet"),
    )
    yield (
        "Laws",
        "".join(
            f"<h3>{escape(escape_invisible(law['title']))}</h3>"
            + build_paragraphs(
                [
                    *([f"Options: {law['options']}."] if law["options"] else []),
                    f"Valid: {law['valid']}.",
                    *([f"Properties: {law['properties']}."] if law["properties"] else []),
                    f"Source: {law['source']}.",
                ]
            )
            for law in report["laws"]
        ),
    )


def format_report(report: Mapping[str, Any]) -> str:
    """Return the report as text for a terminal, section by section, with warnings and notes at the end."""
    sections: list[tuple[str, Rows]] = [("", [("", _describe_run(report))])]
    has_examination = report["trust"]["asked"]
    sections += [
        (f"guide {name}", build_guide_rows(values, has_examination)) for name, values in report["guides"].items()
    ]
    sections += [
        (f"{'corner' if values['corner'] else 'joint'} {name}", build_joint_rows(values, has_examination))
        for name, values in report["joints"].items()
    ]
    sections += [
        ("energy", build_energy_rows(report)),
        ("predictability and accuracy", build_accuracy_rows(report["trust"])),
    ]
    lines_of_text = [_format_title(report)]
    for heading, rows in sections:
        lines_of_text += [heading] if heading and rows else []
        lines_of_text += [f"  {name:<34}  {cell}".rstrip() if name else f"  {cell}" for name, cell in rows]
    lines_of_text += [
        f"law: {law['title']}{'; ' * bool(law['options'])}{law['options']}; valid: {law['valid']}"
        for law in report["laws"]
    ]
    return escape_invisible(
        "\n".join(
            [*lines_of_text, *(f"note: {sentence}" for sentence in (*report["warnings"], *report["trust"]["notes"]))]
        )
    )


def _format_title(report: Mapping[str, Any]) -> str:
    """Return title and scene in one line."""
    return f"{format_one_line(report['title'] or report['mechanism'])}: {report['scene']}"


def _describe_run(report: Mapping[str, Any]) -> str:
    """Return time span, number of samples, method and number of steps in one line."""
    begin, end = report["t"]
    return (
        f"{begin:.6g} … {end:.6g} s, {report['samples']} samples, {report['method']}, {report['trust']['steps']} steps"
    )


def build_joint_rows(joint: Mapping[str, Any], has_examination: bool) -> Rows:
    """Return the rows (name, cell) of a joint with play, or of a slider's corner.

    `joint` has the values of `run_report._compute_joint_values`. `has_examination`: whether the run was examined
    (`examine`), which makes additional runs; without them, the rows that need them contain NOT_REQUESTED. Quantities
    without a value have no row.
    """
    time_fractions = ((name, joint["time"][name]) for name in ("free", "impacting", "contact", "film"))
    time_text = ", ".join(
        f"{name} {100 * fraction:.4g} %" for name, fraction in time_fractions if fraction or name == "free"
    )
    rows = [
        ("gap c" if joint["corner"] else "clearance c", format_quantity(joint["c"], "m")),
        ("fraction of the time", time_text),
    ]
    closed_text = f", {joint['still_closed']} to the end" if joint["still_closed"] else ""
    rows.append(("contacts", f"{joint['contacts']}{closed_text}"))
    if stiffness := joint["stiffness"]:
        rows.append(("stiffness K of its law", f"{stiffness['K']:.4g} {stiffness['unit']}"))
    if joint["asked"] is not None:
        free_restitution = joint["free_impact"]
        text = "" if free_restitution is None else f", delivered in a free impact {free_restitution:.5g}"
        rows.append(("restitution requested", f"{joint['asked']:g}{text}"))
    if joint["approach"]:
        rows.append(("approach, min … median … max", _format_range_cell(joint["approach"], "m/s")))
        restitution = joint["restitution"]
        is_known = restitution is not None and math.isfinite(restitution["median"])
        reason = "no contact with an approach speed ended" if restitution is not None else NOT_REQUESTED
        cell = _format_range_cell(restitution, "") if is_known else reason
        rows.append(("restitution, min … median … max", cell))
    rows.append(
        ("peak force", f"{format_quantity(joint['peak']['F'], 'N')} at {format_quantity(joint['peak']['t'], 's')}")
    )
    rows.append((f"RMS force, of {joint['rms_of']}", format_quantity(joint["rms"], "N")))
    rows += [] if joint["corner"] else _format_ideal_rows(joint, has_examination)  # of a guide the sum has one
    if math.isfinite(joint["penetration"]):
        text = f"{format_quantity(joint['penetration'], 'm')}, {joint['penetration_share']:.3g} c"
        rows.append(("largest penetration", text if joint["penetration"] else "none"))
    if math.isfinite(joint["film_least"]):
        rows.append(("smallest film thickness", format_quantity(joint["film_least"], "m")))
    return rows + _format_work_rows(joint["work"], has_examination)


def build_guide_rows(guide: Mapping[str, Any], has_examination: bool) -> Rows:
    """Return the rows (name, cell) of a guide with play: peak and RMS force, peak moment, and the ideal force.

    The force and the moment are those on the slider. `has_examination`: whether the run was examined (`examine`);
    without it, the row of the ideal force contains NOT_REQUESTED.
    """
    peak, moment = guide["peak"], guide["M"]
    return [
        (
            "force on the slider, peak of samples",
            f"{format_quantity(peak['F'], 'N')} at {format_quantity(peak['t'], 's')}",
        ),
        ("RMS force, of samples", format_quantity(guide["rms"], "N")),
        (
            "moment on the slider, peak of samples",
            f"{format_quantity(moment['peak'], 'N*m')} at {format_quantity(moment['t'], 's')}",
        ),
        *_format_ideal_rows(guide, has_examination),
    ]


def _format_ideal_rows(joint: Mapping[str, Any], has_examination: bool) -> Rows:
    """Return the rows of peak and RMS force in the ideal scene, each with the ratio of the force with play to it.

    Without these forces there is one row with "not known", or with NOT_REQUESTED without `has_examination`.
    """
    if not (ideal := joint["ideal"]):
        return [("ideal forces", NOT_REQUESTED if not has_examination else "not known")]
    return [
        ("ideal peak force", f"{format_quantity(ideal['F'], 'N')}{_format_ratio(joint['peak']['F'], ideal['F'])}"),
        ("ideal RMS force", f"{format_quantity(ideal['rms'], 'N')}{_format_ratio(joint['rms'], ideal['rms'])}"),
    ]


def _format_work_rows(work: Mapping[str, float] | None, has_examination: bool) -> Rows:
    """Return the rows of the energies that contact, friction and film dissipate, without those that are not finite.

    If `work` is None, there is one row with "not known", or with NOT_REQUESTED without `has_examination`.
    """
    if work is None:
        return [("dissipated energy", NOT_REQUESTED if not has_examination else "not known")]
    names = {
        "taken": "energy into contact",
        "returned": "returned by contact",
        "damping": "dissipated by damping",
        "friction": "dissipated by friction",
        "film": "dissipated by the film",
    }
    return [(label, format_quantity(work[name], "J")) for name, label in names.items() if math.isfinite(work[name])]


def _format_range_cell(quantiles: Mapping[str, float], unit: str) -> str:
    """Return minimum, median and maximum as a cell."""
    return " … ".join(format_quantity(quantiles[name], unit) for name in ("min", "median", "max"))


def _format_ratio(ratio: float, ideal: float) -> str:
    """Return the ratio of a value to the ideal one: ", with play 1.2 times that"; "" if the ideal value is 0."""
    return f", with play {ratio / ideal:.3g} times that" if ideal > 0.0 else ""


def build_energy_rows(report: Mapping[str, Any]) -> Rows:
    """Return the rows (name, cell) of the energy balance.

    Without masses there is one row, "not known". Works of joints with play have a row only if there are such joints.
    """
    energy = report["energy"]
    if energy is None:
        return [("energy", "not known: a body has no mass or no inertia")]
    names = {
        "drives": "work of the drives",
        "forces": "work of the forces",
        "clearances": "work of the joints with play",
        "not_told_apart": "dissipated by joints, not assigned",
        "change": "kinetic and potential energy, change",
        "residual": "largest residual of the balance",
        "turned_over": "energy throughput",
    }
    rows = [(label, format_quantity(energy[name], "J")) for name, label in names.items() if name in energy]
    return [row for row in rows if report["joints"] or row[0] != names["clearances"]]


def build_accuracy_rows(accuracy: Mapping[str, Any]) -> Rows:
    """Return the rows (name, cell) of a run's accuracy: drift, tolerance, step, predictability horizon, differences.

    `accuracy` has the values of `run_report._collect_accuracy_values`. A tolerance or step that is not finite has no
    row; a horizon that is not finite becomes "not requested". Without a requested comparison with a more accurate run,
    the last row is NOT_REQUESTED.
    """
    rows = [("drift, max |Φ|", f"{accuracy['phi_max']:.2e}"), ("drift, max |Φ̇|", f"{accuracy['phi_dot_max']:.2e}")]
    if math.isfinite(accuracy["rtol"]):
        rows.append(("tolerance of a step", f"{accuracy['rtol']:.3g}"))
    if math.isfinite(accuracy["step"]):
        rows.append(("step", format_quantity(accuracy["step"], "s")))
    horizon = accuracy["horizon"]
    horizon_text = (
        horizon
        if isinstance(horizon, str)
        else format_quantity(horizon, "s")
        if math.isfinite(horizon)
        else "not requested"
    )
    rows.append(("predictability horizon", horizon_text))
    for difference in accuracy["differences"]:
        text = (
            f"{format_quantity(difference['largest'], difference['unit'])} at {format_quantity(difference['t'], 's')}"
        )
        rows.append((f"{difference['name']}, against {accuracy['compared_with']}", text))
    return rows if accuracy["asked"] else [*rows, ("against smaller steps", NOT_REQUESTED)]


def draw_orbit_svg(run: Result, joint: str) -> str:
    """Return the journal's path through all steps in the circle e = c as an SVG figure, thinned to MAX_POINTS points.

    `joint` is a bearing with play. The start is a small circle.
    """
    c = run.constants[f"{joint}.c"]
    _, x, y = joint_curves.get_journal_path(run, joint)
    is_finite = np.isfinite(x) & np.isfinite(y)
    x, y = x[is_finite] / c, y[is_finite] / c
    half_width = 1.06 * max(1.0, float(np.hypot(x, y).max(initial=0.0)))
    scale = ORBIT_SIZE / (2.0 * half_width)
    stride = slice(None, None, max(1, -(-len(x) // MAX_POINTS)))
    points_in_pixels = zip(ORBIT_SIZE / 2 + scale * x[stride], ORBIT_SIZE / 2 - scale * y[stride], strict=True)
    path = " ".join(f"{pixel_x:.1f},{pixel_y:.1f}" for pixel_x, pixel_y in points_in_pixels)
    start_coordinates = path.partition(" ")[0].partition(",")
    start_element = (
        f"<circle class='g-start' cx='{start_coordinates[0]}' cy='{start_coordinates[2]}' r='3.5'/>" if path else ""
    )
    return (
        f"<figure><svg role='img' aria-label='orbit of the journal of {escape(joint, quote=True)}' width='{ORBIT_SIZE}'"
        f" height='{ORBIT_SIZE}' viewBox='0 0 {ORBIT_SIZE} {ORBIT_SIZE}'><circle class='g-circle'"
        f" cx='{ORBIT_SIZE / 2:g}' cy='{ORBIT_SIZE / 2:g}' r='{scale:.1f}'/>"
        f"<polyline class='g-path' stroke-width='.8' points='{path}'/>{start_element}</svg>"
        "<figcaption>the journal in the circle e = c, ○ start</figcaption></figure>"
    )
