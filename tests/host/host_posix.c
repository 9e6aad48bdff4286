#include "host.h"

#include <dirent.h>
#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

void *host_allocate(size_t size, size_t alignment) { return aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment); }

void host_release(void *block) { free(block); }

int host_thread_count(void)
{
    int count = 0;
    DIR *threads = opendir("/proc/self/task");
    for (const struct dirent *entry; threads && (entry = readdir(threads));) count += entry->d_name[0] != '.';
    if (threads) closedir(threads);
    return count;
}

void host_end_after(unsigned seconds) { alarm(seconds); }

void *host_load(const char *path) { return dlopen(path, RTLD_NOW | RTLD_LOCAL); }

void *host_find(void *library, const char *name) { return dlsym(library, name); }

bool host_unload(void *library) { return dlclose(library) == 0; }

bool host_has_loaded(const char *file_name)
{
    char line[1024];
    bool found = false;
    FILE *maps = fopen("/proc/self/maps", "r");
    while (maps && fgets(line, sizeof line, maps)) found = found || strstr(line, file_name) != NULL;
    if (maps) fclose(maps);
    return found;
}
