/* Arithmetic with CPython's results and CPython's errors.
 *
 * A translated kernel calls these where Python can raise. Each returns Python's result to the last
 * bit, or records the fault and returns 0; the kernel then returns at the end of the statement.
 * The first fault is kept. What Python's unbounded ints could still do beyond 64 bits is a fault.
 *
 * Compile with -ffp-contract=off -fno-tree-vectorize: a contracted a * b + c rounds once, and GCC's vectoriser contracts
 * a sum next to a difference even under -ffp-contract=off. Of the C library only what IEEE 754 defines to the last bit is
 * called.
 */
#ifndef KERNEL_MATH_H
#define KERNEL_MATH_H

#include <float.h>
#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#if FLT_EVAL_METHOD != 0
#error "this target computes doubles in wider registers and would round results twice: compile with SSE2 (-msse2 -mfpmath=sse)"
#endif

/* What ended a call, and the Python line that raises in the Python flavour. */
typedef struct Fault {
    const char *what; /* NULL: nothing happened; else exception and message as Python has them */
    const char *file; /* NULL: it is not of a Python line */
    int line;
    const char *subject; /* the component or variable of a system; NULL in a block */
} Fault;

#define NO_FAULT {NULL, NULL, 0, NULL}

#define ZERO_DIVISION "ZeroDivisionError: division by zero"
#define DOMAIN_ERROR "ValueError: math domain error"
#define RANGE_ERROR "OverflowError: math range error"
#define INT_FROM_NAN "ValueError: cannot convert float NaN to integer"
#define INT_FROM_INFINITY "OverflowError: cannot convert float infinity to integer"
#define INT_TOO_WIDE "OverflowError: int beyond 64 bits"
#define INDEX_ERROR "IndexError: list index out of range"

/* A function that only failing calls reach: compilers keep it, and the way to it, out of the usual path. */
#if defined(__GNUC__)
#define COLD __attribute__((cold, noinline))
#else
#define COLD
#endif

/* floor, ceil and trunc without a call, but for the sign of a zero, which no int has. From 2^52 on every double is whole. */
static inline double whole_trunc(double x)
{
    return fabs(x) < 4503599627370496.0 ? (double)(int64_t)x : x;
}

static inline double whole_floor(double x)
{
    const double whole = whole_trunc(x);
    return whole > x ? whole - 1.0 : whole;
}

static inline double whole_ceil(double x)
{
    const double whole = whole_trunc(x);
    return whole < x ? whole + 1.0 : whole;
}

static const double MATH_PI = 3.141592653589793;
static const double MATH_TAU = 6.283185307179586;
static const double MATH_E = 2.718281828459045;
static const double MATH_INF = INFINITY;
static const double MATH_NAN = NAN;

static COLD void set_fault(Fault *fault, const char *file, int line, const char *what)
{
    if (fault->what == NULL) {
        fault->what = what;
        fault->file = file;
        fault->line = line;
    }
}

/* ---- floats ---- */

static inline double py_divide(Fault *fault, const char *file, int line, double a, double b)
{
    if (b == 0.0) {
        set_fault(fault, file, line, ZERO_DIVISION);
        return 0.0;
    }
    return a / b;
}

/* What all elements of a matrix are divided by. */
static inline double py_divisor(Fault *fault, const char *file, int line, double divisor)
{
    if (divisor == 0.0) {
        set_fault(fault, file, line, ZERO_DIVISION);
    }
    return divisor;
}

/* a % b with the sign of b, for b != 0; CPython's float_rem. */
static inline double float_modulo(double a, double b)
{
    double remainder = fmod(a, b);
    if (remainder != 0.0) {
        if ((b < 0.0) != (remainder < 0.0)) remainder += b;
    } else {
        remainder = copysign(0.0, b);
    }
    return remainder;
}

/* a // b for b != 0; CPython's _float_div_mod. */
static inline double float_floor_divide(double a, double b)
{
    const double remainder = fmod(a, b);
    double quotient = (a - remainder) / b;
    if (remainder != 0.0 && (b < 0.0) != (remainder < 0.0)) quotient -= 1.0;
    if (quotient == 0.0) return copysign(0.0, a / b);
    double floored = whole_floor(quotient);
    if (quotient - floored > 0.5) floored += 1.0;
    return floored;
}

