/* waveform.h - the formulas of the built-in pulses, as plain functions of time.
 *
 * Gauge pressure [Pa] of time [s]; used by the boundary pulses (pulse.h) and by Lua (bulla.*). */
#ifndef WAVEFORM_H
#define WAVEFORM_H

/* Extracorporeal lithotripter, Church 1989, J. Acoust. Soc. Am. 86, 215: 2 amplitude exp(-decay t)
 * cos(2 pi frequency t + pi/3) for t >= 0, 0 before; its peak at t = 0 is `amplitude`. */
double waveform_lithotripter(double t, double amplitude, double decay, double frequency);

/* amplitude sin(2 pi frequency t) for 0 <= t <= cycles / frequency (cycles 0: for ever), else 0. */
double waveform_sine(double t, double amplitude, double frequency, double cycles);

/* Of a burst, s periods after its beginning, in [0, 1]: window 0: 1; 1: Hann, half a cosine up and down over the whole;
 * 2: Tukey, over an eighth at each end. 1 if it never ends. */
double waveform_window(double s, double cycles, int window);

/* amplitude exp(-((t - centre) / width)^2). */
double waveform_gaussian(double t, double amplitude, double centre, double width);

#endif
