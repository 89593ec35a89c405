/* watch_answer.h - what is answered to a request, before any library has a part in it: the table of all that can be
 * asked for, and nothing else. Numbers alone come from the address, never a path or a name. */
#ifndef WATCH_ANSWER_H
#define WATCH_ANSWER_H

#include "watch/watch_curve.h"
#include "watch/watch_gate.h"
#include "watch/watch_picture.h"
#include "watch/watch_runs.h"

struct watch_answer_world {
    char token[WATCH_GATE_TOKEN + 1];
    struct watch_runs runs;
    struct watch_pictures pictures;
    struct watch_curve_kept curves;
};

/* A request. `number` finds a number in the query ("run", "column", ...); false: there is none, or it is no number. */
struct watch_answer_request {
    const char *method, *path, *host; /* host: NULL if the header is missing */
    bool (*number)(void *data, const char *name, unsigned long *ret_number);
    void *data;
};

struct watch_answer {
    unsigned status; /* of HTTP */
    const char *type;
    size_t n;
    void *bytes;                      /* [n], new memory */
    char nonce[WATCH_GATE_TOKEN + 1]; /* of scripts and styles in it; "": it has none */
};

void watch_answer_make(struct watch_answer_world *world, const struct watch_answer_request *request,
                       struct watch_answer *ret_answer);

/* The policy that goes with an answer: nothing from elsewhere, no scripts but its own. New memory. */
char *watch_answer_policy(const struct watch_answer *answer);

#endif
