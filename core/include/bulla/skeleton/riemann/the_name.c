/* the_name.c - a Riemann solver: HLLC in its plain form, face by face, to be changed into yours.
 *
 * Two signals S_L, S_R enclose the face's waves; between them lie one velocity S_M and one pressure p* on
 * both sides of the contact (Toro 2009, section 10.4). What lies upwind of the contact goes through:
 *     S_M = (p_R - p_L + a_L u_L - a_R u_R)/(a_L - a_R),   a_K = rho_K (S_K - u_K),   p* = p_K + a_K (S_M - u_K),
 *     rho*_K = rho_K chi,  chi = (S_K - u_K)/(S_K - S_M),   mass flux m_K chi S_M.
 * At uniform p and u mass, volume fraction and energy must move together, whatever jumps beside them:
 * bulla/riemann.h says why, `bulla module check` tests it. */
#include <bulla/riemann.h>

/* One side of one face; u is normal to the face. */
struct the_name_side {
    double rho, u, p, c, rho_E;
};

/* What goes through: side K moves with `carrier`, between the signals chi S_M. */
struct the_name_face {
    double u, p, rho_E, carrier;
    int from_left;
};

static struct the_name_side the_name_at(const struct bulla_side *side, size_t i)
{
    return (struct the_name_side){side->rho[i], side->u[0][i], side->p[i], side->c[i], side->rho_E[i]};
}

static double the_name_least(double a, double b)
{
    return a < b ? a : b;
}

static struct the_name_face the_name_between(struct the_name_side left, struct the_name_side right)
{
    double s_left = the_name_least(left.u - left.c, right.u - right.c);
    double s_right = -the_name_least(-(left.u + left.c), -(right.u + right.c));
    double a_left = left.rho * (s_left - left.u), a_right = right.rho * (s_right - right.u);
    double s_contact = (right.p - left.p + a_left * left.u - a_right * right.u) / (a_left - a_right);
    int from_left = s_left >= 0.0 || (s_right > 0.0 && s_contact >= 0.0);
    struct the_name_side from = from_left ? left : right;
    if (s_left >= 0.0 || s_right <= 0.0) return (struct the_name_face){from.u, from.p, from.rho_E, from.u, from_left};
    double s = from_left ? s_left : s_right, chi = (s - from.u) / (s - s_contact);
    double p_star = from.p + (from_left ? a_left : a_right) * (s_contact - from.u);
    double rho_E = chi * from.rho_E + (p_star * s_contact - from.p * from.u) / (s - s_contact);
    return (struct the_name_face){s_contact, p_star, rho_E, chi * s_contact, from_left};
}

static void the_name_solve(const void *self, const struct bulla_faces *faces)
{
    const struct bulla_flux *flux = &faces->flux;
    (void)self;
    for (size_t i = 0; i < faces->n; i++) {
        struct the_name_face face = the_name_between(the_name_at(&faces->left, i), the_name_at(&faces->right, i));
        const struct bulla_side *from = face.from_left ? &faces->left : &faces->right;
        double mass = from->rho[i] * face.carrier;
        flux->u[i] = face.u;
        flux->rho_E[i] = face.u * (face.rho_E + face.p);
        flux->momentum[0][i] = mass * face.u + face.p;
        for (unsigned k = 1; k < faces->n_velocity; k++) flux->momentum[k][i] = mass * from->u[k][i];
        for (unsigned l = 0; l < faces->n_material; l++) flux->m[l][i] = from->m[l][i] * face.carrier;
        for (unsigned l = 0; l < faces->n_alpha; l++) flux->alpha[l][i] = from->alpha[l][i];
    }
}

static const struct bulla_riemann the_name_table = {.size = sizeof(struct bulla_riemann), .solve = the_name_solve};

/* No parameters, so no instance: `open` and `close` may stay away. The skeleton of kind eos has both. */
BULLA_EXPORT const struct bulla_module bulla_module = {
    .magic = BULLA_MAGIC,
    .abi = BULLA_ABI,
    .size = sizeof(struct bulla_module),
    .kind = "riemann",
    .name = "the-name",
    .version = "0.1",
    .doc = "Say what the solver does. Say what it is good for.",
    .cite = "paper and equation",
    .table = &the_name_table,
};
