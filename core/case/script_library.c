/* script_library.c - see script_library.h. Small C functions, so that common initial conditions
 * and boundary values need no Lua of their own and cost no more than a call. */
#include "case/script_library.h"

#include "case/waveform.h"

#include <lauxlib.h>
#include <math.h>

static const double script_library_reach = 1.875; /* half the width of the smooth step: the slope of tanh at 0 */

/* The step of degree 5, which ends: a tail like that of tanh would leave traces of a material in every cell around, and
 * a trace of gas takes the tension out of a liquid. Each half is computed from its own end, so that what is small there
 * is no difference of large numbers. */
static double script_library_step(double s)
{
    double t = s < 0.0 ? 1.0 + s : 1.0 - s; /* from the end, 0, to the middle, 1 */
    if (t <= 0.0) return s < 0.0 ? 1.0 : 0.0;
    double rest = 0.0625 * t * t * t * (20.0 + t * (3.0 * t - 15.0));
    return s < 0.0 ? 1.0 - rest : rest;
}

static int script_library_smooth(lua_State *lua)
{
    double d = luaL_checknumber(lua, 1), w = luaL_checknumber(lua, 2);
    if (w < 0.0) return luaL_argerror(lua, 2, "a width is not negative");
    double jump = d < 0.0 ? 1.0 : d > 0.0 ? 0.0 : 0.5;
    lua_pushnumber(lua, w > 0.0 ? script_library_step(d / (script_library_reach * w)) : jump);
    return 1;
}

static int script_library_sphere(lua_State *lua)
{
    double square = 0.0;
    for (int d = 1; d <= 3; d++) {
        double away = luaL_checknumber(lua, d) - luaL_checknumber(lua, d + 3);
        square += away * away;
    }
    lua_pushnumber(lua, sqrt(square) - luaL_checknumber(lua, 7));
    return 1;
}

static int script_library_lithotripter(lua_State *lua)
{
    lua_pushnumber(lua, waveform_lithotripter(luaL_checknumber(lua, 1), luaL_checknumber(lua, 2),
                                              luaL_optnumber(lua, 3, 9.1e5), luaL_optnumber(lua, 4, 83.3e3)));
    return 1;
}

static int script_library_sine(lua_State *lua)
{
    lua_pushnumber(lua, waveform_sine(luaL_checknumber(lua, 1), luaL_checknumber(lua, 2), luaL_checknumber(lua, 3),
                                      luaL_optnumber(lua, 4, 0.0)));
    return 1;
}

static int script_library_gaussian(lua_State *lua)
{
    lua_pushnumber(lua, waveform_gaussian(luaL_checknumber(lua, 1), luaL_checknumber(lua, 2), luaL_checknumber(lua, 3),
                                          luaL_checknumber(lua, 4)));
    return 1;
}

void script_library_open(lua_State *lua)
{
    static const luaL_Reg functions[] = {
        {"smooth", script_library_smooth},     {"sphere", script_library_sphere},
        {"sine", script_library_sine},         {"lithotripter", script_library_lithotripter},
        {"gaussian", script_library_gaussian}, {NULL, NULL},
    };
    luaL_newlib(lua, functions);
}
