/* One instance of a block: its state, its life cycle, its messages, alike in all versions of FMI.
 *
 * fmi2_types.h or fmi3_types.h, included before, says what a status and a logger are.
 *
 * The life cycle is that of fmus_src/runtime.py, line by line: setting a variable during
 * initialisation marks the instance, the next read puts states and outputs back to their
 * declared starts and runs the block's initialize again.
 */
#ifndef INSTANCE_H
#define INSTANCE_H

#include <inttypes.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "python_repr.h"

#define ELEMENT_COUNT (sizeof ELEMENTS / sizeof ELEMENTS[0])
#define MESSAGE_SIZE 1024

/* States of the co-simulation state machine; bits, so that a set of them is one number. */
typedef enum Mode {
    MODE_INSTANTIATED = 1,
    MODE_INITIALIZATION = 2,
    MODE_STEP = 4,
    MODE_TERMINATED = 8,
    MODE_ERROR = 16
} Mode;

#define MODE_ANY (MODE_INSTANTIATED | MODE_INITIALIZATION | MODE_STEP | MODE_TERMINATED | MODE_ERROR)
#define MODE_READABLE (MODE_INITIALIZATION | MODE_STEP | MODE_TERMINATED | MODE_ERROR)
#define MODE_SETTABLE (MODE_INSTANTIATED | MODE_INITIALIZATION | MODE_STEP)

/* Everything that a step depends on; copying it copies the instance's state. */
typedef struct Snapshot {
    Mode mode;
    bool unsettled;
    int64_t tick; /* samples taken since the start */
    double start_time;
    double time; /* end of the last successful step */
    Block block;
} Snapshot;

typedef struct Component {
    Snapshot now;
    Status last_step;
    double stop_time; /* INFINITY where the importer has not said when it stops */
    Logger logger; /* NULL where nothing is logged */
    Logger importers_logger;
    Environment environment;
    char instance_name[];
} Component;

/* The instance behind FMI's pointer, which C++ does not convert by itself. */
static inline Component *instance_of(void *pointer)
{
    return (Component *)pointer;
}

/* What the file around the wrapper provides: a block with `single_block.h`, a system of blocks with `system_steps.h` and
 * its own C. */
static void get_starts(Block *block); /* declared starts of all variables */
static void pass_parameters(Block *block, Fault *fault); /* set those that follow from others */
static bool is_used(const Block *block, uint32_t offset); /* true where the element there is of what is simulated */
static Status advance(Component *component, double t, double h);

/* Log an error and return it. */
static COLD Status fail(const Component *component, const char *format, ...)
{
    if (component->logger != NULL) {
        char message[MESSAGE_SIZE];
        va_list arguments;
        va_start(arguments, format);
        vsnprintf(message, sizeof message, format, arguments);
        va_end(arguments);
        log_error(component->logger, component->environment, component->instance_name, message);
    }
    return STATUS_ERROR;
}

static const char *mode_name(Mode mode)
{
    switch (mode) {
        case MODE_INSTANTIATED: return "before initialisation";
        case MODE_INITIALIZATION: return "during initialisation";
        case MODE_STEP: return "between steps";
        case MODE_TERMINATED: return "after termination";
        case MODE_ERROR: return "after an error";
    }
    return "in an unknown state";
}

/* STATUS_OK where the function may be called now. */
static inline Status check_mode(const Component *component, const char *function, int allowed)
{
    if (component == NULL) return STATUS_ERROR;
    if ((component->now.mode & allowed) == 0) {
        return fail(component, "%s is not allowed %s", function, mode_name(component->now.mode));
    }
    return STATUS_OK;
}

/* End the run with the Python line that raises in the Python flavour, if the fault is of one. */
static COLD Status end_with_fault(Component *component, const Fault *fault, const char *where)
{
    const char *subject = fault->subject == NULL ? "" : fault->subject;
    const char *colon = fault->subject == NULL ? "" : ": ";
    component->now.mode = MODE_ERROR;
    if (fault->file == NULL) return fail(component, "%s%s%s%s", subject, colon, fault->what, where);
    return fail(component, "%s%sFile \"%s\", line %d: %s%s", subject, colon, fault->file, fault->line, fault->what, where);
}

/* An int of the block that FMI's type of 32 bits cannot hold. */
static COLD Status refuse_wide(Component *component, uint32_t reference, int64_t wide, const char *type)
{
    component->now.mode = MODE_ERROR;
    return fail(component, "OverflowError: %s = %" PRId64 " exceeds an FMI %s's 32 bits", NAMES[reference], wide, type);
}

/* Why a variable of the right type may not be set now. */
static COLD Status refuse_set(const Component *component, const char *function, uint32_t reference, uint32_t traits)
{
    const char *why = traits & COMPUTED ? "computed and cannot be set" : "a parameter, fixed after initialisation";
    return fail(component, "%s: %s is %s", function, NAMES[reference], why);
}

/* Back to the state right after instantiation. */
static void restart(Component *component)
{
    memset(&component->now, 0, sizeof component->now);
    get_starts(&component->now.block);
    component->now.mode = MODE_INSTANTIATED;
    component->now.unsettled = true;
    component->last_step = STATUS_OK;
    component->stop_time = INFINITY;
}

static COLD Status refuse_point(Component *component, double point)
{
    char point_text[REPR_SIZE];
    char here_text[REPR_SIZE];
    return fail(component,
        "StepError: the step begins at %s s, and the FMU is at %s s; continue from there, or restore the state at the step's beginning",
        python_repr(point, point_text), python_repr(component->now.time, here_text));
}

static COLD Status refuse_end(Component *component, double end)
{
    char end_text[REPR_SIZE];
    char stop_text[REPR_SIZE];
    return fail(component, "StepError: the step ends at %s s, after the stop time of %s s",
        python_repr(end, end_text), python_repr(component->stop_time, stop_text));
}

static COLD Status end_step_with_fault(Component *component, const Fault *fault, double t, double h)
{
    char t_text[REPR_SIZE];
    char h_text[REPR_SIZE];
    char where[2 * REPR_SIZE + 40];
    snprintf(where, sizeof where, ", in the step from t = %s s over h = %s s", python_repr(t, t_text),
        python_repr(h, h_text));
    return end_with_fault(component, fault, where);
}

#endif
