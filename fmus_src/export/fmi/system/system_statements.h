/* What the statements of a system's steps do where that takes more than a line. They stand in functions that have the
 * Fault `fault` and return nothing.
 */
#ifndef SYSTEM_STATEMENTS_H
#define SYSTEM_STATEMENTS_H

#include "kernel_math.h"

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
} FaultInput;

enum { FAULT_NONE, FAULT_OVERRIDE, FAULT_BIAS, FAULT_FREEZE };

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

#endif
