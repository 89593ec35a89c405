/* viscoelastic.h - Maxwell branches of solids: springs with a dashpot in a row, each on a stretch of its own.
 *
 * The stress of a solid is that of its elastic law plus that of its branches, and so is its energy. A branch of modulus
 * G and time tau is a neo-Hookean solid whose stretch V_b moves as V does, with the mass of its own solid, and relaxes:
 *     dV_b/dt = L V_b - tr(L) V_b/3 - Dp V_b,   Dp = s'_b/(2 G tau) = dev B_b/(2 tau)
 * What elastic energy is lost that way is heat, as total energy stays. A solid whose elastic law bears nothing is a
 * Maxwell fluid; one branch beside a law makes the standard linear solid, several a generalised Maxwell solid; a very
 * short tau with G = eta/tau a Kelvin-Voigt solid. Cf. Reese & Govindjee, Int. J. Solids Struct. 35 (1998) 3455-3482,
 * whose inelastic flow of finite strain this is, written for the left stretch. */
#ifndef VISCOELASTIC_H
#define VISCOELASTIC_H

#include "scheme/term.h"

/* Acts behind strain.h: half of the relaxation, the motion, the other half, in every stage. */
extern const struct term viscoelastic_term;

#endif
