/* tableau.h - the time integrator as data: the stages of an explicit Runge-Kutta method in the form of Shu and Osher.
 *
 * A stage takes the rates L at the primitives of the stage before, and makes
 *     u_i = u + mix (base + step dt L - u),   base = u or what the stage before has made (previous),
 * a mean of the state at the beginning of the step and one explicit step. Sound numbers stay sound: for mix in (0, 1] a
 * stage is as bounded as the explicit step is (Shu & Osher, J. Comput. Phys. 77 (1988) 439). Guard, ghosts of finer
 * levels, registers, dumps and the plan follow the rows; a new method is one table in tableau.c and its name in the
 * case layer. */
#ifndef TABLEAU_H
#define TABLEAU_H

#include "case/scene.h"

enum { TABLEAU_STAGES = 4 }; /* most of any method */

/* The number of one explicit step, which no case asks for: the guard's last try (advance.c). */
enum { TABLEAU_SINGLE = SCENE_HANCOCK + 1 };

struct tableau_stage {
    const char *name;
    const char *doc; /* the formula, for people */
    bool previous;   /* the explicit step starts from what the stage before has made, else from u */
    double step;     /* of the explicit step, in dt */
    double mix;
    double at;     /* time of the primitives within the step, in dt: boundaries and ghosts are asked there */
    double weight; /* of the fluxes of this stage in the whole step: they sum to 1 */
    bool slopes;   /* no explicit step: primitives from the slopes of the cells (scheme/hancock.h), where no cell is
                      troubled */
};

struct tableau {
    const char *name, *doc; /* name: as in case files */
    int n;
    struct tableau_stage stage[TABLEAU_STAGES];
};

/* The integrator that a scene asks for. */
const struct tableau *tableau_of(const struct scene *scene);

/* By enum scene_integrator or TABLEAU_SINGLE, and the number of one or of a name; -1: there is none. */
const struct tableau *tableau_numbered(int integrator);
int tableau_number(const struct tableau *tableau);
int tableau_named(const char *name);

/* Time of the state that a stage makes, since the step began, in dt. */
double tableau_reach(const struct tableau *tableau, int stage);

/* Does a stage need the conserved fields of the one before? */
bool tableau_keeps(const struct tableau *tableau);

/* Has it a stage of slopes? */
bool tableau_slopes(const struct tableau *tableau);

/* Is a stage the first whose fluxes count? */
bool tableau_is_first_weight(const struct tableau *tableau, int stage);

#endif
