/* plot_film.h - frames to a film: numbered PNG files in a folder of their own, which ffmpeg makes one file of. Without
 * ffmpeg they stay, and what to type is said. */
#ifndef PLOT_FILM_H
#define PLOT_FILM_H

#include <cairo.h>
#include <stdbool.h>
#include <stddef.h>

enum { PLOT_FILM_PACE = 12, PLOT_FILM_PACE_MOST = 120 }; /* frames per second, by default and at most */

struct plot_film {
    const char *file; /* FILE.mp4, .webm or .gif: the ending says how it is made */
    char *folder;     /* of the frames, beside it; removed with them when the film is there */
    unsigned n;       /* frames so far */
    size_t total;     /* that there will be */
    int size[2];      /* of the largest frame so far [pixels] */
    bool uneven;      /* not all have it */
};

/* A film of so many frames, which a terminal sees come. STATUS_CASE: no film ends like this; STATUS_RUN: its folder
 * cannot be made. End with plot_film_end. */
int plot_film_begin(const char *file, size_t total, struct plot_film *ret_film);

/* One more frame. Widths and heights must be even (picture_canvas.h). */
int plot_film_add(struct plot_film *film, cairo_surface_t *image);

/* Makes the file, `pace` frames per second, and prints its name; where there is no ffmpeg prints the folder, and notes
 * what is missing: STATUS_OK too. STATUS_RUN: ffmpeg fails; the frames stay. With `code` not 0, that of a frame that
 * failed: removes everything and returns it. Frames that are smaller than others get a white margin. */
int plot_film_end(struct plot_film *film, int pace, int code);

#endif
