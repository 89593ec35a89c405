/* chunk.c - see chunk.h. Shuffle: all first bytes of the elements, then all second bytes, ...; deflate: a zlib
 * stream. Chunks are whole numbers of elements. */
#include "io/chunk.h"

#include "base/mem.h"

#include <string.h>
#include <zlib.h>

enum { CHUNK_LEVEL = 1, CHUNK_NO_DEFLATE = 1u << 1 }; /* deflate is the second filter */

static void chunk_shuffle(const unsigned char *in, size_t n, size_t element, unsigned char *out)
{
    size_t count = n / element;
    for (size_t byte = 0; byte < element; byte++)
        for (size_t i = 0; i < count; i++) out[byte * count + i] = in[i * element + byte];
}

size_t chunk_pack(const void *in, size_t n, size_t element, void *out, uint32_t *ret_skipped)
{
    unsigned char *shuffled = mem_new(n, 1);
    uLongf packed = n;
    chunk_shuffle(in, n, element, shuffled);
    *ret_skipped = 0;
    if (compress2(out, &packed, shuffled, n, CHUNK_LEVEL) != Z_OK) { /* it does not fit into n bytes */
        memcpy(out, shuffled, n);
        packed = n;
        *ret_skipped = CHUNK_NO_DEFLATE;
    }
    mem_free(shuffled);
    return packed;
}
