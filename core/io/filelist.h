/* filelist.h - <case>.hdf.series: the plot files of a run with their times, as ParaView reads them:
 * {"file-series-version": "1.0", "files": [{"name": "tube_000000.hdf", "time": 0.0}, ...]} */
#ifndef FILELIST_H
#define FILELIST_H

#include <stddef.h>

/* Start from {0}; names are relative to the list's folder. */
struct filelist {
    size_t n;
    char **names;
    double *times; /* [s] */
};

/* Reads a list: STATUS_RUN if it is missing or not such a list. */
int filelist_read(const char *path, struct filelist *ret_list);
void filelist_done(struct filelist *list);

/* Adds a file; entries at or after its time are dropped first (a run that was taken up again). */
void filelist_add(struct filelist *list, const char *name, double time);

/* Takes the file added last away again. */
void filelist_drop(struct filelist *list);

/* The list as a text, to be released with mem_free; NULL: a file name is not UTF-8. */
char *filelist_text(const struct filelist *list);

#endif
