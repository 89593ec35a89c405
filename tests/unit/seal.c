/* seal.c - a sealed file: every flipped bit and every cut is found, forged headers are refused, and what was
 * written wrongly is never sealed. */
#include "io/seal.h"

#include "base/status.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>
#include <xxhash.h>

enum { LENGTH = SEAL_BYTES + 600, FIRST = SEAL_BYTES + 50, SECOND = SEAL_BYTES + 300 };

static char path[64], whole[LENGTH];

static void write_bytes(const char *bytes, size_t length)
{
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(bytes, 1, length, file), length);
    assert_int_equal(fclose(file), 0);
}

/* A file of 600 numbers with two parts, 100 and 200 bytes long, and gaps around them; kept in `whole`. */
static int make(void **state)
{
    (void)state;
    struct seal seal = {.number = 7};
    snprintf(path, sizeof path, "/tmp/bulla-seal-XXXXXX");
    int made = mkstemp(path);
    if (made < 0 || close(made)) return 1;
    memset(whole, 0, sizeof whole);
    for (size_t i = SEAL_BYTES; i < LENGTH; i++) whole[i] = (char)(i * i >> 3);
    write_bytes(whole, LENGTH);
    seal_add(&seal, "/second", SECOND, 200, seal_hash(whole + SECOND, 200));
    seal_add(&seal, "/first", FIRST, 100, seal_hash(whole + FIRST, 100));
    assert_int_equal(seal_close(path, &seal), 0);
    FILE *file = fopen(path, "rb");
    assert_int_equal(fread(whole, 1, LENGTH, file), LENGTH);
    fclose(file);
    return 0;
}

static int drop(void **state)
{
    (void)state;
    return unlink(path);
}

static void parts_are_found_again(void **state)
{
    (void)state;
    struct seal seal;
    assert_true(seal_is(path));
    assert_int_equal(seal_check(path, &seal), 0);
    assert_true(seal.number == 7 && seal.n == 2 && seal.bytes == LENGTH);
    assert_string_equal(seal.parts[0].name, "/first");
    assert_true(seal_find(&seal, "/second")->offset == SECOND && seal_find(&seal, "/second")->length == 200);
    assert_null(seal_find(&seal, "/third"));
}

static void every_flipped_bit_is_found(void **state)
{
    (void)state;
    struct seal seal;
    char bytes[LENGTH];
    memcpy(bytes, whole, LENGTH);
    for (size_t i = 0; i < LENGTH; i++) {
        bytes[i] = (char)(bytes[i] ^ 1 << i % 8);
        write_bytes(bytes, LENGTH);
        assert_int_equal(seal_check(path, &seal), STATUS_RUN);
        assert_non_null(strstr(status_text(), i < 16 ? "not a checkpoint" : "damaged: the checksum of"));
        assert_null(strchr(status_text(), '\n'));
        bytes[i] = whole[i];
    }
}

static void every_cut_is_found(void **state)
{
    (void)state;
    struct seal seal;
    for (size_t length = 0; length < LENGTH; length += 37) {
        write_bytes(whole, length);
        assert_int_equal(seal_read(path, &seal), STATUS_RUN);
        assert_int_equal(seal_check(path, &seal), STATUS_RUN);
        assert_non_null(strstr(status_text(), "cut"));
    }
}

/* Writes a header with other numbers and a checksum that fits it. */
static void forge(size_t at, uint64_t value)
{
    char bytes[LENGTH];
    memcpy(bytes, whole, LENGTH);
    memcpy(bytes + at, &value, sizeof value);
    uint64_t hash = XXH64(bytes, SEAL_BYTES - sizeof hash, 0);
    memcpy(bytes + SEAL_BYTES - sizeof hash, &hash, sizeof hash);
    write_bytes(bytes, LENGTH);
}

static void forged_headers_are_refused(void **state)
{
    (void)state;
    /* FORMAT: the order of bytes and the format together */
    enum {
        FORMAT = 16,
        BYTES = 24,
        N = 48,
        PART = 56,
        OFFSET = SEAL_NAME,
        SIZE = SEAL_NAME + 8,
        STEP = SEAL_NAME + 24
    };
    struct seal seal;
    const struct {
        size_t at;
        uint64_t value;
        const char *said;
    } lies[] = {
        {FORMAT, (uint64_t)9 << 32 | 0x01020304, "a checkpoint of format 9; this version reads formats 1 to 2"},
        {FORMAT, (uint64_t)1 << 32 | 0x04030201, "another order of bytes"},
        {BYTES, 1 << 20, "it was cut or grew"},
        {BYTES, 0, "impossible"},
        {N, UINT64_MAX, "impossible"},
        {N, SEAL_MOST + 1, "impossible"},
        {PART + OFFSET, 0, "impossible"},
        {PART + OFFSET, UINT64_MAX - 8, "impossible"},
        {PART + SIZE, UINT64_MAX - 8, "impossible"},
        {PART + STEP + OFFSET, FIRST + 99, "impossible"},
        {PART + STEP + SIZE, 301, "impossible"},
    };
    for (size_t i = 0; i < sizeof lies / sizeof *lies; i++) {
        forge(lies[i].at, lies[i].value);
        assert_int_equal(seal_check(path, &seal), STATUS_RUN);
        if (!strstr(status_text(), lies[i].said)) print_error("%zu: %s\n", i, status_text());
        assert_non_null(strstr(status_text(), lies[i].said));
    }
}

/* What the disk gives back is compared with what was meant to be written. */
static void wrong_data_are_not_sealed(void **state)
{
    (void)state;
    struct seal seal = {.number = 1};
    memset(whole, 0, SEAL_BYTES);
    write_bytes(whole, LENGTH);
    seal_add(&seal, "/first", FIRST, 100, seal_hash(whole + FIRST, 100) + 1);
    assert_int_equal(seal_close(path, &seal), STATUS_RUN);
    assert_non_null(strstr(status_text(), "checksum of '/first' is wrong"));
    assert_false(seal_is(path));
}

static void other_files_are_refused(void **state)
{
    (void)state;
    struct seal seal;
    assert_int_equal(seal_check("/tmp", &seal), STATUS_RUN);
    assert_non_null(strstr(status_text(), "not a file"));
    assert_int_equal(seal_check("/tmp/bulla-nothing", &seal), STATUS_RUN);
    assert_non_null(strstr(status_text(), "No such file"));
    assert_false(seal_is("/tmp"));
    assert_int_equal(unlink(path), 0);
    assert_int_equal(mkfifo(path, 0600), 0); /* must not wait for a writer */
    assert_false(seal_is(path));
    assert_int_equal(seal_check(path, &seal), STATUS_RUN);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(parts_are_found_again, make, drop),
        cmocka_unit_test_setup_teardown(every_flipped_bit_is_found, make, drop),
        cmocka_unit_test_setup_teardown(every_cut_is_found, make, drop),
        cmocka_unit_test_setup_teardown(forged_headers_are_refused, make, drop),
        cmocka_unit_test_setup_teardown(wrong_data_are_not_sealed, make, drop),
        cmocka_unit_test_setup_teardown(other_files_are_refused, make, drop),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
