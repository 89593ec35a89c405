/* plot_option.h - what the command line of `bulla plot` asks for, checked. */
#ifndef PLOT_OPTION_H
#define PLOT_OPTION_H

#include "cli/cli.h"

#include <stdbool.h>

extern const struct cli_option *const plot_option_table[];

enum { PLOT_RANGES = 3, PLOT_TIMES = 8, PLOT_OVERS = 4, PLOT_ISOS = 4 };

enum plot_option_when { PLOT_LAST, PLOT_STEP, PLOT_TIME, PLOT_ALL };

struct plot_option_span {
    bool given;
    double lo, hi;
};

/* A surface on which a field has a value. */
struct plot_option_iso {
    char field[64];
    double value;
};

struct plot_option {
    const char *output; /* -o, or NULL */
    const char *movie;  /* --movie, or NULL */
    int pace;           /* of it [frames/s] */
    bool beside;        /* several runs in one picture */
    enum plot_option_when when;
    long step;
    unsigned n_time;
    double times[PLOT_TIMES]; /* --time, in the order given */
    unsigned n_over;
    const char *over[PLOT_OVERS]; /* --over: references of histories */
    bool sliced[3];               /* by axis */
    double slice[3];
    struct plot_option_span
        range[PLOT_RANGES];           /* values: of the fields of a picture in the order left, right, inside */
    struct plot_option_span limit[3]; /* x and y of the picture; in space x, y, z */
    bool log, mirror, tiles;
    const char *map;      /* or NULL: by field */
    const char *contours; /* list of materials, "none", or NULL: all */
    int width;            /* 0: by layout */
    const char *left, *right;
    char inside[64];          /* a material; "": none */
    const char *inside_field; /* what is shown in it */
    unsigned n_iso;           /* 0: pictures of planes and lines */
    struct plot_option_iso iso[PLOT_ISOS];
    double view[2]; /* azimuth and elevation of the viewer [degrees] */
};

/* Reads the options of a command line; what contradicts itself or is no number is STATUS_CASE. */
int plot_option_read(const struct cli_given *given, struct plot_option *ret_option);

/* One of several files of a command with one -o, in new memory: "x.png" of the pressure is "x_pressure.png". */
char *plot_option_file(const char *output, const char *field);

#endif
