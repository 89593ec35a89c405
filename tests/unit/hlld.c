/* hlld against regions built here wave by wave from the jump conditions, in textbook form, and against linear waves. */
#include "sides.h"

/* The six regions of hlld, left to right, and the five waves between them. */
struct fan {
    struct side region[6];
    double speed[5];
};

/* Behind the fast wave S of side K (Toro 2009, 10.39). */
static struct side fan_star(const struct side *k, double S, double S_M, double p)
{
    struct side star = *k;
    double chi = (S - k->u[0]) / (S - S_M);
    star.rho = chi * k->rho;
    for (unsigned l = 0; l < MATERIALS; l++) star.m[l] = chi * k->m[l];
    star.u[0] = S_M;
    star.p = p;
    star.rho_E = (k->rho_E * (S - k->u[0]) + p * S_M - k->p * k->u[0]) / (S - S_M);
    return star;
}

/* Shear speed behind the fast wave: rho* c_S* = rho c_S chi^(1/3) in its Pade form, not above the fast wave. */
static double fan_slow(const struct side *k, const struct side *star, double S)
{
    double chi = star->rho / k->rho, slow = k->c_s * (1.0 + 2.0 * chi) / (2.0 + chi) / chi;
    return fmin(slow, fabs(S - star->u[0]));
}

/* Behind the slow wave that runs with `run` (negative: to the left) against the matter. */
static struct side fan_slide(const struct side *star, double run, const double *u, const double *s)
{
    struct side inner = *star;
    if (run == 0.0) return inner;
    for (unsigned k = 0; k + 1 < AXES; k++) {
        inner.rho_E -= (s[k] * u[k] - star->s[k] * star->u[k + 1]) / run;
        inner.u[k + 1] = u[k];
        inner.s[k] = s[k];
    }
    return inner;
}

static struct fan fan_of(const struct face *face)
{
    const struct side *l = &face->left, *r = &face->right;
    double S_L = fmin(l->u[0] - l->c, r->u[0] - r->c), S_R = fmax(l->u[0] + l->c, r->u[0] + r->c);
    double a_l = l->rho * (S_L - l->u[0]), a_r = r->rho * (S_R - r->u[0]);
    double S_M = (a_l * l->u[0] - a_r * r->u[0] + r->p - l->p) / (a_l - a_r), p = l->p + a_l * (S_M - l->u[0]);
    struct fan fan = {.region = {*l, fan_star(l, S_L, S_M, p), *l, *r, fan_star(r, S_R, S_M, p), *r}};
    double c_l = fan_slow(l, &fan.region[1], S_L), c_r = fan_slow(r, &fan.region[4], S_R);
    double z_l = fan.region[1].rho * c_l, z_r = fan.region[4].rho * c_r, u[AXES - 1] = {0}, s[AXES - 1] = {0};
    for (unsigned k = 0; k + 1 < AXES && z_l + z_r > 0.0; k++) {
        s[k] = (z_l * r->s[k] + z_r * l->s[k] + z_l * z_r * (r->u[k + 1] - l->u[k + 1])) / (z_l + z_r);
        u[k] = (z_l * l->u[k + 1] + z_r * r->u[k + 1] + r->s[k] - l->s[k]) / (z_l + z_r);
    }
    fan.region[2] = fan_slide(&fan.region[1], -c_l, u, s);
    fan.region[3] = fan_slide(&fan.region[4], c_r, u, s);
    memcpy(fan.speed, (double[5]){S_L, S_M - c_l, S_M, S_M + c_r, S_R}, sizeof fan.speed);
    return fan;
}

/* U in the order of the fluxes; what has no flux is 0. */
static struct out fan_vector(const struct side *side)
{
    struct out out = {.rho_E = side->rho_E};
    for (unsigned k = 0; k < AXES; k++) out.momentum[k] = side->rho * side->u[k];
    for (unsigned l = 0; l < MATERIALS; l++) out.m[l] = side->m[l];
    return out;
}

/* S [U] = [F] across wave i. */
static void check_jump(const struct face *face, struct shape shape, const struct fan *fan, unsigned i)
{
    struct out U[2] = {fan_vector(&fan->region[i]), fan_vector(&fan->region[i + 1])};
    struct out F[2] = {physical(shape, &fan->region[i]), physical(shape, &fan->region[i + 1])};
    double u[2][OUT], f[2][OUT], got[OUT], want[OUT];
    memcpy(u, U, sizeof u);
    memcpy(f, F, sizeof f);
    for (unsigned q = 0; q < OUT; q++) {
        bool conserved = q <= PLACE(out, rho_E);
        got[q] = conserved ? fan->speed[i] * (u[1][q] - u[0][q]) : 0.0;
        want[q] = conserved ? f[1][q] - f[0][q] : 0.0;
    }
    struct out left, right;
    memcpy(&left, got, sizeof left);
    memcpy(&right, want, sizeof right);
    compare("jump", face, left, right, 1e-11);
}

