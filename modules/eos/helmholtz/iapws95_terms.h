/* iapws95_terms.h - water: the formulation IAPWS-95, coefficients of Wagner & Pruss, J. Phys. Chem. Ref. Data 31
 * (2002) 387-535, tables 6.1 and 6.2, as in IAPWS R6-95(2018). e = s = 0: saturated liquid at 273.16 K. */
#ifndef IAPWS95_TERMS_H
#define IAPWS95_TERMS_H

#include "helmholtz.h"

static const struct helmholtz_ideal iapws95_ideals[] = {
    {HELMHOLTZ_POWER, -8.32044648374970, 0.0},
    {HELMHOLTZ_POWER, 6.68321052759320, 1.0},
    {HELMHOLTZ_LOG, 3.00632, 0.0},
    {HELMHOLTZ_EINSTEIN, 0.012436, 1.28728967},
    {HELMHOLTZ_EINSTEIN, 0.97315, 3.53734222},
    {HELMHOLTZ_EINSTEIN, 1.27950, 7.74073708},
    {HELMHOLTZ_EINSTEIN, 0.96956, 9.24437796},
    {HELMHOLTZ_EINSTEIN, 0.24873, 27.5075105},
};

/* n, d, t, c; bells: alpha, beta, gamma, epsilon */
static const struct helmholtz_term iapws95_terms[] = {
    {0.012533547935523, 1, -0.5, 0, 0, 0, 0, 0},
    {7.8957634722828, 1, 0.875, 0, 0, 0, 0, 0},
    {-8.7803203303561, 1, 1.0, 0, 0, 0, 0, 0},
    {0.31802509345418, 2, 0.5, 0, 0, 0, 0, 0},
    {-0.26145533859358, 2, 0.75, 0, 0, 0, 0, 0},
    {-0.0078199751687981, 3, 0.375, 0, 0, 0, 0, 0},
    {0.0088089493102134, 4, 1.0, 0, 0, 0, 0, 0},
    {-0.66856572307965, 1, 4.0, 1, 0, 0, 0, 0},
    {0.20433810950965, 1, 6.0, 1, 0, 0, 0, 0},
    {-6.6212605039687e-05, 1, 12.0, 1, 0, 0, 0, 0},
    {-0.19232721156002, 2, 1.0, 1, 0, 0, 0, 0},
    {-0.25709043003438, 2, 5.0, 1, 0, 0, 0, 0},
    {0.16074868486251, 3, 4.0, 1, 0, 0, 0, 0},
    {-0.04009282892587, 4, 2.0, 1, 0, 0, 0, 0},
    {3.9343422603254e-07, 4, 13.0, 1, 0, 0, 0, 0},
    {-7.5941377088144e-06, 5, 9.0, 1, 0, 0, 0, 0},
    {0.00056250979351888, 7, 3.0, 1, 0, 0, 0, 0},
    {-1.5608652257135e-05, 9, 4.0, 1, 0, 0, 0, 0},
    {1.1537996422951e-09, 10, 11.0, 1, 0, 0, 0, 0},
    {3.6582165144204e-07, 11, 4.0, 1, 0, 0, 0, 0},
    {-1.3251180074668e-12, 13, 13.0, 1, 0, 0, 0, 0},
    {-6.2639586912454e-10, 15, 1.0, 1, 0, 0, 0, 0},
    {-0.10793600908932, 1, 7.0, 2, 0, 0, 0, 0},
    {0.017611491008752, 2, 1.0, 2, 0, 0, 0, 0},
    {0.22132295167546, 2, 9.0, 2, 0, 0, 0, 0},
    {-0.40247669763528, 2, 10.0, 2, 0, 0, 0, 0},
    {0.58083399985759, 3, 10.0, 2, 0, 0, 0, 0},
    {0.0049969146990806, 4, 3.0, 2, 0, 0, 0, 0},
    {-0.031358700712549, 4, 7.0, 2, 0, 0, 0, 0},
    {-0.74315929710341, 4, 10.0, 2, 0, 0, 0, 0},
    {0.4780732991548, 5, 10.0, 2, 0, 0, 0, 0},
    {0.020527940895948, 6, 6.0, 2, 0, 0, 0, 0},
    {-0.13636435110343, 6, 10.0, 2, 0, 0, 0, 0},
    {0.014180634400617, 7, 10.0, 2, 0, 0, 0, 0},
    {0.0083326504880713, 9, 1.0, 2, 0, 0, 0, 0},
    {-0.029052336009585, 9, 2.0, 2, 0, 0, 0, 0},
    {0.038615085574206, 9, 3.0, 2, 0, 0, 0, 0},
    {-0.020393486513704, 9, 4.0, 2, 0, 0, 0, 0},
    {-0.0016554050063734, 9, 8.0, 2, 0, 0, 0, 0},
    {0.0019955571979541, 10, 6.0, 2, 0, 0, 0, 0},
    {0.00015870308324157, 10, 9.0, 2, 0, 0, 0, 0},
    {-1.638856834253e-05, 12, 8.0, 2, 0, 0, 0, 0},
    {0.043613615723811, 3, 16.0, 3, 0, 0, 0, 0},
    {0.034994005463765, 4, 22.0, 3, 0, 0, 0, 0},
    {-0.076788197844621, 4, 23.0, 3, 0, 0, 0, 0},
    {0.022446277332006, 5, 23.0, 3, 0, 0, 0, 0},
    {-6.2689710414685e-05, 14, 10.0, 4, 0, 0, 0, 0},
    {-5.5711118565645e-10, 3, 50.0, 6, 0, 0, 0, 0},
    {-0.19905718354408, 6, 44.0, 6, 0, 0, 0, 0},
    {0.31777497330738, 6, 46.0, 6, 0, 0, 0, 0},
    {-0.11841182425981, 6, 50.0, 6, 0, 0, 0, 0},
    {-31.306260323435, 3, 0.0, 0, 20.0, 150.0, 1.21, 1.0},
    {31.546140237781, 3, 1.0, 0, 20.0, 150.0, 1.21, 1.0},
    {-2521.3154341695, 3, 4.0, 0, 20.0, 250.0, 1.25, 1.0},
};

