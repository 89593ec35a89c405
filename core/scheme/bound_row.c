/* bound_row.c - see bound_row.h. */
#include "scheme/bound_row.h"

#include "phys/mix.h"

#include <math.h>
#include <string.h>

/* Stiffness of materials at points: rho_l c_l^2 and, with Allaire's closure, d(rho_l e_l)/dp; [n_material] rows. */
struct bound_row_stiffness {
    size_t stride;
    double K[SCENE_MATERIALS * BOUND_ROW], xi[SCENE_MATERIALS * BOUND_ROW];
};

static bool bound_row_is_allaire(const struct model *model)
{
    return model->n_alpha && !model->kapila;
}

/* rho c^2 of the mixture at the point c, and what its frozen sound has more (returned). Waves run at Wood's speed in
 * Kapila's mixtures, 1/(rho c^2) = sum_l alpha_l/(rho_l c_l^2), and in Allaire's at rho c^2 = sum_l alpha_l xi_l rho_l
 * c_l^2/sum_l alpha_l xi_l, xi = d(rho e)/dp (Allaire, Clerc & Kokh 2002). What has no stiffness takes no part (mix.h).
 */
static double bound_row_excess(const struct model *model, const double *alpha, const struct bound_row_stiffness *stiff,
                               size_t c, double *modulus)
{
    double frozen = 0.0, give = 0.0, weight = 0.0, weighed = 0.0;
    for (unsigned l = 0; l < model->n_alpha; l++) {
        size_t i = l * stiff->stride + c;
        double share = alpha[i], K = stiff->K[i];
        if (!(share > 0.0 && K > 0.0)) continue;
        frozen += share * K;
        give += share / K;
        if (model->kapila) continue;
        weight += share * stiff->xi[i];
        weighed += share * stiff->xi[i] * K;
    }
    if (!(give > 0.0)) return *modulus = 0.0;
    *modulus = model->kapila ? 1.0 / give : weighed / weight;
    return frozen - *modulus;
}

static void bound_row_xi(const struct model *model, size_t n, const double *rho, const double *p,
                         struct bound_row_stiffness *stiff)
{
    double slope[BOUND_ROW];
    for (unsigned l = 0; l < model->n_alpha; l++)
        model->eos[l].law->derivatives(model->eos[l].self, n, rho + l * stiff->stride, p, stiff->xi + l * stiff->stride,
                                       slope);
}

/* Is a point of one material? Then it is treated as on that one's path, to the bit. */
static bool bound_row_is_pure(const struct model *model, const double *alpha, size_t stride, size_t c)
{
    bool pure = !model->n_alpha;
    for (unsigned l = 0; l < model->n_alpha; l++) pure |= alpha[l * stride + c] >= 1.0;
    return pure;
}

void bound_row_sound(const struct model *model, const struct bound_row *row, double *rho, double *sound)
{
    struct bound_row_stiffness stiff;
    double c2[BOUND_ROW], modulus;
    const double *alpha = row->w + model->i_alpha * row->stride, *own = row->w + model->i_m * row->stride;
    stiff.stride = row->stride;
    mix_stiffness(model, row->n, row->stride, row->w, stiff.K);
    mix_speed2(model, row->n, row->stride, row->w, stiff.K, c2);
    if (bound_row_is_allaire(model)) bound_row_xi(model, row->n, own, row->w + model->i_E * row->stride, &stiff);
    for (size_t c = 0; c < row->n; c++) {
        rho[c] = 0.0;
        for (unsigned l = 0; l < model->n_material; l++)
            rho[c] += (model->n_alpha ? alpha[l * row->stride + c] : 1.0) * own[l * row->stride + c];
        if (!bound_row_is_pure(model, alpha, row->stride, c))
            c2[c] -= bound_row_excess(model, alpha, &stiff, c, &modulus) / rho[c];
        sound[c] = sqrt(c2[c]);
    }
}

/* What a density is multiplied by over a step of pressure, with K = rho c^2 where it begins and half way. Where there
 * is no sound on the way it stays. */
static double bound_row_ratio(double dp, double K, double K_half)
{
    double y = 2.0 * (K_half / K - 1.0);
    return K > 0.0 && y > -1.0 ? bound_wave_ratio(dp / K, y) : 1.0;
}

