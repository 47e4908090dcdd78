/* An FMU as others make them, for co-simulation by FMI 2.0, with the quirks that macros choose.
 *
 * dy/dt = gain u + count + (on ? 10 : 0) + mode, y = 0 at the start. It writes a letter for each call of its life
 * cycle to the file that FOREIGN_LOG names: i instantiate, e enter and x exit initialisation, t terminate, r reset,
 * f free, and ! before one that its state does not allow.
 *
 * LOSES_EARLY      values set before initialisation mode are lost
 * REFUSES_AGAIN    setting Reals in initialisation mode returns fmi2Error
 * IGNORES_GAIN     gain cannot be set, which it does not say
 * IGNORES_WORD     likewise word
 * FLOAT32          gain is kept in single precision
 * UNREADABLE_GAIN  the status that getting gain returns; from then on it fails, as FMI says, where it is fmi2Error
 * UNREADABLE_WORD  likewise word
 * KEEPS_PARAMETERS, KEEPS_STATE   what fmi2Reset forgets to put back
 * REPORTS_OLD_GAIN fmi2Reset puts gain back, but getting it gives what was set before
 * RESET            the status that fmi2Reset returns
 * BREAKS           a step with gain < 0 returns fmi2Error, and no reset mends it
 * GOES_TO          the folder that it makes the process's own when it is instantiated
 * ONE_AT_A_TIME    a second instance beside the first is refused
 * ENDS_AT          the time (s) at which it asks for the end, as Stair of the Reference FMUs does at 10 s
 * SAYS_TIME        the fmi2LastSuccessfulTime that it then gives, as text, which is not its own
 * KEEPS_END        fmi2Reset does not forget that it has asked for the end, which it does at the next step again
 * DEED, IN         what it does to its process in a call, see deeds.h
 * ANSWERS, AT      the status that fmi2DoStep returns from the time AT (s) on
 */
#define _GNU_SOURCE
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include "refused_calls.h"
#include "deeds.h"

enum { GAIN, U, Y, TWICE, TOLERANCE, LENGTH, REALS };
enum { COUNT, MODE, INTEGERS };
typedef enum { INSTANTIATED, INITIALISING, STEPPING, FAILED_STEP, TERMINATED, BROKEN } State;
typedef struct {
    double real[REALS];
    int whole[INTEGERS], on, ended, spent, hurt;
    double time, old_gain;
    char word[64];
    State state;
} Odd;

static int instances = 0;

static void note(const char *letters)
{
    const char *name = getenv("FOREIGN_LOG");
    FILE *file = name == NULL ? NULL : fopen(name, "a");
    if (file != NULL) {
        fputs(letters, file);
        fclose(file);
    }
}

static void forget_parameters(Odd *odd)
{
    odd->real[GAIN] = 2.0;
    odd->whole[COUNT] = odd->whole[MODE] = 1;
    odd->on = 0;
    strcpy(odd->word, "one");
}

static void forget_state(Odd *odd)
{
    odd->real[U] = 0.5;
    odd->real[Y] = odd->time = 0.0;
    odd->real[TOLERANCE] = -1.0;
    odd->ended = 0;
}

const char *fmi2GetTypesPlatform(void) { return fmi2TypesPlatform; }
const char *fmi2GetVersion(void) { return fmi2Version; }

fmi2Component fmi2Instantiate(fmi2String name, fmi2Type type, fmi2String guid, fmi2String place,
    const fmi2CallbackFunctions *call, fmi2Boolean visible, fmi2Boolean logging)
{
#ifdef ONE_AT_A_TIME
    if (instances > 0) return NULL;
#endif
#ifdef GOES_TO
    if (chdir(GOES_TO) != 0) return NULL;
#endif
    note("i");
    REMEMBER(call, name);
    MAY_DO(INSTANTIATION);
    instances++;
    Odd *odd = calloc(1, sizeof(Odd));
    forget_parameters(odd);
    forget_state(odd);
    return odd;
}

void fmi2FreeInstance(fmi2Component c)
{
    note("f");
    MAY_DO(FREEING);
    instances--;
    free(c);
}

fmi2Status fmi2SetDebugLogging(fmi2Component c, fmi2Boolean on, size_t n, const fmi2String names[]) { return fmi2OK; }

static fmi2Status go(Odd *odd, const char *letter, State from, State to)
{
    if (odd->state != from) note("!");
    note(letter);
    odd->state = to;
    return fmi2OK;
}

fmi2Status fmi2SetupExperiment(fmi2Component c, fmi2Boolean known, fmi2Real tolerance, fmi2Real start,
    fmi2Boolean ends, fmi2Real stop)
{
    Odd *odd = c;
    odd->real[TOLERANCE] = known ? tolerance : -1.0;
    odd->time = start;
    return fmi2OK;
}

fmi2Status fmi2EnterInitializationMode(fmi2Component c)
{
#ifdef LOSES_EARLY
    forget_parameters(c);
#endif
    return go(c, "e", INSTANTIATED, INITIALISING);
}

fmi2Status fmi2ExitInitializationMode(fmi2Component c)
{
    MAY_DO_WITH(INITIALISATION, ((Odd *)c)->whole[COUNT]);
    return go(c, "x", INITIALISING, STEPPING);
}

fmi2Status fmi2Terminate(fmi2Component c)
{
    Odd *odd = c;
    return go(odd, "t", odd->state == FAILED_STEP ? FAILED_STEP : STEPPING, TERMINATED);
}

