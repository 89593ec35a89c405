/* plot_case.h - single entries of the resolved case that a run leaves beside its output. */
#ifndef PLOT_CASE_H
#define PLOT_CASE_H

/* A scalar of the top mapping of DIR/case.yaml ("title", "about") in new memory, or NULL. */
char *plot_case_scalar(const char *directory, const char *key);

/* The title of the case, or else the last part of the directory's name, in new memory. */
char *plot_case_title(const char *directory);

/* The directory without slashes at its end, in new memory: "out/" is "out". */
char *plot_case_directory(const char *directory);

/* The title that all the runs have, in new memory; "" if they differ. */
char *plot_case_common_title(const char *const *directories, unsigned n);

/* The runs' names in legends, each in new memory: their titles if these are short and no two the same; or else the last
 * parts of their paths; or, where two runs have the same, the parts of the paths that are not the same in all. */
void plot_case_names(const char *const *directories, unsigned n, char **ret_names);

#endif
