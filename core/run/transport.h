/* transport.h - what `bulla check` says of viscosity, heat and surface tension: how far they reach, what they ask of
 * time steps, how they stand beside the mesh. Prints to stdout, nothing of materials without any. */
#ifndef TRANSPORT_H
#define TRANSPORT_H

#include "phys/model.h"

/* Of material l at 1 atm, with the most that the rate of shear allows: layers of the run, steps by level, the jumps of
 * the scheme between cells. */
void transport_print_viscosity(const struct scene *scene, const struct model *model, unsigned l);

/* Of material l at 25 C and 1 atm. */
void transport_print_heat(const struct scene *scene, const struct model *model, unsigned l);

/* Of gases that diffuse through each other: D where it is given, how far they get, steps by level. */
void transport_print_gases(const struct scene *scene, const struct model *model);

/* Of the pair scene->tension[k]: Laplace numbers sigma rho R/mu^2 of its viscous materials, R of the smallest sphere of
 * one of them that the scene begins with, else the shortest side; by level the steps that capillary waves of two cells
 * allow (not in one dimension). */
void transport_print_tension(const struct scene *scene, const struct model *model, unsigned k);

/* Reynolds numbers rho u L/mu of the viscous materials: u the larger of `speed` [m/s] and what walls move with, L the
 * shortest side of the domain. */
void transport_print_reynolds(const struct scene *scene, const struct model *model, double speed);

/* Recommends faces for slow flow (scheme.low-mach) where viscosity or surface tension matter and the Mach number is
 * below 0.05. */
void transport_print_slow(const struct scene *scene, const struct model *model, double speed);

/* Which fluids stick to solids. */
void transport_print_sticks(const struct scene *scene, const struct model *model);

#endif
