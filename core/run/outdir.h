/* outdir.h - the output directory of a run: who may write there, and what an old run left. */
#ifndef OUTDIR_H
#define OUTDIR_H

#include <stdbool.h>

/* May a run write there? If the directory holds the output of a run and not `overwrite`:
 * STATUS_CASE with a message that lists what is there. Collective, as all calls here; rank 0 acts. */
int outdir_check(const char *path, bool overwrite);

/* Takes the directory, if there is one, for this process, before what lies there is read: a run at work would remove it
 * meanwhile. STATUS_CASE: another run is at work there. */
int outdir_claim(const char *path);

/* Makes the directory (and its parents), takes it for this process and removes the output of an older run. Files that
 * are not ours are never touched. STATUS_CASE: another run is at work there. */
int outdir_prepare(const char *path);

/* Takes the directory and keeps what is there, for a run that goes on, but for drafts that a killed run left. */
int outdir_go_on(const char *path);

/* Does a file lie in the folder `name` of the directory? */
bool outdir_holds(const char *path, const char *name, const char *file);

/* Writes a text file of the run, for example case.yaml. */
int outdir_write(const char *directory, const char *name, const char *text);

#endif
