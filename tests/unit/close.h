/* close.h - doubles in tests: equal to an absolute tolerance, with both values in the message. */
#ifndef CLOSE_H
#define CLOSE_H

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#define assert_close(value, wanted, tolerance) close_check((value), (wanted), (tolerance), __FILE__, __LINE__)

static inline void close_check(double value, double wanted, double tolerance, const char *file, int line)
{
    if (fabs(value - wanted) <= tolerance) return; /* NaN fails */
    print_error("%.17g is not %.17g to %.3g\n", value, wanted, tolerance);
    _fail(file, line);
}

#endif
