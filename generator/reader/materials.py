"""Materials, and what says by a material's name which numbers it has: roles of bearings, shapes of bodies.

Where the file has several materials that would do, the choice is a number of the run, and what it says follows it.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

from gudgeon.errors import MissingKeyError, UnknownNameError
from gudgeon.generator.format.sections import MATERIAL
from gudgeon.generator.mechanism import Choice, Material, Quantity, following
from gudgeon.generator.reader.collector import Reader
from gudgeon.generator.reader.fields import Around, read_fields
from gudgeon.generator.yaml import Map, Text
from gudgeon.language.names import unknown_name

ELASTIC = ("E", "nu")  # what contact asks of a material
EXAMPLE = "materials: {steel: {E: 210 GPa, nu: 0.3, density: 7850 kg/m^3}}"


class Materials:
    """`known` by name; `choices` are what names one of several, by address: "bearings.pin.journal_material"."""

    def __init__(self, reader: Reader, section: Map) -> None:
        self._reader, self._needs = reader, dict[str, tuple[str, ...]]()
        self.known: dict[str, Material] = {}
        self.choices: dict[str, Choice] = {}
        for name, node in section.pairs():
            own = read_fields(reader, node, MATERIAL.fields, Around(f"materials.{name}")).quantities
            self.known[str(name)] = Material(str(name), own)
        for needs in (ELASTIC, ("density",)):
            self._keep(needs)

    def _keep(self, needs: tuple[str, ...]) -> None:
        """Numbers of which there is a choice are kept, a Poisson's ratio that is written as 0 too."""
        fitting = self._fitting(needs)
        for name in fitting if len(fitting) > 1 else ():
            numbers = self.known[name].numbers
            kept = {what: self._reader.keep(replace(numbers[what], kept=True)) for what in needs}
            self.known[name] = Material(name, {**numbers, **kept})

    def _fitting(self, needs: Iterable[str]) -> list[str]:
        return [name for name, material in self.known.items() if all(what in material.numbers for what in needs)]

    def take(self, address: str, text: Text, needs: tuple[str, ...]) -> dict[str, Quantity]:
        """The numbers that a material, named at an address, is asked for; its own where another may be chosen.

        Raises UnknownNameError, MissingKeyError.
        """
        self._needs[address] = needs
        numbers = self._named(text, needs).numbers
        if len(self._fitting(needs)) < 2:
            return {what: numbers[what] for what in needs}
        own = {what: self._reader.keep(following(f"{address}.{what}", numbers[what], text.where)) for what in needs}
        for field in MATERIAL.fields:
            for bound in field.bounds if field.name in own else ():
                self._reader.require(own[field.name], bound.relation, float(bound.limit), bound.why)
        self.choices[address] = Choice(address, str(text), own)
        return own

    def chosen(self, address: Text, text: Text) -> str:
        """The name of the material that a scene has at an address. Raises as `take`."""
        if address not in self._needs:
            raise unknown_name("address of a material", address, self._needs, address.where)
        return self._named(text, self._needs[address]).name

    def _named(self, text: Text, needs: tuple[str, ...]) -> Material:
        if not self.known:
            raise UnknownNameError(f"unknown material {str(text)[:200]!r}", text.where, f"write it: {EXAMPLE}")
        if text not in self.known:
            raise unknown_name("material", text, self.known, text.where)
        lacking = [what for what in needs if what not in self.known[text].numbers]
        if lacking:
            fitting = ", ".join(self._fitting(needs))
            hint = f"expected the key {lacking[0]!r} in materials.{text}" + (f", or one of: {fitting}" * bool(fitting))
            raise MissingKeyError(f"material {text} has no {' and no '.join(lacking)}", text.where, hint)
        return self.known[text]
