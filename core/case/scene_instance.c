/* scene_instance.c - every module that a scene has opened, one after the other; and which of two stands for another. */
#include "case/scene.h"

struct instance *scene_instance(struct scene *scene, unsigned index)
{
    enum { LAWS = 6, SCHEMES = 5, FACES = 2 * SCENE_AXES };
    if (index < LAWS * scene->n_material) {
        struct scene_material *material = &scene->material[index / LAWS];
        struct instance *const laws[LAWS] = {&material->eos,       &material->constitutive, &material->plastic,
                                             &material->viscosity, &material->conductivity, &material->damage.law};
        return laws[index % LAWS];
    }
    index -= LAWS * scene->n_material;
    struct scene_scheme *scheme = &scene->scheme;
    struct instance *const schemes[SCHEMES] = {&scheme->reconstruction, &scheme->limiter, &scheme->interface_limiter,
                                               &scheme->along_limiter, &scheme->riemann};
    if (index < SCHEMES) return schemes[index];
    index -= SCHEMES;
    if (index < FACES) return &scene->domain.boundary[index / 2][index % 2].law;
    index -= FACES;
    return index < scene->n_derived ? &scene->derived[index].law : NULL;
}

const struct instance *scene_instance_along(const struct scene_scheme *scheme)
{
    return scheme->along_limiter.module ? &scheme->along_limiter : &scheme->limiter;
}
