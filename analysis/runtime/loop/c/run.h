/* One run of a system: its program, its memory, and what of it is simulated and recorded.
 *
 * Python reads this file (run_layout.py) and fills the members by name from arrays and numbers: a member is declared
 * here alone. NAME_rows and NAME_columns are the sizes of the array NAME. Sizes: i instructions, s slots, p parameter
 * values, c connections, f faults, t texts, n communication points. Times in s.
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

/* Words of an outcome. A failure leaves all but POINT_REACHED, which a run in flight writes with SUBJECT. */
enum OutcomeWord {
    ENDING = 0,
    SUBJECT = 1,        /* component, slot, parameter or text */
    FUNCTION_CALLED = 2,
    STATUS_RETURNED = 3,
    POINT_REACHED = 4,  /* the communication point that is being computed */
    INSTRUCTION = 5,
};

#define FMI_WARNING 1

/* A system as arrays. */
typedef struct {
    const uint64_t *instructions;        /* [i, COLUMNS] */
    int64_t reset_end;                   /* instructions before it end a run and reset the FMUs: a fresh instance skips them */
    const int64_t *phases;               /* [m + 1]: instructions before the first initialise; step n executes part n mod m */
    int64_t phases_rows;
    const uint32_t *reference;           /* [s], value references */
    const double *initial;               /* [s], before anything is exchanged: starts of inputs, NaN for what is to come */
    const uint32_t *parameter_reference; /* [p] */
    const double *tolerance;             /* of each component's own solver, NaN where its FMU states none */
    const int64_t *source;               /* [c], slots */
    const int64_t *target;               /* [c], slots */
    const double *factor;                /* [c] */
    const double *offset;                /* [c] */
    const int64_t *table;                /* [c, 2], first and count in table_from, table_to */
    const double *table_from;
    const double *table_to;
    int64_t finished_slot;               /* -1: no connector `finished` */
    const int64_t *fault_slot;           /* [f] */
    const int64_t *fault_kind;           /* [f], OVERRIDE, BIAS, FREEZE or EXCITE */
    double *fault_window;                /* [f, 2], from and until */
    double *fault_value;                 /* [f]; of EXCITE the column of the excitation */
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

/* Strings, or Binaries, that are exchanged. */
typedef struct {
    const uint32_t *reference; /* [t], value references */
    const uint8_t *initial;    /* [t, bytes], before anything is exchanged */
    uint8_t *rows;             /* [t, bytes], Strings zero-terminated */
    int64_t rows_rows;
    int64_t rows_columns;
    const uint64_t *address;   /* [t], of the rows */
    uint64_t *given;           /* [t], addresses that FMUs returned */
} Texts;

/* Memory of a run. */
typedef struct {
    double *values;      /* [s] */
    int64_t values_rows;
    int32_t *whole;      /* [s] */
    double *frozen;      /* [f], NaN until a freeze begins */
    int64_t frozen_rows;
    Settings read_back;  /* parameters as the FMUs have them, once initialised */
    int64_t *outcome;    /* [OutcomeWord] */
    Texts texts;
    const int64_t *halt; /* [1], which another thread sets to end the run at its next point */
} Buffers;

/* What of a run is simulated. */
typedef struct {
    int64_t reset; /* whether the FMUs have been simulated before */
    double start;
    double step;
    double stop;   /* the stop time that FMUs are given; infinite: none */
    int64_t first; /* communication point to continue from, with buffers and FMUs as they are; -1 initialises */
    int64_t last;  /* communication point to simulate to */
} Span;

/* What is recorded: these slots at every stride-th communication point, and always at the last one. */
typedef struct {
    const int64_t *slots; /* [k] */
    int64_t slots_rows;
    int64_t stride;
    double *record;       /* [k, r], the samples of a slot side by side */
    int64_t record_columns;
    double *times;        /* [r] */
    int64_t offset;       /* the first row that is written */
} Recording;

/* What is exchanged with FMUs of FMI 3.0: transfers of slots, parameters or texts, one call each. */
typedef struct {
    const int64_t *rows;       /* [q, TRANSFER_COLUMNS] */
    const uint32_t *reference; /* value references, one of a whole array */
    const uint64_t *functions; /* [components, FUNCTION_NAMES], addresses */
    int64_t functions_columns;
} Transfers;

/* Values of FMUs of FMI 3.0 in their own types. */
typedef struct {
    uint64_t *sent;  /* [s], each transfer's values side by side from its first slot on, as last exchanged */
    uint64_t *exact; /* [s], integers of 64 bits, of which the double of a slot may be rounded */
    bool *flags;     /* [8], what calls return */
    double *time;    /* [2], likewise: the last is when an FMU has ended the simulation, or began a step */
} StoredValues;

/* What a system with FMUs of FMI 3.0 has in addition. */
typedef struct {
    Transfers transfers;
    const uint64_t *start;         /* [s], integers of 64 bits before anything is exchanged */
    StoredValues stored;
    uint64_t *given;               /* [p], parameters: each transfer's values side by side from its first word on */
    uint64_t *confirmed;           /* [p], likewise, read back */
    Texts binaries;
    uint64_t *sizes;               /* [t], bytes of each Binary */
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
    uint64_t fused_steps;     /* address of a FusedSteps, 0: instructions are interpreted */
} Run;

/* The steps of a system compiled as one function, from a communication point on; returns the rows in the record. */
typedef int64_t FusedSteps(const Run *run, int64_t point, int64_t rows, int64_t to_record);

/* Inputs and outcomes of n consecutive runs: v parameters of type Real, w Integers and Booleans. */
typedef struct {
    const double *real;           /* [n, v] */
    const int64_t *real_position; /* [v], in Settings */
    int64_t real_position_rows;
    const int32_t *whole;         /* [n, w] */
    const int64_t *whole_position;
    int64_t whole_position_rows;
    const double *fault_window;   /* [n, f, 2], of the first f faults */
    const double *fault_value;    /* [n, f] */
    int64_t fault_value_columns;
    int64_t *ends;                /* [n], the rows in the record after each run */
    int64_t ends_rows;
    int64_t *endings;             /* [n], ENDING of each run */
} RunGroup;

#endif
