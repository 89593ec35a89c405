/* waveform.c - see waveform.h. Pure formulas: no state, no scene. */
#include "case/waveform.h"

#include <math.h>

double waveform_lithotripter(double t, double amplitude, double decay, double frequency)
{
    if (t < 0.0) return 0.0;
    return 2.0 * amplitude * exp(-decay * t) * cos(2.0 * M_PI * frequency * t + M_PI / 3.0);
}

double waveform_sine(double t, double amplitude, double frequency, double cycles)
{
    if (t < 0.0 || (cycles > 0.0 && t * frequency > cycles)) return 0.0;
    return amplitude * sin(2.0 * M_PI * frequency * t);
}

double waveform_window(double s, double cycles, int window)
{
    const double taper = window == 1 ? 0.5 : 0.125; /* at each end, of all cycles */
    if (window == 0 || !(cycles > 0.0)) return 1.0;
    double end = s < cycles - s ? s : cycles - s, rise = end / (taper * cycles);
    if (rise >= 1.0) return 1.0;
    return rise > 0.0 ? 0.5 * (1.0 - cos(M_PI * rise)) : 0.0;
}

double waveform_gaussian(double t, double amplitude, double centre, double width)
{
    double s = (t - centre) / width;
    return amplitude * exp(-s * s);
}
