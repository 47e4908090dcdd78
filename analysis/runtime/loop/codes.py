"""Codes of the loop's instructions and run endings, compared with `c/codes.h` and `c/run.h` when it is loaded.

A system becomes a list of instructions (`instructions.py`): one section for the initialisation, one that is repeated
every communication step. The loop knows no algorithm: the order of instructions determines it.
"""

# Every communication step.
COPY, TRANSFORM, MAP, INJECT, SET_REAL, SET_WHOLE, GET_REAL, GET_WHOLE, STEP, DRIVE, ADD = range(11)
READ_REAL = SET_REAL  # a call that passes Reals; a GET_REAL looks whether they are finite
PUT_REAL, MOVE_REAL, TAKE_REAL, TAKE_WHOLE, TAKE_BOOLEAN = range(11, 16)
SET_TEXT, GET_TEXT, COPY_TEXT = range(16, 19)
# Once, before a flight; behind all others, as those of Strings are behind those of numbers.
PARAMETERS, WHOLE_PARAMETERS, TEXT_PARAMETERS, SETUP, MODE, READ_BACK, WHOLE_READ_BACK, TEXT_READ_BACK = range(19, 27)
# Of FMI 3.0, behind all others.
SET_TRANSFER, GET_TRANSFER, READ_TRANSFER, COPY_EXACT, STEP_TO_EVENTS, SETTLE = range(27, 33)
COPY_BINARY, GIVE_TEXTS, TAKE_TEXTS, SET_EVENTS = range(33, 37)
GIVE_PARAMETERS, TAKE_BACK, ENTER_INITIALIZATION = range(37, 40)
RESTORE_FLOATS = 40  # after each call of an FMU that is not self-contained
IN_MEMORY = (PUT_REAL, MOVE_REAL, TAKE_REAL, TAKE_WHOLE, TAKE_BOOLEAN)  # whose ADDRESS is a place in the instance

# Instruction columns. FIRST and COUNT are connections, faults, slots, parameters, Strings or driven inputs; a COPY
# and a COPY_TEXT have the first target in FIRST and the first source in ADDRESS; a STEP over several communication
# steps their number in COUNT (0 for one); those IN_MEMORY the place of the first variable in ADDRESS, and a
# MOVE_REAL, which is a COPY and its PUT_REAL, the first source in FUNCTION; behind a TAKE_WHOLE stands the GET_WHOLE
# of the same slots, which is called where one of them is beyond 32 bits, so that the FMU says so; a DRIVE has 0 in
# ADDRESS while the FMUs initialise, then 1; FUNCTION numbers library.FUNCTION_NAMES. Exchanged values belong to the
# end of the step, the initialisation's to the start.
CODE, ADDRESS, INSTANCE, FIRST, COUNT, COMPONENT, FUNCTION = range(7)
COLUMNS = 7
# Of FMI 3.0 FIRST and COUNT are transfers, rows of `arrays.Transfers.rows`; a COPY_EXACT and a COPY_BINARY have the
# columns of a COPY, and a STEP_TO_EVENTS has in FIRST whether its component uses event mode.
# The columns of a transfer: its variables, then its slots, parameters or texts.
REFERENCE, REFERENCES, FIRST_VALUE, VALUES, KIND = range(5)
TRANSFER_COLUMNS = 5
# Kinds of a transfer, in the order of representations.REPRESENTATIONS.
FLOAT64, FLOAT32, INT8, UINT8, INT16, UINT16, INT32, UINT32, INT64, UINT64, BOOLEAN, STRING, BINARY = range(13)
# FUNCTION of calls of FMI 3.0 alone; there is a setter and a getter for each kind.
SETTERS, GETTERS, DO_STEP = 14, 27, 40
ENTER_EVENT_MODE, UPDATE_DISCRETE_STATES, ENTER_STEP_MODE = 46, 47, 48

# Words of Buffers.outcome, and the first of them: how a run ends.
ENDING, SUBJECT, FUNCTION_CALLED, STATUS_RETURNED, POINT_REACHED, INSTRUCTION = range(6)
STOP_TIME, FINISHED, NONFINITE, FAILED, UNMAPPED, INTERRUPTED, NOT_TAKEN, TOO_LONG, ENDED, STUCK = range(10)
OUTSIDE_STEP = 10
OVERRIDE, BIAS, FREEZE, EXCITE = range(4)
