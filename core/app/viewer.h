/* viewer.h - hands the commands that draw to the program beside this one (view/view.h). */
#ifndef VIEWER_H
#define VIEWER_H

#include <stdbool.h>

/* Does the command line ask for a picture? */
bool viewer_wanted(int argc, char **argv);

/* Becomes the drawing program, with the same command line. Returns only if that fails: the exit code; it has been said why. */
int viewer_become(char **argv);

#endif
