/* stop.c - see stop.h. */
#include "run/stop.h"

#include "base/status.h"

#include <signal.h>
#include <unistd.h>

static volatile sig_atomic_t stop_number;

static void stop_handle(int number)
{
    static const char message[] = "\nstopped at once: nothing more was saved\n";
    if (stop_number && number == SIGUSR1) return;
    if (stop_number) {
        ssize_t written = write(STDERR_FILENO, message, sizeof message - 1);
        _exit(written < 0 ? STATUS_RUN : STATUS_STOPPED);
    }
    stop_number = number;
}

void stop_catch(void)
{
    static const int numbers[] = {SIGINT, SIGTERM, SIGUSR1, SIGHUP};
    struct sigaction action = {.sa_handler = stop_handle, .sa_flags = SA_RESTART};
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++) sigaction(numbers[i], &action, NULL);
    signal(SIGXFSZ, SIG_IGN); /* a limit on the size of files is a failed write like any other */
}

int stop_signal(void)
{
    return (int)stop_number;
}
