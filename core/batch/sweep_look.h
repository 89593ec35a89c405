/* sweep_look.h - what an output directory holds, seen by somebody who wants to run a certain case there. */
#ifndef SWEEP_LOOK_H
#define SWEEP_LOOK_H

enum sweep_look {
    SWEEP_LOOK_NEW,     /* no run */
    SWEEP_LOOK_DONE,    /* the same case has come to its end there */
    SWEEP_LOOK_BEGUN,   /* the same case, which can only begin again */
    SWEEP_LOOK_SAVED,   /* the same case, with a checkpoint to go on from */
    SWEEP_LOOK_FOREIGN, /* another case, or something that is no whole run */
};

/* Cases are the same if their resolved texts are but for the output directory: what was run may have been moved.
 * FOREIGN: *ret_difference says what differs; else NULL. Release it with mem_free. */
enum sweep_look sweep_look_at(const char *directory, const char *resolved, char **ret_difference);

#endif
