/* watch_life.h - is a run at work, done, or dead? From signs that it cannot fake: a run holds a lock on its directory
 * until its process ends, however it ends, and says in provenance.json why it ended. */
#ifndef WATCH_LIFE_H
#define WATCH_LIFE_H

#include <stdbool.h>

enum watch_life {
    WATCH_LIFE_NONE,     /* nothing has begun */
    WATCH_LIFE_RUNNING,  /* at work */
    WATCH_LIFE_QUIET,    /* at work, or so it seems, but nothing has been written for long */
    WATCH_LIFE_FINISHED, /* came to its end */
    WATCH_LIFE_MISSED,   /* came to its end, but an expectation does not hold */
    WATCH_LIFE_FAILED,
    WATCH_LIFE_STOPPED, /* interrupted; it has saved itself */
    WATCH_LIFE_KILLED,  /* it says that it runs, but its process is gone */
};

enum { WATCH_LIFE_LONG = 300 }; /* s without a file that changes, from which a run counts as quiet */

struct watch_life_signs {
    bool known;      /* there is a provenance.json */
    bool ended;      /* with an exit code in it */
    int exit_code;   /* of an ended run */
    int locked;      /* its directory: 1, 0; -1: nobody knows (system_locked) */
    bool here;       /* it runs on this machine: only here a lock that is missing says something */
    double silent_s; /* since its files changed last */
};

enum watch_life watch_life_of(const struct watch_life_signs *signs);

/* "running", "killed": a word for programs; and a sentence for people. Static texts. */
const char *watch_life_word(enum watch_life life);
const char *watch_life_sentence(enum watch_life life, const struct watch_life_signs *signs);

#endif
