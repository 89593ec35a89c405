/* elastic_correct.c - what refluxing adds to the stretch of one coarse cell; see elastic.h.
 *
 * The stretch follows its material as V <- polar((1 + M) V), M what the change of the velocity gradient stretches it by
 * over the step. To first order polar takes a rotation off from the right: dV = M V - V W with the skew W that leaves
 * dV symmetric, V W + W V = M V - (M V)^T, which for the axial vectors is (tr V - V) w = z (Hoger & Carlson 1984,
 * Quart. Appl. Math. 42, 113). The mean of M V and its transpose would be right for V = 1 only: it turns a stretch half
 * as far as its material. */
#include "phys/elastic.h"

#include "phys/elastic_tensor.h"

#include <math.h>
#include <string.h>

typedef double correct_matrix[3][3];

static void elastic_correct_unpack(const struct model *model, const double *V, correct_matrix full)
{
    for (unsigned i = 0; i < 3; i++)
        for (unsigned j = 0; j < 3; j++) {
            unsigned c = elastic_component(i, j);
            full[i][j] = c < model->n_stretch ? V[c] : 0.0;
        }
}

/* Change of the velocity gradient, its trace taken off. Around the axis or the centre it is what div u has beside
 * it. */
static void elastic_correct_gradient(const struct model *model, const struct elastic_correction *in, correct_matrix M)
{
    memset(M, 0, sizeof(correct_matrix));
    for (unsigned i = 0; i < model->n_velocity; i++) M[i][in->axis] = in->velocity[i];
    if (model->beta && in->axis == 0) {
        double hoop = (-in->swept - in->velocity[0]) / model->beta;
        M[2][2] += hoop;
        if (model->beta == 2) M[1][1] += hoop;
    }
    double mean = (M[0][0] + M[1][1] + M[2][2]) / 3.0;
    for (int i = 0; i < 3; i++) M[i][i] -= mean;
}

/* Solves (tr V - V) w = z; 0 where V is none, as before the first step. */
static void elastic_correct_spin(const correct_matrix V, const double z[3], double w[3])
{
    double a = V[1][1] + V[2][2], b = V[0][0] + V[2][2], c = V[0][0] + V[1][1];
    double f = -V[0][1], g = -V[0][2], h = -V[1][2];
    double A = b * c - h * h, B = a * c - g * g, C = a * b - f * f;
    double F = g * h - f * c, G = f * h - g * b, H = f * g - h * a;
    double det = c * C + (2.0 * (f * (g * h)) - (a * h * h + b * g * g));
    det = det > 0.0 ? det : HUGE_VAL;
    w[0] = (A * z[0] + F * z[1] + G * z[2]) / det;
    w[1] = (F * z[0] + B * z[1] + H * z[2]) / det;
    w[2] = (G * z[0] + H * z[1] + C * z[2]) / det;
}

/* What the transport asks for, as far as det stays: a mean of stretches is put back to det 1 along the gradient of
 * det. */
static void elastic_correct_carried(const struct model *model, const struct elastic_correction *in, double *ret_dV)
{
    double V[6] = {0}, all = 0.0, along = 0.0;
    for (unsigned c = 0; c < model->n_stretch; c++) V[c] = in->V[c];
    struct elastic_tensor C = elastic_tensor_cofactors((struct elastic_tensor){V[0], V[1], V[2], V[3], V[4], V[5]});
    const double slope[6] = {C.xx, C.yy, C.zz, C.xy, C.xz, C.yz};
    for (unsigned c = 0; c < model->n_stretch; c++) {
        double weight = c < 3 ? 1.0 : 2.0;
        ret_dV[c] = in->carried[c] - in->V[c] * in->arrived;
        along += weight * (slope[c] * ret_dV[c]);
        all += weight * (slope[c] * slope[c]);
    }
    for (unsigned c = 0; all > 0.0 && c < model->n_stretch; c++) ret_dV[c] -= along / all * slope[c];
}

void elastic_correct(const struct model *model, const struct elastic_correction *in, double *ret_dV)
{
    correct_matrix V, M, P = {{0}};
    double w[3];
    elastic_correct_carried(model, in, ret_dV);
    elastic_correct_unpack(model, in->V, V);
    elastic_correct_gradient(model, in, M);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) P[i][j] = M[i][0] * V[0][j] + M[i][1] * V[1][j] + M[i][2] * V[2][j];
    elastic_correct_spin(V, (const double[]){P[2][1] - P[1][2], P[0][2] - P[2][0], P[1][0] - P[0][1]}, w);
    const correct_matrix W = {{0.0, -w[2], w[1]}, {w[2], 0.0, -w[0]}, {-w[1], w[0], 0.0}};
    for (unsigned i = 0; i < 3; i++)
        for (unsigned j = i; j < 3; j++) {
            unsigned c = elastic_component(i, j);
            if (c >= model->n_stretch) continue;
            double here = P[i][j] - (V[i][0] * W[0][j] + V[i][1] * W[1][j] + V[i][2] * W[2][j]);
            double there = P[j][i] - (V[j][0] * W[0][i] + V[j][1] * W[1][i] + V[j][2] * W[2][i]);
            ret_dV[c] += 0.5 * (here + there);
        }
}
