/* moves.h - tiles that change owner at regrids, for the partition study. */
#ifndef MOVES_H
#define MOVES_H

#include "study.h"

/* A few regrids, between which the features grow by the width of the buffer: prints the shares of tiles that are born
 * and that change owner, as a row. keep: owners stay as far as that balances. */
void moves_print(const struct study *study, int size, bool keep);

#endif
