/* view.h - drawing is a program of its own, bulla-view: the solver loads neither cairo nor fonts.
 *
 * People call both by one word: for the commands listed here `bulla` becomes the program beside it, so help, options
 * and messages are those of one tool. This header is all that the solver knows of the folder. In it live pictures of
 * snapshots, maps, profiles and histories, and the report; they read files of a run (io/read.h) and no state. */
#ifndef VIEW_H
#define VIEW_H

/* Name, words and one line of each command, for both tables of commands. */
#define VIEW_PLOT                               \
    "plot", "DIR... FIELD|history|map|profile", \
        "PNG pictures and films of snapshots; histories, maps, and profiles out of maps."
#define VIEW_REPORT "report", "DIR", "One HTML page about a run, pictures inside."

#define VIEW_PROGRAM "bulla-view"

#endif
