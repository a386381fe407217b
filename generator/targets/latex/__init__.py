"""Writes the equations of a scene for people: LaTeX, plain text, HTML."""

from gudgeon.generator.targets.latex.write import equations_html, equations_tex, equations_text

__all__ = ["equations_html", "equations_tex", "equations_text"]
