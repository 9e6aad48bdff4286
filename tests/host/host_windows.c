#include "host.h"

#include <malloc.h>
#include <windows.h>
#include <tlhelp32.h>

void *host_allocate(size_t size, size_t alignment) { return _aligned_malloc(size, alignment); }

void host_release(void *block) { _aligned_free(block); }

int host_thread_count(void)
{
    int count = 0;
    THREADENTRY32 thread = {.dwSize = sizeof thread};
    const HANDLE threads = CreateToolhelp32Snapshot(TH32CS_SNAPTHREAD, 0);
    for (BOOL any = Thread32First(threads, &thread); any; any = Thread32Next(threads, &thread)) count += thread.th32OwnerProcessID == GetCurrentProcessId();
    CloseHandle(threads);
    return count;
}

static VOID CALLBACK end(PVOID none, BOOLEAN fired)
{
    (void)none;
    (void)fired;
    TerminateProcess(GetCurrentProcess(), 1);
}

void host_end_after(unsigned seconds)
{
    static HANDLE timer;
    if (timer) (void)DeleteTimerQueueTimer(NULL, timer, NULL);
    timer = NULL;
    if (seconds) CreateTimerQueueTimer(&timer, NULL, end, NULL, seconds * 1000, 0, WT_EXECUTEONLYONCE);
}

void *host_load(const char *path) { return LoadLibraryA(path); }

void *host_find(void *library, const char *name) { return (void *)GetProcAddress(library, name); }

bool host_unload(void *library) { return FreeLibrary(library) != 0; }

bool host_has_loaded(const char *file_name) { return GetModuleHandleA(file_name) != NULL; }
