/* status.h - how failures travel: a code upwards, one clear message beside it.
 *
 * A function that can fail returns an int: 0, or one of the codes below, which are also the
 * exit codes of the program. The message is kept here until somebody at the top prints it;
 * library code never prints. assert() is for our mistakes, status for the world's. */
#ifndef STATUS_H
#define STATUS_H

enum status {
    STATUS_OK = 0,
    STATUS_EXPECT = 1,  /* an expectation or a test failed */
    STATUS_CASE = 2,    /* bad usage or bad case: nothing was run */
    STATUS_RUN = 3,     /* the run failed: unphysical state, resources, I/O */
    STATUS_STOPPED = 4, /* interrupted; what was there has been saved */
};

#define STATUS_CHECKED __attribute__((warn_unused_result))

/* Hands a failure on to the caller. */
#define TRY(call)                      \
    do {                               \
        int try_code = (call);         \
        if (try_code) return try_code; \
    } while (0)

/* Records a message (printf format; replaces the previous one) and returns `code`. */
int status_fail(int code, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* Puts a clause before the recorded message: "while writing x.hdf: " + message. Returns `code`. */
int status_wrap(int code, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* The last recorded message; "" if there is none. Valid until the next status call. */
const char *status_text(void);

#endif
