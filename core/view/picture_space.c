/* picture_space.c - see picture_space.h. */
#include "view/picture_space.h"

#include "base/mem.h"
#include "view/picture_axes.h"
#include "view/picture_canvas.h"
#include "view/picture_header.h"
#include "view/picture_text.h"

#include <math.h>
#include <string.h>

#define SPACE_MARGIN 9.0
#define SPACE_WIDE 360.0 /* of the box on the page, at most */
#define SPACE_TALL 330.0
#define SPACE_NUMBER 12.0 /* from an edge to its numbers, and to its label */
#define SPACE_LABEL 33.0
#define SPACE_ROOM 40.0 /* around the box for them */
#define SPACE_BAR 9.5
#define SPACE_BAR_GAP 14.0

enum { SPACE_RAYS = 2 }; /* along each side of a pixel */

static const struct picture_text picture_space_numbers = {8.5, false}, picture_space_labels = {9.5, false};

struct picture_space_plan {
    struct picture_space space;
    double right[3], up[3], out[3]; /* of the page, unit vectors; out: towards the viewer */
    double middle[3], domain[2][3];
    double zoom;             /* points per metre */
    struct picture_rect box; /* around the projected box */
    struct picture_header header;
    struct picture_bar bar;
    struct picture_rect bar_box;
};

static double picture_space_dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void picture_space_camera(struct picture_space_plan *plan)
{
    double az = plan->space.azimuth * M_PI / 180.0, el = plan->space.elevation * M_PI / 180.0;
    double right[3] = {cos(az), sin(az), 0.0}, out[3] = {cos(el) * sin(az), -cos(el) * cos(az), sin(el)};
    double up[3] = {-sin(el) * sin(az), sin(el) * cos(az), cos(el)};
    memcpy(plan->right, right, sizeof right);
    memcpy(plan->out, out, sizeof out);
    memcpy(plan->up, up, sizeof up);
    for (int k = 0; k < 3; k++) {
        plan->domain[0][k] = plan->space.axis[k].lo;
        plan->domain[1][k] = plan->space.axis[k].hi;
        plan->middle[k] = 0.5 * (plan->domain[0][k] + plan->domain[1][k]);
    }
}

/* On the page [points]. */
static void picture_space_project(const struct picture_space_plan *plan, const double x[3], double ret_at[2])
{
    double from[3] = {x[0] - plan->middle[0], x[1] - plan->middle[1], x[2] - plan->middle[2]};
    ret_at[0] = plan->box.x + 0.5 * plan->box.w + plan->zoom * picture_space_dot(from, plan->right);
    ret_at[1] = plan->box.y + 0.5 * plan->box.h - plan->zoom * picture_space_dot(from, plan->up);
}

/* Corner number c of the box: bit k says which side along axis k. */
static void picture_space_corner(const struct picture_space_plan *plan, int c, double ret_x[3])
{
    for (int k = 0; k < 3; k++) ret_x[k] = plan->domain[c >> k & 1][k];
}

/* Half the size of the box as the viewer sees it [m]. */
static void picture_space_extent(const struct picture_space_plan *plan, double ret_half[2])
{
    ret_half[0] = ret_half[1] = 0.0;
    for (int k = 0; k < 3; k++) {
        double half = 0.5 * (plan->domain[1][k] - plan->domain[0][k]);
        ret_half[0] += half * fabs(plan->right[k]);
        ret_half[1] += half * fabs(plan->up[k]);
    }
}

/* --- the edges with numbers --- */

struct picture_space_edge {
    double from[3], to[3];
    double outward[2]; /* on the page, unit */
};

/* Of the four edges along an axis the one with numbers: at the foot of the picture, for the upright axis on its
 * left. */
static void picture_space_pick(const struct picture_space_plan *plan, int axis, struct picture_space_edge *ret_edge)
{
    double best = -INFINITY;
    for (int c = 0; c < 8; c++) {
        double from[3], to[3], a[2], b[2];
        if (c >> axis & 1) continue;
        picture_space_corner(plan, c, from);
        picture_space_corner(plan, c | 1 << axis, to);
        picture_space_project(plan, from, a);
        picture_space_project(plan, to, b);
        double middle[2] = {0.5 * (a[0] + b[0]) - (plan->box.x + 0.5 * plan->box.w),
                            0.5 * (a[1] + b[1]) - (plan->box.y + 0.5 * plan->box.h)};
        double rank = axis == 2 ? -middle[0] + 1e-3 * middle[1] : middle[1] - 1e-3 * fabs(middle[0]);
        if (rank <= best) continue;
        best = rank;
        memcpy(ret_edge->from, from, sizeof from);
        memcpy(ret_edge->to, to, sizeof to);
        double length = hypot(b[0] - a[0], b[1] - a[1]);
        double normal[2] = {length > 0.0 ? (b[1] - a[1]) / length : 0.0, length > 0.0 ? (a[0] - b[0]) / length : 1.0};
        double sign = normal[0] * middle[0] + normal[1] * middle[1] < 0.0 ? -1.0 : 1.0;
        for (int i = 0; i < 2; i++) ret_edge->outward[i] = sign * normal[i];
    }
}

