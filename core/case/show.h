/* show.h - a tree as YAML text: the resolved case, which reads back as the same tree. */
#ifndef SHOW_H
#define SHOW_H

#include "base/text.h"
#include "case/tree.h"

/* Appends a value as it stands in one line. */
void show_value(const struct node *node, struct text *text);

/* Appends the map `root` as a YAML document. */
void show_tree(const struct node *root, struct text *text);

#endif
