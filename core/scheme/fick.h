/* fick.h - gases diffuse through each other: vapour through air.
 *
 * Gases of a mixture (section `gas-diffusion:`) have fractions of their own at one pressure; together they fill alpha =
 * sum alpha_k of a cell, with the density rho = sum alpha_k rho_k/alpha and the mass fractions Y_k = alpha_k
 * rho_k/(alpha rho). Fick's law in the frame of their mean velocity, which is that of the flow: j_k = -rho D grad Y_k,
 * sum j_k = 0,   q = sum j_k h_k, through the part of a face that both cells have gas at, min(alpha_L, alpha_R). rho D
 * of the face is the harmonic mean, so that no cell gives more than it has. What moves has the enthalpy and the volume
 * of the cell it comes from, each gas at its own pressure (phys/traction.h): d m_k/dt = -div j_k,   d(rho E)/dt = -div
 * q,   d alpha_k/dt = -div(j_k/rho_k) + what keeps one pressure (swell.h). Thus p and T that are uniform stay so while
 * gases of unlike molar masses mix (Bird, Stewart & Lightfoot, Transport Phenomena, 2nd ed., 17.1, 19.3; without
 * diffusion by gradients of T and p). D is a constant, or D0 (p0/p) (T/T0)^1.75 (Fuller, Schettler & Giddings, Ind.
 * Eng. Chem. 58 (1966) 18), T the gases' mean by mass, since what little there is of a gas can be hotter than all else;
 * more than two gases share one D.
 *
 * Time step: 1/dt = signal/CFL + DISTANCE_PACE D sum 1/h^2 where the gases are enough of a cell (heed.h); where they
 * are less, D is bounded by what keeps it stable. */
#ifndef FICK_H
#define FICK_H

#include "scheme/term.h"

/* Owns a row for each gas of the path's mixtures: the volume that it takes along [1/s]. */
extern const struct term fick_term;

#endif