static inline double py_float_modulo(Fault *fault, const char *file, int line, double a, double b)
{
    if (b == 0.0) {
        set_fault(fault, file, line, ZERO_DIVISION);
        return 0.0;
    }
    return float_modulo(a, b);
}

static inline double py_float_floor_divide(Fault *fault, const char *file, int line, double a, double b)
{
    if (b == 0.0) {
        set_fault(fault, file, line, ZERO_DIVISION);
        return 0.0;
    }
    return float_floor_divide(a, b);
}

/* ---- functions of Python's math ---- */

/* A result that is no number, or infinite, from finite arguments: a domain or a range error. */
static inline double checked_result(
    Fault *fault, const char *file, int line, double result, bool from_nan, bool from_finite, const char *if_infinite)
{
    if (isfinite(result)) return result; /* the usual case, with one test */
    if (isnan(result) && !from_nan) {
        set_fault(fault, file, line, DOMAIN_ERROR);
    } else if (isinf(result) && from_finite) {
        set_fault(fault, file, line, if_infinite);
    }
    return result;
}

/* py_sin and the like, after the function that computes; used or not. */
#define CHECKED_FUNCTION(name, computed, if_infinite) \
    static inline double py_##name(Fault *fault, const char *file, int line, double x) \
    { \
        return checked_result(fault, file, line, computed(x), isnan(x), isfinite(x), if_infinite); \
    }

#define CHECKED_POWER(name, computed) \
    static inline double py_##name(Fault *fault, const char *file, int line, double x, double y) \
    { \
        const bool from_finite = isfinite(x) && isfinite(y); \
        const char *if_infinite = x == 0.0 ? DOMAIN_ERROR : RANGE_ERROR; \
        return checked_result(fault, file, line, computed(x, y), !from_finite, from_finite, if_infinite); \
    }

static inline double py_sqrt(Fault *fault, const char *file, int line, double x)
{
    if (x < 0.0) {
        set_fault(fault, file, line, DOMAIN_ERROR);
        return 0.0;
    }
    return sqrt(x);
}

/* 2^n, for n from -1022 to 1023. */
static inline double power_of_two(int64_t n)
{
    const uint64_t bits = (uint64_t)(n + 1023) << 52;
    double power;
    memcpy(&power, &bits, sizeof power);
    return power;
}

/* x 2^n, rounded once. */
static inline double exact_ldexp(double x, int64_t n)
{
    for (int k = 0; n > 1023 && k < 3; k++) {
        x *= power_of_two(1023);
        n -= 1023;
    }
    for (int k = 0; n < -1022 && k < 3; k++) { /* 53 bits stay above the last step, which rounds */
        x *= power_of_two(-969);
        n += 969;
    }
    return x * power_of_two(n > 1023 ? 1023 : n < -1022 ? -1022 : n);
}

static inline double py_ldexp(Fault *fault, const char *file, int line, double x, int64_t n)
{
    return checked_result(fault, file, line, exact_ldexp(x, n), isnan(x), isfinite(x), RANGE_ERROR);
}

/* Two values of a function. */
typedef struct DoubleInt64 {
    double part0;
    int64_t part1;
} DoubleInt64;

/* m from 1/2 to 1 and n of x = m 2^n. */
static inline DoubleInt64 exact_frexp(double x)
{
    uint64_t bits;
    int64_t n = -1022;
    if (x == 0.0 || !isfinite(x)) return (DoubleInt64){x, 0};
    if (fabs(x) < 2.2250738585072014e-308) {
        x *= 18014398509481984.0; /* 2^54 */
        n -= 54;
    }
    memcpy(&bits, &x, sizeof bits);
    n += (int64_t)(bits >> 52 & 0x7ff);
    bits = (bits & UINT64_C(0x800fffffffffffff)) | UINT64_C(0x3fe0000000000000);
    memcpy(&x, &bits, sizeof x);
    return (DoubleInt64){x, n};
}

static inline double py_fmod(Fault *fault, const char *file, int line, double x, double y)
{
    return checked_result(fault, file, line, fmod(x, y), isnan(x) || isnan(y), false, DOMAIN_ERROR);
}

