/* raster.h - regions given by an array of values: the pixels of an image, a scan, signed distances of another program.
 *
 * The array fills a box with equal parts, one value at the middle of each; between the middles values are interpolated
 * linearly along each axis, beyond the outermost ones they stay. The region is where the value is below 0, within the
 * box. Its surface is smooth where values are (a grey edge, a distance) and a chain of pixels where they jump.
 *
 * Shapes need a level that is never larger than the distance to the surface. Near it that is |value| / L, L the
 * steepest slope of the array; far from it a transform of distances to the parts that the surface runs through
 * (Felzenszwalb & Huttenlocher 2012, Theory of Computing 8, 415), less what a part can be off. */
#ifndef RASTER_H
#define RASTER_H

#include <stdbool.h>
#include <stddef.h>

struct raster {
    int dim;      /* axes of the array; what is left of the scene's is unbounded */
    size_t n[3];  /* 1 for axes that the array has not */
    float *value; /* [n[0]][n[1]][n[2]], below 0 inside */
    float *away;  /* the same shape: no nearer is the surface; < 0: it may be here. Made by raster_place */
    double lower[3], upper[3];
    double steepest; /* L */
};

enum { RASTER_VALUES = 1 << 28 };

/* Reads a PNG image: grey values from 0 (black) to 1, colours by their luminance, transparent pixels as white; the
 * first axis is along the rows, the second upwards. STATUS_CASE says what is wrong. Release with raster_done, also
 * after failure. */
int raster_read_image(const char *path, struct raster *ret_raster);

/* Reads a NumPy file (.npy) of 1 to 3 axes, [x][y][z], real or integer. As above. */
int raster_read_array(const char *path, struct raster *ret_raster);
void raster_done(struct raster *raster);

/* Puts the array into a box; values become sign (value - threshold). STATUS_CASE if none or all of them are inside. */
int raster_place(struct raster *raster, const double lower[3], const double upper[3], double threshold, double sign);

/* Signed level of a point, see shape.h. */
double raster_level(const struct raster *raster, const double x[3]);

#endif
