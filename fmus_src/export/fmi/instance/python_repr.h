/* A double as text, as Python's repr() writes it. */
#ifndef PYTHON_REPR_H
#define PYTHON_REPR_H

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define REPR_SIZE 40

/* Shortest digits that read back to the same bits; decimals between 1e-4 and 1e16, else an exponent. */
static const char *python_repr(double value, char text[REPR_SIZE])
{
    if (isnan(value)) return strcpy(text, "nan");
    if (isinf(value)) return strcpy(text, value > 0.0 ? "inf" : "-inf");
    char scientific[REPR_SIZE];
    for (int precision = 0; precision <= 16; precision++) {
        snprintf(scientific, sizeof scientific, "%.*e", precision, value);
        if (strtod(scientific, NULL) == value) break;
    }
    /* sign, digits and exponent apart: the decimal point depends on the host's locale */
    char digits[18];
    int count = 0;
    const char *next = scientific + (scientific[0] == '-');
    for (; *next != 'e'; next++) {
        if (*next >= '0' && *next <= '9' && count < 17) digits[count++] = *next;
    }
    digits[count] = '\0';
    const int exponent = atoi(next + 1);
    char *out = text;
    if (signbit(value)) *out++ = '-';
    if (exponent < -4 || exponent >= 16) {
        *out++ = digits[0];
        if (count > 1) out += sprintf(out, ".%s", digits + 1);
        sprintf(out, "e%c%02d", exponent < 0 ? '-' : '+', abs(exponent));
    } else if (exponent < 0) {
        sprintf(out, "0.%.*s%s", -exponent - 1, "0000", digits);
    } else {
        for (int place = 0; place <= exponent; place++) *out++ = place < count ? digits[place] : '0';
        sprintf(out, ".%s", count > exponent + 1 ? digits + exponent + 1 : "0");
    }
    return text;
}

#endif