static double picture_space_length(const struct picture_space_plan *plan, int axis)
{
    return plan->zoom * (plan->domain[1][axis] - plan->domain[0][axis]) * hypot(plan->right[axis], plan->up[axis]);
}

static void picture_space_text(cairo_t *cr, struct picture_text font, const double at[2], const double outward[2],
                               double distance, const char *text)
{
    double place[2] = {at[0] + distance * outward[0],
                       at[1] + distance * outward[1] + 0.5 * PICTURE_TEXT_HEIGHT * font.size};
    picture_text_draw(cr, font, place, 0.5 - 0.5 * outward[0], text);
}

static void picture_space_axis(cairo_t *cr, const struct picture_space_plan *plan, int axis)
{
    const struct picture_scale *scale = &plan->space.axis[axis];
    struct picture_space_edge edge = {0};
    double at[2], x[3];
    if (picture_space_length(plan, axis) < 25.0) return; /* it points at the viewer */
    picture_space_pick(plan, axis, &edge);
    cairo_set_source_rgb(cr, 0.0, 0.0, 0.0);
    cairo_set_line_width(cr, 0.7);
    for (unsigned i = 0; i < scale->n_tick; i++) {
        double part = picture_scale_at(scale, scale->tick[i]);
        for (int k = 0; k < 3; k++) x[k] = edge.from[k] + part * (edge.to[k] - edge.from[k]);
        picture_space_project(plan, x, at);
        cairo_move_to(cr, at[0], at[1]);
        cairo_rel_line_to(cr, 3.5 * edge.outward[0], 3.5 * edge.outward[1]);
        cairo_stroke(cr);
        picture_space_text(cr, picture_space_numbers, at, edge.outward, SPACE_NUMBER - 4.0 * fabs(edge.outward[0]),
                           scale->text[i]);
    }
    for (int k = 0; k < 3; k++) x[k] = 0.5 * (edge.from[k] + edge.to[k]);
    picture_space_project(plan, x, at);
    if (fabs(edge.outward[0]) > 0.9) { /* upright: the label reads upwards, beyond the numbers */
        double out = 0.0;
        for (unsigned i = 0; i < scale->n_tick; i++)
            out = fmax(out, picture_text_width(cr, picture_space_numbers, scale->text[i]));
        double place[2] = {at[0] + edge.outward[0] * (out + 14.0), at[1]};
        picture_text_draw_up(cr, picture_space_labels, place, scale->label);
        return;
    }
    picture_space_text(cr, picture_space_labels, at, edge.outward, SPACE_LABEL, scale->label);
}

/* Edges of the box that end in its corner nearest to the viewer, or all others. */
static void picture_space_frame(cairo_t *cr, const struct picture_space_plan *plan, bool front)
{
    int nearest = 0;
    for (int k = 0; k < 3; k++) nearest |= (plan->out[k] > 0.0) << k;
    cairo_set_source_rgba(cr, 0.0, 0.0, 0.0, front ? 0.35 : 0.55);
    cairo_set_line_width(cr, 0.6);
    for (int c = 0; c < 8; c++)
        for (int k = 0; k < 3; k++) {
            int other = c | 1 << k;
            if (other == c || (c == nearest || other == nearest) != front) continue;
            double x[3], at[2];
            picture_space_corner(plan, c, x);
            picture_space_project(plan, x, at);
            cairo_move_to(cr, at[0], at[1]);
            picture_space_corner(plan, other, x);
            picture_space_project(plan, x, at);
            cairo_line_to(cr, at[0], at[1]);
            cairo_stroke(cr);
        }
}

/* --- rays --- */

/* Red, green, blue in [0, 1] and how much of a ray they cover. */
struct picture_space_light {
    double rgb[3], cover;
};

