"""Writes the equations of a scene for people: LaTeX, plain text, HTML."""

from gudgeon.generator.targets.latex.write import render_equations_html, render_equations_tex, render_equations_text

__all__ = ["render_equations_html", "render_equations_tex", "render_equations_text"]
