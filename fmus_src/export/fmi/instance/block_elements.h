/* What the C of a block tells the FMI wrappers about the elements of the block's variables. */
#ifndef BLOCK_ELEMENTS_H
#define BLOCK_ELEMENTS_H

#include "kernel_vectors.h"

#define NAME_SIZE 512 /* of an element, in messages */

/* What an element is and when it may be set; bits, so that one test covers a whole list of elements. */
typedef enum Trait {
    KIND_REAL = 1,    /* double in the block's struct */
    KIND_INTEGER = 2, /* int64_t */
    KIND_BOOLEAN = 4, /* bool */
    KIND_ANY = KIND_REAL | KIND_INTEGER | KIND_BOOLEAN,
    SET_BEFORE_STEPS = 8,
    SET_BETWEEN_STEPS = 16,
    COMPUTED = 32,
    TUNABLE = 64 /* a parameter that may be set between steps within its range */
} Trait;

#define ROLE_PARAMETER SET_BEFORE_STEPS
#define ROLE_TUNABLE (SET_BEFORE_STEPS | TUNABLE)
#define ROLE_INPUT (SET_BEFORE_STEPS | SET_BETWEEN_STEPS)
#define ROLE_OUTPUT COMPUTED
#define ROLE_STATE COMPUTED

/* One scalar, or one element of a vector. FMI 2.0's value references number these in order. Eight bytes each:
 * every call that gets or sets reads them. Names, for messages only, are in a table apart. */
typedef struct Element {
    uint32_t offset; /* in the block's struct */
    uint16_t traits;
    uint16_t alike; /* so many from this one on, itself included, have its traits and lie side by side */
} Element;

/* What parameters and inputs may be where a simulation starts, tunable parameters between steps, too. A table apart from ELEMENTS, which every step reads; a
 * row whose count is 0 ends it. */
typedef struct Range {
    uint32_t first; /* element */
    uint32_t count; /* of elements from there on, which lie side by side */
    double minimum;
    double maximum;
} Range;

#endif
