/* Bytes that say which functions of a native FMU are called, and with what: what `fmi2.c` and `fmi3.c` share.
 *
 * Compiled together with the FMU's source under sanitizers, by clang with libFuzzer, which looks for bytes that come
 * to other code, or with STANDALONE and random bytes:
 *
 *     fmi RUNS SEED
 *
 * GUID, STEP (s, the FMU's own) and REFERENCES (how many value references it has) are macros. The FMU may refuse whatever it likes; it
 * may not touch memory of others, divide by zero or convert what no integer holds.
 */
#ifndef BYTES_H
#define BYTES_H

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { INSTANCES = 2, STATES = 2, AT_ONCE = 6, STEPS = 3 };

static const uint8_t *next;
static size_t left;

static unsigned below(unsigned limit)
{
    if (left == 0) return 0;
    left--;
    return *next++ % limit;
}

static double number(void)
{
    const double odd[] = {0.0, -0.0, 1.0, -1.0, 5e-324, 1e-310, 1e300, -1.7e308, INFINITY, -INFINITY, NAN, 2147483648.0};
    const unsigned kind = below(3);
    double value = 0.0;
    if (kind == 0) return odd[below(sizeof odd / sizeof odd[0])];
    if (kind == 1 || left < sizeof value) return (double)below(256) / 64.0 - 2.0;
    memcpy(&value, next, sizeof value);
    next += sizeof value;
    left -= sizeof value;
    return value;
}

static unsigned word(void)
{
    const unsigned high = below(256);
    return high * 256u + below(256);
}

/* A value reference, most often one of the FMU. */
static uint32_t choose_reference(void)
{
    return below(16) == 0 ? 0xfffffff0u + below(16) : word() % (REFERENCES + 1);
}

static int32_t whole_number(void)
{
    return below(4) == 0 ? INT32_MIN + (int)below(2) : (int32_t)below(256) - 8;
}

/* Change some words or bits of a serialised state; how many of its bytes are to be read back. */
static size_t mangle(void *state, size_t size)
{
    uint8_t *bytes = state;
    for (unsigned i = below(4); i > 0; i--) {
        const double value = number();
        uint8_t *at = bytes + 8 * (word() % (size / 8));
        if (below(2)) {
            memcpy(at, &value, 8);
        } else {
            const unsigned byte = below(8);
            at[byte] ^= (uint8_t)(1u << below(8));
        }
    }
    return below(8) ? size : size - below(9);
}

static double step_size(void)
{
    return below(4) ? STEP * (1 + below(STEPS)) : below(4) ? number() : 1e300;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

#ifdef STANDALONE
int main(int count, char **arguments)
{
    static uint8_t random[600];
    uint64_t state = count > 2 ? strtoull(arguments[2], NULL, 10) * 2 + 1 : 1;
    for (long run = count > 1 ? atol(arguments[1]) : 1; run > 0; run--) {
        for (size_t i = 0; i < sizeof random; i++) {
            state = state * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
            random[i] = (uint8_t)(state >> 56);
        }
        LLVMFuzzerTestOneInput(random, sizeof random);
    }
    return 0;
}
#endif

#endif
