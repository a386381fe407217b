"""Reads materials, and resolves the names of materials in bearings, guides and shapes of bodies.

If several materials of the file fit, the choice is a run-time parameter, and the material's values follow it.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

from gudgeon.errors import MissingKeyError, UnknownNameError
from gudgeon.generator.format.sections import MATERIAL
from gudgeon.generator.mechanism import Choice, Material, Quantity, make_dependent_quantity
from gudgeon.generator.reader.collector import Reader
from gudgeon.generator.reader.fields import FieldContext, read_fields
from gudgeon.generator.yaml import Map, Text
from gudgeon.language.names import make_unknown_name_error

ELASTIC_KEYS = ("E", "nu")  # properties that contacts need
EXAMPLE_SECTION = "materials: {steel: {E: 210 GPa, nu: 0.3, density: 7850 kg/m^3}}"


class Materials:
    """Contain the materials of a file: `known` by name, and in `choices` by address those that a run may replace.

    An address is "bearings.pin.journal_material".
    """

    def __init__(self, reader: Reader, section: Map) -> None:
        """Read the section `materials:`; values of interchangeable materials become run-time parameters."""
        self._reader, self._required_properties = reader, dict[str, tuple[str, ...]]()
        self.by_name: dict[str, Material] = {}
        self.choices: dict[str, Choice] = {}
        for name, node in section.list_entries():
            quantities = read_fields(reader, node, MATERIAL.fields, FieldContext(f"materials.{name}")).quantities
            self.by_name[str(name)] = Material(str(name), quantities)
        for needs in (ELASTIC_KEYS, ("density",)):
            self._make_properties_parameters(needs)

    def _make_properties_parameters(self, properties: tuple[str, ...]) -> None:
        """Make the values of materials that can be chosen run-time parameters, also those that are written as 0.

        `properties` are the properties that a use needs; nothing changes unless at least two materials have them all.
        """
        names = self._find_materials_with(properties)
        for name in names if len(names) > 1 else ():
            numbers = self.by_name[name].numbers
            parameters = {
                key: self._reader.register_quantity(replace(numbers[key], is_always_parameter=True))
                for key in properties
            }
            self.by_name[name] = Material(name, {**numbers, **parameters})

    def _find_materials_with(self, properties: Iterable[str]) -> list[str]:
        """Return the names of the materials that have all properties in `properties`."""
        return [name for name, material in self.by_name.items() if all(key in material.numbers for key in properties)]

    def read_properties(self, address: str, material_name: Text, properties: tuple[str, ...]) -> dict[str, Quantity]:
        """Return the properties of the material named at an address, by their names `properties`.

        If another material has them too, the properties become run-time parameters at this address, with the bounds of
        materials, and `choices` gets the address. Raises UnknownNameError, MissingKeyError.
        """
        self._required_properties[address] = properties
        quantities = self._find_material(material_name, properties).numbers
        if len(self._find_materials_with(properties)) < 2:
            return {key: quantities[key] for key in properties}
        parameters = {
            key: self._reader.register_quantity(
                make_dependent_quantity(f"{address}.{key}", quantities[key], material_name.where)
            )
            for key in properties
        }
        for field in MATERIAL.fields:
            for bound in field.bounds if field.name in parameters else ():
                self._reader.add_condition(parameters[field.name], bound.relation, float(bound.limit), bound.why)
        self.choices[address] = Choice(address, str(material_name), parameters)
        return parameters

    def resolve_choice(self, address: Text, material_name: Text) -> str:
        """Return the name of the material that a scene gives an address. Raises UnknownNameError, MissingKeyError.

        The address must be that of a bearing, guide or shape with a material, whose needed properties the material must
        have.
        """
        if address not in self._required_properties:
            raise make_unknown_name_error("address of a material", address, self._required_properties, address.where)
        return self._find_material(material_name, self._required_properties[address]).name

    def _find_material(self, material_name: Text, properties: tuple[str, ...]) -> Material:
        """Return the material named `material_name` if it has all properties in `properties`.

        Raises UnknownNameError, with an example if the file has no materials, and MissingKeyError.
        """
        if not self.by_name:
            raise UnknownNameError(
                f"unknown material {str(material_name)[:200]!r}", material_name.where, f"add it: {EXAMPLE_SECTION}"
            )
        if material_name not in self.by_name:
            raise make_unknown_name_error("material", material_name, self.by_name, material_name.where)
        missing_keys = [key for key in properties if key not in self.by_name[material_name].numbers]
        if missing_keys:
            suitable_names = ", ".join(self._find_materials_with(properties))
            hint = f"expected the key {missing_keys[0]!r} in materials.{material_name}" + (
                f", or one of: {suitable_names}" * bool(suitable_names)
            )
            raise MissingKeyError(
                f"material {material_name} has no {' and no '.join(missing_keys)}", material_name.where, hint
            )
        return self.by_name[material_name]
