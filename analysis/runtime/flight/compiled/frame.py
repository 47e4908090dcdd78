"""What the compiled loop hands to the C of a system's steps: words in a row, which both sides name alike."""

from __future__ import annotations

POINTERS = {
    "instructions": "const uint64_t",
    "values": "double",
    "whole": "int32_t",
    "frozen": "double",
    "outcome": "int64_t",
    "halt": "const volatile int64_t",
    "reference": "const uint32_t",
    "fault_window": "const double",
    "fault_value": "const double",
    "excitation": "const double",
    "drive_table": "const double",
    "record": "double",
    "times": "double",
    "text_reference": "const uint32_t",
    "text_address": "char *const",
    "text_given": "const char *",
}
# Lengths and counters: rows and columns of tables, the columns of the record, where the flight stands.
COUNTS = (
    "excitation_rows",
    "excitation_columns",
    "drive_rows",
    "drive_columns",
    "capacity",
    "text_size",
    "stride",
    "rows",
    "to_record",
    "point",
    "first_point",
    "last_point",
)
REALS = ("start", "step")  # s
WORDS = (*POINTERS, *COUNTS)
