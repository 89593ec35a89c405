/* scene_value.c - a number of a case, or the script that gives it. */
#include "case/scene.h"

#include "base/status.h"

int scene_value_at(const struct scene_value *value, const double x[SCENE_AXES], double r, double t, double *ret)
{
    if (!value->script) {
        *ret = value->number;
        return STATUS_OK;
    }
    double in[] = {x[0], x[1], x[2], r, t};
    return script_call(value->script, in, 5, ret, 1);
}