/* The same to first order, bounded on both sides: half way. */
static double bound_row_half(double dp, double K)
{
    double x = 0.5 * dp / K;
    if (!(K > 0.0)) return 1.0;
    return x > 0.0 ? 1.0 + x : 1.0 / (1.0 - x);
}

/* Of the materials of a row with densities of their own, [BOUND_ROW] apart, and the pressures p. With Allaire's closure
 * all are compressed alike, and what resists is the mixture. */
static void bound_row_moduli(const struct model *model, size_t n, const double *rho, const double *alpha,
                             const double *p, struct bound_row_stiffness *stiff)
{
    double e[BOUND_ROW], modulus;
    stiff->stride = BOUND_ROW;
    for (unsigned l = 0; l < model->n_material; l++)
        model->eos[l].law->state(model->eos[l].self, n, rho + l * BOUND_ROW, p, e, stiff->K + l * BOUND_ROW);
    if (!bound_row_is_allaire(model)) return;
    bound_row_xi(model, n, rho, p, stiff);
    for (size_t c = 0; c < n; c++) {
        if (bound_row_is_pure(model, alpha, BOUND_ROW, c)) continue;
        bound_row_excess(model, alpha, stiff, c, &modulus);
        for (unsigned l = 0; l < model->n_alpha; l++) stiff->K[l * BOUND_ROW + c] = modulus;
    }
}

/* The mass fractions of the point c stay: with one pressure, what gives way more has less of the volume then. */
static void bound_row_share(const struct model *model, struct bound_row *row, size_t c, const double *inside)
{
    double sum = 0.0;
    for (unsigned l = 0; l < model->n_alpha; l++) {
        double *alpha = &row->w[(model->i_alpha + l) * row->stride + c];
        if (*alpha == 0.0) continue;
        *alpha *= inside[l * BOUND_ROW + c] / row->w[(model->i_m + l) * row->stride + c];
        sum += *alpha;
    }
    for (unsigned l = 0; l < model->n_alpha; l++) row->w[(model->i_alpha + l) * row->stride + c] /= sum;
}

/* What lies inside, of the materials of a row. */
struct bound_row_inside {
    double alpha[SCENE_MATERIALS * BOUND_ROW], rho[SCENE_MATERIALS * BOUND_ROW];
};

static void bound_row_keep(const struct model *model, const struct bound_row *row, struct bound_row_inside *inside)
{
    for (unsigned l = 0; l < model->n_material; l++)
        memcpy(inside->rho + l * BOUND_ROW, row->w + (model->i_m + l) * row->stride, row->n * sizeof(double));
    for (unsigned l = 0; l < model->n_alpha; l++)
        memcpy(inside->alpha + l * BOUND_ROW, row->w + (model->i_alpha + l) * row->stride, row->n * sizeof(double));
}

/* Puts the point c back to what lies inside. */
static void bound_row_restore(const struct model *model, struct bound_row *row, size_t c, const double *old,
                              const double *const *old_u, const struct bound_row_inside *inside)
{
    row->w[model->i_E * row->stride + c] = old[c];
    for (unsigned d = 0; d < model->n_velocity; d++)
        if (old_u[d]) row->w[(model->i_u + d) * row->stride + c] = old_u[d][c];
    for (unsigned l = 0; l < model->n_material; l++)
        row->w[(model->i_m + l) * row->stride + c] = inside->rho[l * BOUND_ROW + c];
    for (unsigned l = 0; l < model->n_alpha; l++)
        row->w[(model->i_alpha + l) * row->stride + c] = inside->alpha[l * BOUND_ROW + c];
}

/* Densities along the isentropes; `at`: moduli inside. Where a law has no sound on the way, or linear waves leave
 * nothing of a material (a trace of gas in a solid under tension), its density stays what it is inside. */
