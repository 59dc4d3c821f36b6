#include "app/base/interrupt.h"

#include "app/base/output_pending.h"

#include <signal.h>
#include <stddef.h>
#include <unistd.h>

static volatile sig_atomic_t signals, asked;

static void on_signal(int number)
{
    (void)number;
    if (signals) {
        output_discard_all();
        _exit(EXIT_INTERRUPTED);
    }
    signals = 1;
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
    return signals != 0;
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
    asked = 0; /* two that came before a look are one */
    return true;
}
