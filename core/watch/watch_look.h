/* watch_look.h - what a run is doing, from its own files, as the page gets it.
 *
 * Short, of every run: "name", "title", "life" (a word of watch_life.h), "says", "reason", "t", "until", "step", "dt",
 * "percent", "left_s" (at the mean pace so far; or null), "silent_s", "started", "ranks", "guard" (four counts or
 * null), "snapshots" (how many). Whole, of one run: these, and "columns", "fields" of the last snapshot, "times" of
 * all, "expect", "log". Numbers that are not there are null. Every text is one line of UTF-8, whatever the file had. */
#ifndef WATCH_LOOK_H
#define WATCH_LOOK_H

#include <jansson.h>

/* `name`: what the page calls it. */
json_t *watch_look_short(const char *directory, const char *name);
json_t *watch_look_whole(const char *directory, const char *name);

#endif
