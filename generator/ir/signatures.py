"""Argument lists of generated functions: types, access, and lists that many functions share."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum, auto
from typing import TypeAlias

import sympy as sp

from gudgeon.generator.symbols import storage
from gudgeon.generator.symbols.storage import StorageLocation


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

    def __getitem__(self, step: str | int) -> StorageLocation:
        """Return the place of an array element or of a struct's field of the argument."""
        return StorageLocation(self.name)[step]


def make_input_argument(name: str, type: Type = Number.REAL) -> Argument:
    """Return the argument for an array or struct that the function reads; `type` is that of its elements."""
    return Argument(name, type, Access.READ)


def make_output_argument(name: str, type: Type = Number.REAL) -> Argument:
    """Return the argument for an array, struct or number that the function writes; `type` is that of its elements."""
    return Argument(name, type, Access.WRITTEN)


# The branches that are frozen over a step (or none), and the array to which switching functions are written.
BRANCHES = (make_input_argument("branch"), make_output_argument("g"))

TIME = Argument("t", access=Access.CONSTANT)
STATE = (TIME, make_input_argument("q"), make_input_argument("v"))
DISCRETE = make_input_argument("discrete", "DiscreteState")
PARAMETERS = make_input_argument(storage.PARAMETERS, "Parameters")
RHS = make_output_argument("rhs", "RhsOutputs")
CONTACT = make_input_argument("contact", "ContactState")  # of one contact
ZERO = sp.Integer(0)


def make_contact_arguments(index: int) -> tuple[StorageLocation, ...]:
    """Return the last arguments of a call of the force function of joint `index` with play, as storage locations.

    They are its contact state, the parameters, the frozen branches and the switching functions.
    """
    return (DISCRETE["contact"][index], *(StorageLocation(argument.name) for argument in (PARAMETERS, *BRANCHES)))
