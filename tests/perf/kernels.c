/* kernels.c - what the arithmetic of one cell-stage costs with nothing around it: the floor that
 * the whole program is compared with. No test: it prints a figure for this machine.
 *
 * One tile that stays in cache, stiffened gases, Kapila closure: limited face states (MC), the
 * laws of the materials on both sides, HLLC, the step with the differences of the fluxes, and the
 * primitive fields again. Plain loops, written for one and for two materials and called
 * directly: no plugin table, no gathered frame, no halo, no guard. They run over whole planes
 * of the tile, ghost columns included; the least cost over some tile sizes is printed. */
#include "bulla/module.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

enum { GHOST = 2, MOST = 32, PITCH = MOST + 2 * GHOST, SIZE = PITCH * PITCH, MATERIALS = 2, FIELDS = 7 };

/* Places of the fields; with one material the second fraction and density stay unused. */
enum field { A0, A1, R0, R1, U, V, P };

/* The faces of the cells on one side of them: primitives, then what the laws add. */
struct side {
    double w[FIELDS][SIZE], m[MATERIALS][SIZE], rho[SIZE], rho_E[SIZE], c[SIZE];
};

struct tile {
    unsigned n_material;
    size_t n, pitch;
    double w[FIELDS][SIZE];    /* alpha_l, rho_l, u, v, p */
    double q[FIELDS][SIZE];    /* alpha_l, m_l, rho u, rho v, rho E */
    double flux[FIELDS][SIZE]; /* of q through the low faces */
    double u_star[SIZE], carrier[SIZE], div[SIZE];
    struct side low, high; /* states inside the low and the high face of each cell */
};

static struct tile tile;

/* Water and a gas: gamma, p_inf. */
static const double law[MATERIALS][2] = {{4.4, 6e8}, {1.4, 0.0}};

static inline double least(double a, double b)
{
    return a < b ? a : b;
}

static inline double most(double a, double b)
{
    return a > b ? a : b;
}

/* rho e and rho c^2 of material l. */
static inline double law_energy(unsigned l, double p)
{
    return (p + law[l][0] * law[l][1]) * (1.0 / (law[l][0] - 1.0));
}

static inline double law_stiffness(unsigned l, double p)
{
    return law[l][0] * (p + law[l][1]);
}

/* Face values of a cell: half a slope, monotonized central, to either side. */
BULLA_KERNEL static void faces(size_t n, size_t step, const double *restrict w, double *restrict low,
                               double *restrict high)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double before = w[i - step], here = w[i], after = w[i + step];
        double a = here - before, b = after - here, size_a = fabs(a), size_b = fabs(b);
        double mean = 0.5 * (size_a + size_b), twice = 2.0 * (size_a < size_b ? size_a : size_b);
        int one_way = (a > 0.0) == (b > 0.0);
        double half = copysign(one_way ? 0.5 * (mean < twice ? mean : twice) : 0.0, a);
        low[i] = here - half;
        high[i] = here + half;
    }
}

/* The rest of a state from its primitives. */
BULLA_KERNEL static void complete_one(size_t from, size_t n, struct side *side)
{
    const double *restrict r = side->w[R0] + from, *restrict u = side->w[U] + from;
    const double *restrict v = side->w[V] + from, *restrict p = side->w[P] + from;
    double *restrict E = side->rho_E + from, *restrict c = side->c + from;
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double rho = r[i], x = u[i], y = v[i], pressure = p[i];
        E[i] = law_energy(0, pressure) + 0.5 * rho * (x * x + y * y);
        c[i] = sqrt(law_stiffness(0, pressure) / rho);
    }
}

