"""Codes of the loop's instructions and run endings, compared with `c/codes.h` and `c/run.h` when the loop is loaded.

A system becomes a list of instructions (`instructions.py`): a section for the initialisation, and sections that are
repeated in turn, one for each communication step. The loop knows no algorithm: the order of instructions determines it.
"""

# Executed in every communication step.
COPY, TRANSFORM, MAP, INJECT, SET_REAL, SET_WHOLE, GET_REAL, GET_WHOLE, STEP, DRIVE, ADD = range(11)
READ_REAL = SET_REAL  # calls that pass Reals; only GET_REAL checks that they are finite
PUT_REAL, MOVE_REAL, TAKE_REAL, TAKE_WHOLE, TAKE_BOOLEAN = range(11, 16)
SET_TEXT, GET_TEXT, COPY_TEXT = range(16, 19)
# Executed once, before a flight.
PARAMETERS, WHOLE_PARAMETERS, TEXT_PARAMETERS, SETUP, MODE, READ_BACK, WHOLE_READ_BACK, TEXT_READ_BACK = range(19, 27)
# Only for FMI 3.0.
SET_TRANSFER, GET_TRANSFER, READ_TRANSFER, COPY_EXACT, STEP_TO_EVENTS, SETTLE = range(27, 33)
COPY_BINARY, GIVE_TEXTS, TAKE_TEXTS, SET_EVENTS = range(33, 37)
GIVE_PARAMETERS, TAKE_BACK, ENTER_INITIALIZATION = range(37, 40)
RESTORE_FLOATS = 40  # after each call of an FMU that is not self-contained
IN_MEMORY = (PUT_REAL, MOVE_REAL, TAKE_REAL, TAKE_WHOLE, TAKE_BOOLEAN)  # with an ADDRESS in the instance's memory

# Instruction columns. FIRST and COUNT are a range of connections, faults, slots, parameters, Strings or driven inputs.
# FUNCTION is a number in library.FUNCTION_NAMES. Special cases:
# - COPY, COPY_TEXT: FIRST is the first target, ADDRESS the first source
# - STEP: COUNT is the number of communication steps, 0 for one
# - IN_MEMORY: ADDRESS is the address of the first variable
# - MOVE_REAL, a COPY with its PUT_REAL: FUNCTION is the first source
# - TAKE_WHOLE: followed by a GET_WHOLE of the same slots, which is called if one of them exceeds 32 bits, so that the
#   FMU reports the error
# - DRIVE: ADDRESS is 0 while the FMUs initialise, then 1
# Exchanged values belong to the end of the step, in the initialisation to the start of the simulation.
CODE, ADDRESS, INSTANCE, FIRST, COUNT, COMPONENT, FUNCTION = range(7)
COLUMNS = 7
# In instructions of FMI 3.0, FIRST and COUNT are a range of transfers, rows of `arrays.Transfers.rows`. COPY_EXACT and
# COPY_BINARY have the columns of COPY. FIRST of STEP_TO_EVENTS is 1 if its component uses event mode.
# Columns of a transfer: its variables, then its slots, parameters or texts.
REFERENCE, REFERENCES, FIRST_VALUE, VALUES, KIND = range(5)
TRANSFER_COLUMNS = 5
# Kinds of a transfer, in the order of representations.REPRESENTATIONS.
FLOAT64, FLOAT32, INT8, UINT8, INT16, UINT16, INT32, UINT32, INT64, UINT64, BOOLEAN, STRING, BINARY = range(13)
# FUNCTION of calls that only FMI 3.0 has; there is a setter and a getter for each kind.
SETTERS, GETTERS, DO_STEP = 14, 27, 40
ENTER_EVENT_MODE, UPDATE_DISCRETE_STATES, ENTER_STEP_MODE = 46, 47, 48

# Words of Buffers.outcome, and the values of the first word, ENDING.
ENDING, SUBJECT, FUNCTION_CALLED, STATUS_RETURNED, POINT_REACHED, INSTRUCTION = range(6)
STOP_TIME, FINISHED, NONFINITE, FAILED, UNMAPPED, INTERRUPTED, NOT_TAKEN, TOO_LONG, ENDED, STUCK = range(10)
OUTSIDE_STEP = 10
OVERRIDE, BIAS, FREEZE, EXCITE = range(4)
