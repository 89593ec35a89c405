/* picture_space.h - surfaces and cuts in a box in space as a picture: parallel light, no perspective, so that lengths
 * along an axis can be compared anywhere in it.
 *
 * A ray for each quarter of a pixel looks for the first surface or cut; surfaces are lit from above the viewer's left
 * shoulder, cuts keep the colours of their scale. */
#ifndef PICTURE_SPACE_H
#define PICTURE_SPACE_H

#include "view/colormap.h"
#include "view/picture_scale.h"
#include "view/voxels.h"

#include <cairo.h>

enum { PICTURE_SPACE_SURFACES = 4, PICTURE_SPACE_CUTS = 3 };

struct picture_space_surface {
    const struct voxels *voxels;
    double level;
    uint32_t rgb; /* where no field colours it */
};

struct picture_space_cut {
    int axis;
    double at;
};

struct picture_space {
    const char *title, *note;
    struct picture_scale axis[3]; /* lo, hi: the box */
    double azimuth, elevation;    /* where the viewer is [degrees]: 0, 0 looks along y; 0, 90 from the end of z */
    unsigned n_surface, n_cut;
    struct picture_space_surface surface[PICTURE_SPACE_SURFACES];
    struct picture_space_cut cut[PICTURE_SPACE_CUTS];
    const struct voxels *field; /* colours cuts, or surfaces if there are no cuts; NULL: none */
    struct picture_scale scale;
    struct colormap map;
};

/* Draws on a new image surface, see picture_canvas_draw. */
int picture_space_draw(const struct picture_space *space, int width, cairo_surface_t **ret_image);

#endif