BULLA_KERNEL static void complete_two(size_t from, size_t n, struct side *side)
{
    const double *restrict a0 = side->w[A0] + from, *restrict a1 = side->w[A1] + from;
    const double *restrict r0 = side->w[R0] + from, *restrict r1 = side->w[R1] + from;
    const double *restrict u = side->w[U] + from, *restrict v = side->w[V] + from, *restrict p = side->w[P] + from;
    double *restrict m0 = side->m[0] + from, *restrict m1 = side->m[1] + from, *restrict r = side->rho + from;
    double *restrict E = side->rho_E + from, *restrict c = side->c + from;
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double share0 = a0[i], share1 = a1[i], x = u[i], y = v[i], pressure = p[i];
        double mass0 = share0 * r0[i], mass1 = share1 * r1[i], rho = mass0 + mass1;
        double stiffness = share0 * law_stiffness(0, pressure) + share1 * law_stiffness(1, pressure);
        double inner = share0 * law_energy(0, pressure) + share1 * law_energy(1, pressure);
        m0[i] = mass0;
        m1[i] = mass1;
        r[i] = rho;
        E[i] = inner + 0.5 * rho * (x * x + y * y);
        c[i] = sqrt(stiffness / rho);
    }
}

/* Rows of one side for HLLC, the normal velocity first. */
struct rows {
    const double *rho, *u, *v, *p, *rho_E, *c;
};

struct fluxes {
    double *normal, *tangential, *rho_E, *u, *carrier;
};

BULLA_KERNEL static void hllc(size_t n, const struct rows *from_left, const struct rows *from_right,
                              const struct fluxes *to)
{
    const struct rows L = *from_left, R = *from_right;
    const double *restrict rl = L.rho, *restrict ul = L.u, *restrict vl = L.v, *restrict pl = L.p;
    const double *restrict rr = R.rho, *restrict ur = R.u, *restrict vr = R.v, *restrict pr = R.p;
    const double *restrict El = L.rho_E, *restrict cl = L.c, *restrict Er = R.rho_E, *restrict cr = R.c;
    double *restrict normal = to->normal, *restrict tangential = to->tangential, *restrict energy = to->rho_E;
    double *restrict u_star = to->u, *restrict carrier = to->carrier;
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double r0 = rl[i], u0 = ul[i], v0 = vl[i], p0 = pl[i], E0 = El[i], c0 = cl[i];
        double r1 = rr[i], u1 = ur[i], v1 = vr[i], p1 = pr[i], E1 = Er[i], c1 = cr[i];
        double s0 = least(u0 - c0, u1 - c1), s1 = most(u0 + c0, u1 + c1);
        double a0 = r0 * (s0 - u0), a1 = r1 * (s1 - u1);
        double middle = 0.5 * (u0 + u1) + ((p1 - p0) - 0.5 * (u1 - u0) * (a0 + a1)) / (a0 - a1);
        double p_star = 0.5 * ((p0 + a0 * (middle - u0)) + (p1 + a1 * (middle - u1)));
        double inner = s1 <= 0.0 ? u1 : middle, u = s0 >= 0.0 ? u0 : inner;
        int left = u >= 0.0, inside = (s0 < 0.0) & (s1 > 0.0);
        double rk = left ? r0 : r1, uk = left ? u0 : u1, vk = left ? v0 : v1, pk = left ? p0 : p1;
        double Ek = left ? E0 : E1, inverse = 1.0 / ((left ? s0 : s1) - middle);
        double chi = 1.0 + (middle - uk) * inverse, E_star = chi * Ek + (p_star * middle - pk * uk) * inverse;
        double speed = inside ? chi * middle : uk, p = inside ? p_star : pk, E = inside ? E_star : Ek;
        carrier[i] = speed;
        u_star[i] = u;
        normal[i] = rk * speed * u + p;
        tangential[i] = rk * speed * vk;
        energy[i] = u * (E + p);
    }
}

/* The upwind density with its speed: flux of a mass or of a volume fraction. */
BULLA_KERNEL static void carry(size_t n, const double *restrict left, const double *restrict right,
                               const double *restrict u, const double *restrict speed, double *restrict flux)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double a = left[i], b = right[i];
        flux[i] = (u[i] >= 0.0 ? a : b) * speed[i];
    }
}

/* q += factor (flux in - flux out) */
BULLA_KERNEL static void apply(size_t n, size_t step, double factor, const double *restrict flux, double *restrict q)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) q[i] += factor * (flux[i] - flux[i + step]);
}

/* div += u* out - u* in; the first axis starts it. */
BULLA_KERNEL static void diverge(size_t n, size_t step, const double *restrict u, double *restrict div, int first)
{
    const double keep = first ? 0.0 : 1.0;
#pragma omp simd
    for (size_t i = 0; i < n; i++) div[i] = keep * div[i] + (u[i + step] - u[i]);
}

