/* progress.h - how far a run is: one live line on a terminal, a line every few seconds
 * elsewhere, one JSON object per line for programs, or nothing.
 *
 * Rank 0 alone shows anything. Lines for people go to stderr, JSON to stdout. */
#ifndef PROGRESS_H
#define PROGRESS_H

#include "mesh/mesh.h"
#include "run/eta.h"

#include <stdbool.h>

enum progress_mode { PROGRESS_LINES, PROGRESS_LIVE, PROGRESS_JSON, PROGRESS_SILENT };

struct progress {
    enum progress_mode mode;
    bool color;
    double until;    /* end of the run [s] */
    long most_steps; /* or this many steps; 0: no limit */
    double cells;    /* of the mesh, all levels */
    int n_level;
    double level_cells[MESH_LEVELS];
    long level_steps[MESH_LEVELS];
    double work; /* cell updates since the start, and when a line was shown last */
    double worked;
    double start; /* clock at the start [s] */
    double cpu;   /* CPU time of this process then */
    double shown; /* clock and share of the run when a line was shown last */
    double share;
    struct eta eta;
    bool line_open; /* a live line stands on the terminal */
};

/* Seconds of a clock that never jumps. */
double progress_clock(void);

/* Mode for a terminal or not, as NO_COLOR and `json`, `quiet` ask. */
enum progress_mode progress_choose(bool json, bool quiet, bool terminal);

/* Counts the cells of the mesh and the work done on it: at the start, and after each step. `level_steps`: the steps
 * that each level has taken (state.h). */
void progress_mesh(struct progress *progress, const struct mesh *mesh, const long level_steps[MESH_LEVELS]);

/* Begins; `name` of the case and `ranks` go into the first JSON line. */
void progress_begin(struct progress *progress, const char *name, const char *directory);

/* After each step; shows a line when it is time for one. */
void progress_step(struct progress *progress, double t, double dt, long step);

/* Ends a live line so that other lines can follow. */
void progress_clear(struct progress *progress);

/* The end: with JSON the last object; `code` is the exit code, `reason` why the run ended. */
void progress_end(struct progress *progress, double t, long step, int code, const char *reason);

#endif
