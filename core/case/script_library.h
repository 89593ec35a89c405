/* script_library.h - the functions that Lua scripts find under bulla.*. */
#ifndef SCRIPT_LIBRARY_H
#define SCRIPT_LIBRARY_H

#include <lua.h>

/* Pushes a new table with
 *   smooth(d, w)                        (1 - tanh(d / w)) / 2: 1 for d < 0 (inside), 0 for d > 0; a jump for w = 0
 *   sphere(x, y, z, cx, cy, cz, R)      signed distance, negative inside
 *   lithotripter(t, amplitude [, decay, frequency])   defaults 9.1e5 1/s, 83.3e3 Hz
 *   sine(t, amplitude, frequency [, cycles])
 *   gaussian(t, amplitude, centre, width)             gauge pressures, see waveform.h
 * May raise a Lua error (memory). */
void script_library_open(lua_State *lua);

#endif