BULLA_KERNEL static void primitives_one(size_t from, size_t n)
{
    double *restrict r = tile.w[R0] + from, *restrict u = tile.w[U] + from, *restrict v = tile.w[V] + from;
    double *restrict p = tile.w[P] + from;
    const double *restrict m = tile.q[R0] + from, *restrict mu = tile.q[U] + from, *restrict mv = tile.q[V] + from;
    const double *restrict E = tile.q[P] + from;
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double rho = m[i], inverse = 1.0 / rho, x = mu[i] * inverse, y = mv[i] * inverse;
        r[i] = rho;
        u[i] = x;
        v[i] = y;
        p[i] = (E[i] - 0.5 * rho * (x * x + y * y)) * (law[0][0] - 1.0) - law[0][0] * law[0][1];
    }
}

/* Kapila: d_t alpha_l + div(alpha_l u) = alpha_l (rho c_w^2)/(rho_l c_l^2) div u; then the pressure that
 * closes rho e, linear in p for stiffened gases. */
BULLA_KERNEL static void primitives_two(size_t from, size_t n, double factor)
{
    double *restrict a0 = tile.w[A0] + from, *restrict a1 = tile.w[A1] + from, *restrict r0 = tile.w[R0] + from;
    double *restrict r1 = tile.w[R1] + from, *restrict u = tile.w[U] + from, *restrict v = tile.w[V] + from;
    double *restrict p = tile.w[P] + from, *restrict q0 = tile.q[A0] + from, *restrict q1 = tile.q[A1] + from;
    const double *restrict m0 = tile.q[R0] + from, *restrict m1 = tile.q[R1] + from, *restrict mu = tile.q[U] + from;
    const double *restrict mv = tile.q[V] + from, *restrict E = tile.q[P] + from, *restrict div = tile.div + from;
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double old = p[i], share0 = a0[i] / law_stiffness(0, old), share1 = a1[i] / law_stiffness(1, old);
        double growth = factor * div[i] / (share0 + share1);
        double x0 = q0[i] + growth * share0, x1 = q1[i] + growth * share1;
        double mass0 = m0[i], mass1 = m1[i], rho = mass0 + mass1, inverse = 1.0 / rho;
        double x = mu[i] * inverse, y = mv[i] * inverse, inner = E[i] - 0.5 * rho * (x * x + y * y);
        double slope = x0 / (law[0][0] - 1.0) + x1 / (law[1][0] - 1.0);
        q0[i] = a0[i] = x0;
        q1[i] = a1[i] = x1;
        r0[i] = mass0 / x0;
        r1[i] = mass1 / x1;
        u[i] = x;
        v[i] = y;
        p[i] = (inner - (x0 * law_energy(0, 0.0) + x1 * law_energy(1, 0.0))) / slope;
    }
}

static struct rows rows_of(const struct side *side, size_t from, unsigned axis)
{
    const double *rho = tile.n_material > 1 ? side->rho : side->w[R0];
    return (struct rows){rho + from,        side->w[U + axis] + from, side->w[V - axis] + from,
                         side->w[P] + from, side->rho_E + from,       side->c + from};
}

/* Is the field in use? */
static int used(unsigned field)
{
    return tile.n_material > 1 || field >= U || field == R0;
}

