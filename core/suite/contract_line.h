/* contract_line.h - no jumps: rho e of a law along lines of constant density and of constant pressure.
 *
 * Where continuations begin and end a law is put together of pieces; its slopes have to explain its changes there,
 * too. */
#ifndef CONTRACT_LINE_H
#define CONTRACT_LINE_H

#include "suite/contract_point.h"

/* Walks all lines from p_min up, and says to the contract where rho e jumps, or falls with p. */
void contract_line_all(const struct contract_points *suite);

#endif
