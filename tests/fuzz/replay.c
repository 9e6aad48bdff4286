/* Runs a target once on each file it is given, and on all files of each folder: for compilers without libFuzzer. */
#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/stat.h>

#include "fuzz.h"

static int runs;

static void run_file(const char *path)
{
    FILE *file = fopen(path, "rb");
    HOLDS(file && fseek(file, 0, SEEK_END) == 0);
    const long size = ftell(file);
    HOLDS(size >= 0);
    rewind(file);
    uint8_t *data = malloc((size_t)size + 1);
    HOLDS(data && fread(data, 1, (size_t)size, file) == (size_t)size);
    fclose(file);
    printf("%s\n", path);
    fflush(stdout); /* the last line is the input that fails */
    LLVMFuzzerTestOneInput(data, (size_t)size);
    runs++;
    free(data);
}

static void run_folder(const char *path)
{
    char name[4096];
    DIR *folder = opendir(path);
    HOLDS(folder);
    for (const struct dirent *entry; (entry = readdir(folder));) {
        if (entry->d_name[0] == '.') continue;
        snprintf(name, sizeof name, "%s/%s", path, entry->d_name);
        run_file(name);
    }
    closedir(folder);
}

int main(int count, char **arguments)
{
    LLVMFuzzerInitialize(&count, &arguments);
    for (int i = 1; i < count; i++) {
        struct stat what;
        if (stat(arguments[i], &what)) continue; /* a corpus that is not there yet */
        if (S_ISDIR(what.st_mode)) run_folder(arguments[i]);
        else run_file(arguments[i]);
    }
    printf("%d inputs\n", runs);
    return runs == 0;
}
