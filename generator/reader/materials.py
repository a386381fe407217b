"""Reads materials, and resolves the names of materials in bearings, guides and shapes of bodies.

If several materials of the file fit, the choice is a run-time parameter, and the material's values follow it.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

from gudgeon.errors import MissingKeyError, UnknownNameError
from gudgeon.generator.format.sections import MATERIAL
from gudgeon.generator.mechanism import Choice, Material, Quantity, following
from gudgeon.generator.reader.collector import Reader
from gudgeon.generator.reader.fields import FieldContext, read_fields
from gudgeon.generator.yaml import Map, Text
from gudgeon.language.names import unknown_name

ELASTIC = ("E", "nu")  # properties that contacts need
EXAMPLE = "materials: {steel: {E: 210 GPa, nu: 0.3, density: 7850 kg/m^3}}"


class Materials:
    """Contain the materials of a file.

    `known` contains them by name, `choices` the replaceable ones by address: "bearings.pin.journal_material".
    """

    def __init__(self, reader: Reader, section: Map) -> None:
        self._reader, self._needs = reader, dict[str, tuple[str, ...]]()
        self.known: dict[str, Material] = {}
        self.choices: dict[str, Choice] = {}
        for name, node in section.pairs():
            own = read_fields(reader, node, MATERIAL.fields, FieldContext(f"materials.{name}")).quantities
            self.known[str(name)] = Material(str(name), own)
        for needs in (ELASTIC, ("density",)):
            self._make_replaceable(needs)

    def _make_replaceable(self, needs: tuple[str, ...]) -> None:
        """Make the values of materials that can be chosen run-time parameters, also those that are written as 0."""
        fitting = self._names_with(needs)
        for name in fitting if len(fitting) > 1 else ():
            numbers = self.known[name].numbers
            kept = {what: self._reader.keep(replace(numbers[what], kept=True)) for what in needs}
            self.known[name] = Material(name, {**numbers, **kept})

    def _names_with(self, needs: Iterable[str]) -> list[str]:
        """Return the names of the materials that have all properties in `needs`."""
        return [name for name, material in self.known.items() if all(what in material.numbers for what in needs)]

    def values_of_material(self, address: str, text: Text, needs: tuple[str, ...]) -> dict[str, Quantity]:
        """Return the properties of the material named at an address, by their names `needs`.

        If another material may be chosen, they are parameters of their own. Raises UnknownNameError, MissingKeyError.
        """
        self._needs[address] = needs
        numbers = self._find_material(text, needs).numbers
        if len(self._names_with(needs)) < 2:
            return {what: numbers[what] for what in needs}
        own = {what: self._reader.keep(following(f"{address}.{what}", numbers[what], text.where)) for what in needs}
        for field in MATERIAL.fields:
            for bound in field.bounds if field.name in own else ():
                self._reader.require(own[field.name], bound.relation, float(bound.limit), bound.why)
        self.choices[address] = Choice(address, str(text), own)
        return own

    def check_choice(self, address: Text, text: Text) -> str:
        """Return the name of the material that a scene gives an address. Raises UnknownNameError, MissingKeyError."""
        if address not in self._needs:
            raise unknown_name("address of a material", address, self._needs, address.where)
        return self._find_material(text, self._needs[address]).name

    def _find_material(self, text: Text, needs: tuple[str, ...]) -> Material:
        """Return the material with this name if it has all properties in `needs`.

        Raises UnknownNameError, MissingKeyError.
        """
        if not self.known:
            raise UnknownNameError(f"unknown material {str(text)[:200]!r}", text.where, f"write it: {EXAMPLE}")
        if text not in self.known:
            raise unknown_name("material", text, self.known, text.where)
        lacking = [what for what in needs if what not in self.known[text].numbers]
        if lacking:
            fitting = ", ".join(self._names_with(needs))
            hint = f"expected the key {lacking[0]!r} in materials.{text}" + (f", or one of: {fitting}" * bool(fitting))
            raise MissingKeyError(f"material {text} has no {' and no '.join(lacking)}", text.where, hint)
        return self.known[text]
