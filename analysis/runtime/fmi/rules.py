"""Rules of FMI for model descriptions that the schema cannot express."""

from __future__ import annotations

import re

from attrs import evolve
from fmpy.model_description import ModelDescription
from fmpy.validation import validate_model_description

ELEMENT = r"[A-Za-z_][A-Za-z0-9_]*(\[[0-9]+(,[0-9]+)*\])?"
PLAIN_NAME = re.compile(rf"{ELEMENT}(\.{ELEMENT})*")  # permitted by FMI 2.0


def broken_rules(description: ModelDescription) -> list[str]:
    """Return violations of FMI's rules on the names of variables and on the model structure."""
    # FMPy needs a millisecond to parse a name: it only checks names that are not plain.
    doubtful = [variable for variable in description.modelVariables if not PLAIN_NAME.fullmatch(variable.name)]
    partial = evolve(description, modelVariables=doubtful)
    others = validate_model_description(partial)
    rules = [rule for rule in validate_model_description(partial, validate_variable_names=True) if rule not in others]
    # FMPy also requires the aliases of listed variables
    unnamed = evolve(description, modelVariables=[each for each in description.modelVariables if not each.alias])
    rules += validate_model_description(unnamed, validate_model_structure=True)
    return [" ".join(rule.split()) for rule in rules]
