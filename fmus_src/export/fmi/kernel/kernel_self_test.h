/* Self test: whether the compiler and the processor compute what the C source says, with one rounding per operation.
 *
 * Users compile sources/ with flags of their own, some of which change results without notice. The operands are
 * volatile, so that nothing is computed at compile time; the expressions are those of kernels, under the same flags.
 */
#ifndef KERNEL_SELF_TEST_H
#define KERNEL_SELF_TEST_H

#include "kernel_math.h"

/* Not inlined, so that the code of steps is compiled as without it. */
#if defined(__GNUC__)
#define NOT_INLINED __attribute__((noinline))
#else
#define NOT_INLINED
#endif

/* A difference next to a sum, which GCC's vectoriser fuses with their products even under -ffp-contract=off. */
static NOT_INLINED void add_and_subtract(const double *x, const double *y, const double *z, double *result)
{
    const double difference = x[0] * y[0] - z[0] * y[0], sum = x[1] * y[1] + z[1] * y[1];
    result[0] = difference;
    result[1] = sum;
}

/* What is wrong, and what to do; NULL if results have the bits of Python. */
static NOT_INLINED const char *check_arithmetic(void)
{
    volatile double a = 1.0, b = 0x1.001p-53; /* b: a little more than half a unit in a's last place */
    volatile double result = a + b;
    bool is_nearest = result == 1.0 + 0x1p-52; /* 1 if rounded to 64 bits first */
    b = 0x1p-60;
    is_nearest = is_nearest && a + b == 1.0 && a - b == 1.0;
    a = 0x1.00000004p-522;
    b = 0x1.000002p-523;
    volatile double subnormal = a * b; /* 536870976 and a half 2^-1074, and a little more */
    is_nearest = is_nearest && (subnormal == 536870977.0 * 0x1p-1074 || subnormal == 0.0);
    if (!is_nearest) {
        return "results are not rounded to the nearest double: x87 arithmetic (compile sources/ with -msse2 "
               "-mfpmath=sse) or another rounding mode in this thread";
    }

    a = 0.75;
    bool is_exact = a + 0x1.8p52 - 0x1.8p52 == 1.0; /* 0.75 if reassociated */
    a = 3.0;
    is_exact = is_exact && a / 10.0 == 0.3; /* 0.30000000000000004 if multiplied by 0.1 */
    a = NAN;
    const double no_number = a;
    is_exact = is_exact && isnan(no_number) && no_number != no_number;
    a = -0.0;
    is_exact = is_exact && copysign(1.0, a + 0.0) == 1.0;
    if (!is_exact) {
        return "the compiler changes results (-ffast-math or a part of it); compile sources/ without it";
    }

    a = 1.0 + 0x1p-27;
    b = -(1.0 + 0x1p-26);
    if (a * a + b != 0.0) { /* 2^-54 if fused */
        return "the compiler fuses a * b + c into one operation, which rounds once; "
               "compile sources/ with -ffp-contract=off";
    }
    const double equal[2] = {a, a};
    double pair[2];
    add_and_subtract(equal, equal, equal, pair);
    if (pair[0] != 0.0) { /* 2^-54 or its negative if one of the equal products is fused */
        return "the compiler's vectoriser fuses a * b + c into one operation, which rounds once; "
               "compile sources/ with -fno-tree-vectorize";
    }

    if (subnormal == 0.0) {
        return "subnormal numbers are flushed to zero; compile and link this FMU, and what loads it, "
               "without -ffast-math";
    }
    return NULL;
}

#endif
