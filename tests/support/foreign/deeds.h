/* What an FMU may do to its process, DEED, IN one of its calls; where COUNTED is defined, only if count is that.
 *
 * In steps it does so from 0.5 s on. Without DEED nothing is done.
 */
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <sched.h>
#include <signal.h>
#include <sys/ptrace.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/syscall.h>

enum { CONSTRUCTION, INSTANTIATION, INITIALISATION, STEP, RESETTING, FREEING };
enum { SEGFAULT, ABORT, OVERFLOW, EXIT_0, EXIT_1, EXIT_AT_ONCE, KILL_GROUP, HANG, GROW, FILL, RESERVE, PRINT, SCRIBBLE, CORRUPT, LEAVE_ORPHAN, TRY, LOG, LOG_CONTROLS, HANG_WITH_LOCK, LOG_MILLION, CLOSE, SAY };

#ifdef DEED
static const fmi2CallbackFunctions *callbacks;
static char *instance;

static void say(const char *message)
{
    callbacks->logger(callbacks->componentEnvironment, instance, fmi2OK, "any", message);
}

/* One line for each thing that it tries: what, and whether that was refused. */
static void tried(const char *what, long result)
{
    printf("%s: %s\n", what, result >= 0 ? "done" : strerror(errno));
    fflush(stdout);
}

static long writes(const char *folder, const char *name)
{
    char path[4096];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    return open(path, O_CREAT | O_WRONLY, 0600);
}

/* What they set is what is set already, or nobody's. */
static void try_settings(void)
{
    pid_t parent = getppid();
    struct rlimit limit;
    struct sched_param usual = {0};
    unsigned long processors[16], nobody = 54321;
    unsigned char attributes[56] = {56};
    long masks = syscall(SYS_sched_getaffinity, 0, sizeof processors, processors);
    syscall(SYS_sched_getattr, 0, attributes, sizeof attributes, 0);
    tried("prlimit64", prlimit(parent, RLIMIT_CPU, NULL, &limit));
    tried("setpriority", setpriority(PRIO_PROCESS, parent, getpriority(PRIO_PROCESS, parent)));
    tried("setpriority of a user", setpriority(PRIO_USER, nobody, 0));
    tried("setpriority of a group", setpriority(PRIO_PGRP, nobody, 0));
    tried("ioprio_set", syscall(SYS_ioprio_set, 1, parent, syscall(SYS_ioprio_get, 1, parent)));
    tried("ioprio_set of a user", syscall(SYS_ioprio_set, 3, nobody, 0));
    tried("sched_setaffinity", syscall(SYS_sched_setaffinity, parent, masks, processors));
    tried("sched_setparam", syscall(SYS_sched_setparam, parent, &usual));
    tried("sched_setscheduler", syscall(SYS_sched_setscheduler, parent, SCHED_OTHER, &usual));
    tried("sched_setattr", syscall(SYS_sched_setattr, parent, attributes, 0));
    tried("migrate_pages", syscall(SYS_migrate_pages, parent, 0, NULL, NULL));
    tried("move_pages", syscall(SYS_move_pages, parent, 0, NULL, NULL, NULL, 0));
    tried("kcmp", syscall(SYS_kcmp, parent, parent, 1, 0, 0));
    tried("process_mrelease", syscall(448, -1, 0));
    tried("own prlimit64", prlimit(0, RLIMIT_NOFILE, NULL, &limit));
    tried("own prlimit64 by number", prlimit(getpid(), RLIMIT_NOFILE, NULL, &limit));
    tried("own setpriority", setpriority(PRIO_PROCESS, 0, getpriority(PRIO_PROCESS, 0)));
    tried("own ioprio_set", syscall(SYS_ioprio_set, 1, getpid(), syscall(SYS_ioprio_get, 1, 0)));
    tried("own sched_setaffinity", syscall(SYS_sched_setaffinity, getpid(), masks, processors));
    tried("own sched_setparam", syscall(SYS_sched_setparam, 0, &usual));
    tried("own sched_setscheduler", syscall(SYS_sched_setscheduler, 0, SCHED_OTHER, &usual));
    tried("own sched_setattr", syscall(SYS_sched_setattr, 0, attributes, 0));
}

static void try_everything(void)
{
    const char *results = getenv("TRY_RESULTS");
    tried("own folder", writes(getenv("TMPDIR"), "mine"));
    tried("home", writes(getenv("HOME"), "perilune_tried"));
    tried("temporary folder", writes("/tmp", "perilune_tried"));
    tried("results", writes(results == NULL ? "." : results, "tried"));
    tried("TCP", socket(AF_INET, SOCK_STREAM, 0));
    tried("UDP", socket(AF_INET, SOCK_DGRAM, 0));
    tried("AF_UNIX", socket(AF_UNIX, SOCK_STREAM, 0));
    tried("io_uring", syscall(425, 1, NULL));
    tried("ptrace", ptrace(PTRACE_ATTACH, getppid(), NULL, NULL));
    tried("signal", kill(getppid(), SIGTERM));
    tried("signal to all", kill(-1, SIGCONT));
    try_settings();
    int pair[2];
    tried("socketpair", socketpair(AF_UNIX, SOCK_STREAM, 0, pair));
}

static double overflow(volatile double *below)
{
    volatile double here[4096];
    here[0] = below == NULL ? 0.0 : below[0];
    return overflow(here) + here[1];
}

static void fill(size_t bytes)
{
    volatile char *memory = malloc(bytes);
    for (size_t i = 0; i < bytes; i += 4096) memory[i] = 1;
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
    case FILL: fill(180000000); abort();
    case RESERVE: fill(1000000000); break;
    case PRINT: for (int i = 0; i < 1000000; i++) printf("\033[31mline %d\n", i); break;
    case SCRIBBLE: for (int i = 0; i < 256; i++) if (write(i, "no answer at all, but long enough", 33) < 0) continue; break;
    case CORRUPT: grown = malloc(24); memset(grown - 16, 0xff, 64); free(grown); break;
    case LOG: say("%s%s%s%n"); break;
    case LOG_MILLION: for (int i = 0; i < 1000000; i++) say("more"); break;
    case HANG_WITH_LOCK: ((int (*)(void))dlsym(RTLD_DEFAULT, "PyGILState_Ensure"))(); while (1) pause();
    case LOG_CONTROLS: say("\033[31mred\xc2\x9b\xe2\x80\xae"); break;
    case CLOSE: for (int i = 3; i < 256; i++) close(i); say("closed"); break;
    case SAY: printf("perilune: all is well\nand more\n"); fflush(stdout); break;
    case TRY: try_everything(); break;
    case LEAVE_ORPHAN: if (fork() == 0) { setsid(); if (fork() == 0) while (1) pause(); _exit(0); } abort();
    }
}
#define MAY_DO(call) do { if (IN == call) do_it(); } while (0)
#ifdef COUNTED
#define MAY_DO_WITH(call, count) do { if (IN == call && (count) == COUNTED) do_it(); } while (0)
#else
#define MAY_DO_WITH(call, count) MAY_DO(call)
#endif
#define REMEMBER(call, name) do { callbacks = call; instance = strdup(name); } while (0)
__attribute__((constructor)) static void construct(void) { MAY_DO(CONSTRUCTION); }
#else
#define MAY_DO(call)
#define MAY_DO_WITH(call, count)
#define REMEMBER(call, name)
#endif
