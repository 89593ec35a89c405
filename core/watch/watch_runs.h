/* watch_runs.h - the runs that a page shows: the directories given, and of a directory that is no run those in it, as a
 * sweep leaves them. A run has its number for as long as the page is there; new ones come behind. */
#ifndef WATCH_RUNS_H
#define WATCH_RUNS_H

enum { WATCH_RUNS_MOST = 512 };

struct watch_runs {
    const char *const *given; /* directories */
    unsigned n_given;
    unsigned n;
    char *paths[WATCH_RUNS_MOST]; /* of runs */
    char *names[WATCH_RUNS_MOST]; /* what tells them apart, for people; any bytes */
};

/* STATUS_CASE: one of the directories is not there. The list keeps pointing at them. */
int watch_runs_begin(const char *const *given, unsigned n_given, struct watch_runs *ret_runs);

/* Looks for runs that have appeared since. */
void watch_runs_look(struct watch_runs *runs);
void watch_runs_done(struct watch_runs *runs);

#endif