/* One axis: the high faces of cells i - step and the low faces of cells i meet. */
static void sweep(unsigned axis, double factor)
{
    size_t step = axis ? tile.pitch : 1, first = GHOST * tile.pitch, cells = tile.n * tile.pitch, n = cells + step;
    for (unsigned f = 0; f < FIELDS; f++)
        if (used(f))
            faces(n + step, step, tile.w[f] + first - step, tile.low.w[f] + first - step,
                  tile.high.w[f] + first - step);
    void (*complete)(size_t, size_t, struct side *) = tile.n_material > 1 ? complete_two : complete_one;
    complete(first, n, &tile.low);
    complete(first - step, n, &tile.high);
    struct rows left = rows_of(&tile.high, first - step, axis), right = rows_of(&tile.low, first, axis);
    struct fluxes to = {tile.flux[U + axis] + first, tile.flux[V - axis] + first, tile.flux[P] + first,
                        tile.u_star + first, tile.carrier + first};
    hllc(n, &left, &right, &to);
    for (unsigned l = 0; l < tile.n_material; l++) {
        const double *high = tile.n_material > 1 ? tile.high.m[l] : tile.high.w[R0];
        const double *low = tile.n_material > 1 ? tile.low.m[l] : tile.low.w[R0];
        carry(n, high + first - step, low + first, to.u, to.carrier, tile.flux[R0 + l] + first);
    }
    for (unsigned l = 0; l < MATERIALS && tile.n_material > 1; l++)
        carry(n, tile.high.w[l] + first - step, tile.low.w[l] + first, to.u, to.u, tile.flux[l] + first);
    for (unsigned f = 0; f < FIELDS; f++)
        if (used(f)) apply(cells, step, factor, tile.flux[f] + first, tile.q[f] + first);
    if (tile.n_material > 1) diverge(cells, step, to.u, tile.div + first, axis == 0);
}

static void stage(double factor)
{
    sweep(0, factor);
    sweep(1, factor);
    size_t first = GHOST * tile.pitch, cells = tile.n * tile.pitch;
    if (tile.n_material > 1) primitives_two(first, cells, factor);
    else primitives_one(first, cells);
}

/* A gentle wave in a mixture, so that every branch is taken and nothing blows up. */
static void prepare(unsigned n_material, size_t n)
{
    memset(&tile, 0, sizeof tile);
    tile.n_material = n_material;
    tile.n = n;
    tile.pitch = n + 2 * GHOST;
    for (size_t i = 0; i < SIZE; i++) {
        double x = sin(0.7 * (double)(i % tile.pitch)), y = cos(0.5 * (double)(i / tile.pitch)), p = 1e5 + 1e3 * x;
        double share[MATERIALS] = {n_material > 1 ? 0.5 + 0.2 * x * y : 1.0}, density[] = {1000.0 + x, 1.2 + 0.1 * y};
        double rho = 0.0, inner = 0.0;
        share[1] = 1.0 - share[0];
        for (unsigned l = 0; l < n_material; l++) {
            tile.w[A0 + l][i] = tile.q[A0 + l][i] = share[l];
            tile.w[R0 + l][i] = density[l];
            tile.q[R0 + l][i] = share[l] * density[l];
            rho += share[l] * density[l];
            inner += share[l] * law_energy(l, p);
        }
        tile.w[U][i] = y, tile.w[V][i] = x, tile.w[P][i] = p;
        tile.q[U][i] = rho * y, tile.q[V][i] = rho * x;
        tile.q[P][i] = inner + 0.5 * rho * (x * x + y * y);
    }
}

static double now(void)
{
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

/* The least of several repeats [ns per cell-stage]: interruptions only add. */
static double measure(unsigned n_material, size_t n)
{
    enum { REPEATS = 200, STAGES = 50 };
    double best = 1e300;
    for (int repeat = 0; repeat < REPEATS; repeat++) {
        prepare(n_material, n);
        double start = now();
        for (int i = 0; i < STAGES; i++) stage(1e-5);
        best = least(best, now() - start);
        double p = tile.w[P][(GHOST + n / 2) * tile.pitch + GHOST + n / 2];
        if (!(p > 0.0 && p < 1e7)) fprintf(stderr, "kernels: the wave is no longer gentle: p = %g\n", p);
    }
    return 1e9 * best / (STAGES * (double)(n * n));
}

int main(void)
{
    static const size_t sizes[] = {16, 24, 32};
    double best[MATERIALS] = {1e300, 1e300};
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++)
        for (unsigned m = 1; m <= MATERIALS; m++) {
            double cost = measure(m, sizes[i]);
            fprintf(stderr, "%zu x %zu, %u material%s: %.1f ns\n", sizes[i], sizes[i], m, m > 1 ? "s" : "", cost);
            best[m - 1] = least(best[m - 1], cost);
        }
    printf("bare kernels: two materials 2D %.1f ns, one material 2D %.1f ns per cell-stage\n", best[1], best[0]);
    return 0;
}
