/* script_host.h - the Lua state of a case: how it is made, what it may use, and its end. */
#ifndef SCRIPT_HOST_H
#define SCRIPT_HOST_H

#include "case/script.h"

#define SCRIPT_HOST_TIME 0.2 /* seconds of CPU time for a call, if the case says nothing */

struct script_host *script_host_new(void);       /* ends the program if there is no memory for it */
void script_host_free(struct script_host *host); /* frees its scripts too; NULL is fine */

/* Seconds of CPU time that a call may take from now on (SCRIPT_HOST_TIME at first; below 2000); many calls, one after
 * the other, may take a 200th of it in the mean, and twice as much in sum whatever they are. */
void script_host_limit(struct script_host *host, double seconds);

#endif
