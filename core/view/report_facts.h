/* report_facts.h - what a run recorded about itself, as sections of a page. Files that are not there leave their
 * section out. */
#ifndef REPORT_FACTS_H
#define REPORT_FACTS_H

#include "base/text.h"

/* Title, about and cite of DIR/case.yaml. */
void report_facts_head(struct text *page, const char *directory);

/* Key figures of DIR/provenance.json. */
void report_facts_run(struct text *page, const char *directory);

/* Table of DIR/expect.json. */
void report_facts_expect(struct text *page, const char *directory);

/* The whole of DIR/case.yaml, folded. */
void report_facts_case(struct text *page, const char *directory);

#endif