static void picture_space_rgb(uint32_t color, double ret_rgb[3])
{
    for (int i = 0; i < 3; i++) ret_rgb[i] = (double)(color >> (16 - 8 * i) & 0xff) / 255.0;
}

/* Soft light from the left above, a little of it from everywhere, and a gleam (Blinn, SIGGRAPH 1977). */
static void picture_space_shade(const struct picture_space_plan *plan, double normal[3], double rgb[3])
{
    double light[3], half[3], size = 0.0;
    if (picture_space_dot(normal, plan->out) < 0.0)
        for (int k = 0; k < 3; k++) normal[k] = -normal[k];
    for (int k = 0; k < 3; k++) light[k] = plan->out[k] - 0.55 * plan->right[k] + 0.65 * plan->up[k];
    double length = sqrt(picture_space_dot(light, light));
    for (int k = 0; k < 3; k++) {
        light[k] /= length;
        half[k] = light[k] + plan->out[k];
        size += half[k] * half[k];
    }
    double lit = fmax(picture_space_dot(normal, light), 0.0);
    double gleam = 0.22 * pow(fmax(picture_space_dot(normal, half), 0.0) / sqrt(size), 40.0);
    for (int i = 0; i < 3; i++) rgb[i] = fmin(rgb[i] * (0.38 + 0.68 * lit) + gleam, 1.0);
}

static void picture_space_color(const struct picture_space *space, const double x[3], double ret_rgb[3])
{
    double shade = picture_scale_at(&space->scale, voxels_at(space->field, x));
    picture_space_rgb(isnan(shade) ? 0xffd0d0d0u : colormap_at(&space->map, shade), ret_rgb);
}

/* The nearest surface within `span`, which ends there. */
static void picture_space_surfaces(const struct picture_space_plan *plan, const double from[3], const double along[3],
                                   double span[2], struct picture_space_light *light)
{
    const struct picture_space *space = &plan->space;
    for (unsigned i = 0; i < space->n_surface; i++) {
        const struct picture_space_surface *surface = &space->surface[i];
        double t, normal[3], x[3];
        if (!voxels_hit(surface->voxels, surface->level, from, along, span, &t, normal)) continue;
        for (int k = 0; k < 3; k++) x[k] = from[k] + t * along[k];
        if (space->field && !space->n_cut) picture_space_color(space, x, light->rgb);
        else picture_space_rgb(surface->rgb, light->rgb);
        picture_space_shade(plan, normal, light->rgb);
        light->cover = 1.0;
        span[1] = t;
    }
}

static void picture_space_cuts(const struct picture_space_plan *plan, const double from[3], const double along[3],
                               double span[2], struct picture_space_light *light)
{
    const struct picture_space *space = &plan->space;
    for (unsigned i = 0; i < space->n_cut; i++) {
        const struct picture_space_cut *cut = &space->cut[i];
        double t = fabs(along[cut->axis]) > 1e-9 ? (cut->at - from[cut->axis]) / along[cut->axis] : INFINITY, x[3];
        if (!(t >= span[0] && t <= span[1])) continue;
        for (int k = 0; k < 3; k++) x[k] = from[k] + t * along[k];
        if (isnan(voxels_at(space->field, x))) continue;
        picture_space_color(space, x, light->rgb);
        light->cover = 1.0;
        span[1] = t;
    }
}

/* What a ray through a point of the page meets. */
static struct picture_space_light picture_space_look(const struct picture_space_plan *plan, double px, double py)
{
    struct picture_space_light light = {0};
    double from[3], along[3], span[2];
    double u = (px - plan->box.x - 0.5 * plan->box.w) / plan->zoom,
           v = (plan->box.y + 0.5 * plan->box.h - py) / plan->zoom;
    for (int k = 0; k < 3; k++) {
        from[k] = plan->middle[k] + u * plan->right[k] + v * plan->up[k];
        along[k] = -plan->out[k];
    }
    if (!voxels_clip(plan->domain, from, along, &span[0], &span[1])) return light;
    if (plan->space.n_cut) picture_space_cuts(plan, from, along, span, &light);
    picture_space_surfaces(plan, from, along, span, &light);
    return light;
}

