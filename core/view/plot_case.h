/* plot_case.h - single entries of the resolved case that a run leaves beside its output. */
#ifndef PLOT_CASE_H
#define PLOT_CASE_H

/* A scalar of the top mapping of DIR/case.yaml ("title", "about") in new memory, or NULL. */
char *plot_case_scalar(const char *directory, const char *key);

/* The title of the case, or else the last part of the directory's name, in new memory. */
char *plot_case_title(const char *directory);

/* The directory without slashes at its end, in new memory: "out/" is "out". */
char *plot_case_directory(const char *directory);

/* A run's name in a legend: the last part of its path, the path itself if another of the runs is called so too. */
const char *plot_case_run(const char *const *directories, unsigned n, unsigned run);

#endif
