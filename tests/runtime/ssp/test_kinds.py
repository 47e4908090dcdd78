"""Permitted connections between kinds of connectors.

Truth: the table "Allowed connections" of SSP 2.0, section Connections, row by row as printed there.
"""

import itertools

from perilune.analysis.runtime.ssp.kinds import can_connect

KINDS = ("input", "output", "parameter", "calculatedParameter", "structuralParameter", "constant", "local", "inout")
TABLE = """
System structuralParameter System calculatedParameter
System structuralParameter System output
System structuralParameter System local
System parameter System calculatedParameter
System parameter System output
System parameter System local
System input System output
System input System local
System structuralParameter Element structuralParameter
System structuralParameter Element parameter
System structuralParameter Element input
System structuralParameter Element inout
System parameter Element parameter
System parameter Element input
System parameter Element inout
System input Element input
System input Element inout
Element constant Element structuralParameter
Element constant Element parameter
Element constant Element input
Element constant Element inout
Element calculatedParameter Element parameter
Element calculatedParameter Element input
Element calculatedParameter Element inout
Element output Element input
Element output Element inout
Element local Element input
Element local Element inout
Element inout Element input
Element constant System constant
Element constant System calculatedParameter
Element constant System output
Element constant System local
Element calculatedParameter System calculatedParameter
Element calculatedParameter System output
Element calculatedParameter System local
Element output System output
Element output System local
Element local System output
Element local System local
Element inout System output
Element inout System local
"""
OURS = {("Element", "inout", "Element", "inout")}  # from one dictionary to another


def test_the_table_of_the_standard():
    allowed = {
        (*source, *target)
        for source, target in itertools.product(itertools.product(("System", "Element"), KINDS), repeat=2)
        if can_connect(source[1], source[0] == "System", target[1], target[0] == "System")
    }
    assert allowed - OURS == {tuple(line.split()) for line in TABLE.strip().splitlines()}
