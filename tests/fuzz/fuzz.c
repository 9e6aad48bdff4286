#include "fuzz.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *folder;

/* Short stacks and a small quarantine: worlds come and go quickly here. */
const char *__asan_default_options(void);
const char *__asan_default_options(void) { return "malloc_context_size=8:quarantine_size_mb=32"; }

void fuzz_begin(int count, char **arguments)
{
    setenv("PBMPM_ISA", "sse4", 1);
    if (count == 3 && strcmp(arguments[1], "--seeds") == 0) folder = arguments[2];
}

void fuzz_ready(void)
{
    if (!folder) return;
    target_seeds();
    exit(0);
}

void fuzz_seed(const char *name, const void *data, size_t size)
{
    char path[4096];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *file = fopen(path, "wb");
    HOLDS(file && fwrite(data, 1, size, file) == size && fclose(file) == 0);
}

_Noreturn void fuzz_stop(const char *what, const char *file, int line)
{
    fprintf(stderr, "%s:%d: does not hold: %s; last error: %s\n", file, line, what, pbmpm_last_error());
    abort();
}

bool fuzz_chance(const uint8_t *data, size_t size, uint32_t of)
{
    uint32_t hash = 2166136261u;
    for (size_t i = 0; i < size; i++) hash = (hash ^ data[i]) * 16777619u;
    return (hash >> 8) % of == 0;
}

void bytes_take(Bytes *bytes, void *to, size_t size)
{
    const size_t there = size < bytes->left ? size : bytes->left;
    memset(to, 0, size);
    if (there) memcpy(to, bytes->data, there);
    bytes->data += there;
    bytes->left -= there;
}

uint8_t bytes_u8(Bytes *bytes)
{
    uint8_t value;
    bytes_take(bytes, &value, sizeof value);
    return value;
}

uint32_t bytes_u32(Bytes *bytes)
{
    uint32_t value;
    bytes_take(bytes, &value, sizeof value);
    return value;
}
