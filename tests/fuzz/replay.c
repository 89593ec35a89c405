/* replay.c - runs a fuzz target without libFuzzer: `fuzz-NAME FOLDER COUNT` tries every file of the folder, and of
 * each COUNT changed copies: bits flipped, pieces removed, repeated, taken from another file. The changes are the
 * same every time, so that what fails, fails again. An input that kills the program, or takes more than ten
 * seconds of processor time, is left in fuzz-failed.bin. */
#include <dirent.h>
#include <fcntl.h>
#include <signal.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/time.h>
#include <unistd.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

enum { REPLAY_ROOM = 1 << 20, REPLAY_SECONDS = 10, REPLAY_MEMORY = 256 /* MB */ };

static uint8_t replay_now[REPLAY_ROOM], replay_other[REPLAY_ROOM];
static size_t replay_size;
static uint64_t replay_seed = 88172645463325252u;
static char replay_failed[4096];

static void replay_keep(int number)
{
    int file = open(replay_failed, O_WRONLY | O_CREAT | O_TRUNC, 0644);
    if (file >= 0 && write(file, replay_now, replay_size) < 0) _exit(2);
    signal(number, SIG_DFL);
    raise(number);
}

/* A number below n (xorshift). */
static size_t replay_random(size_t n)
{
    replay_seed ^= replay_seed << 13;
    replay_seed ^= replay_seed >> 7;
    replay_seed ^= replay_seed << 17;
    return n ? (size_t)(replay_seed % n) : 0;
}

static size_t replay_load(const char *path, uint8_t *room)
{
    FILE *file = fopen(path, "rb");
    size_t size = file ? fread(room, 1, REPLAY_ROOM, file) : 0;
    if (file) fclose(file);
    return size;
}

/* SIGPROF after so many seconds of processor time; 0: never. */
static void replay_limit(long seconds)
{
    const struct itimerval limit = {.it_value.tv_sec = seconds};
    setitimer(ITIMER_PROF, &limit, NULL);
}

static void replay_run(void)
{
    replay_limit(REPLAY_SECONDS);
    LLVMFuzzerTestOneInput(replay_now, replay_size);
    replay_limit(0);
}

/* One change to the input. */
static void replay_change(size_t other)
{
    size_t at = replay_random(replay_size), length = replay_random(replay_size - at < 64 ? replay_size - at : 64);
    size_t room = REPLAY_ROOM - replay_size, from = replay_random(other);
    if (!replay_size) return;
    switch (replay_random(5)) {
    case 0: replay_now[at] ^= (uint8_t)(1u << replay_random(8)); return;
    case 1: replay_now[at] = (uint8_t)replay_random(256); return;
    case 2:
        memmove(replay_now + at, replay_now + at + length, replay_size - at - length);
        replay_size -= length;
        return;
    case 3:
        if (length > room) return;
        memmove(replay_now + at + length, replay_now + at, replay_size - at);
        replay_size += length;
        return;
    default:
        length = length < other - from ? length : other - from;
        if (length > replay_size - at) length = replay_size - at;
        memcpy(replay_now + at, replay_other + from, length);
    }
}

static long replay_file(const char *path, const char *partner, long count)
{
    size_t other = replay_load(partner, replay_other);
    for (long i = 0; i <= count; i++) {
        replay_size = replay_load(path, replay_now);
        for (size_t k = i ? 1 + replay_random(4) : 0; k > 0; k--) replay_change(other);
        replay_run();
    }
    return count + 1;
}

static int replay_wanted(const struct dirent *entry)
{
    return entry->d_name[0] != '.';
}

int main(int argc, char **argv)
{
    static const int fatal[] = {SIGSEGV, SIGBUS, SIGILL, SIGFPE, SIGABRT, SIGPROF};
    struct dirent **files = NULL;
    struct rusage usage;
    char *folder = argc == 3 ? realpath(argv[1], NULL) : NULL, path[4096], partner[4096];
    int n = folder ? scandir(folder, &files, replay_wanted, alphasort) : -1;
    long runs = 0;
    if (n < 1 || !getcwd(path, sizeof path - 32)) return fprintf(stderr, "usage: %s FOLDER COUNT\n", argv[0]), 2;
    snprintf(replay_failed, sizeof replay_failed, "%.4000s/fuzz-failed.bin", path);
    for (size_t i = 0; i < sizeof fatal / sizeof *fatal; i++) signal(fatal[i], replay_keep);
    for (int i = 0; i < n; i++) {
        snprintf(path, sizeof path, "%s/%s", folder, files[i]->d_name);
        snprintf(partner, sizeof partner, "%s/%s", folder, files[(i + 1) % n]->d_name);
        runs += replay_file(path, partner, strtol(argv[2], NULL, 10));
    }
    for (int i = 0; i < n; i++) free(files[i]);
    free(files);
    free(folder);
    getrusage(RUSAGE_SELF, &usage);
    printf("%ld inputs from %d files, at most %ld MB\n", runs, n, usage.ru_maxrss / 1024);
#if !defined(__SANITIZE_ADDRESS__)
    if (usage.ru_maxrss / 1024 > REPLAY_MEMORY) return fprintf(stderr, "more than %d MB\n", REPLAY_MEMORY), 1;
#endif
    return 0;
}
