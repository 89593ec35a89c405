/* maps.h - space-time maps: fields at places in a row, over time. maps/NAME.csv grows during the run; when it ends the
 * same numbers become arrays in maps/NAME.hdf.
 *
 * The table has a line for each time and place: `t,x,<field>...`, the second column named for the axis of the places
 * (`s`: distance along an oblique line or a curve), vectors as <field>_x, ... Places on lines and curves are seen as
 * probes see them (sample.h). On a surface a place is the mean over those of its pieces that lie within half the
 * distance of places, a piece as wide as a cell; NaN where there is none. A rectangle has two columns of places,
 * `s1,s2`, of which s2 varies faster. Times are those of steps: the first one at or after each multiple of `every` (so
 * maps never cut a step), the start and the end. The arrays: /t [n] s, /x (or y, z, s) [m] m, /<field> [n, m], with
 * attributes `units`; of a rectangle /s1 [m1], /s2 [m2] and m = m1 m2, with attributes corner, first, second of /. */
#ifndef MAPS_H
#define MAPS_H

#include "derive/derive.h"
#include "io/notes.h"
#include "solve/state.h"

struct maps;

/* Opens the files if the case has maps (else *ret_maps is NULL, which all calls accept). A state with steps behind it
 * goes on with the rows up to its time. STATUS_CASE for unknown fields. Collective, as all calls here. */
int maps_new(const struct state *state, struct maps **ret_maps);
void maps_free(struct maps *maps);

/* Notes where the files are, and goes back there (csv.h); `origin` is the directory that the rows of the past may be
 * copied from. */
int maps_keep(struct maps *maps, struct notes *notes);
int maps_recall(struct maps *maps, const struct notes *notes, const char *origin);

/* To be called with the initial state and after every step: writes what is due. */
int maps_record(struct maps *maps, const struct state *state, struct derive_moment *moment);

/* The end of a run: a last time, if the state is whole, and the arrays. */
int maps_finish(struct maps *maps, const struct state *state, struct derive_moment *moment);

#endif
