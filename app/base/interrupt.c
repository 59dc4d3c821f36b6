#include "app/base/interrupt.h"

#include "app/base/output_pending.h"

#include <errno.h>
#include <signal.h>
#include <stddef.h>
#include <stdint.h>
#include <sys/eventfd.h>
#include <unistd.h>

static volatile sig_atomic_t first, asked; /* first: number of the first signal; 0: none yet */
static volatile sig_atomic_t bell = -1;    /* file descriptor for a waiting thread */

static void on_signal(int number)
{
    const int before = errno;
    if (first) {
        output_discard_all();
        _exit(EXIT_INTERRUPTED);
    }
    first = number;
    if (bell >= 0 && write(bell, &(uint64_t){1}, sizeof(uint64_t)) < 0)
        bell = -1; /* no thread listens */
    errno = before;
}

static void catch_unless_ignored(int number)
{
    struct sigaction old;
    struct sigaction new = {.sa_handler = on_signal, .sa_flags = SA_RESTART};
    sigemptyset(&new.sa_mask);
    if (sigaction(number, NULL, &old) == 0 && old.sa_handler != SIG_IGN)
        sigaction(number, &new, NULL);
}

void interrupt_install(void)
{
    catch_unless_ignored(SIGINT);
    catch_unless_ignored(SIGTERM);
    catch_unless_ignored(SIGHUP);
    signal(SIGPIPE, SIG_IGN);
    signal(SIGXFSZ, SIG_IGN);
}

bool interrupted(void)
{
    return first != 0;
}

int interrupt_signal(void)
{
    return first;
}

int interrupt_bell(void)
{
    if (bell < 0)
        bell = eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK);
    if (first && bell >= 0 && write(bell, &(uint64_t){1}, sizeof(uint64_t)) < 0) /* it came before */
        bell = -1;
    return bell;
}

static void on_ask(int number)
{
    (void)number;
    asked = 1;
}

void interrupt_hear_ask(void)
{
    struct sigaction hear = {.sa_handler = on_ask, .sa_flags = SA_RESTART};
    sigemptyset(&hear.sa_mask);
    sigaction(SIGUSR1, &hear, NULL);
}

bool interrupt_asked(void)
{
    if (!asked)
        return false;
    asked = 0; /* two requests before a look count once */
    return true;
}
