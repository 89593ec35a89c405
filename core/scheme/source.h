/* source.h - what acts throughout the domain: body forces, heating, sources of mass (scene_sources).
 *
 * Sources are rates of the conserved fields of a cell, at the middle of its volume and at the time of the stage, added
 * to those of the fluxes: the midpoint rule keeps its second order, refluxing sees nothing of them. Pressure is
 * reconstructed, and interpolated between levels, relative to the forces (source_weight.h).
 *     acceleration a, force f   d(rho u) = rho a + f,  d(rho E) = u . (rho a + f)
 *     heating q_l               d(rho E) = sum alpha_l q_l
 *     mass s_l                  d m_l = s_l,  d(rho u) = s_l u,  d(rho E) = s_l (e_l + p/rho_l + u^2/2)
 *     fractions, stretch        d alpha_l, d V as they are
 * Mass arrives in the state that the material has there, a solid's with its stretch, and nowhere where the material is
 * absent. With the Kapila closure, what heat and mass would drive the pressures of the materials apart by moves volume
 * between them, as in exchange.h: d alpha_l = e_l - s_l/S sum_k e_k with the compliances s_l = alpha_l/(rho_l c_l^2), S
 * = sum s_l, and e_l = s_l q_l/(d rho_l e_l/dp) + (mass source)/rho_l. */
#ifndef SOURCE_H
#define SOURCE_H

#include "base/text.h"
#include "scheme/term.h"

extern const struct term source_term;

/* Adds what acts, in words: "acceleration, heating, lua"; nothing without sources. */
void source_text(const struct scene *scene, struct text *text);

#endif
