/* What the statements of a system's steps do where that takes more than a line. They stand in functions that have the
 * Fault `fault` and return nothing.
 */
#ifndef SYSTEM_STATEMENTS_H
#define SYSTEM_STATEMENTS_H

#include "block_elements.h"

/* End the step for a reason of the system's own; `name` is a component or a signal. */
#define FAIL(name, why) \
    { \
        fault->what = why; \
        fault->subject = name; \
        return; \
    }

/* End the step where a component has failed. */
#define FAILED_IN(name) \
    if (fault->what != NULL) { \
        fault->subject = name; \
        return; \
    }

#define CHECK_FINITE(value, name) \
    if (!(fabs(value) < INFINITY)) FAIL(name, "its value is not finite")

/* A number for an Integer or a Boolean. */
#define CHECK_WHOLE(value, name) \
    if (!((value) >= INT32_MIN && (value) <= INT32_MAX)) FAIL(name, "its value does not fit into 32 bits")

#define CHECK_32_BITS(value, name) \
    if ((value) < INT32_MIN || (value) > INT32_MAX) FAIL(name, "OverflowError: exceeds an FMI Integer's 32 bits")

/* A fault of a connector, as the FMU's inputs say. */
typedef struct FaultInput {
    int64_t kind; /* FAULT_NONE and the like */
    double value; /* of an override or a bias, in the connector's unit */
    double frozen; /* what a freeze keeps; NAN before it begins */
    int64_t last_kind; /* those of the last step */
    double last_value;
} FaultInput;

enum { FAULT_NONE, FAULT_OVERRIDE, FAULT_BIAS, FAULT_FREEZE };

/* What is wrong with a fault of a connector of this kind; NULL: nothing. */
static inline const char *refuse_fault(const FaultInput *input, int connector)
{
    if (input->kind < FAULT_NONE || input->kind > FAULT_FREEZE) return "there is no such kind of fault; give 0 to 3";
    if (input->kind == FAULT_BIAS && connector == KIND_BOOLEAN) return "a Boolean has no bias; give an override";
    if (input->kind != FAULT_OVERRIDE && input->kind != FAULT_BIAS) return NULL;
    if (!isfinite(input->value)) return "the value is not finite";
    if (connector == KIND_REAL) return NULL;
    if (connector == KIND_BOOLEAN && input->value != 0.0 && input->value != 1.0) return "the value is no Boolean; give 0 or 1";
    if (!(input->value >= INT32_MIN && input->value <= INT32_MAX)) return "the value does not fit into 32 bits";
    return input->value == floor(input->value) ? NULL : "the value is no whole number";
}

#define CHECK_FAULT(input, connector, name) \
    { \
        const char *why = refuse_fault(&(input), connector); \
        if (why != NULL) FAIL(name, why) \
    }

/* On a value that is exchanged at the end of a step. */
static inline void inject(double *signal, FaultInput *input)
{
    if (input->kind == FAULT_OVERRIDE) *signal = input->value;
    if (input->kind == FAULT_BIAS) *signal += input->value;
    if (input->kind == FAULT_FREEZE) {
        if (isnan(input->frozen)) input->frozen = *signal;
        *signal = input->frozen;
    } else {
        input->frozen = NAN;
    }
}

/* On a value that the last step has handed over and that an input of the system has changed since. */
static inline void inject_again(double *signal, const FaultInput *input)
{
    if (input->last_kind == FAULT_OVERRIDE) *signal = input->last_value;
    if (input->last_kind == FAULT_BIAS) *signal += input->last_value;
    if (input->last_kind == FAULT_FREEZE) *signal = input->frozen;
}

static inline void note_fault(FaultInput *input)
{
    input->last_kind = input->kind;
    input->last_value = input->value;
}

#endif