static void bound_row_compress(const struct model *model, struct bound_row *row, const double *old,
                               const struct bound_row_inside *inside, struct bound_row_stiffness *at)
{
    struct bound_row_stiffness between;
    double half[SCENE_MATERIALS * BOUND_ROW], p_half[BOUND_ROW];
    const double *p = row->w + model->i_E * row->stride;
    bound_row_moduli(model, row->n, inside->rho, inside->alpha, old, at);
    for (size_t c = 0; c < row->n; c++) p_half[c] = 0.5 * (old[c] + p[c]);
    for (unsigned l = 0; l < model->n_material; l++)
        for (size_t c = 0, i = l * BOUND_ROW; c < row->n; c++, i++)
            half[i] = inside->rho[i] * bound_row_half(p[c] - old[c], at->K[i]);
    bound_row_moduli(model, row->n, half, inside->alpha, p_half, &between);
    for (unsigned l = 0; l < model->n_material; l++)
        for (size_t c = 0, i = l * BOUND_ROW; c < row->n; c++, i++)
            row->w[(model->i_m + l) * row->stride + c] *= bound_row_ratio(p[c] - old[c], at->K[i], between.K[i]);
}

/* The same, and fractions: the row has new pressures, and what lies inside has those of `old`. */
static void bound_row_move(const struct model *model, struct bound_row *row, const double *old,
                           const struct bound_row_inside *inside, struct bound_row_stiffness *at)
{
    bound_row_compress(model, row, old, inside, at);
    for (size_t c = 0; c < row->n && model->kapila; c++) bound_row_share(model, row, c, inside->rho);
}

void bound_row_follow(const struct model *model, struct bound_row *row, const double *old, const double *const *old_u)
{
    struct bound_row_inside inside;
    struct bound_row_stiffness at;
    double rho[BOUND_ROW], sound[BOUND_ROW];
    bound_row_keep(model, row, &inside);
    bound_row_move(model, row, old, &inside, &at);
    bound_row_sound(model, row, rho, sound);
    for (size_t c = 0; c < row->n; c++)
        if (!(sound[c] > 0.0 && rho[c] > 0.0)) bound_row_restore(model, row, c, old, old_u, &inside);
}

/* The materials of a point of Kapila's mixtures, with K_l inside and where the pressure has grown by dp. */
static void bound_row_parts(const struct model *model, const struct bound_row_inside *inside, size_t c, const double *K,
                            const double *K_there, double dp, struct bound_wave *wave)
{
    double give = 0.0;
    wave->n = 0;
    for (unsigned l = 0; l < model->n_alpha; l++) {
        size_t i = l * BOUND_ROW + c;
        double gamma = (K_there[i] - K[i]) / dp;
        if (!(inside->alpha[i] > 0.0 && K[i] > 0.0)) continue;
        wave->share[wave->n] = inside->alpha[i];
        wave->part_K[wave->n] = K[i];
        wave->part_gamma[wave->n++] = isfinite(gamma) ? gamma : 1.0;
        give += inside->alpha[i] / K[i];
    }
    wave->rest = wave->K - 1.0 / give;
    if (wave->n < 2) wave->n = 0;
}

void bound_row_waves(const struct model *model, struct bound_row *row, const double *rho, const double *sound,
                     const double *there, struct bound_wave *waves)
{
    struct bound_row_inside inside, outside;
    struct bound_row_stiffness at, beyond;
    double rho_there[BOUND_ROW], sound_there[BOUND_ROW], old[BOUND_ROW];
    static const double *const kept[SCENE_AXES];
    double *p = row->w + model->i_E * row->stride;
    memcpy(old, p, row->n * sizeof *p);
    bound_row_keep(model, row, &inside);
    memcpy(p, there, row->n * sizeof *p);
    bound_row_move(model, row, old, &inside, &at);
    bound_row_sound(model, row, rho_there, sound_there);
    bound_row_keep(model, row, &outside);
    if (model->kapila) bound_row_moduli(model, row->n, outside.rho, outside.alpha, there, &beyond);
    for (size_t c = 0; c < row->n; c++) {
        double Z = rho[c] * sound[c], K = Z * sound[c], dp = there[c] - old[c];
        double gamma = (rho_there[c] * sound_there[c] * sound_there[c] - K) / dp;
        waves[c].Z = Z;
        waves[c].K = K;
        waves[c].gamma = isfinite(gamma) ? gamma : 1.0;
        waves[c].rho = rho[c];
        waves[c].n = 0;
        if (model->kapila) bound_row_parts(model, &inside, c, at.K, beyond.K, dp, &waves[c]);
        bound_row_restore(model, row, c, old, kept, &inside);
    }
}
