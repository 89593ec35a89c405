/* human.h - numbers as people read them: SI prefixes, durations, bytes. */
#ifndef HUMAN_H
#define HUMAN_H

enum { HUMAN_ROOM = 32 };

/* "432.1 ns", "1.5 us", "0 s": four digits, SI prefix; returns `text`, room for HUMAN_ROOM bytes. */
const char *human_si(double value, const char *unit, char text[HUMAN_ROOM]);

/* A number of things: "16384", "1.049 M", "2.66 G"; plain digits below 100 000. */
const char *human_count(double value, char text[HUMAN_ROOM]);

/* "0:42", "1:02:03", "3 d 04:05:06"; "-" if not finite. */
const char *human_duration(double seconds, char text[HUMAN_ROOM]);

/* "12.5 MiB". */
const char *human_bytes(double bytes, char text[HUMAN_ROOM]);

/* "HH:MM:SS", "MM:SS" or seconds into seconds; returns STATUS_CASE with a message if it is none. */
int human_read_duration(const char *text, double *ret_seconds);

/* "8 GiB", "500MB", "2G" (letters alone are powers of 1024) or a number of bytes; STATUS_CASE if it is none. */
int human_read_bytes(const char *text, double *ret_bytes);

#endif
