/* hardening.h - plastic strains and damage travel with the mass of their solids: d(m_l eps_l)/dt = -div(eps* F_l).
 *
 * F_l is the mass flux of the solid through the face, eps* of the side it comes from, so a uniform strain stays
 * uniform. How they grow is the business of plastic.h and rupture.h. */
#ifndef HARDENING_H
#define HARDENING_H

#include "scheme/term.h"

extern const struct term hardening_term;

#endif
