/* Instructions of the loop, rows of a table of numbers; codes.py explains the columns. */
#ifndef CODES_H
#define CODES_H

enum Column { CODE = 0, ADDRESS = 1, INSTANCE = 2, FIRST = 3, COUNT = 4, COMPONENT = 5, FUNCTION = 6, COLUMNS = 7 };

enum Code {
    COPY = 0,
    TRANSFORM = 1,
    MAP = 2,
    INJECT = 3,
    SET_REAL = 4,
    SET_WHOLE = 5,
    GET_REAL = 6,
    GET_WHOLE = 7,
    STEP = 8,
    DRIVE = 9,
    ADD = 10,
    PUT_REAL = 11,
    MOVE_REAL = 12,
    TAKE_REAL = 13,
    TAKE_WHOLE = 14,
    TAKE_BOOLEAN = 15,
    SET_TEXT = 16,
    GET_TEXT = 17,
    COPY_TEXT = 18,
    PARAMETERS = 19,
    WHOLE_PARAMETERS = 20,
    TEXT_PARAMETERS = 21,
    SETUP = 22,
    MODE = 23,
    READ_BACK = 24,
    WHOLE_READ_BACK = 25,
    TEXT_READ_BACK = 26,
    /* only for FMI 3.0 */
    SET_TRANSFER = 27,
    GET_TRANSFER = 28,
    READ_TRANSFER = 29,
    COPY_EXACT = 30,
    STEP_TO_EVENTS = 31,
    SETTLE = 32,
    COPY_BINARY = 33,
    GIVE_TEXTS = 34,
    TAKE_TEXTS = 35,
    SET_EVENTS = 36,
    GIVE_PARAMETERS = 37,
    TAKE_BACK = 38,
    ENTER_INITIALIZATION = 39,
    /* after each call of an FMU that is not self-contained */
    RESTORE_FLOATS = 40,
};

enum FaultKind { OVERRIDE = 0, BIAS = 1, FREEZE = 2, EXCITE = 3 };

/* Columns of a transfer: its variables, then its slots, parameters or texts. */
enum TransferColumn { REFERENCE = 0, REFERENCES = 1, FIRST_VALUE = 2, VALUES = 3, KIND = 4, TRANSFER_COLUMNS = 5 };

enum Kind {
    FLOAT64 = 0,
    FLOAT32 = 1,
    INT8 = 2,
    UINT8 = 3,
    INT16 = 4,
    UINT16 = 5,
    INT32 = 6,
    UINT32 = 7,
    INT64 = 8,
    UINT64 = 9,
    BOOLEAN = 10,
    STRING = 11,
    BINARY = 12,
};

/* Numbers of functions of FMI 3.0 in library.FUNCTION_NAMES, which has a setter and a getter for each kind. */
enum Function {
    SETTERS = 14,
    GETTERS = 27,
    DO_STEP = 40,
    ENTER_EVENT_MODE = 46,
    UPDATE_DISCRETE_STATES = 47,
    ENTER_STEP_MODE = 48,
};

#endif