/* Truncated series in (delta, theta) for the two critical terms: c[i][k] belongs to h_delta^i h_theta^k. */
struct iapws95_series {
    double c[HELMHOLTZ_R][HELMHOLTZ_L];
};

static inline struct iapws95_series iapws95_times(const struct iapws95_series *a, const struct iapws95_series *b)
{
    struct iapws95_series product = {{{0}}};
    for (int i = 0; i < HELMHOLTZ_R; i++)
        for (int k = 0; k < HELMHOLTZ_L; k++)
            for (int m = 0; m <= i; m++)
                for (int n = 0; n <= k; n++) product.c[i][k] += a->c[m][n] * b->c[i - m][k - n];
    return product;
}

/* F(series) from the Taylor coefficients of F at its constant; five powers are all there are. */
static inline struct iapws95_series iapws95_compose(struct iapws95_series inner, const double F[6])
{
    struct iapws95_series sum = {{{F[0]}}}, power = {{{1.0}}};
    inner.c[0][0] = 0.0;
    for (int order = 1; order < 6; order++) {
        power = iapws95_times(&power, &inner);
        for (int i = 0; i < HELMHOLTZ_R; i++)
            for (int k = 0; k < HELMHOLTZ_L; k++) sum.c[i][k] += F[order] * power.c[i][k];
    }
    return sum;
}

/* factor |y|^m as a series in delta, y = delta - 1, m > 2 */
static inline void iapws95_add_power(struct iapws95_series *sum, double factor, double y, double m)
{
    double size = fabs(y), sign = y < 0.0 ? -1.0 : 1.0;
    sum->c[0][0] += factor * pow(size, m);
    sum->c[1][0] += factor * m * sign * pow(size, m - 1.0);
    sum->c[2][0] += factor * 0.5 * m * (m - 1.0) * pow(size, m - 2.0);
}

/* n Delta^b delta psi with Delta = xi^2 + B y^(2a), xi = 1 - tau + A y^(1/beta), psi = exp(-C y^2 - D (tau - 1)^2) */
static inline void iapws95_critical_term(const double par[4], double delta, double theta,
                                         double phi[HELMHOLTZ_R][HELMHOLTZ_L])
{
    const double a = 3.5, A = 0.32, B = 0.2, beta = 0.3, n = par[0], b = par[1], C = par[2], D = par[3];
    double tau = exp(theta), y = delta - 1.0, far = C * y * y + D * (tau - 1.0) * (tau - 1.0);
    if (!(far < 100.0)) return;                                /* psi < 4e-44 */
    double up[HELMHOLTZ_L] = {tau, tau, tau / 2.0, tau / 6.0}; /* tau as a series in theta */
    struct iapws95_series xi = {{{0}}}, swing = {{{0}}};
    for (int k = 0; k < HELMHOLTZ_L; k++) {
        xi.c[0][k] = -up[k];
        swing.c[0][k] = up[k];
    }
    xi.c[0][0] += 1.0;
    swing.c[0][0] -= 1.0;
    iapws95_add_power(&xi, A, y, 1.0 / beta);
    struct iapws95_series distance = iapws95_times(&xi, &xi), fade = iapws95_times(&swing, &swing);
    iapws95_add_power(&distance, B, y, 2.0 * a);
    for (int i = 0; i < HELMHOLTZ_R; i++)
        for (int k = 0; k < HELMHOLTZ_L; k++) fade.c[i][k] *= -D;
    fade.c[0][0] = 0.0;
    fade.c[1][0] -= 2.0 * C * y;
    fade.c[2][0] -= C;
    double away = distance.c[0][0] > 1e-30 ? distance.c[0][0] : 1e-30, size = n * exp(-far);
    double power[6] = {pow(away, b)}, growth[6] = {size};
    for (int k = 1; k < 6; k++) {
        power[k] = power[k - 1] * (b - k + 1.0) / (k * away);
        growth[k] = growth[k - 1] / k;
    }
    struct iapws95_series root = iapws95_compose(distance, power), psi = iapws95_compose(fade, growth);
    struct iapws95_series line = {{{delta}, {1.0}}};
    struct iapws95_series term = iapws95_times(&root, &psi);
    term = iapws95_times(&term, &line);
    static const double factorial[HELMHOLTZ_L] = {1.0, 1.0, 2.0, 6.0};
    for (int i = 0; i < HELMHOLTZ_R; i++)
        for (int k = 0; k < HELMHOLTZ_L; k++) phi[i][k] += factorial[i] * factorial[k] * term.c[i][k];
}

static inline void iapws95_critical(double delta, double theta, double phi[HELMHOLTZ_R][HELMHOLTZ_L])
{
    iapws95_critical_term((const double[]){-0.14874640856724, 0.85, 28.0, 700.0}, delta, theta, phi);
    iapws95_critical_term((const double[]){0.31806110878444, 0.95, 32.0, 800.0}, delta, theta, phi);
}

static const struct helmholtz_fluid iapws95_fluid = {
    .R = 461.51805,
    .rho_c = 322.0,
    .T_c = 647.096,
    .terms = iapws95_terms,
    .ideals = iapws95_ideals,
    .n_term = sizeof iapws95_terms / sizeof *iapws95_terms,
    .n_ideal = sizeof iapws95_ideals / sizeof *iapws95_ideals,
    .critical = iapws95_critical,
};

#endif
