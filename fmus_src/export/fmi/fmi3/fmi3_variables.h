/* What the C of a block tells the FMI 3.0 wrapper about the block's variables. */
#ifndef FMI3_VARIABLES_H
#define FMI3_VARIABLES_H

#include "block_elements.h"

typedef enum VariableType { TYPE_FLOAT64, TYPE_INT32, TYPE_BOOLEAN, TYPE_ENUMERATION } VariableType;

/* One scalar, vector or matrix, or one field of a record. Value references number these in order; the next number is
 * that of time, the independent variable. */
typedef struct Variable {
    uint32_t first; /* of its elements, which follow one another in ELEMENTS and in the block's struct */
    uint32_t size;
    VariableType type;
    uint32_t columns; /* of a matrix whose elements are named by row and column; 1: numbered through, 0: a scalar */
} Variable;

#endif
