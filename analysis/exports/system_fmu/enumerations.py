"""Enumeration types of a system, as defined by its components and its description."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from ....common.zips import open_zip, read_entry
from ....fmus_src.export.description.system import EnumerationMember, EnumerationType
from ...runtime.ssp.documents import parse_xml
from ...runtime.ssp.fmu_description import DESCRIPTION
from ...runtime.ssp.names import split_name
from ...runtime.system.fmu import Fmu
from ...runtime.system.network import Network


class Enumerations:
    """Enumeration types of signals and connectors by name; ``networks`` are the networks of all choices."""

    def __init__(self, networks: Sequence[Network]) -> None:
        self._networks = networks
        self._in_fmus: dict[str, Mapping[str, EnumerationType]] = {}  # by the FMU's digest

    def of(self, name: str) -> EnumerationType | None:
        """Return the enumeration type of a signal or connector.

        None is returned if the type is not an enumeration, or if its members differ between candidates: the FMU then
        declares an Integer.
        """
        types = [each for network in self._networks for each in self._in_network(network, name)]
        first = types[0] if types else None
        return first if all(first and each and each.numbers == first.numbers for each in types) else None

    def in_fmu(self, fmu: Fmu) -> Mapping[str, EnumerationType]:
        """Return the enumeration types of an FMU by variable."""
        if fmu.digest not in self._in_fmus:
            defined = _read_types(fmu)
            declared = {each.name: each.declaredType for each in fmu.description.modelVariables}
            types = {name: defined[kind.name] for name, kind in declared.items() if kind and kind.name in defined}
            self._in_fmus[fmu.digest] = types
        return self._in_fmus[fmu.digest]

    def _in_network(self, network: Network, name: str) -> list[EnumerationType | None]:
        """Return the type of a name in one network; an empty list if the network does not contain the name."""
        component, variable = split_name(name, network.fmus)
        if component:
            fmu = network.fmus[component]
            return [self.in_fmu(fmu).get(variable)] if variable in fmu.variables else []
        node = network.nodes.get(name)
        if node is None or not node.enumeration:
            return [] if node is None else [None]
        for other in network.nodes.values():  # an untyped connector shares the members of its link
            if other.component is not None and other.enumeration is node.enumeration:
                return [self.in_fmu(network.fmus[other.component])[other.variable]]
        declared = network.description.enumerations
        defined = next(each for each, members in declared.items() if members is node.enumeration)
        return [EnumerationType(defined, tuple(EnumerationMember(*member) for member in node.enumeration.items()))]


def _read_types(fmu: Fmu) -> dict[str, EnumerationType]:
    """Return the enumeration types defined by the modelDescription.xml of one of Perilune's FMUs, by name."""
    root = parse_xml(read_entry(open_zip(fmu.content, fmu.label), DESCRIPTION, fmu.label), fmu.label)
    types = {}
    for kind in root.iterfind("TypeDefinitions/SimpleType[Enumeration]"):
        members = [
            EnumerationMember(each.get("name", ""), int(each.get("value", "")), each.get("description", ""))
            for each in kind.iterfind("Enumeration/Item")
        ]
        name = kind.get("name", "")
        types[name] = EnumerationType(name, tuple(members), kind.get("description", ""))
    return types
