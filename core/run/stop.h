/* stop.h - SIGINT, SIGTERM, SIGUSR1, SIGHUP: the first asks the run to save and stop, the second ends
 * the process at once (exit code 4, nothing saved). SIGUSR1 is never a second one: queues warn with it, and send it to
 * all processes of a job, of which some hand it on. */
#ifndef STOP_H
#define STOP_H

/* Catches the signals from now on. */
void stop_catch(void);

/* The signal that asked to stop, 0 if none did. Of this rank: agree before acting on it. */
int stop_signal(void);

#endif
