/* Vectors of two, three and four doubles, passed and returned by value; the operations of vector_types.py.
 *
 * Each component is computed by one operation, as in Python, so that results have its bits.
 */
#ifndef KERNEL_VECTORS_H
#define KERNEL_VECTORS_H

#include "kernel_math.h"

/* Always inlined: a vector that is passed to a function goes through memory, which costs more than the operation. */
#if defined(__GNUC__)
#define VECTOR_INLINE static inline __attribute__((always_inline))
#else
#define VECTOR_INLINE static inline
#endif

#define EACH_OF_2(component) {{component(0), component(1)}}
#define EACH_OF_3(component) {{component(0), component(1), component(2)}}
#define EACH_OF_4(component) {{component(0), component(1), component(2), component(3)}}
#define ANY_OF_2(test) (test(0) || test(1))
#define ANY_OF_3(test) (test(0) || test(1) || test(2))
#define ANY_OF_4(test) (test(0) || test(1) || test(2) || test(3))

#define SUM_OF(i) a.x[i] + b.x[i]
#define DIFFERENCE_OF(i) a.x[i] - b.x[i]
#define NEGATIVE_OF(i) -a.x[i]
#define SCALED_OF(i) factor * a.x[i]
#define PRODUCT_OF(i) a.x[i] * b.x[i]
#define SHARE_OF(i) a.x[i] / divisor
#define QUOTIENT_OF(i) a.x[i] / b.x[i]
#define IS_ZERO(i) b.x[i] == 0.0

/* py_divide and py_quotient record a division by zero, of any component; divide and quotient expect none. */
#define VECTOR_TYPE(n) \
    typedef struct Vector##n { \
        double x[n]; \
    } Vector##n; \
    VECTOR_INLINE Vector##n add##n(Vector##n a, Vector##n b) \
    { \
        return (Vector##n)EACH_OF_##n(SUM_OF); \
    } \
    VECTOR_INLINE Vector##n subtract##n(Vector##n a, Vector##n b) \
    { \
        return (Vector##n)EACH_OF_##n(DIFFERENCE_OF); \
    } \
    VECTOR_INLINE Vector##n negative##n(Vector##n a) \
    { \
        return (Vector##n)EACH_OF_##n(NEGATIVE_OF); \
    } \
    VECTOR_INLINE Vector##n scale##n(double factor, Vector##n a) \
    { \
        return (Vector##n)EACH_OF_##n(SCALED_OF); \
    } \
    VECTOR_INLINE Vector##n multiply##n(Vector##n a, Vector##n b) \
    { \
        return (Vector##n)EACH_OF_##n(PRODUCT_OF); \
    } \
    VECTOR_INLINE Vector##n divide##n(Vector##n a, double divisor) \
    { \
        return (Vector##n)EACH_OF_##n(SHARE_OF); \
    } \
    VECTOR_INLINE Vector##n quotient##n(Vector##n a, Vector##n b) \
    { \
        return (Vector##n)EACH_OF_##n(QUOTIENT_OF); \
    } \
    VECTOR_INLINE Vector##n py_divide##n(Fault *fault, const char *file, int line, Vector##n a, double divisor) \
    { \
        if (divisor == 0.0) { \
            set_fault(fault, file, line, ZERO_DIVISION); \
            return a; \
        } \
        return divide##n(a, divisor); \
    } \
    VECTOR_INLINE Vector##n py_quotient##n(Fault *fault, const char *file, int line, Vector##n a, Vector##n b) \
    { \
        if (ANY_OF_##n(IS_ZERO)) { \
            set_fault(fault, file, line, ZERO_DIVISION); \
            return a; \
        } \
        return quotient##n(a, b); \
    }

VECTOR_TYPE(2)
VECTOR_TYPE(3)
VECTOR_TYPE(4)

#endif
