/* verify_file.h - files of `bulla verify`: where cases are, tables in the documentation, folders. */
#ifndef VERIFY_FILE_H
#define VERIFY_FILE_H

/* The folder above cases/verify: the working directory, or the one the program was built or installed in; NULL: there
 * is none. The caller frees it. */
char *verify_file_source(void);

/* Replaces what stands between the markers of `id` in a file by `table`, or adds both at its end, under the title; all
 * else stays. STATUS_RUN if it cannot be written. */
int verify_file_save(const char *path, const char *id, const char *title, const char *table);

/* Makes a folder and those above it. STATUS_RUN if it cannot be made. */
int verify_file_folder(const char *path);

#endif
