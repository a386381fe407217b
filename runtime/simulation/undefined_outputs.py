"""Find outputs, drives and forces of a run that are NaN at samples although all their inputs are numbers."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from gudgeon.contract.kernel_source import KernelSource
from gudgeon.language.tree import Expr, evaluate, from_json, iterate_calls, iterate_names
from gudgeon.language.undefined_parts import is_defined_everywhere
from gudgeon.model.cached_values import cache_by_values
from gudgeon.model.choices import format_parameter
from gudgeon.model.compiled import Array
from gudgeon.model.file_expressions import explain_nonfinite_part, read_expression_trees
from gudgeon.results.results import Result
from gudgeon.results.series import get_catalogue


@dataclass(frozen=True)
class _Expression:
    """Hold an expression that is checked at samples, and its inputs."""

    name: str  # for messages
    tree: Expr
    series_names: tuple[str, ...]  # inputs that are series or t
    parameter_indices: tuple[tuple[str, int], ...]  # inputs that are parameters, and their indices


@cache_by_values
def list_checked_expressions(source: KernelSource) -> tuple[_Expression, ...]:
    """Return the expressions of a scene to check: its outputs, then drives and forces with a `where`.

    C evaluates one branch of a `where` silently if a compared operand is not a number. Drives and forces whose operands
    are always finite are left out, and so are expressions with names that results do not have.
    """
    catalogue = get_catalogue(source)
    trees = {f"output {name}": from_json(tree) for name, tree in source.outputs.items() if name in catalogue}
    for info, tree in read_expression_trees(source, ("drives", "forces")):
        operands = [operand for call in iterate_calls(tree, "where") for operand in call.arguments[:2]]
        if not all(map(is_defined_everywhere, operands)):
            trees[info.address] = tree
    index = source.parameter_indices | {
        address.removeprefix("parameters."): k
        for address, k in source.parameter_indices.items()
        if address.startswith("parameters.")
    }
    names = {name: {used.path for used in iterate_names(tree)} for name, tree in trees.items()}
    return tuple(
        _Expression(
            name,
            tree,
            tuple(path for path in names[name] if path not in index),
            tuple((path, index[path]) for path in names[name] if path in index),
        )
        for name, tree in trees.items()
        if names[name] <= {"t", *catalogue, *index}
    )


class UndefinedOutputs:
    """Count the samples at which the checked expressions of a scene are not finite, block by block."""

    def __init__(self, source: KernelSource) -> None:
        self.source, self.expressions = source, list_checked_expressions(source)
        self.n_samples = 0
        self.counts = [0] * len(self.expressions)  # samples at which each is not a number
        self.messages = [""] * len(self.expressions)  # on the first of them

    def add_samples(self, samples: Result) -> None:
        """Check all expressions at the next samples of the run.

        Values that are not finite although all their inputs are, are counted; the first one gets a message.
        """
        self.n_samples += len(samples.t)
        for k, expression in enumerate(self.expressions):
            inputs: dict[str, Any] = {name: samples[name] for name in expression.series_names}
            for name, index in expression.parameter_indices:
                inputs[name] = format_parameter(self.source.parameters[index], float(samples.p[index]))
            is_undefined = ~np.isfinite(evaluate(expression.tree, inputs.__getitem__))
            if not is_undefined.any():
                continue
            values = {name: np.broadcast_to(value, samples.t.shape) for name, value in inputs.items()}
            is_undefined = np.broadcast_to(is_undefined, samples.t.shape).copy()
            for value in values.values():
                is_undefined &= np.isfinite(value)
            if is_undefined.any() and not self.counts[k]:
                self.messages[k] = self._explain_non_finite_value(
                    expression, values, samples.t, int(is_undefined.argmax())
                )
            self.counts[k] += int(is_undefined.sum())

    def _explain_non_finite_value(self, expression: _Expression, values: dict[str, Array], t: Array, k: int) -> str:
        """Return a message with value, time and reason for an expression that is not finite at sample k.

        `values`: of its inputs by name, (N,).
        """
        value = np.broadcast_to(evaluate(expression.tree, values.__getitem__), t.shape)[k]
        explanation = explain_nonfinite_part(self.source, expression.tree, lambda name: float(values[name][k]))
        return f"{expression.name} is not finite ({value}) at t = {t[k]:.9g} s: {explanation}"

    def build_notes(self) -> tuple[str, ...]:
        """Return a note on the first non-finite sample of each expression that has one, and their number.

        Called after all samples.
        """
        return tuple(
            message + (f"; it is not finite at {count} of {self.n_samples} samples" if count > 1 else "")
            for message, count in zip(self.messages, self.counts, strict=True)
            if count
        )
