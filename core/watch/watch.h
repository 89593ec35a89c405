/* watch.h - seeing runs while they are at work: a page of this machine, in a program of its own, bulla-watch.
 *
 * Only this program loads the library that speaks HTTP; `bulla watch` becomes it, as `bulla plot` becomes bulla-view.
 * This header is all that the solver knows of the folder. Nothing here writes a file: what a page shows is what runs
 * have written, and that a run is alive is seen at the lock that it holds on its directory. */
#ifndef WATCH_H
#define WATCH_H

/* Name, words and one line of the command, for both tables of commands. */
#define WATCH_COMMAND "watch", "DIR...", "A page in your browser about runs while they are at work."

#define WATCH_PROGRAM "bulla-watch"

#endif
