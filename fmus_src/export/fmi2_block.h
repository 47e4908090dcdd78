/* What the C of a block tells the FMI wrapper about the block's variables. */
#ifndef FMI2_BLOCK_H
#define FMI2_BLOCK_H

#include "kernel_math.h"

typedef enum Kind { KIND_REAL, KIND_INTEGER, KIND_BOOLEAN } Kind;

typedef enum Role { ROLE_PARAMETER, ROLE_INPUT, ROLE_OUTPUT, ROLE_STATE } Role;

/* One scalar, or one element of a vector. Value references number these in order. */
typedef struct Element {
    const char *name;
    Kind kind; /* double, int64_t or bool in the block's struct */
    Role role;
    size_t offset; /* in the block's struct */
} Element;

#endif