/* hlld gives the flux of the region at the face; V_nt carried from K with the slide is that of the region. */
static void check_fan(const struct face *face, struct shape shape, unsigned *hits)
{
    struct fan fan = fan_of(face);
    struct out got = solve("hlld", shape, *face), scale = scale_of(face);
    unsigned at = 0;
    for (unsigned i = 0; i < 5; i++) check_jump(face, shape, &fan, i);
    while (at < 5 && fan.speed[at] <= 0.0) at++;
    hits[at]++;
    const struct side *region = &fan.region[at], *upwind = at < 3 ? &face->left : &face->right;
    struct out want = physical(shape, region);
    for (unsigned l = 0; l < MATERIALS; l++) want.alpha[l] = upwind->alpha[l];
    memcpy(want.slide_left, got.slide_left, sizeof want.slide_left);
    memcpy(want.slide_right, got.slide_right, sizeof want.slide_right);
    compare("flux", face, got, want, 1e-11);
    if (upwind->c_s == 0.0) return;
    const double *slide = at < 3 ? got.slide_left : got.slide_right;
    double run = at < 3 ? fan.speed[2] - fan.speed[1] : fan.speed[2] - fan.speed[3];
    for (unsigned k = 0; k + 1 < AXES; k++) {
        double jump = region->u[k + 1] - upwind->u[k + 1]; /* of V_nt/V_nn: this over the run */
        double carried = jump == 0.0 ? 0.0 : jump / run * region->u[0];
        assert_true(fabs(carried - region->u[k + 1] + slide[k]) <= 1e-10 * scale.u);
    }
}

/* From gentle faces, where shear waves pass the face, to supersonic ones. */
static void test_fan(void **state)
{
    (void)state;
    struct shape shape = {.n_material = 2, .n_velocity = AXES, .mixed = 1, .solid = 1};
    uint64_t seed = 21;
    unsigned hits[6] = {0};
    for (unsigned j = 0; j < 20000; j++) {
        struct face face = draw_face(&seed, shape, j % 3 ? 0.01 : 4.0);
        if (j % 2) face.right.p = face.left.p * random_between(&seed, 0.999, 1.001);
        if (j % 7 == 0) face.left.c_s *= 4.0; /* faster than the fast wave, at times: bounded by it */
        check_fan(&face, shape, hits);
    }
    for (unsigned i = 0; i < 6; i++) assert_true(hits[i] > 500);
}

/* Small jumps between two solids, at rest or drifting slower than their shear waves. */
static void test_shear_wave(void **state)
{
    (void)state;
    struct shape shape = {.n_material = 1, .n_velocity = 2, .mixed = 1, .solid = 1};
    struct side soft = {.rho = 1060.0, .p = 1e5, .c = 1600.0, .m = {1060.0}, .c_s = 8.954813};
    struct side stiff = {.rho = 1995.0, .p = 1e5, .c = 3872.4, .m = {1995.0}, .c_s = 2319.0};
    struct face face = {soft, stiff};
    double z_l = soft.rho * soft.c_s, z_r = stiff.rho * stiff.c_s, u_l = 1e-9, s_r = 1e-9 * z_l;
    face.left.u[1] = u_l;
    face.right.s[0] = s_r;
    double u = (z_l * u_l + s_r) / (z_l + z_r), s = (z_l * s_r - z_l * z_r * u_l) / (z_l + z_r);
    struct out got = solve("hlld", shape, face);
    assert_true(fabs(got.momentum[1] + s) <= 1e-12 * fabs(s));
    assert_true(fabs(got.slide_left[0] - u) <= 1e-9 * u && got.slide_right[0] == got.slide_left[0]);
    assert_true(fabs(got.rho_E + s * u) <= 1e-9 * fabs(s * u));
    face.left.u[0] = face.right.u[0] = 1.0;
    got = solve("hlld", shape, face);
    assert_true(fabs(got.momentum[1] - (soft.rho * u - s)) <= 1e-10 * fabs(s));
    assert_true(fabs(got.slide_left[0] - (u + (u_l - u) / soft.c_s)) <= 1e-9 * u_l);
}

/* The same along the normal, for equal fast speeds: the signals of Davis give both sides the faster one. */
static void test_pressure_wave(void **state)
{
    (void)state;
    struct shape shape = {.n_material = 1, .n_velocity = 1, .mixed = 1, .solid = 1};
    struct side light = {.rho = 1060.0, .c = 2000.0, .m = {1060.0}, .c_s = 900.0};
    struct side heavy = {.rho = 1995.0, .c = 2000.0, .m = {1995.0}, .c_s = 1100.0};
    struct face face = {light, heavy};
    double z_l = 1060.0 * 2000.0, z_r = 1995.0 * 2000.0, u_l = 2e-5, p_r = 1e-5 * z_r;
    face.left.u[0] = u_l;
    face.right.p = p_r;
    double u = (z_l * u_l - p_r) / (z_l + z_r), p = (z_l * p_r + z_l * z_r * u_l) / (z_l + z_r);
    static const char *const names[] = {"rusanov", "hll", "hllc", "hlld"};
    for (unsigned i = 0; i < 4; i++) {
        struct out got = solve(names[i], shape, face);
        assert_true(fabs(got.u - u) <= 1e-6 * fabs(u));
        assert_true(fabs(got.momentum[0] - p) <= 1e-6 * p);
        assert_true(fabs(got.rho_E - p * u) <= 1e-6 * fabs(p * u));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_fan), cmocka_unit_test(test_shear_wave),
                                       cmocka_unit_test(test_pressure_wave)};
    return cmocka_run_group_tests(tests, sides_start, sides_stop);
}
