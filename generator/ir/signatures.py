"""Arguments of kernels: their types, how they are accessed, and those that many kernels share."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum, auto
from typing import TypeAlias

import sympy as sp

from gudgeon.generator.symbols import storage
from gudgeon.generator.symbols.storage import Place


class Number(Enum):
    """Types of numbers in the arguments of functions."""

    REAL = auto()
    INTEGER = auto()
    BYTE = auto()


Type: TypeAlias = Number | str  # str: the name of a struct


class Access(Enum):
    """How a function accesses an argument."""

    VALUE = auto()
    CONSTANT = auto()  # a value that is declared never to change
    READ = auto()  # an array or struct
    WRITTEN = auto()  # an array, struct or number that the caller reads afterwards


@dataclass(frozen=True)
class Argument:
    """An argument of a kernel; for an array, `type` is that of its elements."""

    name: str
    type: Type = Number.REAL
    access: Access = Access.VALUE

    def __getitem__(self, step: str | int) -> Place:
        """Return the place of an array element or of a struct's field of the argument."""
        return Place(self.name)[step]


def source(name: str, type: Type = Number.REAL) -> Argument:
    """Return the argument for an array or struct that the function reads; `type` is that of its elements."""
    return Argument(name, type, Access.READ)


def result(name: str, type: Type = Number.REAL) -> Argument:
    """Return the argument for an array, struct or number that the function writes; `type` is that of its elements."""
    return Argument(name, type, Access.WRITTEN)


# Corners: the sides that are held over a step (or none), and where the switching functions go.
BRANCHES = (source("branch"), result("g"))

TIME = Argument("t", access=Access.CONSTANT)
STATE = (TIME, source("q"), source("v"))
DISCRETE = source("discrete", "DiscreteState")
PARAMETERS = source(storage.PARAMETERS, "Parameters")
RHS = result("rhs", "RhsOutputs")
CONTACT = source("contact", "ContactState")  # of one contact
ZERO = sp.Integer(0)


def acting_on(index: int) -> tuple[Place, ...]:
    """Return the last arguments of a call of the function of joint `index` with play.

    They are its contact state, the parameters, and the arguments for branches.
    """
    return (DISCRETE["contact"][index], *(Place(argument.name) for argument in (PARAMETERS, *BRANCHES)))