/* ---- floats to ints ---- */

/* float(math.floor(x)) and the like, which Python computes through an int: whole is that of x. */
static inline double py_whole_float(Fault *fault, const char *file, int line, double whole)
{
    if (!isfinite(whole)) set_fault(fault, file, line, isnan(whole) ? INT_FROM_NAN : INT_FROM_INFINITY);
    return whole + 0.0; /* an int has no -0 */
}

/* int(x), math.floor(x), math.ceil(x): whole is that of x. */
static inline int64_t py_whole_int(Fault *fault, const char *file, int line, double whole)
{
    py_whole_float(fault, file, line, whole);
    if (!(whole >= -9223372036854775808.0 && whole < 9223372036854775808.0)) {
        set_fault(fault, file, line, INT_TOO_WIDE);
        return 0;
    }
    return (int64_t)whole;
}

/* ---- ints ---- */

static inline int64_t py_add(Fault *fault, const char *file, int line, int64_t a, int64_t b)
{
    if ((b > 0 && a > INT64_MAX - b) || (b < 0 && a < INT64_MIN - b)) {
        set_fault(fault, file, line, INT_TOO_WIDE);
        return 0;
    }
    return a + b;
}

static inline int64_t py_subtract(Fault *fault, const char *file, int line, int64_t a, int64_t b)
{
    if ((b < 0 && a > INT64_MAX + b) || (b > 0 && a < INT64_MIN + b)) {
        set_fault(fault, file, line, INT_TOO_WIDE);
        return 0;
    }
    return a - b;
}

static inline int64_t py_multiply(Fault *fault, const char *file, int line, int64_t a, int64_t b)
{
    bool fits = true;
    if (a > 0) {
        fits = b > 0 ? a <= INT64_MAX / b : b >= INT64_MIN / a;
    } else if (a < 0) {
        fits = b > 0 ? a >= INT64_MIN / b : b == 0 || b >= INT64_MAX / a;
    }
    if (!fits) {
        set_fault(fault, file, line, INT_TOO_WIDE);
        return 0;
    }
    return a * b;
}

static inline int64_t py_negative(Fault *fault, const char *file, int line, int64_t a)
{
    return py_subtract(fault, file, line, 0, a);
}

static inline int64_t int_abs(int64_t a)
{
    return a < 0 ? -a : a;
}

static inline int64_t py_int_abs(Fault *fault, const char *file, int line, int64_t a)
{
    return a < 0 ? py_negative(fault, file, line, a) : a;
}

/* a % b with the sign of b, for b != 0. */
static inline int64_t int_modulo(int64_t a, int64_t b)
{
    if (b == -1) return 0; /* INT64_MIN % -1 is undefined in C */
    const int64_t remainder = a % b;
    return remainder != 0 && (remainder < 0) != (b < 0) ? remainder + b : remainder;
}

/* a // b, rounded down, for b != 0 and a quotient within 64 bits. */
static inline int64_t int_floor_divide(int64_t a, int64_t b)
{
    const int64_t quotient = a / b;
    return a % b != 0 && (a < 0) != (b < 0) ? quotient - 1 : quotient;
}

static inline int64_t py_int_modulo(Fault *fault, const char *file, int line, int64_t a, int64_t b)
{
    if (b == 0) {
        set_fault(fault, file, line, ZERO_DIVISION);
        return 0;
    }
    return int_modulo(a, b);
}

static inline int64_t py_int_floor_divide(Fault *fault, const char *file, int line, int64_t a, int64_t b)
{
    if (b == 0) {
        set_fault(fault, file, line, ZERO_DIVISION);
        return 0;
    }
    if (a == INT64_MIN && b == -1) {
        set_fault(fault, file, line, INT_TOO_WIDE);
        return 0;
    }
    return int_floor_divide(a, b);
}

/* An index that was not proven right beforehand; negative ones count from the end. */
static inline int64_t py_index(Fault *fault, const char *file, int line, int64_t index, int64_t size)
{
    const int64_t position = index < 0 ? index + size : index;
    if (position < 0 || position >= size) {
        set_fault(fault, file, line, INDEX_ERROR);
        return 0;
    }
    return position;
}

#endif
