/* script_library.h - the functions that Lua scripts find under bulla.*. */
#ifndef SCRIPT_LIBRARY_H
#define SCRIPT_LIBRARY_H

#include <lua.h>

/* Pushes a new table with
 *   smooth(d, w)                        from exactly 1 for d <= -1.875 w (inside) to exactly 0 for d >= 1.875 w, with
 *                                       continuous second derivatives and the slope of (1 - tanh(d / w)) / 2 at 0: with
 *                                       t = 1 - |d| / (1.875 w), t^3 (20 - 15 t + 3 t^2) / 16 outside and 1 - that
 *                                       inside; a jump for w = 0
 *   sphere(x, y, z, cx, cy, cz, R)      signed distance, negative inside
 *   lithotripter(t, amplitude [, decay, frequency])   defaults 9.1e5 1/s, 83.3e3 Hz
 *   sine(t, amplitude, frequency [, cycles])
 *   gaussian(t, amplitude, centre, width)             gauge pressures, see waveform.h
 * May raise a Lua error (memory). */
void script_library_open(lua_State *lua);

#endif