/* A pixel, from several rays: as cairo stores it, colours times cover. */
static uint32_t picture_space_pixel(const struct picture_space_plan *plan, double x, double y, double scale)
{
    double sum[4] = {0.0};
    uint32_t pixel = 0;
    for (int j = 0; j < SPACE_RAYS; j++)
        for (int i = 0; i < SPACE_RAYS; i++) {
            struct picture_space_light light =
                picture_space_look(plan, (x + (i + 0.5) / SPACE_RAYS) / scale, (y + (j + 0.5) / SPACE_RAYS) / scale);
            sum[0] += light.cover;
            for (int k = 0; k < 3; k++) sum[k + 1] += light.rgb[k] * light.cover;
        }
    for (int k = 0; k < 4; k++) pixel |= (uint32_t)lround(255.0 * sum[k] / (SPACE_RAYS * SPACE_RAYS)) << (24 - 8 * k);
    return pixel;
}

static void picture_space_cast(cairo_t *cr, const struct picture_space_plan *plan, double scale)
{
    int left = (int)floor(plan->box.x * scale), top = (int)floor(plan->box.y * scale);
    int width = (int)ceil(plan->box.w * scale) + 1, height = (int)ceil(plan->box.h * scale) + 1;
    cairo_surface_t *image = cairo_image_surface_create(CAIRO_FORMAT_ARGB32, width, height);
    unsigned char *bytes = cairo_image_surface_get_data(image);
    for (int j = 0; bytes && j < height; j++) {
        uint32_t *row = (uint32_t *)(void *)(bytes + (ptrdiff_t)j * cairo_image_surface_get_stride(image));
        for (int i = 0; i < width; i++) row[i] = picture_space_pixel(plan, left + i, top + j, scale);
    }
    cairo_surface_mark_dirty(image);
    cairo_save(cr);
    cairo_identity_matrix(cr);
    cairo_set_source_surface(cr, image, left, top);
    cairo_paint(cr);
    cairo_restore(cr);
    cairo_surface_destroy(image);
}

/* --- the page --- */

static void picture_space_page(cairo_t *cr, void *data, double ret_size[2])
{
    struct picture_space_plan *plan = data;
    double half[2];
    picture_space_camera(plan);
    picture_space_extent(plan, half);
    plan->zoom = fmin(0.5 * SPACE_WIDE / half[0], 0.5 * SPACE_TALL / half[1]);
    plan->box =
        (struct picture_rect){SPACE_MARGIN + SPACE_ROOM, 0.0, 2.0 * half[0] * plan->zoom, 2.0 * half[1] * plan->zoom};
    for (int k = 0; k < 3; k++) picture_axes_fit(cr, &plan->space.axis[k], picture_space_length(plan, k), true);
    double right = SPACE_ROOM;
    if (plan->space.field) {
        plan->bar = (struct picture_bar){.scale = &plan->space.scale, .map = &plan->space.map, .upright = true};
        picture_axes_fit(cr, &plan->space.scale, 0.7 * plan->box.h, true);
        right = SPACE_BAR_GAP + SPACE_BAR + picture_axes_bar_room(cr, &plan->bar);
    }
    double width = plan->box.x + plan->box.w + right + SPACE_MARGIN;
    plan->header =
        (struct picture_header){.title = plan->space.title, .note = plan->space.note, .box_width = plan->box.w};
    width += picture_header_plan(cr, &plan->header, width - 2.0 * SPACE_MARGIN);
    plan->box.y = SPACE_MARGIN + plan->header.height + 4.0;
    plan->bar_box = (struct picture_rect){plan->box.x + plan->box.w + SPACE_BAR_GAP, plan->box.y + 0.15 * plan->box.h,
                                          SPACE_BAR, 0.7 * plan->box.h};
    ret_size[0] = width;
    ret_size[1] = plan->box.y + plan->box.h + SPACE_ROOM + SPACE_MARGIN;
}

static void picture_space_paint(cairo_t *cr, void *data, double scale)
{
    struct picture_space_plan *plan = data;
    picture_space_frame(cr, plan, false);
    picture_space_cast(cr, plan, scale);
    picture_space_frame(cr, plan, true);
    for (int k = 0; k < 3; k++) picture_space_axis(cr, plan, k);
    if (plan->space.field) picture_axes_bar(cr, plan->bar_box, &plan->bar);
    picture_header_draw(cr, &plan->header, SPACE_MARGIN, SPACE_MARGIN);
}

int picture_space_draw(const struct picture_space *space, int width, cairo_surface_t **ret_image)
{
    struct picture_space_plan plan = {.space = *space};
    return picture_canvas_draw(&(struct picture_canvas){picture_space_page, picture_space_paint, &plan}, width,
                               ret_image);
}
