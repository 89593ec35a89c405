/* file.c - see file.h. A pipe is opened without waiting for its writer, so that it can be refused at once. */
#include "base/file.h"

#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

FILE *file_open(const char *path, const char **ret_why)
{
    struct stat about;
    int file = open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY);
    if (file < 0 || fstat(file, &about)) *ret_why = strerror(errno);
    else if (S_ISDIR(about.st_mode)) *ret_why = strerror(EISDIR);
    else if (!S_ISREG(about.st_mode)) *ret_why = "it is a pipe or a device, not a file";
    else {
        FILE *stream = fdopen(file, "rb");
        if (stream) return stream;
        *ret_why = strerror(errno);
    }
    if (file >= 0) close(file);
    return NULL;
}
