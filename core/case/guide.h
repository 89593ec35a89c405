/* guide.h - all keys of a case file as a page to read, from the same tables that read cases. */
#ifndef GUIDE_H
#define GUIDE_H

/* Markdown, with the keys of all modules that are loaded; free with mem_free. The modules must
 * have been found (registry_init). */
char *guide_text(void);

#endif
