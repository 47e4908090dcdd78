/* What an FMU may do to its process, DEED, IN one of its calls; where COUNTED is defined, only if count is that.
 *
 * In steps it does so from 0.5 s on. Without DEED nothing is done.
 */
#include <pthread.h>
#include <signal.h>
#include <sys/socket.h>

enum { CONSTRUCTION, INSTANTIATION, INITIALISATION, STEP, RESETTING, FREEING };
enum { SEGFAULT, ABORT, OVERFLOW, EXIT_0, EXIT_1, EXIT_AT_ONCE, KILL_GROUP, HANG, GROW, PRINT, SCRIBBLE, CORRUPT, LEAVE_ORPHAN };

#ifdef DEED
static double overflow(volatile double *below)
{
    volatile double here[4096];
    here[0] = below == NULL ? 0.0 : below[0];
    return overflow(here) + here[1];
}

static void do_it(void)
{
    char *grown = NULL;
    switch (DEED) {
    case SEGFAULT: raise(SIGSEGV); break;
    case ABORT: abort();
    case OVERFLOW: overflow(NULL); break;
    case EXIT_0: exit(0);
    case EXIT_1: exit(1);
    case EXIT_AT_ONCE: _exit(3);
    case KILL_GROUP: kill(0, SIGKILL); break;
    case HANG: while (1) pause();
    case GROW:
        for (int i = 0; i < 60; i++) {
            grown = malloc(10000000);
            if (grown == NULL) abort();
            memset(grown, 1, 10000000);
            usleep(5000);
        }
        break;
    case PRINT: for (int i = 0; i < 1000000; i++) printf("\033[31mline %d\n", i); break;
    case SCRIBBLE: for (int i = 0; i < 256; i++) if (write(i, "no answer at all, but long enough", 33) < 0) continue; break;
    case CORRUPT: grown = malloc(24); memset(grown - 16, 0xff, 64); free(grown); break;
    case LEAVE_ORPHAN: if (fork() == 0) { setsid(); if (fork() == 0) while (1) pause(); _exit(0); } abort();
    }
}
#define MAY_DO(call) do { if (IN == call) do_it(); } while (0)
#ifdef COUNTED
#define MAY_DO_WITH(call, count) do { if (IN == call && (count) == COUNTED) do_it(); } while (0)
#else
#define MAY_DO_WITH(call, count) MAY_DO(call)
#endif
__attribute__((constructor)) static void construct(void) { MAY_DO(CONSTRUCTION); }
#else
#define MAY_DO(call)
#define MAY_DO_WITH(call, count)
#endif
