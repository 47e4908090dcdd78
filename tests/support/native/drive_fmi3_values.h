/* The variables of an FMU of FMI 3.0 by their types: drawn, set, got, and their checksum. */
#ifndef DRIVE_FMI3_VALUES_H
#define DRIVE_FMI3_VALUES_H

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "fmi3Functions.h"
#include "random.h"

static const char *types;   /* a letter for each variable: f, i, b or e */
static size_t count;        /* of variables */
static size_t *sizes;       /* of each */
static size_t largest, all; /* elements of the largest variable, and of all together */

static double number(void)
{
    const double odd[] = {0.0, -0.0, 1.0, -1.0, 1e-310, 1e300, -1e308, INFINITY, -INFINITY, NAN};
    if (draw(200) == 0) return odd[draw(sizeof odd / sizeof odd[0])];
    const double fraction = (double)draw(1 << 30) / (1 << 29) - 1.0; /* in this order for every compiler */
    return ldexp(fraction, (int)draw(20) - 6);
}

/* ---- a variable by its type ---- */

typedef union Value {
    fmi3Float64 real;
    fmi3Int32 integer;
    fmi3Int64 wide;
    fmi3Boolean boolean;
    uint64_t word;
} Value;

typedef union Buffer {
    fmi3Float64 reals[1];
    fmi3Int32 integers[1];
    fmi3Int64 wides[1];
    fmi3Boolean booleans[1];
} Buffer;

static Buffer *buffer; /* exactly as long as the values of one call, so that the sanitizer sees what is beyond */

static size_t width(char type)
{
    return type == 'f' ? sizeof(fmi3Float64) : type == 'i' ? sizeof(fmi3Int32)
        : type == 'e' ? sizeof(fmi3Int64)    : sizeof(fmi3Boolean);
}

static void resize(char type, size_t size)
{
    free(buffer);
    buffer = calloc(size ? size : 1, width(type));
    if (buffer == NULL) exit(2);
}

static fmi3Status get(fmi3Instance fmu, fmi3ValueReference reference, char type, size_t size)
{
    resize(type, size);
    if (type == 'f') return fmi3GetFloat64(fmu, &reference, 1, buffer->reals, size);
    if (type == 'i') return fmi3GetInt32(fmu, &reference, 1, buffer->integers, size);
    if (type == 'e') return fmi3GetInt64(fmu, &reference, 1, buffer->wides, size);
    return fmi3GetBoolean(fmu, &reference, 1, buffer->booleans, size);
}

static fmi3Status set(fmi3Instance fmu, fmi3ValueReference reference, char type, size_t size)
{
    if (type == 'f') return fmi3SetFloat64(fmu, &reference, 1, buffer->reals, size);
    if (type == 'i') return fmi3SetInt32(fmu, &reference, 1, buffer->integers, size);
    if (type == 'e') return fmi3SetInt64(fmu, &reference, 1, buffer->wides, size);
    return fmi3SetBoolean(fmu, &reference, 1, buffer->booleans, size);
}

static void draw_values(char type, size_t size)
{
    resize(type, size);
    for (size_t k = 0; k < size; k++) {
        if (type == 'f') buffer->reals[k] = number();
        if (type == 'i') buffer->integers[k] = (fmi3Int32)draw(5);
        if (type == 'e') buffer->wides[k] = (fmi3Int64)draw(5);
        if (type == 'b') buffer->booleans[k] = draw(2) == 1;
    }
}

static uint64_t checksum = UINT64_C(14695981039346656037); /* FNV-1a of all that was read; one NaN is as another */

static void add_to_checksum(char type, size_t size)
{
    for (size_t k = 0; k < size; k++) {
        Value value = {.word = 0};
        if (type == 'f') value.real = buffer->reals[k];
        if (type == 'f' && isnan(value.real)) value.word = 1;
        if (type == 'i') value.integer = buffer->integers[k];
        if (type == 'e') value.wide = buffer->wides[k];
        if (type == 'b') value.boolean = buffer->booleans[k];
        checksum = (checksum ^ value.word) * UINT64_C(1099511628211);
    }
}

/* All bytes of all variables; what cannot be read, after an overflow of 32 bits, is 0. */
static void read_all(fmi3Instance fmu, unsigned char *bytes)
{
    memset(bytes, 0, all * sizeof(Value));
    for (size_t i = 0; i < count; i++) {
        if (get(fmu, (fmi3ValueReference)i, types[i], sizes[i]) == fmi3OK) {
            memcpy(bytes, buffer, sizes[i] * width(types[i]));
            add_to_checksum(types[i], sizes[i]);
        }
        bytes += sizes[i] * sizeof(Value);
    }
}

#endif