fmi2Status fmi2Reset(fmi2Component c)
{
    Odd *odd = c;
    note("r");
    MAY_DO(RESETTING);
    odd->state = INSTANTIATED;
#ifdef REPORTS_OLD_GAIN
    odd->old_gain = odd->real[GAIN];
#endif
#ifndef KEEPS_PARAMETERS
    forget_parameters(odd);
#endif
#ifndef KEEPS_STATE
    forget_state(odd);
#endif
#ifdef RESET
    return RESET;
#endif
    return fmi2OK;
}

fmi2Status fmi2GetReal(fmi2Component c, References r, size_t n, fmi2Real v[])
{
    Odd *odd = c;
    odd->real[TWICE] = 2.0 * odd->real[GAIN];
    odd->real[LENGTH] = (double)strlen(odd->word);
    for (size_t i = 0; i < n; i++) {
        v[i] = odd->real[r[i]];
#ifdef REPORTS_OLD_GAIN
        if (r[i] == GAIN && odd->old_gain != 0.0) v[i] = odd->old_gain;
#endif
#ifdef UNREADABLE_GAIN
        if (r[i] == GAIN) {
            if (UNREADABLE_GAIN >= fmi2Error) odd->state = BROKEN;
            return UNREADABLE_GAIN;
        }
#endif
    }
    return odd->state == BROKEN ? fmi2Error : fmi2OK;
}

fmi2Status fmi2SetReal(fmi2Component c, References r, size_t n, const fmi2Real v[])
{
    Odd *odd = c;
#ifdef REFUSES_AGAIN
    if (odd->state == INITIALISING) return fmi2Error;
#endif
    for (size_t i = 0; i < n; i++) {
#ifdef IGNORES_GAIN
        if (r[i] == GAIN) continue;
#endif
        odd->real[r[i]] = v[i];
#ifdef FLOAT32
        if (r[i] == GAIN) odd->real[GAIN] = (float)v[i];
#endif
    }
    return fmi2OK;
}

fmi2Status fmi2GetInteger(fmi2Component c, References r, size_t n, fmi2Integer v[])
{
    for (size_t i = 0; i < n; i++) v[i] = ((Odd *)c)->whole[r[i]];
    return fmi2OK;
}

fmi2Status fmi2SetInteger(fmi2Component c, References r, size_t n, const fmi2Integer v[])
{
#ifndef IGNORES_COUNT
    for (size_t i = 0; i < n; i++) ((Odd *)c)->whole[r[i]] = v[i];
#endif
    return fmi2OK;
}

fmi2Status fmi2GetBoolean(fmi2Component c, References r, size_t n, fmi2Boolean v[])
{
    for (size_t i = 0; i < n; i++) v[i] = ((Odd *)c)->on;
    return fmi2OK;
}

fmi2Status fmi2SetBoolean(fmi2Component c, References r, size_t n, const fmi2Boolean v[])
{
#ifndef IGNORES_COUNT
    for (size_t i = 0; i < n; i++) ((Odd *)c)->on = v[i] != 0;
#endif
    return fmi2OK;
}

fmi2Status fmi2GetString(fmi2Component c, References r, size_t n, fmi2String v[])
{
#ifdef UNREADABLE_WORD
    return UNREADABLE_WORD;
#endif
    for (size_t i = 0; i < n; i++) v[i] = ((Odd *)c)->word;
    return fmi2OK;
}

fmi2Status fmi2SetString(fmi2Component c, References r, size_t n, const fmi2String v[])
{
#ifndef IGNORES_WORD
    for (size_t i = 0; i < n; i++) strncpy(((Odd *)c)->word, v[i], 63);
#endif
    return fmi2OK;
}

fmi2Status fmi2DoStep(fmi2Component c, fmi2Real t, fmi2Real h, fmi2Boolean final)
{
    Odd *odd = c;
    double end = t + h;
    if (t >= 0.5) MAY_DO_WITH(STEP, odd->whole[COUNT]);
    if (odd->state != STEPPING) note("!");
#ifdef BREAKS
    if (odd->real[GAIN] < 0.0) {
        odd->hurt = 1;
        odd->state = BROKEN;
        return fmi2Error;
    }
#endif
#ifdef ENDS_AT
    odd->ended = odd->spent || end > ENDS_AT;
    if (odd->ended) end = odd->spent ? end : ENDS_AT;
#ifdef KEEPS_END
    odd->spent = odd->ended;
#endif
#endif
#ifdef ANSWERS
    if (t >= AT) {
        odd->state = ANSWERS == fmi2Discard ? FAILED_STEP : BROKEN;
        return ANSWERS;
    }
#endif
    odd->real[Y] += (end - t) * (odd->real[GAIN] * odd->real[U] + odd->whole[COUNT] + odd->whole[MODE]
        + (odd->on ? 10.0 : 0.0) + 1000.0 * odd->hurt);
    odd->time = end;
    if (odd->ended) odd->state = FAILED_STEP;
    return odd->ended ? fmi2Discard : fmi2OK;
}

fmi2Status fmi2GetBooleanStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Boolean *v)
{
    *v = ((Odd *)c)->ended;
    return kind == fmi2Terminated ? fmi2OK : fmi2Discard;
}

fmi2Status fmi2GetRealStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Real *v)
{
    *v = ((Odd *)c)->time;
#ifdef SAYS_TIME
    *v = strtod(SAYS_TIME, NULL);
#endif
    return kind == fmi2LastSuccessfulTime ? fmi2OK : fmi2Discard;
}
