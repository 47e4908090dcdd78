"""Direct dependencies of outputs on inputs: declared by FMUs, stated by the SSD or a user, or assumed."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass, replace
from enum import StrEnum

from ....common.errors import InputError
from .network import Network
from .options import SystemOptions

Dependencies = dict[str, dict[str, set[str]]]  # component -> output -> inputs on which it depends directly
OPTIONS = ("`feedthrough`", "`no_feedthrough`")


class Origin(StrEnum):
    """Source of a component's direct dependencies."""

    FMU = "declared by the FMU"
    SSD = "stated by the SSD"
    OPTION = "stated by an option"
    ALONE = "simulated alone"
    ASSUMED = "assumed, since the FMU does not declare it"


@dataclass(frozen=True)
class Feedthrough:
    """Direct dependencies by component and output; ``stepping`` orders the steps, ``initial`` the initialisation.

    ``undeclared`` lists, in the order of the SSD, the components with an output whose dependencies are stated neither
    by the FMU, nor by the SSD or a user. Such a component is stepped with inputs of t_n, and initialised as if its
    outputs depended on all inputs. Components without a driven input are omitted, since their order has no effect.
    ``cuts`` lists connections to undeclared components that close a loop; they are cut because the initialisation
    cannot solve the loop. ``origins`` maps each component to the source of its dependencies.
    """

    stepping: Dependencies
    initial: Dependencies
    origins: dict[str, Origin]
    undeclared: tuple[str, ...] = ()
    cuts: tuple[str, ...] = ()

    def notes(self, network: Network, algorithm: str) -> list[str]:
        """Return the assumptions, one line for each component, and the connections at which loops are cut."""
        assumed = self.undeclared if algorithm == "sequential" else ()
        return [
            *(f"{name}: FMU {network.fmus[name].name}{ASSUMED}" for name in assumed),
            *(f"{cut}: a loop through undeclared dependencies, which is cut here at the start" for cut in self.cuts),
        ]


ASSUMED = (
    " does not declare which outputs depend directly on inputs: none are assumed to, so it is stepped with "
    "inputs from the start of the step; if the dependencies are known, give `feedthrough` or `no_feedthrough`"
)


def find_feedthrough(network: Network, options: SystemOptions, algorithm: str, *, is_alone: bool) -> Feedthrough:
    """Return the direct dependencies of every component, including assumed dependencies.

    A user's option overrides the SSD's annotation, which applies only to the FMU that the SSD names, not to an FMU that
    replaces it (``use``). Both override the FMU's declaration. A stand-alone FMU (``is_alone``) steps to t_(n+1) with
    inputs of t_n, whatever its dependencies, as in FMPy. So does every FMU in Jacobi's algorithm, which needs
    assumptions only for the initialisation. Raises InputError for an unknown component, for a component in both
    options, and for ``feedthrough`` of a stand-alone FMU.
    """
    _check(network.fmus, options, is_alone=is_alone)
    stated = {
        name: (part.feedthrough, Origin.SSD)
        for name, part in network.components()
        if name not in options.use and part.feedthrough is not None
    }
    stated |= dict.fromkeys(network.fmus, (False, Origin.ALONE)) if is_alone else {}
    stated |= dict.fromkeys(options.chosen["feedthrough"], (True, Origin.OPTION))
    stated |= dict.fromkeys(options.chosen["no_feedthrough"], (False, Origin.OPTION))
    stepping: Dependencies = {}
    initial: Dependencies = {}
    origins: dict[str, Origin] = {}
    for name, fmu in network.fmus.items():
        declared = fmu.read_dependencies() | {variable: None for variable in _read_locals(network, name)}
        every = {variable.name for variable in fmu.variables.values() if variable.causality == "input"}
        is_open = None in declared.values()
        if name in stated:
            direct, origins[name] = stated[name]
            stepping[name] = initial[name] = dict.fromkeys(declared, every) if direct else {}
            continue
        origins[name] = Origin.ASSUMED if is_open and _is_driven(network, name) else Origin.FMU
        initial[name] = {output: every if inputs is None else inputs for output, inputs in declared.items()}
        stepping[name] = {} if is_open else initial[name]
    undeclared = tuple(name for name, origin in origins.items() if origin is Origin.ASSUMED)
    return Feedthrough(stepping, initial, origins, undeclared)


def _read_locals(network: Network, component: str) -> set[str]:
    """Return local variables that are connected as sources, since FMUs do not declare their dependencies."""
    return {
        link.source.variable
        for link in network.links()
        if link.source.component == component and link.source.kind == "local"
    }


def _is_driven(network: Network, component: str) -> bool:
    """Return True if an input of a component is connected or driven during simulation."""
    prefix = f"{component}."
    return any(link.target.component == component and not link.is_parameter for link in network.driver.values()) or any(
        name.startswith(prefix) and not network.fmus[component].variables[name.removeprefix(prefix)].is_tunable
        for name in network.driven
    )


def _check(components: Collection[str], options: SystemOptions, *, is_alone: bool) -> None:
    for option, names in zip(OPTIONS, (options.chosen["feedthrough"], options.chosen["no_feedthrough"]), strict=True):
        for name in names:
            if name not in components:
                raise InputError(option, name, "no such component", f"use one of {', '.join(sorted(components))}")
    for name in options.chosen["feedthrough"]:
        if name in options.chosen["no_feedthrough"]:
            raise InputError(
                OPTIONS[0], name, f"is also given to {OPTIONS[1]}", "give the component to only one of the two options"
            )
        if is_alone:
            problem = "an FMU alone is stepped with inputs from the start of the step, as in FMPy"
            raise InputError(
                OPTIONS[0], name, problem, f"leave out {OPTIONS[0]}, or simulate the FMU as a component of a system"
            )


def cut_loops(network: Network, feedthrough: Feedthrough) -> tuple[Feedthrough, set[str]]:
    """Cut the initial loops through undeclared dependencies; return the new dependencies, and the inputs at the cuts.

    A loop is cut at the first of its undeclared components in the order of the SSD: the component's input in the loop
    keeps its start value, and the outputs that depend on it directly are computed with that value.
    """
    initial = {name: dict(outputs) for name, outputs in feedthrough.initial.items()}
    driven = {link.target.name: link for link in network.driver.values() if not link.is_parameter}
    readers: dict[str, list[str]] = {}
    for link in network.links():
        if not link.is_parameter:
            readers.setdefault(link.source.name, []).append(link.target.name)
    cuts: dict[str, str] = {}
    for component in feedthrough.undeclared:
        for variable in sorted(set().union(*initial[component].values())):
            name = f"{component}.{variable}"
            if name in driven and _reaches_itself(network, name, initial, readers):
                cuts[name] = f"{driven[name].source.name} -> {name}"
                initial[component] = {output: inputs - {variable} for output, inputs in initial[component].items()}
    return replace(feedthrough, initial=initial, cuts=tuple(cuts.values())), set(cuts)


def _reaches_itself(network: Network, name: str, direct: Dependencies, readers: dict[str, list[str]]) -> bool:
    """Return True if an input affects itself at the same communication point."""
    visited: set[str] = set()
    queue = [name]
    while queue:
        current = queue.pop()
        node = network.nodes.get(current)
        successors = list(readers.get(current, ()))
        if node is not None and node.component is not None and node.kind == "input":
            outputs = direct[node.component].items()
            successors += [f"{node.component}.{output}" for output, inputs in outputs if node.variable in inputs]
        if name in successors:
            return True
        queue += [other for other in successors if other not in visited]
        visited.update(successors)
    return False
