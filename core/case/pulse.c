/* pulse.c - see pulse.h. Times are shifted by the delay once; the formulas live in waveform.c. */
#include "case/pulse.h"

#include "base/status.h"
#include "case/waveform.h"

#include <math.h>

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
        *ret_pressure = waveform_sine(t, boundary->amplitude, boundary->frequency, boundary->cycles);
        break;
    case SCENE_PULSE_GAUSSIAN:
        *ret_pressure = waveform_gaussian(t, boundary->amplitude, boundary->centre, boundary->width);
        break;
    case SCENE_PULSE_SERIES: *ret_pressure = pulse_series(boundary, t); break;
    case SCENE_PULSE_SCRIPT: return script_call(boundary->script, in, 4, ret_pressure, 1);
    }
    return STATUS_OK;
}

int pulse_pressure(const struct scene_boundary *boundary, double t, const double x[SCENE_AXES], double *ret_pressure)
{
    double since = t - boundary->delay, pressure = 0.0;
    if (boundary->delay > 0.0 && since < 0.0) {
        *ret_pressure = 0.0;
        return STATUS_OK;
    }
    TRY(pulse_value(boundary, since, x, &pressure));
    if (boundary->compressive_only && (pressure <= 0.0 || pulse_over(boundary, since))) pressure = 0.0;
    *ret_pressure = pressure;
    return STATUS_OK;
}
