/* What programs that drive an FMU under sanitizers share: answers compared and counted, and states spoilt. */
#ifndef CHECKS_H
#define CHECKS_H

#include <stdio.h>
#include <string.h>

#include "random.h"

#define HEADER_SIZE 48 /* of a serialised state: six words before the variables */

static int failures;

/* The status of a call, of either version of FMI. */
#define EXPECT(wanted, call) expect((int)(wanted), (int)(call), #call, __LINE__)

static void expect(int wanted, int actual, const char *call, int line)
{
    if (actual == wanted) return;
    printf("line %d: %s gave status %d instead of %d\n", line, call, actual, wanted);
    failures++;
}

static void check(int holds, const char *what)
{
    if (holds) return;
    printf("%s\n", what);
    failures++;
}

/* Put an extreme word or a random byte somewhere, often into the header, where more depends on each word. */
static void spoil(void *state, size_t length)
{
    const int64_t extremes[] = {0, -1, INT64_MAX, INT64_MIN, INT64_C(1) << 53, INT64_C(0x7FF0000000000000), 1000};
    const size_t word = 1 + draw((draw(2) ? length : HEADER_SIZE) / 8 - 1);
    unsigned char *bytes = (unsigned char *)state + 8 * word;
    if (draw(2)) {
        memcpy(bytes, &extremes[draw(sizeof extremes / sizeof extremes[0])], 8);
    } else {
        const size_t place = draw(8); /* in this order for every compiler */
        bytes[place] = (unsigned char)draw(256);
    }
}

#endif
