/* watch_page.h - the page itself: one text of HTML with its style and its script inside, made of the files in page/ by
 * the build. It holds nothing of any run: the script asks for that, as JSON, and puts it on the page as text. */
#ifndef WATCH_PAGE_H
#define WATCH_PAGE_H

/* Terminated. WATCH_PAGE_NONCE stands in it twice, for a nonce that belongs to one answer. */
extern const char watch_page_text[];

#define WATCH_PAGE_NONCE "@NONCE@"

#endif
