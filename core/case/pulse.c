/* pulse.c - see pulse.h. Times are shifted by the delay once; the formulas live in waveform.c. */
#include "case/pulse.h"

#include "base/mem.h"
#include "base/status.h"
#include "case/beam.h"
#include "case/waveform.h"

#include <math.h>

enum { PULSE_SUMS = 1000000 };

/* Index of the last sample at or before t; t lies within the series. */
static unsigned pulse_find(const struct scene_boundary *boundary, double t)
{
    unsigned low = 0, high = boundary->n_series - 1;
    while (high - low > 1) {
        unsigned middle = low + (high - low) / 2;
        if (boundary->series_t[middle] <= t) low = middle;
        else high = middle;
    }
    return low;
}

static double pulse_series(const struct scene_boundary *boundary, double t)
{
    const double *ts = boundary->series_t, *ps = boundary->series_p;
    unsigned n = boundary->n_series;
    if (n == 0 || t < ts[0] || t > ts[n - 1]) return 0.0;
    if (n == 1) return ps[0];
    unsigned i = pulse_find(boundary, t);
    double s = (t - ts[i]) / (ts[i + 1] - ts[i]);
    return ps[i] + s * (ps[i + 1] - ps[i]);
}

/* Does a series fall to 0 or below, having been above, before t? */
static bool pulse_series_over(const struct scene_boundary *boundary, double t)
{
    bool begun = false;
    for (unsigned i = 0; i < boundary->n_series && boundary->series_t[i] < t; i++) {
        if (boundary->series_p[i] > 0.0) begun = true;
        else if (begun) return true;
    }
    return false;
}

/* Is t past the first zero of the pulse? */
static bool pulse_over(const struct scene_boundary *boundary, double t)
{
    switch (boundary->pulse) {
    case SCENE_PULSE_LITHOTRIPTER: return 12.0 * boundary->frequency * t >= 1.0; /* omega t + pi/3 = pi/2 */
    case SCENE_PULSE_SINE: return 2.0 * boundary->frequency * t >= 1.0;
    case SCENE_PULSE_SERIES: return pulse_series_over(boundary, t);
    case SCENE_PULSE_GAUSSIAN:
    case SCENE_PULSE_SCRIPT: break;
    }
    return false;
}

static int pulse_value(const struct scene_boundary *boundary, double t, const double x[SCENE_AXES],
                       double *ret_pressure)
{
    const double in[4] = {t, x[0], x[1], x[2]};
    switch (boundary->pulse) {
    case SCENE_PULSE_LITHOTRIPTER:
        *ret_pressure = waveform_lithotripter(t, boundary->amplitude, boundary->decay, boundary->frequency);
        break;
    case SCENE_PULSE_SINE:
        *ret_pressure = waveform_sine(t, boundary->amplitude, boundary->frequency, boundary->cycles) *
                        waveform_window(t * boundary->frequency, boundary->cycles, (int)boundary->window);
        break;
    case SCENE_PULSE_GAUSSIAN:
        *ret_pressure = waveform_gaussian(t, boundary->amplitude, boundary->centre, boundary->width);
        break;
    case SCENE_PULSE_SERIES: *ret_pressure = pulse_series(boundary, t); break;
    case SCENE_PULSE_SCRIPT: return script_call(boundary->script, in, 4, ret_pressure, 1);
    }
    return STATUS_OK;
}

/* The pulse at a time from its beginning, before any beam. */
static int pulse_shape(const struct scene_boundary *boundary, double since, const double x[SCENE_AXES],
                       double *ret_pressure)
{
    double pressure = 0.0;
    TRY(pulse_value(boundary, since, x, &pressure));
    if (boundary->compressive_only && (pressure <= 0.0 || pulse_over(boundary, since))) pressure = 0.0;
    *ret_pressure = pressure;
    return STATUS_OK;
}

int pulse_pressure(const struct scene_boundary *boundary, double t, const double x[SCENE_AXES], double *ret_pressure)
{
    const struct beam_ray ray = beam_at(&boundary->beam, x);
    double delay = boundary->delay + ray.later;
    *ret_pressure = 0.0;
    if (delay > 0.0 && t - delay < 0.0) return STATUS_OK;
    TRY(pulse_shape(boundary, t - delay, x, ret_pressure));
    *ret_pressure *= ray.factor;
    return STATUS_OK;
}

/* Impulses, for waves to a focus */

/* A time within which a pulse hardly changes; 0: not known. */
static double pulse_grain(const struct scene_boundary *boundary)
{
    switch (boundary->pulse) {
    case SCENE_PULSE_LITHOTRIPTER: return 1.0 / (100.0 * (boundary->frequency + boundary->decay));
    case SCENE_PULSE_SINE: return 1.0 / (100.0 * boundary->frequency);
    case SCENE_PULSE_GAUSSIAN: return 0.02 * boundary->width;
    case SCENE_PULSE_SERIES:
        if (boundary->n_series < 2) break;
        return (boundary->series_t[boundary->n_series - 1] - boundary->series_t[0]) / boundary->n_series;
    case SCENE_PULSE_SCRIPT: break;
    }
    return 0.0;
}

void pulse_sum(struct scene_boundary *boundary, double until)
{
    const double nowhere[SCENE_AXES] = {0.0};
    double step = pulse_grain(boundary), most = until / PULSE_SUMS;
    if (!(step > 0.0)) return;
    boundary->sum_step = step = step < most ? most : step;
    boundary->n_sum = (unsigned)ceil(until / step) + 2;
    boundary->sum = mem_new(boundary->n_sum, sizeof *boundary->sum);
    for (unsigned i = 0; i + 1 < boundary->n_sum; i++) { /* Simpson */
        double at[3] = {0.0};
        for (int k = 0; k < 3; k++) (void)pulse_shape(boundary, step * (i + 0.5 * k), nowhere, &at[k]);
        boundary->sum[i + 1] = boundary->sum[i] + step / 6.0 * (at[0] + 4.0 * at[1] + at[2]);
    }
}

/* The integral of the pulse up to a time [Pa s]. */
static double pulse_impulse(const struct scene_boundary *boundary, double since)
{
    if (!boundary->sum || since <= 0.0) return 0.0;
    double s = since / boundary->sum_step, last = boundary->n_sum - 2.0;
    unsigned i = (unsigned)(s < last ? s : last);
    return boundary->sum[i] + (s - i) * (boundary->sum[i + 1] - boundary->sum[i]);
}

int pulse_entering(const struct scene_boundary *boundary, double t, const double x[SCENE_AXES], int axis, int side,
                   double *ret_pressure)
{
    TRY(pulse_pressure(boundary, t, x, ret_pressure));
    if (boundary->beam.path == SCENE_BEAM_NORMAL) return STATUS_OK;
    const struct beam_ray ray = beam_at(&boundary->beam, x);
    double cosine = side ? -ray.way[axis] : ray.way[axis];
    double lag = ray.factor * ray.near * pulse_impulse(boundary, t - boundary->delay - ray.later);
    *ret_pressure = 0.5 * (*ret_pressure + cosine * (*ret_pressure - lag));
    return STATUS_OK;
}
