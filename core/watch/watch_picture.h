/* watch_picture.h - a snapshot of a run as PNG, drawn as `bulla plot` draws it.
 *
 * A child draws: what a damaged or too large file does to it does nothing to the page. Pictures are kept in memory, the
 * newest WATCH_PICTURE_KEPT of them, so that each is drawn once for however many pages show it. */
#ifndef WATCH_PICTURE_H
#define WATCH_PICTURE_H

#include <stddef.h>

enum { WATCH_PICTURE_LIKE = 6, WATCH_PICTURE_KEPT = 64, WATCH_PICTURE_WIDTH = 900, WATCH_PICTURE_SECONDS = 120 };

/* A snapshot of a run, by number. */
struct watch_picture_place {
    const char *directory;
    unsigned long snapshot;
};

struct watch_picture {
    char *key; /* what it shows */
    size_t n;
    unsigned char *bytes; /* [n] */
};

struct watch_pictures {
    unsigned next; /* to be replaced */
    struct watch_picture kept[WATCH_PICTURE_KEPT];
};

/* Field number `field` (of the last snapshot, as watch_look.h lists them) of the first of n places, on the scale of all
 * of them. The picture belongs to `pictures` until the next call. STATUS_CASE: there is no such snapshot or field;
 * STATUS_RUN: it cannot be drawn. */
int watch_picture_take(struct watch_pictures *pictures, const struct watch_picture_place *places, unsigned n,
                       unsigned long field, const struct watch_picture **ret_picture);
void watch_picture_done(struct watch_pictures *pictures);

#endif
