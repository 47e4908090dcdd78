/* The library that simulates systems, one translation unit of several files. */
#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include "calls.h"
#include "codes.h"
#include "floats.h"
#include "run.h"

#if defined(_WIN32)
#define EXPORT __declspec(dllexport)
#else
#define EXPORT __attribute__((visibility("default")))
#endif
#define COLD __attribute__((cold, noinline))

/* Sizes of the structures that Python fills, for comparison with its own. */
EXPORT const uint64_t perilune_sizes[] = {sizeof(Run), sizeof(RunGroup)};

/* Called by Python after a call of an FMU's function outside the loop. */
EXPORT void perilune_restore_floats(void)
{
    restore_default_floats();
}

#include "elementary.c"
#include "transfers.c"
#include "texts.c"
#include "beginning.c"
#include "events.c"
#include "fmi3.c"
#include "loop.c"
#include "group.c"
#include "idle_callback.c"
#include "reductions.c"
