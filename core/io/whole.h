/* whole.h - the lists of all tiles, while a file is written.
 *
 * A run knows its own tiles and those around them. A snapshot and a checkpoint name all tiles, where their rows lie,
 * and which corners cells share: so all ranks tell theirs, and each has all lists until the file is made. */
#ifndef WHOLE_H
#define WHOLE_H

#include "mesh/mesh.h"

struct whole;

/* From here to whole_end the levels' lists hold all tiles, with `rank`, `covered` and `unwanted`; `hidden` is known of
 * own ones as ever. Nothing may change the mesh meanwhile. Collective; NULL on one rank, which has them anyhow. */
struct whole *whole_begin(struct mesh *mesh);
void whole_end(struct whole *whole, struct mesh *mesh);

#endif
