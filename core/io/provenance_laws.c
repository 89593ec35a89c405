/* provenance_laws.c - see provenance_laws.h. */
#include "io/provenance_laws.h"

#include "base/text.h"
#include "phys/outside.h"

json_t *provenance_laws_closures(const struct state_counts *counts)
{
    const struct mix_effort *closures = &counts->closures;
    json_t *mean = closures->solved > 0 ? json_real((double)closures->steps / (double)closures->solved) : json_null();
    return json_pack("{s:I, s:o, s:I, s:I}", "solved", (json_int_t)closures->solved, "mean_steps", mean, "most_steps",
                     (json_int_t)closures->most, "failed", (json_int_t)closures->failed);
}

static json_t *provenance_laws_cells(long long sum, long long most)
{
    return json_pack("{s:I, s:I}", "cell_steps", (json_int_t)sum, "most_cells", (json_int_t)most);
}

json_t *provenance_laws_outside(const struct model *model, const struct state_counts *counts)
{
    json_t *outside = json_object();
    for (unsigned l = 0; l < model->n_material; l++)
        if (outside_is_told(model, l))
            json_object_set_new(outside, model->scene->material[l].name,
                                provenance_laws_cells(counts->outside[l], counts->outside_most[l]));
    return outside;
}

json_t *provenance_laws_past(const struct scene *scene, const struct state_counts *counts)
{
    json_t *past = json_object();
    for (unsigned k = 0; k < scene->n_phase; k++) {
        struct text pair = {0};
        text_add(&pair, "%s+%s", scene->material[scene->phases[k].liquid].name,
                 scene->material[scene->phases[k].vapour].name);
        json_object_set_new(past, pair.at, provenance_laws_cells(counts->past[k], counts->past_most[k]));
        text_done(&pair);
    }
    return past;
}
