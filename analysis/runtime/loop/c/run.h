/* One run of a system: its program, its memory, its simulated range and its recording.
 *
 * Python reads this file (structures.py) and fills the members by name from arrays and numbers: members are declared
 * only here. NAME_rows and NAME_columns are the dimensions of the array NAME. Dimensions: i instructions, s slots, p
 * parameter values, c connections, f faults, t texts, n communication points. Times are in s.
 */
#ifndef RUN_H
#define RUN_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* How a run ends. */
enum Ending {
    STOP_TIME = 0,
    FINISHED = 1,
    NONFINITE = 2,
    FAILED = 3,
    UNMAPPED = 4,
    INTERRUPTED = 5,
    NOT_TAKEN = 6,
    TOO_LONG = 7,
    ENDED = 8,
    STUCK = 9,
    OUTSIDE_STEP = 10,
};

/* Words of an outcome. A failure writes all except POINT_REACHED, which, like SUBJECT, is written during the run. */
enum OutcomeWord {
    ENDING = 0,
    SUBJECT = 1,        /* component, slot, parameter or text concerned */
    FUNCTION_CALLED = 2,
    STATUS_RETURNED = 3,
    POINT_REACHED = 4,  /* communication point being computed */
    INSTRUCTION = 5,
};

#define FMI_WARNING 1

/* A system as arrays. */
typedef struct {
    const uint64_t *instructions;        /* [i, COLUMNS] */
    int64_t reset_end;                   /* end of the instructions that end a run and reset the FMUs */
    const int64_t *phases;               /* [m + 1], ends of initialisation and m sections, executed in turn */
    int64_t phases_rows;
    const uint32_t *reference;           /* [s], value references */
    const double *initial;               /* [s], start values of inputs, NaN for values not known yet */
    const uint32_t *parameter_reference; /* [p] */
    const double *tolerance;             /* [components], relative, for solvers of FMUs; NaN if none is stated */
    const int64_t *source;               /* [c], slots */
    const int64_t *target;               /* [c], slots */
    const double *factor;                /* [c] */
    const double *offset;                /* [c] */
    const int64_t *table;                /* [c, 2], first entry and number of entries in table_from, table_to */
    const double *table_from;
    const double *table_to;
    int64_t finished_slot;               /* slot of the connector `finished`, -1 if there is none */
    const int64_t *fault_slot;           /* [f] */
    const int64_t *fault_kind;           /* [f], OVERRIDE, BIAS, FREEZE or EXCITE */
    double *fault_window;                /* [f, 2], start and end */
    double *fault_value;                 /* [f]; for EXCITE the column of the excitation */
    const int64_t *drive_slot;           /* [d], inputs driven over time */
    const double *drive_table;           /* [n, d], for the initialisation, then for every communication point */
    int64_t drive_table_rows;
    int64_t drive_table_columns;
} Program;

/* Parameter values. */
typedef struct {
    double *real;   /* [p] */
    int32_t *whole; /* [p] */
    uint64_t *text; /* [p], addresses of C strings */
} Settings;

/* Exchanged Strings or Binaries. */
typedef struct {
    const uint32_t *reference; /* [t], value references */
    const uint8_t *initial;    /* [t, bytes], before the first exchange */
    uint8_t *rows;             /* [t, bytes], Strings zero-terminated */
    int64_t rows_rows;
    int64_t rows_columns;
    const uint64_t *address;   /* [t], addresses of the rows */
    uint64_t *given;           /* [t], addresses returned by FMUs */
} Texts;

/* Memory of a run. */
typedef struct {
    double *values;      /* [s] */
    int64_t values_rows;
    int32_t *whole;      /* [s] */
    double *frozen;      /* [f], NaN until a freeze begins */
    int64_t frozen_rows;
    Settings read_back;  /* parameters read back from the initialised FMUs */
    int64_t *outcome;    /* [OutcomeWord] */
    Texts texts;
    const int64_t *halt; /* [1]; another thread sets it to end the run at its next communication point */
} Buffers;

/* Simulated range of a run. */
typedef struct {
    int64_t reset; /* true if the FMUs were simulated before */
    double start;
    double step;
    double stop;   /* stop time passed to FMUs; infinite if there is none */
    int64_t first; /* communication point at which to continue with current buffers and FMUs; -1 initialises */
    int64_t last;  /* last communication point to simulate */
} Span;

/* Recorded rows: these slots at every stride-th communication point and at the last one. */
typedef struct {
    const int64_t *slots; /* [k] */
    int64_t slots_rows;
    int64_t stride;
    double *record;       /* [k, r], with the rows of a slot contiguous */
    int64_t record_columns;
    double *times;        /* [r] */
    int64_t offset;       /* first row to write */
} Recording;

/* Transfers of slots, parameters or texts to and from FMUs of FMI 3.0; each is one call. */
typedef struct {
    const int64_t *rows;       /* [q, TRANSFER_COLUMNS] */
    const uint32_t *reference; /* value references, a single one for a whole array */
    const uint64_t *functions; /* [components, FUNCTION_NAMES], addresses */
    int64_t functions_columns;
} Transfers;

/* Values of FMUs of FMI 3.0, stored in their FMI types. */
typedef struct {
    uint64_t *sent;  /* [s], values last exchanged, contiguous for each transfer from its first slot on */
    uint64_t *exact; /* [s], 64-bit integers, which may be rounded in the double of their slot */
    bool *flags;     /* [8], flags returned by calls */
    double *time;    /* [2], times returned by calls; the last: end set by an FMU, or start of a step */
} StoredValues;

/* Additional arrays of systems with FMUs of FMI 3.0. */
typedef struct {
    Transfers transfers;
    const uint64_t *start;         /* [s], 64-bit integers before the first exchange */
    StoredValues stored;
    uint64_t *given;               /* [p], parameters to set, contiguous for each transfer from its first word on */
    uint64_t *confirmed;           /* [p], the same parameters as read back */
    Texts binaries;
    uint64_t *sizes;               /* [t], size of each Binary in bytes */
    int64_t sizes_rows;
    const uint64_t *initial_sizes; /* [t] */
} Fmi3;

typedef struct {
    Program program;
    Buffers buffers;
    Settings settings;
    Span span;
    Recording recording;
    const double *excitation; /* [r, e], added to the excited slots at the communication points after span.first */
    int64_t excitation_rows;
    int64_t excitation_columns;
    int64_t has_fmi3;
    Fmi3 fmi3;
    uint64_t fused_steps;     /* address of a FusedSteps; 0 if instructions are interpreted */
} Run;

/* Compiled steps of a system, executed from a communication point on; returns the number of rows in the record. */
typedef int64_t FusedSteps(const Run *run, int64_t point, int64_t rows, int64_t to_record);

/* Inputs and outcomes of n consecutive runs: v parameters of type Real, w Integers and Booleans. */
typedef struct {
    const double *real;           /* [n, v] */
    const int64_t *real_position; /* [v], indices in Settings */
    int64_t real_position_rows;
    const int32_t *whole;         /* [n, w] */
    const int64_t *whole_position;
    int64_t whole_position_rows;
    const double *fault_window;   /* [n, f, 2], of the first f faults */
    const double *fault_value;    /* [n, f] */
    int64_t fault_value_columns;
    int64_t *ends;                /* [n], row of the record after each run's last row */
    int64_t ends_rows;
    int64_t *endings;             /* [n], ENDING of each run */
} RunGroup;

#endif
