/* viewer.h - hands the commands that draw, and the one that shows runs at work, to the programs beside this one
 * (view/view.h, watch/watch.h). */
#ifndef VIEWER_H
#define VIEWER_H

#include <stdbool.h>

/* Does the command line ask for one of them? */
bool viewer_wanted(int argc, char **argv);

/* Becomes that program, with the same command line. Returns only if that fails: the exit code; it has been said why. */
int viewer_become(char **argv);

#endif
