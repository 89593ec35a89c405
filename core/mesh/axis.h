/* axis.h - components of vectors as a face sees them: the normal one first. */
#ifndef AXIS_H
#define AXIS_H

/* Axis of space that component d of vectors at a face normal to `axis` stands for; component 0 is normal. */
static inline unsigned axis_component(int axis, unsigned d)
{
    return d == 0 ? (unsigned)axis : d <= (unsigned)axis ? d - 1 : d;
}

#endif
