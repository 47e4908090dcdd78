/* An FMU by hand whose every step adds to y what an earlier instance may have left: TRACE says where that lies.
 *
 * y = p * (1 + number of traces met by the steps). An instance alone with its process meets those of its own steps only.
 */
#define _GNU_SOURCE
#include <fenv.h>
#include <limits.h>
#include <locale.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>
#if defined(__x86_64__)
#include <xmmintrin.h>
#endif
#include "real_calls.h"

enum { NOTHING, ROUNDING, TRAPS, FLUSH, FILES, RAND, GLOBAL, FOLDER, LOCALE, ENVIRONMENT, CLOCK };
typedef struct { double value[2]; char place[PATH_MAX]; int leaves; } Coupled; /* p, y */

static int global;

#if defined(__x86_64__)
/* As GCC's crtfastmath.o, which -ffast-math links: flush to zero, denormals are zero. */
__attribute__((constructor)) static void construct(void) { if (TRACE == FLUSH) _mm_setcsr(_mm_getcsr() | 0x8040u); }
#endif

static double meet_trace(Coupled *c)
{
    char folder[PATH_MAX], text[32];
    volatile double smallest = 5e-324;
    double met = 0.0;
    FILE *file;
    switch (TRACE) {
    case ROUNDING: met = fegetround() != FE_TONEAREST; fesetround(FE_UPWARD); break;
    case TRAPS: met = fegetexcept() != 0; feenableexcept(FE_OVERFLOW); break;
    case FLUSH: met = smallest * 1.0 == 0.0; break;
    case FILES:
        file = fopen(c->place, "a+");
        if (file == NULL) return NAN;
        fputc('x', file);
        met = (double)ftell(file);
        fclose(file);
        break;
    case RAND: met = rand() % 1000; break;
    case GLOBAL: met = global++; break;
    case FOLDER:
        met = getcwd(folder, sizeof folder) == NULL || strcmp(folder, "/") == 0;
        if (chdir("/") != 0) return NAN;
        break;
    case LOCALE: met = strcmp(setlocale(LC_NUMERIC, NULL), "C") != 0; setlocale(LC_NUMERIC, "C.UTF-8"); break;
    case ENVIRONMENT:
        met = getenv("COUPLED") == NULL ? 0 : atoi(getenv("COUPLED"));
        snprintf(text, sizeof text, "%d", (int)met + 1);
        setenv("COUPLED", text, 1);
        break;
    case CLOCK: {
        struct timespec now;
        clock_gettime(CLOCK_MONOTONIC, &now);
        met = (double)now.tv_nsec;
        break;
    }
    default: break;
    }
    return met;
}

fmi2Component fmi2Instantiate(fmi2String name, fmi2Type type, fmi2String guid, fmi2String place,
                              const fmi2CallbackFunctions *call, fmi2Boolean visible, fmi2Boolean logging)
{
    Coupled *c = calloc(1, sizeof(Coupled));
    c->value[0] = c->value[1] = 1.0;
    snprintf(c->place, sizeof c->place, "%s/../trace", strncmp(place, "file://", 7) == 0 ? place + 7 : place);
    char *resources = strstr(c->place, "/resources");
    if (resources != NULL) strcpy(resources, "/trace");
    return c;
}
void fmi2FreeInstance(fmi2Component c) { free(c); }
fmi2Status fmi2EnterInitializationMode(fmi2Component c) { return fmi2OK; }
fmi2Status fmi2ExitInitializationMode(fmi2Component c)
{ ((Coupled *)c)->value[1] = ((Coupled *)c)->value[0]; return fmi2OK; }
#ifdef KEEPS_STATE
fmi2Status fmi2Reset(fmi2Component c) { return fmi2Error; }
#else
fmi2Status fmi2Reset(fmi2Component c) { ((Coupled *)c)->value[0] = ((Coupled *)c)->value[1] = 1.0; return fmi2OK; }
#endif
fmi2Status fmi2GetReal(fmi2Component c, References r, size_t n, fmi2Real v[])
{ for (size_t i = 0; i < n; i++) v[i] = ((Coupled *)c)->value[r[i]]; return fmi2OK; }
fmi2Status fmi2SetReal(fmi2Component c, References r, size_t n, const fmi2Real v[])
{ for (size_t i = 0; i < n; i++) ((Coupled *)c)->value[r[i]] = v[i]; return fmi2OK; }
fmi2Status fmi2DoStep(fmi2Component c, fmi2Real t, fmi2Real h, fmi2Boolean final)
{ ((Coupled *)c)->value[1] += ((Coupled *)c)->value[0] * meet_trace(c); return fmi2OK; }
