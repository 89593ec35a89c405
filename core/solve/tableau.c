/* tableau.c - see tableau.h. */
#include "solve/tableau.h"

#include <string.h>

static const struct tableau tableau_all[] = {
    [SCENE_MIDPOINT] = {.name = "midpoint",
                        .doc = "explicit midpoint rule, second order",
                        .n = 2,
                        .stage = {{"half", "u* = u + dt/2 L(w)", false, 0.5, 1.0, 0.0, 0.0},
                                  {"full", "u = u + dt L(w*)", false, 1.0, 1.0, 0.5, 1.0}}},
    [SCENE_SSPRK3] = {.name = "ssprk3",
                      .doc = "three stages of Shu & Osher, third order, strong stability preserving",
                      .n = 3,
                      .stage = {{"first", "u1 = u + dt L(w)", false, 1.0, 1.0, 0.0, 1.0 / 6.0},
                                {"second", "u2 = u + 1/4 (u1 + dt L(w1) - u)", true, 1.0, 0.25, 1.0, 1.0 / 6.0},
                                {"third", "u = u + 2/3 (u2 + dt L(w2) - u)", true, 1.0, 2.0 / 3.0, 0.5, 2.0 / 3.0}}},
    [SCENE_HANCOCK] = {.name = "hancock",
                       .doc = "Hancock's first stage, then that of the midpoint rule; second order",
                       .n = 2,
                       .stage = {{"slopes", "w* = w - dt/2 A(w) s(w)", false, 0.5, 1.0, 0.0, 0.0, .slopes = true},
                                 {"full", "u = u + dt L(w*)", false, 1.0, 1.0, 0.5, 1.0}}},
    [TABLEAU_SINGLE] = {.name = "single",
                        .doc = "one explicit step, first order",
                        .n = 1,
                        .stage = {{"whole", "u = u + dt L(w)", false, 1.0, 1.0, 0.0, 1.0}}},
};

const struct tableau *tableau_numbered(int integrator)
{
    return &tableau_all[integrator];
}

int tableau_number(const struct tableau *tableau)
{
    return (int)(tableau - tableau_all);
}

const struct tableau *tableau_of(const struct scene *scene)
{
    return tableau_numbered((int)scene->scheme.integrator);
}

int tableau_named(const char *name)
{
    int n = (int)(sizeof tableau_all / sizeof *tableau_all);
    for (int i = 0; i < n; i++)
        if (!strcmp(tableau_all[i].name, name)) return i;
    return -1;
}

double tableau_reach(const struct tableau *tableau, int stage)
{
    return stage + 1 < tableau->n ? tableau->stage[stage + 1].at : 1.0;
}

bool tableau_keeps(const struct tableau *tableau)
{
    bool keeps = false;
    for (int s = 0; s < tableau->n; s++) keeps = keeps || tableau->stage[s].previous;
    return keeps;
}

bool tableau_slopes(const struct tableau *tableau)
{
    bool slopes = false;
    for (int s = 0; s < tableau->n; s++) slopes = slopes || tableau->stage[s].slopes;
    return slopes;
}

bool tableau_is_first_weight(const struct tableau *tableau, int stage)
{
    for (int s = 0; s < stage; s++)
        if (tableau->stage[s].weight > 0.0) return false;
    return true;
}
