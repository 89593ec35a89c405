/* place.h - putting files into the output directory so that a killed run leaves no broken ones.
 *
 * A file is written under a temporary name beside its place and renamed when it is whole. Only
 * rank 0 works; all calls are collective and return the same on all ranks. */
#ifndef PLACE_H
#define PLACE_H

/* Makes a folder and those above it; one that is there is fine. STATUS_RUN with the reason. */
int place_folder(const char *path);

/* Writes (replaces) a text file. */
int place_text(const char *path, const char *text);

/* The temporary name of a file: release with mem_free. */
char *place_draft(const char *path);

/* Renames the draft of a file, which is complete, to its name, and makes file and name lasting (fsync). A draft that
 * cannot be renamed is removed. */
int place_accept(const char *path);

/* The same for this process alone, beside the run (aside.h). Drafts of failures stay for place_reject. */
int place_accept_here(const char *path);
int place_text_here(const char *path, const char *text);

/* Removes the draft of a file after a failure; keeps the recorded message. */
void place_reject(const char *path);

#endif
